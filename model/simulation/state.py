"""Running plans as arrays, which the engine reads and writes; `tandem.h` says what rows hold."""

from typing import NamedTuple

import numpy as np

from model.engine.instance import FAR, Instance
from model.engine.library import dtype_of
from model.engine.records import Records
from model.problem import BoolArray, FloatArray, IntArray

NO_VEHICLE = -1
"""Type of the open vehicle before the first opens."""

IN_FLIGHT = -1
"""Recovery stop of a sortie until it is recovered, sortie of a drone that is aboard."""


class VehicleLogs(NamedTuple):
    """What each rollout's open vehicle does, in order."""

    count: Records  # type: ignore[assignment]  # (rollout,) how many of each there are
    trip: Records  # (rollout, trip)
    stop: Records  # (rollout, stop)
    op: Records  # (rollout, op) launches and recoveries
    sortie: Records  # (rollout, sortie)


class State(NamedTuple):
    """Running plans, a row per rollout, then scratch rows. Times in ms since plan start.

    Times of sorties in flight are as if they were launched at once, in the log and in `drone`.
    """

    problem: IntArray  # (rollout,) row in the Instance
    served: BoolArray  # (rollout, node)
    num_unserved: IntArray  # (rollout,)
    used: IntArray  # (rollout, type) vehicles opened
    taken: Records  # (rollout, depot) by the vehicles closed so far, or (rollout, 0)
    starts: IntArray  # (rollout, node) by them, in orders across vehicles, or (rollout, 0)
    done: BoolArray  # (rollout,)
    vehicle: Records  # (rollout,) the open one
    drone: Records  # (rollout, drone) its drones
    log: VehicleLogs
    cost: Records  # (rollout,) of the vehicles closed so far
    fresh: BoolArray  # (problem, type, node) servable alone by a fresh vehicle


def empty_logs(rows: int, num_customers: int) -> VehicleLogs:
    """Allocate logs, one a rollout, for vehicles that may serve every customer."""
    return VehicleLogs(
        count=np.zeros(rows, dtype_of("tandem_log_lengths")),
        trip=np.zeros((rows, num_customers + 1), dtype_of("tandem_logged_trip")),
        stop=np.zeros((rows, 3 * num_customers + 2), dtype_of("tandem_logged_stop")),
        op=np.zeros((rows, 2 * num_customers), dtype_of("tandem_operation")),
        sortie=np.zeros((rows, num_customers), dtype_of("tandem_logged_sortie")),
    )


def empty_state(instance: Instance, rows: int) -> State:
    """Allocate the state of `rows` rollouts, scratch included, before any vehicle opens."""
    num_problems, num_nodes = instance.node.shape[:3:2]
    num_types = instance.type.shape[1]
    max_drones = max(1, int(instance.type["drones"].max()))
    state = State(
        problem=np.zeros(rows, np.int64),
        served=np.zeros((rows, num_nodes), np.bool_),
        num_unserved=np.zeros(rows, np.int64),
        used=np.zeros((rows, num_types), np.int64),
        taken=np.zeros((rows, instance.hub.shape[1]), dtype_of("tandem_hub")),
        starts=np.full((rows, num_nodes if instance.across.shape[1] else 0), -FAR, np.int64),
        done=np.zeros(rows, np.bool_),
        vehicle=np.zeros(rows, dtype_of("tandem_vehicle")),
        drone=np.zeros((rows, max_drones), dtype_of("tandem_drone")),
        log=empty_logs(rows, int(instance.size["customers"].max())),
        cost=empty_costs(rows),
        fresh=np.zeros((num_problems, num_types, num_nodes), np.bool_),
    )
    state.vehicle["type"] = NO_VEHICLE
    state.drone["sortie"] = IN_FLIGHT
    return state


def empty_costs(rows: int) -> Records:
    """Return rows that hold no cost yet of any term."""
    return np.zeros(rows, dtype_of("tandem_cost"))


def empty_outlooks(*shape: int) -> Records:
    """Return rows for what actions on customers lead to."""
    return np.zeros(shape, dtype_of("tandem_outlook"))


def by_term(cost: Records) -> FloatArray:
    """Return costs as a table of numbers, (row, term), in the order of `COST_TERMS`."""
    return cost.view(np.float64).reshape(len(cost), -1)
