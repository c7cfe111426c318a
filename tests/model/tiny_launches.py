"""Where drones of tiny problems may take off."""

from dataclasses import replace

import numpy as np

from model.problem import Problem


def with_few_launch_places(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which drones may take off, and be recovered, at some places alone."""
    return replace(
        problem, depots=tuple(replace(depot, launch=bool(rng.random() < 0.6))
                              for depot in problem.depots),
        customers=tuple(replace(customer, launch=bool(rng.random() < 0.6))
                        for customer in problem.customers))
