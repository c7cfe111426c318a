"""What one decision sees: room for it, and the names of all its numbers.

Networks read rows of 32-bit floats; who writes them sees the same memory by name.
"""

from typing import NamedTuple

import numpy as np

from model.kernel.records import Records, row_of_floats
from model.policy.tokens import NUM_TYPE_FEATURES, Float32Array
from model.problem import IntArray
from model.simulation.simulator import NUM_KINDS
from model.simulation.trial import OUTLOOK

ACTION = row_of_floats(
    ("kind", NUM_KINDS), "duration", "nearness", "cost", "waiting", "window_slack", "lateness",
    "load_share", "capacity_share", "shift_slack", "way_home", "distance_slack", "working_slack",
    "detour", "excess", "endurance_share", "release_delay",
    "next_way", "third_way", "next_excess",
    "next_duration", "next_slack", "lost", "detour_before", "later_duration")
"""A legal action: its kind; duration by scale and by nearness, cost, waiting, slack to the end of
the window (or, if less, of the longest time aboard), lateness cost, share of the load left and of
the capacity, slack to the end of the shift, way home from there, slack of distance, of working
duration, detour against going home now, excess over the nearest candidate, share of the endurance,
delay for release; way to the nearest unserved customer, to the third nearest, the former's excess
over the way from here. Of the nearest unserved ones in time: how soon one is served next (a drone
recovered), its slack (the truck's waiting), the share lost by this action, the detour by one before
(by air: that the truck would make instead), how soon this one could be served after another.

What is picked up is a load too, and so is a customer where trips of a truck without drones may have
so many. Shift and working duration end where overtime begins.

Of a return, the shares are the load left of the capacity, and the trips left. Of a vehicle to open,
they are the vehicles left and the capacity by what is unserved; the slack of distance tells whether
it has drones."""

VEHICLE_STATE = row_of_floats(
    "unserved", "unserved_demand", "demand_by_reserve", "way_home", "idle", "clock", "load_left",
    "spare_reserve", "trips_left", "shift_slack", "working_slack", "flying", "drone_aboard",
    "load_by_demand", ("type", NUM_TYPE_FEATURES))
"""The open vehicle and what is left to do: customers and demand unserved; that demand by what all
vehicles left can carry; the way home; whether it is idle; its clock; the load left; how much more
than the demand all can carry; trips left; slack of shift and of working duration; drones in flight
and whether one is aboard; the load left by the demand; the features of its type."""

NUM_ACTION_FEATURES = ACTION.itemsize // 4
NUM_GLOBAL_FEATURES = VEHICLE_STATE.itemsize // 4


class Observation(NamedTuple):
    """What one decision sees, a row per rollout. Candidates are the legal actions, first `count`.

    `described` and `vehicle` are `feature` and `glob` by name.
    """

    count: IntArray  # type: ignore[assignment]  # (rollout,)
    action: IntArray  # (rollout, candidate) codes
    token: IntArray  # (rollout, candidate) node, or number of nodes + type
    outlook: Records  # (rollout, candidate) OUTLOOK
    feature: Float32Array  # (rollout, candidate, NUM_ACTION_FEATURES)
    described: Records  # (rollout, candidate) ACTION
    glob: Float32Array  # (rollout, NUM_GLOBAL_FEATURES)
    vehicle: Records  # (rollout,) VEHICLE_STATE
    here: IntArray  # (rollout,) token of the vehicle's place


def empty_observation(rows: int, num_nodes: int, num_types: int) -> Observation:
    """Allocate room for the candidates of every rollout."""
    most = 2 * num_nodes + 1 + num_types
    feature = np.zeros((rows, most, NUM_ACTION_FEATURES), np.float32)
    glob = np.zeros((rows, NUM_GLOBAL_FEATURES), np.float32)
    return Observation(
        count=np.zeros(rows, np.int64),
        action=np.zeros((rows, most), np.int64),
        token=np.zeros((rows, most), np.int64),
        outlook=np.zeros((rows, most), OUTLOOK),
        feature=feature,
        described=feature.view(ACTION)[..., 0],
        glob=glob,
        vehicle=glob.view(VEHICLE_STATE)[..., 0],
        here=np.zeros(rows, np.int64),
    )
