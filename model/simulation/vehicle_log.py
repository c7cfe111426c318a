"""Compiled timing of one vehicle's route: as soon as possible, and how late it may depart.

A vehicle log lists what one vehicle does: trips, their stops, its sorties, and the launches and
recoveries at each stop in order. `replay` times it; `latest_start` finds the latest beginning of a
trip that costs nothing elsewhere.
"""

from typing import NamedTuple

import numpy as np

from model.kernel.clock import leg_end, setup_beside
from model.kernel.compiled import compiled, inlined, pasted
from model.kernel.drone_types import are_several
from model.kernel.energy import battery_of, charged, charges_aboard, first_charge
from model.kernel.flight import (
    charged_launch, held_takeoff, launch_begin, left_after, recovery_end, take_off, takes_no_time,
    within_endurance,
)
from model.kernel.instance import FAR, Instance
from model.kernel.leg import lookup, matrices_of, matrix_among, matrix_of
from model.kernel.load import excess_aboard, some_limited
from model.kernel.records import Record, Records, record
from model.kernel.start import counted_from, has_begun, leaves_first
from model.kernel.stop import (
    as_late, end_of_service, in_same_window, places_by_air, places_of, start_of_service, too_late,
)
from model.problem import BoolArray, IntArray

LOGGED_STOP = record("node", "arrival", "start", "leave")
LOGGED_TRIP = record("first_stop", "first_op", "release", "start")
OPERATION = record("stop", "sortie", "is_recovery")
LOGGED_SORTIE = record(
    "drone", "row", "node", "launch_stop", "recovery_stop", "takeoff", "arrival", "start", "ready",
    "recovery_start", "recovery_end", "left", "trial_takeoff", "trial_ready", "trial_end",
    "trial_left")
"""The drone's TYPE is at its row. Its recovery stop is IN_FLIGHT until it is recovered. Where it is
charged aboard: what is left of its battery, of a trial as it is launched and then recovered."""
LENGTHS = record("trips", "stops", "ops", "sorties")
"""How many of each there are."""

IN_FLIGHT = -1


class Craft(NamedTuple):
    """What a type of drones meets."""

    type: Record  # TYPE
    node: Records  # (node, row) NODE
    out: IntArray  # (node, node) ms
    home: IntArray  # (node, node) ms, to where the truck is


class Setting(NamedTuple):
    """What one vehicle type meets in one problem: views into an `Instance`.

    What is said of drones holds where they are of one type, else `craft_of` tells.
    """

    node: Records  # (node, row) NODE
    node_by_air: Records  # (node, row) NODE, as drones meet them
    amount: IntArray  # (node, tier, AMOUNTS); no tiers where `NODE.demand` tells all
    goods: Records  # (node,) GOODS, none where all go together
    fresh_for: IntArray  # (node,) ms, none where nothing is limited
    type: Record  # TYPE
    drive: IntArray  # (node, node) ms
    fly: IntArray  # (node, node) ms
    fly_home: IntArray  # (node, node) ms, to where the truck is
    setup: Records  # (node,) SETUP, none where nobody sets up
    profile_time: IntArray  # (change,)
    profile_factor: IntArray  # (change + 1,)
    types: Records  # (row,) TYPE
    nodes: Records  # (variant, node, row) NODE
    durations: IntArray  # (travel, node, node) ms
    can_fly: BoolArray  # (row, node)


class VehicleLog(NamedTuple):
    """What a vehicle does, in order; in a `State`, with a leading axis of rollouts."""

    count: Record  # LENGTHS
    trip: Records  # (trip,) LOGGED_TRIP
    stop: Records  # (stop,) LOGGED_STOP
    op: Records  # (op,) OPERATION
    sortie: Records  # (sortie,) LOGGED_SORTIE


def empty_logs(rows: int, num_customers: int) -> VehicleLog:
    """Allocate logs, one a rollout, for vehicles that may serve every customer."""
    return VehicleLog(
        count=np.zeros(rows, LENGTHS),
        trip=np.zeros((rows, num_customers + 1), LOGGED_TRIP),
        stop=np.zeros((rows, 3 * num_customers + 2), LOGGED_STOP),
        op=np.zeros((rows, 2 * num_customers), OPERATION),
        sortie=np.zeros((rows, num_customers), LOGGED_SORTIE),
    )


