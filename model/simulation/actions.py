"""The decision process: begin, list the legal actions, act, over a batch of rollouts.

One action per step, vehicle after vehicle: drive to a customer, launch a drone to a customer,
return to a depot, open a vehicle of a type. `engine/simulation/simulator.h` says when one is legal.
"""

from model.engine.instance import Instance
from model.engine.library import call
from model.engine.packing import Packed
from model.engine.records import Records
from model.problem import IntArray
from model.simulation.state import State

DRIVE, LAUNCH, RETURN, OPEN = range(4)
NUM_KINDS = 4


def encode_action(kind: int, target: int) -> int:
    """Return the code of an action; `target` is a customer's node, a depot's node or a type."""
    return target * NUM_KINDS + kind


def legal_actions(instance: Instance, state: State, r: int, scratch: int, actions: IntArray,
                  outlooks: Records) -> int:
    """Write the codes of the legal actions of one rollout and what each leads to.

    In place; returns how many. `outlooks` (action,) is written for customers alone.
    """
    return int(call("tandem_legal_actions", instance, state, r, scratch, actions, outlooks))


def apply(instance: Instance, state: State, r: int, action: int) -> None:
    """Do one legal action of one rollout. In place."""
    call("tandem_apply", instance, state, r, action)


def apply_route(instance: Instance | Packed, state: State, r: int, actions: IntArray,
                first: int) -> int:
    """Do legal actions of one rollout, the `first` and all before the next vehicle opens.

    In place; returns the index of the action that opens it, or how many there are.
    """
    return int(call("tandem_apply_route", instance, state, r, actions, first))


def price_routes(instance: Instance | Packed, state: State, r: int, actions: IntArray,
                 price: Records) -> None:
    """Write what each vehicle costs, (vehicle,), as if there were no other. In place.

    `actions` are legal ones of some plan.
    """
    call("tandem_price_routes", instance, state, r, actions, price)


def finish(instance: Instance, state: State, r: int) -> None:
    """End a rollout that has no legal action left: close its vehicle, count who is left.

    In place.
    """
    call("tandem_finish", instance, state, r)


def max_steps(instance: Instance) -> int:
    """Return how many times the longest rollout may be observed at most.

    Each step serves a customer, opens a vehicle or returns, and neither trip nor vehicle stays
    empty; the observation after the last step finds nothing to do.
    """
    return 3 * int(instance.size["customers"].max()) + 2


def reset(instance: Instance, rollouts: IntArray, num_scratch: int = 1) -> State:
    """Begin one rollout for each entry of `rollouts`.

    Parameters
    ----------
    instance
        Packed problems.
    rollouts
        (rollout,) row of the problem that each rollout plans; at least one.
    num_scratch
        Scratch rows behind the rollouts, one for each thread that will run some of them.
    """
    return State(instance, rollouts, num_scratch)
