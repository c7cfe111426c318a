"""By whom customers may be served, and what that costs, as the engine reads it."""

from collections.abc import Sequence

import numpy as np

from model.problem import BoolArray, FloatArray, Problem, VehicleType


def vehicle_costs(problems: Sequence[Problem], types: int, nodes: int) -> FloatArray:
    """Return (problem, type, node) as `tandem_instance` has it."""
    if all(problem.vehicle_costs is None for problem in problems):
        return np.zeros((len(problems), 0, 0))
    costs = np.zeros((len(problems), types, nodes))
    for row, problem in zip(costs, problems, strict=True):
        if problem.vehicle_costs is not None:
            row[:len(problem.vehicle_types), problem.num_depots:problem.num_nodes] = (
                problem.vehicle_costs)
    return costs


def in_range(problem: Problem, kind: VehicleType, limit: int) -> BoolArray:
    """Mark the customers not too far from any place where trips of who flies begin or end."""
    ends = {kind.begins_at, kind.ends_at, *(kind.reload_places if kind.max_trips > 1 else ())}
    far = problem.travel[kind.straight].distance[np.array(sorted(ends)), problem.num_depots:]
    near: BoolArray = np.max(far, axis=0) <= limit
    return near
