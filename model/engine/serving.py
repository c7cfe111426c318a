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


def in_range(problem: Problem, kind: VehicleType, limit: int, anywhere: bool) -> BoolArray:
    """Mark the customers not too far from where a trip of who flies begins, and where it ends.

    From all such places, if `anywhere`; else from one where it may begin and one where it may end.
    """
    between = kind.reload_places if kind.max_trips > 1 else ()
    distance = problem.travel[kind.straight].distance
    begin, end = (distance[np.array(sorted({place, *between})), problem.num_depots:] <= limit
                  for place in (kind.begins_at, kind.ends_at))
    is_enough = np.all if anywhere else np.any
    near: BoolArray = is_enough(begin, axis=0) & is_enough(end, axis=0)
    return near
