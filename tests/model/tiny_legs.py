"""Problems in which it counts, too, how far trucks go by other legs than those that they drive."""

from dataclasses import replace

import numpy as np

from model.problem import MM_PER_KM, Problem, Travel, VehicleType


def with_other_legs(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose trucks are so limited."""
    places = rng.integers(0, 10, problem.num_nodes) * MM_PER_KM
    far = np.abs(places[:, None] - places)

    def limited(kind: VehicleType) -> VehicleType:
        return kind if kind.flies else replace(
            kind, limited=len(problem.travel), max_distance=int(rng.integers(8, 30)) * MM_PER_KM)

    return replace(problem, vehicle_types=tuple(map(limited, problem.vehicle_types)),
                   travel=(*problem.travel, Travel(far, far)))
