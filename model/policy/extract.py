"""From the actions of a rollout to the plan they make."""

from collections.abc import Sequence

import numpy as np

from model.engine.instance import Instance
from model.engine.plans import told
from model.problem import IntArray, Problem
from model.simulation.actions import reset
from model.solution import Solution


def extract(problem: Problem, instance: Instance, actions: Sequence[int] | IntArray) -> Solution:
    """Return the plan that a rollout's legal actions make.

    Parameters
    ----------
    problem
        The problem planned.
    instance
        The same, packed alone.
    actions
        Codes of all actions, from the first on.
    """
    state = reset(instance, np.zeros(1, np.int64))
    routes = told("tandem_tell_rollout", instance, state, 0, np.array(actions, np.int64))
    return Solution(routes, problem.left_out(np.flatnonzero(state.served[0]).tolist()))
