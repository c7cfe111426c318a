"""Running plans as arrays, which the engine reads and writes; `tandem.h` says what rows hold."""

import numpy as np

from model.engine.instance import FAR, Instance
from model.engine.library import dtype_of
from model.engine.records import Records
from model.engine.structs import Struct
from model.problem import FloatArray

NO_VEHICLE = -1
"""Type of the open vehicle before the first opens."""

IN_FLIGHT = -1
"""Recovery stop of a sortie until it is recovered, sortie of a drone that is aboard."""


class VehicleLogs(Struct):
    """What each rollout's open vehicle does, in order."""


class State(Struct):
    """Running plans, a row per rollout, then scratch rows. Times in ms since plan start.

    Times of sorties in flight are as if they were launched at once, in the log and in `drone`.
    """


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
