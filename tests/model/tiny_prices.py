"""Tiny problems in which it costs by whom and where customers are served."""

from dataclasses import replace

import numpy as np

from model.problem import Problem


def with_vehicle_costs(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which it costs by which type some customers are served."""
    size = (len(problem.vehicle_types), problem.num_customers)
    return replace(problem, vehicle_costs=rng.choice((0.0, 0.0, 3.0, 20.0), size))
