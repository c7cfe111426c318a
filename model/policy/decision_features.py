"""What a policy sees at each step: its candidates and the state of the open vehicle.

Like what is seen of the problem, all numbers are free of units. Training and decoding share this
file. Networks read rows of 32-bit floats; others see the same memory by name.
"""

from typing import NamedTuple

import numpy as np

from model.engine.instance import Instance
from model.engine.library import call, dtype_of, packed
from model.engine.records import Records
from model.policy.problem_features import Float32Array, Scales
from model.problem import IntArray
from model.simulation.actions import reset
from model.simulation.state import empty_outlooks

ACTION = dtype_of("tandem_action_features")
"""A legal action: its kind; duration by scale and by nearness, cost, waiting, slack to the end of
the window (or, if less, of the longest time aboard), lateness cost, share of the load left and of
the capacity, slack to the end of the shift, way home from there, slack of distance, of working
duration, detour against going home now, excess over the nearest candidate, share of the endurance,
delay for release; way to the nearest unserved customer, to the third nearest, the former's excess
over the way from here. Of the nearest unserved ones in time: how soon one is served next (a drone
recovered), its slack (the truck's waiting), the share lost by this action, the detour by one before
(by air: that the truck would make instead), how soon this one could be served after another. What
being served by this vehicle costs on top; whether a shipment is delivered; of a pickup, the way to
its delivery, and how little time that leaves; whether relations keep it with somebody served; how
many unserved ones they keep from being served then; how long the driver rests on the way.

A delivery's window ends once its parcel is too long under way, and the working duration where legs
take too long. What is picked up is a load too, and so is a customer where trips of a truck without
drones may have so many. Shift and working duration end where overtime begins.

Of a return, the shares are the load left of the capacity, and the trips left. Of a vehicle to open,
they are the vehicles left and the capacity by what is unserved; the slack of distance tells whether
it has drones."""

VEHICLE_STATE = dtype_of("tandem_vehicle_features")
"""The open vehicle and what is left to do: customers and demand unserved; that demand by what all
vehicles left can carry; the way home; whether it is idle; its clock; the load left; how much more
than the demand all can carry; trips left; slack of shift and of working duration; drones in flight
and whether one is aboard; the load left by the demand; the features of its type; the share of the
capacity that parcels take which are aboard; how many unserved ones relations keep with its own; how
soon its driver has to rest."""

NUM_ACTION_FEATURES = ACTION.itemsize // 4
NUM_GLOBAL_FEATURES = VEHICLE_STATE.itemsize // 4


class Scene(NamedTuple):
    """Packed problems, and what decisions see of them."""

    instance: Instance
    scale: Scales
    type_token: Float32Array  # (problem, type, NUM_TYPE_FEATURES)


class Observation(NamedTuple):
    """What one decision sees, a row per rollout. Candidates are the legal actions, first `count`.
    """

    count: IntArray  # type: ignore[assignment]  # (rollout,)
    action: IntArray  # (rollout, candidate) codes
    token: IntArray  # (rollout, candidate) node, or number of nodes + type
    outlook: Records  # (rollout, candidate) what an action on a customer leads to
    feature: Float32Array  # (rollout, candidate, NUM_ACTION_FEATURES)
    glob: Float32Array  # (rollout, NUM_GLOBAL_FEATURES)
    here: IntArray  # (rollout,) token of the vehicle's place

    @property
    def described(self) -> Records:
        """Return `feature` by name, (rollout, candidate) ACTION."""
        return self.feature.view(ACTION)[..., 0]

    @property
    def vehicle(self) -> Records:
        """Return `glob` by name, (rollout,) VEHICLE_STATE."""
        return self.glob.view(VEHICLE_STATE)[..., 0]


def empty_observation(rows: int, num_nodes: int, num_types: int) -> Observation:
    """Allocate room for the candidates of every rollout."""
    most = 2 * num_nodes + 1 + num_types
    return Observation(
        count=np.zeros(rows, np.int64),
        action=np.zeros((rows, most), np.int64),
        token=np.zeros((rows, most), np.int64),
        outlook=empty_outlooks(rows, most),
        feature=np.zeros((rows, most, NUM_ACTION_FEATURES), np.float32),
        glob=np.zeros((rows, NUM_GLOBAL_FEATURES), np.float32),
        here=np.zeros(rows, np.int64),
    )


class Rollouts:
    """Running plans of packed problems, and what the next decision of each sees."""

    def __init__(self, scene: Scene, problems: IntArray, num_threads: int = 1) -> None:
        """Begin rollouts.

        Parameters
        ----------
        scene
            The problems.
        problems
            (rollout,) row of the problem that each rollout plans; at least one.
        num_threads
            How many may call `step` at the same time, for different rollouts.
        """
        instance = scene.instance
        self.state = reset(instance, problems, num_threads)
        self.seen = empty_observation(len(problems), instance.node.shape[2],
                                      instance.type.shape[1])
        self._scene = packed(scene)
        self._seen = packed(self.seen)

    def observe(self, first: int = 0, behind: int | None = None, thread: int = 0) -> int:
        """List and describe the legal actions of the rollouts `first` to `behind`.

        In place; a rollout without a legal action is finished. Returns the largest count.
        """
        rows = len(self.seen.count)
        return int(call("tandem_observe", self._scene, self.state, first,
                        rows if behind is None else behind, rows + thread, self._seen))

    def step(self, choice: IntArray, first: int = 0, behind: int | None = None,
             thread: int = 0) -> int:
        """Do what was chosen of what was seen, then observe; at the beginning, only the latter.

        In place. `choice` is (rollout,), an index into the candidates; rollouts without any stay
        as they are. Returns the largest count.
        """
        rows = len(self.seen.count)
        return int(call("tandem_step", self._scene, self.state, first,
                        rows if behind is None else behind, rows + thread, choice, self._seen))
