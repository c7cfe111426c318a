"""What the schema can't tell of no-fly areas."""

from itertools import islice

import numpy as np

from app.requests.draft import Draft, Errors, error_at, point_errors
from app.requests.conversion.zones import reading_of
from app.schemas.fields import Location, point_of
from app.schemas.request import AirspaceInput
from model.travel.airspace import Ring, invalid_polygon_reason
from model.travel.matrices import LocalProjection
from model.travel.obstacles import count_crossings

MAX_AIRSPACE_CORNERS = 1000
"""Most corners of all no-fly areas together."""

MAX_AIRSPACE_CROSSINGS = 10_000
"""How often edges of different no-fly areas may meet: to merge areas takes time for each."""


def airspace_errors(draft: Draft) -> Errors:
    """Say what is wrong with no-fly areas and zones."""
    if draft.airspace is None:
        return
    yield from _zone_errors(draft, draft.airspace)
    if not draft.airspace.no_fly:
        return
    corners = sum(map(len, draft.airspace.no_fly))
    if corners > MAX_AIRSPACE_CORNERS:
        yield error_at("TOO_MANY_CORNERS", ("airspace", "no_fly"),
                       f"The no-fly areas have {corners} corners and at most "
                       f"{MAX_AIRSPACE_CORNERS} are allowed: simplify them.")
        return
    wrong = [error for index, ring in enumerate(draft.airspace.no_fly)
             for number, corner in enumerate(ring)
             for error in point_errors(draft, ("airspace", "no_fly", index, number), corner)]
    yield from wrong
    if draft.coordinate_system is None or wrong:
        return
    rings = _rings_m(draft, draft.airspace.no_fly)
    invalid = [error for index, ring in enumerate(rings) for error in _ring_errors(index, ring)]
    yield from invalid or _crossing_errors(rings)


def _zone_errors(draft: Draft, airspace: AirspaceInput) -> Errors:
    if airspace.zones and draft.coordinate_system == "planar":
        yield error_at("ZONES_ON_PLANE", ("airspace", "zones"),
                       "Zones lie on the globe: state coordinate_system geographic, or areas as "
                       "no_fly.")
        return
    for index, stated in enumerate(airspace.zones):
        for fault in reading_of(stated).faults:
            yield error_at("ZONE_UNREADABLE", ("airspace", "zones", index, "data", *fault.path),
                           fault.message)
    ground = airspace.ground
    if ground is not None and ground.highest < ground.lowest:
        yield error_at("OUT_OF_RANGE", ("airspace", "ground", "highest"),
                       f"The highest ground is below the lowest, {ground.lowest:g} m: raise it, or "
                       "swap the two.")


def _rings_m(draft: Draft, no_fly: list[list[Location]]) -> list[Ring]:
    """Return the areas' corners in planar metres."""
    corners = np.array([corner for ring in no_fly for corner in ring]) * draft.planar_unit
    if draft.coordinate_system == "geographic":
        places = [point for place, *_ in draft.places()
                  if (point := point_of(place.location)) is not None]
        on_globe = [(x, y) for x, y in places if abs(x) <= 180 and abs(y) <= 90]
        projection = LocalProjection.around(np.array(on_globe or no_fly[0]))
        corners = projection.project(corners / draft.planar_unit)
    together = iter(corners.tolist())
    return [tuple((x, y) for x, y in islice(together, len(ring))) for ring in no_fly]


def _ring_errors(index: int, ring: Ring) -> Errors:
    reason = invalid_polygon_reason(ring)
    if reason is not None:
        yield error_at("POLYGON_CROSSES_ITSELF" if "itself" in reason else "POLYGON_WITHOUT_AREA",
                       ("airspace", "no_fly", index),
                       f"{reason[0].upper()}{reason[1:]}: list its corners once each, in order "
                       "around the area.")


def _crossing_errors(rings: list[Ring]) -> Errors:
    crossings = count_crossings(rings)
    if crossings > MAX_AIRSPACE_CROSSINGS:
        yield error_at("TOO_MANY_CORNERS", ("airspace", "no_fly"),
                       f"The no-fly areas' edges meet {crossings} times, and at most "
                       f"{MAX_AIRSPACE_CROSSINGS} times are allowed: merge areas that overlap.")