@pasted
def log_of(logs: VehicleLog, r: int) -> VehicleLog:
    """Return the log of one rollout, as views."""
    return VehicleLog(logs.count[r], logs.trip[r], logs.stop[r], logs.op[r], logs.sortie[r])


@pasted
def setting_of(instance: Instance, b: int, k: int) -> Setting:
    """Return what vehicle type `k` meets in problem `b`, as views."""
    kind = instance.type[b, k]
    nodes = instance.node[b]
    return Setting(places_of(nodes, kind), places_by_air(nodes, kind), instance.amount[b],
                   instance.goods[b], instance.fresh_for[b], kind,
                   matrix_of(instance.duration, b, kind.travel),
                   matrix_of(instance.duration, b, kind.drone_travel),
                   matrix_of(instance.duration, b, kind.home_travel), instance.setup[b],
                   instance.profile_time[b, k], instance.profile_factor[b, k], instance.type[b],
                   nodes, matrices_of(instance.duration, b), instance.can_fly[b])


@pasted
def craft_of(setting: Setting, row: int) -> Craft:
    """Return what drones meet whose TYPE is at a row."""
    kind = setting.types[row]
    return Craft(kind, places_by_air(setting.nodes, kind),
                 matrix_among(setting.durations, kind.drone_travel),
                 matrix_among(setting.durations, kind.home_travel))


@inlined
def travel_arrival(setting: Setting, origin: int, to: int, leave: int) -> int:
    """Return when a truck that leaves at `leave` arrives, by its speed at the time of day.

    And is set up.
    """
    return leg_end(
        setting.type, setting.profile_time, setting.profile_factor,
        lookup(setting.drive, origin, to), leave) + setup_beside(
            setting.type, setting.setup, origin, to)


@inlined
def _arrival_allowed(log: VehicleLog, place: Records, arrival: int, before: int,
                     write: bool) -> bool:
    """Check a window: when writing, that a hard one holds; else, that no lateness is added.

    With drones, also that it is the same window: who has to wait for another may then be met
    sooner, so that a start might cost nothing though an earlier one does.
    """
    if write:
        return not too_late(place, arrival)
    if log.count.sorties > 0:
        return arrival <= in_same_window(place, before)
    return arrival <= as_late(place, before)


@inlined
def aboard_too_long(setting: Setting, node: int, departure: int, start: int) -> bool:
    """Tell whether a parcel is too long aboard on a trip that has left at `departure`."""
    return some_limited(setting.fresh_for) and excess_aboard(
        setting.fresh_for, node, departure, start) > 0


@inlined
def sortie_takeoff(setting: Setting, log: VehicleLog, sortie: Record, free: int,
                   launched: int) -> int:
    """Return when a sortie takes off whose launch may begin at `free`.

    It is held back for the customer's window once it is known where it is recovered. `launched`
    counts the launches of the trip before it.
    """
    craft = craft_of(setting, sortie.row)
    takeoff = take_off(craft.type, free, launched)
    if sortie.recovery_stop != IN_FLIGHT:
        customer = sortie.node
        here, to = log.stop[sortie.launch_stop].node, log.stop[sortie.recovery_stop].node
        takeoff = held_takeoff(craft.type, craft.node[customer], takeoff,
                               lookup(craft.out, here, customer),
                               lookup(craft.home, customer, to))
    return takeoff


@inlined
def charged_takeoff(setting: Setting, log: VehicleLog, index: int, first: int, free: int,
                    launched: int) -> int:
    """As `sortie_takeoff`, of a sortie by its index, where drones are charged aboard.

    In place: what it has then. The trip begins at stop `first`.
    """
    sortie = log.sortie[index]
    craft = craft_of(setting, sortie.row)
    kind = craft.type
    kept, since = first_charge(kind, sortie.drone)
    for other in range(index):
        if log.sortie[other].drone == sortie.drone and log.sortie[other].launch_stop >= first:
            kept, since = log.sortie[other].trial_left, log.sortie[other].trial_end
    if sortie.recovery_stop != IN_FLIGHT:
        here, to = log.stop[sortie.launch_stop].node, log.stop[sortie.recovery_stop].node
        free = max(free, charged_launch(kind, craft.node[sortie.node], kept, since,
                                        lookup(craft.out, here, sortie.node),
                                        lookup(craft.home, sortie.node, to)))
    takeoff = sortie_takeoff(setting, log, sortie, free, launched)
    sortie.trial_left = charged(kind, kept, since, launch_begin(kind, takeoff, launched))
    return takeoff


