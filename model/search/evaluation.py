"""How routes of a type are timed and priced, by the rules that are stated."""

import numpy as np

from model.engine.drone_types import any_aboard
from model.engine.instance import FAR, Instance
from model.engine.library import dtype_of
from model.engine.records import Records
from model.engine.type_rows import NO_PROFILE, WORK_RATES
from model.problem import UNLIMITED, BoolArray


def evaluate(instance: Instance) -> Records:
    """Return how routes are evaluated, (row,) as `tandem_evaluation` says, of a packed problem.

    `docs/develop/by-problem.md` has a table of what each rule does.
    """
    place, types, rates = instance.node[0], instance.type[0], instance.rate[0]
    hourly, early, once = (bool((instance.price[0][name] > 0).any())
                           for name in ("lateness", "waiting", "late"))
    soft = bool((place["arrival_limit"] == FAR).any()) and (hourly or once)
    costly = np.any([rates[name] > 0 for name in WORK_RATES], axis=0)
    rests = types["must_rest"] > 0
    timed = costly | (types["max_working_duration"] < UNLIMITED) | rests
    retimed = (types["speed_changes"] != NO_PROFILE) | (types["breaks"] > 0)
    flies = types["flies"] > 0
    lagging = instance.lag.shape[1] > 0
    awaited = (types["charge"] > 0) | (types["storms"] > 0)
    retimed = retimed | any_aboard(types, awaited & ((types["drones"] > 0) | flies)) | lagging
    if place.shape[2] > 1:
        # What is known of later arrivals holds within the windows that they are served in.
        retimed = retimed | timed | soft | early | (types["drones"] > 0)
    # What may last too long, or take too much of a battery, as far as it isn't drones' alone.
    bound = flies & ((types["endurance"] < UNLIMITED) | (types["points"] > 0))
    lasting = _may_wait(instance, bound)
    limited = lasting | bool(instance.max_time_aboard.shape[1])
    held_back = early | ((retimed | limited) & timed) | lagging
    release = bool((place["release"] > 0).any())
    priced = soft | limited | held_back | retimed | (rates["load"] > 0)
    # So is what it drives in all, though nothing is held back for that.
    timed = timed | (np.minimum(types["max_travel_duration"], types["max_distance"]) < UNLIMITED)
    # How long a vehicle works at no cost is looked at everywhere if its one trip waits for nothing.
    free = ~costly & (types["max_trips"] == 1) & (types["drones"] == 0)
    by_detour = ~(timed if release else timed & ~free) & ~priced & ~bound & ~rests
    apart = instance.goods.shape[1] > 0
    farther = types["max_trip_distance"] < UNLIMITED
    paired = instance.pair.shape[1] > 0
    differ = instance.vehicle_cost.shape[2] > 0
    by_distance = (by_detour & ~(timed | release | apart | farther | paired | differ)
                   & (types["max_trips"] == 1) & (types["drones"] == 0) & ~flies)
    evaluation = np.zeros(len(types), dtype_of("tandem_evaluation"))
    for name, told in (("timed", timed), ("priced", priced), ("held_back", held_back),
                       ("retimed", retimed), ("lasting", lasting), ("by_detour", by_detour),
                       ("by_distance", by_distance)):
        evaluation[name] = told
    return evaluation


def _may_wait(instance: Instance, bound: BoolArray) -> BoolArray:
    """Return whose trips may have to wait so that nothing lasts too long, (row,); `bound` whose are
    in the air so long at most.
    """
    place = instance.node[0]
    waits = bool((place["window_earliest"] > 0).any()) or place.shape[2] > 1
    aboard, between = bool(instance.max_time_aboard.shape[1]), bool(instance.max_between.shape[2])
    return between | ((aboard | bound) & waits)
