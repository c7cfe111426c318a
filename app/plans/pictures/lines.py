"""The lines of legs and flights in km east and north: those of the plan, else straight ones."""

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
import polyline

from app.plans.pictures.scene import Layout, Place, Point, flown_places
from app.schemas.plan import SortieInput, StopInput, TripInput

DECIMALS = 6

NEAR_KM = 0.02
"""How near to its places the ends of a plan's line must be: else it is not that of this leg."""

Line = list[Point]


def driven_lines(layout: Layout, trip: TripInput) -> Iterator[Line]:
    """Yield the line of each leg of a trip."""
    for before, stop in pairwise(places_of(trip)):
        yield _line(layout, (before.kind, before.id), (stop.kind, stop.id), stop.geometry)


def flown_lines(layout: Layout, trip: TripInput, sortie: SortieInput) -> Iterator[Line]:
    """Yield the line of each flight of a sortie."""
    lines = [*(visit.geometry for visit in sortie.customers), sortie.recovery_geometry]
    for (start, end), line in zip(pairwise(flown_places(trip, sortie)), lines, strict=True):
        yield _line(layout, start, end, line)


def _line(layout: Layout, start: Place, end: Place, stated: str | None) -> Line:
    ends = [layout.points[start], layout.points[end]]
    line = [] if stated is None else _decoded(layout, stated)
    if len(line) > 1 and np.hypot(*np.subtract([line[0], line[-1]], ends).T).max() < NEAR_KM:
        return [ends[0], *line[1:-1], ends[1]]
    return ends


def _decoded(layout: Layout, line: str) -> Sequence[Point]:
    """Return a line's places, or none if it can't be read."""
    try:
        places = np.array(polyline.decode(line, DECIMALS), dtype=np.float64)
        return [(float(x), float(y)) for x, y in layout.project(places[:, ::-1])]
    except (IndexError, ValueError):
        return []


def places_of(trip: TripInput) -> list[StopInput]:
    """Return the stops of a trip but for its breaks, which lie between them."""
    return [stop for stop in trip.stops if stop.kind != "break"]