@inlined
def _replay_launch(setting: Setting, log: VehicleLog, index: int, first: int, node: int,
                   free: int, launched: int, departure: int, write: bool) -> int:
    """Time one launch begun at `free`; return the take-off, -1 if it is not allowed.

    `departure` is that of the trip, which begins at stop `first`, if any came before.
    """
    sortie = log.sortie[index]
    customer, craft = sortie.node, craft_of(setting, sortie.row)
    place = craft.node[customer]
    if charges_aboard(craft.type):
        takeoff = charged_takeoff(setting, log, index, first, free, launched)
    else:
        takeoff = sortie_takeoff(setting, log, sortie, free, launched)
    arrival = takeoff + lookup(craft.out, node, customer)
    # Who is still in flight may be launched before those of other types.
    if not _arrival_allowed(log, place, arrival, sortie.arrival, write) and not (
            write and sortie.recovery_stop == IN_FLIGHT and are_several(setting.type)):
        return -1
    served = end_of_service(place, arrival)
    sortie.trial_takeoff, sortie.trial_ready = takeoff, served
    if write:
        sortie.takeoff, sortie.arrival = takeoff, arrival
        sortie.start, sortie.ready = start_of_service(place, arrival), served
    elif (sortie.recovery_stop == IN_FLIGHT and served > sortie.ready) or aboard_too_long(
            setting, customer, min(departure, takeoff), start_of_service(place, arrival)):
        return -1
    return takeoff


@inlined
def _replay_recovery(setting: Setting, log: VehicleLog, index: int, node: int, free: int,
                     busy: int, write: bool) -> tuple[int, bool]:
    """Time one recovery begun at `free` or later; return its end, and whether the drone lasts.

    One that takes no time is held up by what takes time alone, which is over at `busy`.
    If nothing is written, the end is -1 where it doesn't, or is in the air longer than logged.
    """
    sortie = log.sortie[index]
    takeoff, customer = sortie.trial_takeoff, sortie.node
    craft = craft_of(setting, sortie.row)
    home = lookup(craft.home, customer, node)
    back = sortie.trial_ready + home
    begin = max(busy if takes_no_time(craft.type, True, 0) else free, back)
    # A sortie as long as before may wait where that takes more.
    left = left_after(craft.type, craft.node[customer],
                      lookup(craft.out, log.stop[sortie.launch_stop].node, customer), home,
                      takeoff, sortie.trial_ready, begin)
    end = recovery_end(craft.type, begin)
    if charges_aboard(craft.type):
        left -= battery_of(craft.type) - sortie.trial_left
        sortie.trial_left, sortie.trial_end = left, end
    if not write:
        lasts = left >= 0 and begin - takeoff <= sortie.recovery_start - sortie.takeoff
        return end if lasts else -1, lasts
    sortie.left, sortie.recovery_start, sortie.recovery_end = left, begin, end
    return end, left >= 0 and within_endurance(craft.type, takeoff, back, begin)


@inlined
def _serve(setting: Setting, log: VehicleLog, index: int, arrival: int, departure: int,
           write: bool) -> tuple[int, int]:
    """Time service at a stop; return when it begins and ends, -1 if it is not allowed."""
    stop = log.stop[index]
    place = setting.node[stop.node]
    start = start_of_service(place, arrival)
    if not _arrival_allowed(log, place, arrival, stop.arrival, write) or (
            not write and aboard_too_long(setting, stop.node, departure, start)):
        return -1, -1
    return start, end_of_service(place, arrival)


