"""Rules of thumb in the same simulator, to compare policies with."""

import numpy as np

from model.policy.decision_features import Observation
from model.problem import FloatArray, IntArray
from model.simulation.state import by_term
from model.simulation.actions import DRIVE, LAUNCH, OPEN, RETURN
from training.rollout import Batch, Simulation


def nearest_choice(batch: Batch, seen: Observation, row: int, problem: int) -> int:
    """Choose the nearest feasible customer; drones fly to customers that no truck may serve."""
    count = int(seen.count[row])
    kind, duration = (seen.described[name][row, :count] for name in ("kind", "duration"))
    token = seen.token[row, :count]
    by_truck = batch.instance.can_drive[problem].any(axis=0)
    customer = np.minimum(token, len(by_truck) - 1)
    score = np.select(
        [kind[:, DRIVE] > 0, (kind[:, LAUNCH] > 0) & ~by_truck[customer],
         kind[:, RETURN] > 0, kind[:, OPEN] > 0],
        [duration, duration, 100.0, 200.0], 300.0)
    return int(score.argmin())


def nearest_neighbour(batch: Batch) -> FloatArray:
    """Plan each problem by the nearest feasible customer; return the true costs, (problem,)."""
    simulation = Simulation(batch, range(batch.num_problems), 1, 1)
    choice: IntArray = np.zeros(batch.num_problems, np.int64)
    while simulation.step(choice):
        for row in np.flatnonzero(simulation.seen.count).tolist():
            choice[row] = nearest_choice(batch, simulation.seen, row, row)
    simulation.close()
    return by_term(simulation.state.cost[: batch.num_problems]).sum(axis=1)
