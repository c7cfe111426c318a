"""Tiny problems whose depots open and close."""

from dataclasses import replace

import numpy as np

from model.problem import Problem, within_hours
from tests.model.tiny import MINUTE


def with_hours(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose vehicles work while the depots where they begin and end are open."""
    depots = tuple([replace(depot, earliest=int(rng.integers(9)) * MINUTE,
                            latest=int(rng.integers(20, 51)) * MINUTE)
                    for depot in problem.depots])
    kinds = [kind for kind in problem.vehicle_types
             if kind.earliest <= depots[kind.ends_at].latest]
    if len(kinds) < len(problem.vehicle_types):
        return problem
    return replace(problem, depots=depots,
                   vehicle_types=tuple([within_hours(depots, kind) for kind in kinds]))