@inlined
def replay(setting: Setting, num_depots: int, log: VehicleLog, first_trip: int, start: int,
           write: bool) -> bool:
    """Time the trips from `first_trip` on, the first begun at `start`, all else without delay.

    In place where `write` is set: the log takes new times, void if a hard window doesn't hold; the
    result tells whether endurance holds, too. Else it tells alone whether the later start costs
    nothing: no more lateness, no longer sortie, no later end than logged, and no parcel too long
    aboard; `departure` is the first of all that leave on a trip.
    """
    op, leave, lasting = log.trip[first_trip].first_op, start, True
    for trip in range(first_trip, log.count.trips):
        first, launched, departure = log.trip[trip].first_stop, 0, FAR
        behind = log.trip[trip + 1].first_stop if trip + 1 < log.count.trips else log.count.stops
        if trip > first_trip:
            start = max(log.trip[trip].release, leave + setting.type.reload_duration)
        if write:
            log.trip[trip].start = start
        for index in range(first, behind):
            node = log.stop[index].node
            arrival = start if index == first else travel_arrival(
                setting, log.stop[index - 1].node, node, leave)
            service_start = free = busy = arrival
            leave = leaves_first(setting.type, arrival) if index == first else arrival
            if node >= num_depots:
                service_start, leave = _serve(setting, log, index, arrival, departure, write)
                if leave < 0:
                    return False
            while op < log.count.ops and log.op[op].stop == index:
                sortie = log.op[op].sortie
                instant = takes_no_time(setting.types[log.sortie[sortie].row],
                                        log.op[op].is_recovery, launched)
                if log.op[op].is_recovery:
                    end, lasts = _replay_recovery(setting, log, sortie, node, free, busy, write)
                    lasting = lasting and lasts
                else:
                    end = _replay_launch(setting, log, sortie, first, node, free, launched,
                                         departure, write)
                    departure, launched = min(departure, end), launched + 1
                if end < 0:
                    return False
                free = max(free, end)
                busy = busy if instant else free
                op += 1
            leave = max(leave, free)
            departure = min(departure, leave)
            if write:
                stop = log.stop[index]
                stop.arrival, stop.start, stop.leave = arrival, service_start, leave
    return lasting and (write or leave <= log.stop[log.count.stops - 1].leave)


@inlined
def most_excess(setting: Setting, num_depots: int, log: VehicleLog) -> int:
    """Return by how much a parcel is too long aboard on the last trip; at most 0 if none is."""
    first, most = log.trip[log.count.trips - 1].first_stop, -FAR
    departure = log.stop[first].leave
    for index in range(log.count.sorties):
        if log.sortie[index].launch_stop == first:
            departure = min(departure, log.sortie[index].takeoff)
    for index in range(first, log.count.stops):
        node = log.stop[index].node
        if node >= num_depots:
            most = max(most, excess_aboard(setting.fresh_for, node, departure,
                                           log.stop[index].start))
    for index in range(log.count.sorties):
        sortie = log.sortie[index]
        if sortie.launch_stop >= first:
            most = max(most, excess_aboard(setting.fresh_for, sortie.node, departure, sortie.start))
    return most


@inlined
def latest_start(setting: Setting, num_depots: int, log: VehicleLog, trip: int, known: int) -> int:
    """Return the latest start of a trip that costs nothing; `known` is one that costs nothing."""
    if not replay(setting, num_depots, log, trip, known + 1, False):
        return known
    low = known + 1
    high = log.stop[log.count.stops - 1].leave + 1
    while high - low > 1:
        middle = (low + high) // 2
        if replay(setting, num_depots, log, trip, middle, False):
            low = middle
        else:
            high = middle
    return low


@compiled
def first_departure(setting: Setting, log: VehicleLog, start: int) -> int:
    """Return when truck or drone first leaves the depot if the first trip begins at `start`.

    If its work counts from an instant, however late it leaves: that instant.
    """
    departure = leaves_first(setting.type, start)
    if log.count.ops > 0 and log.op[0].stop == 0:
        departure = sortie_takeoff(setting, log, log.sortie[log.op[0].sortie], start, 0)
    return counted_from(setting.type, departure)


@compiled
def start_to_depart(setting: Setting, log: VehicleLog, departure: int) -> int:
    """Return the start of the first trip by which none leaves the depot before `departure`."""
    if log.count.ops > 0 and log.op[0].stop == 0:
        return launch_begin(setting.types[log.sortie[log.op[0].sortie].row], departure, 0)
    return departure


@compiled
def start_within_work(setting: Setting, num_depots: int, log: VehicleLog, known: int) -> int:
    """Return a start of the first trip that costs nothing and keeps the working duration.

    Or `known`. Only the soonest that would keep it is tried: mostly all before one that costs
    nothing cost nothing, but where batteries are charged, not all do.
    """
    needed = log.stop[log.count.stops - 1].leave - setting.type.max_working_duration
    if has_begun(setting.type) or first_departure(setting, log, known) >= needed:
        return known
    later = start_to_depart(setting, log, needed)
    return later if replay(setting, num_depots, log, 0, later, False) else known
