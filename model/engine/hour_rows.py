"""When depots are open, and launch sites, as rows for the engine."""

from collections.abc import Sequence

from model.engine.records import Records
from model.problem import UNLIMITED, Problem, VehicleType, keeps_hours


def write_hours(problem: Problem, kinds: Sequence[VehicleType], nodes: Records,
                types: Records) -> None:
    """Write when depots are open, (variant, node), and which types look at that, (row,). In place.
    """
    for number, place in enumerate(problem.depots):
        if place.earliest == 0 and place.latest >= UNLIMITED and not place.is_launch_site:
            continue
        for name, time in (("window_earliest", place.earliest), ("arrival_limit", place.latest),
                           ("window_latest", place.latest)):
            nodes[:, number][name] = time
    types["keeps_hours"][:len(kinds)] = [keeps_hours(problem.depots, kind) for kind in kinds]
