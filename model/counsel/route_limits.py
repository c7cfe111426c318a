"""Limits of what a vehicle drives and works that are kept or broken by all of a route: a row each.

By these rows a trip to a customer alone, and one through others, are told to lack so much.
"""

from collections.abc import Callable
from typing import NamedTuple

from model.counsel.diagnosis import more_of, up_to_tenth
from model.counsel.remedy import Part, in_km, in_minutes
from model.judge.driving import travel_duration
from model.judge.metrics import RouteMetrics
from model.problem import VehicleType
from model.problem.limits import KM, LIMITS
from model.solution import Route


class RouteLimit(NamedTuple):
    """A limit, what is said where it is broken, by `more` and `of` whom, and how much is used."""

    name: str  # as `LIMITS` has it
    code: str  # of the reason
    alone: str
    through: str  # of one who drives through others
    used: Callable[[Route, RouteMetrics], int]


class TooMuch(NamedTuple):
    """By how much a limit of a route is too low, in words, and what would do."""

    limit: RouteLimit
    more: str
    remedy: Part
    changed: VehicleType


ROUTE_LIMITS = {
    "TRIP_DISTANCE": RouteLimit(
        "trip_distance", "RANGE", "A trip there and back is {more} longer than a trip may be.",
        "would drive {more} more than a trip may be long",
        lambda _, measured: measured.trips[0].distance),
    "DISTANCE": RouteLimit(
        "distance", "DISTANCE", "The way there and back is {more} more than {of} may drive.",
        "would drive {more} more than it may",
        lambda _, measured: sum([trip.distance for trip in measured.trips])),
    "TRAVEL_DURATION": RouteLimit(
        "travel", "TRAVEL_DURATION",
        "The way there and back takes {more} more than {of} may travel.",
        "would travel {more} more than it may", lambda route, _: travel_duration(route.trips)),
    "WORKING_DURATION": RouteLimit(
        "work", "WORKING_HOURS", "Serving it alone takes {more} more than {of} may work.",
        "would work {more} more than it may", lambda _, measured: measured.working_duration),
}
"""By the codes of broken rules."""


def too_much(code: str, kind: VehicleType, route: Route, measured: RouteMetrics) -> TooMuch:
    """Return by how much a route is beyond a limit of its vehicle that it breaks."""
    row = ROUTE_LIMITS[code]
    limit = LIMITS[row.name]
    more = up_to_tenth(row.used(route, measured) - (limit.of(kind) or 0), limit.step.size)
    remedy, changed = more_of(row.name, kind, more, kind.id if "{of}" in limit.words else "")
    return TooMuch(row, in_km(more) if limit.step is KM else in_minutes(more), remedy, changed)
