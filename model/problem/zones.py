"""Zones with hours, as bits of the places that lie in them."""

from collections.abc import Iterable

from model.problem.problem import Problem


def zones_of(problem: Problem, nodes: Iterable[int]) -> int:
    """Return the zones with hours in which any of some nodes lies, as bits."""
    zones = 0
    for node in nodes:
        zones |= problem.place_at(node).zones
    return zones


def has_timed_zones(problem: Problem) -> bool:
    """Tell whether any place lies in a zone with hours."""
    return zones_of(problem, range(problem.num_nodes)) != 0
