"""What the schema can't tell of no-fly areas."""

from itertools import islice

import numpy as np

from app.requests.airspace_size import size_errors
from app.requests.draft import Draft, Errors, error_at, point_errors
from app.requests.conversion.zones import reading_of
from app.schemas.airspace import AirspaceInput
from app.schemas.fields import Location, point_of
from model.travel.airspace import Ring, invalid_polygon_reason
from model.travel.matrices import LocalProjection


def airspace_errors(draft: Draft) -> Errors:
    """Say what is wrong with no-fly areas and zones."""
    if draft.airspace is None:
        return
    too_large = [*size_errors(draft.airspace)]
    if too_large:
        yield from too_large
        return
    yield from _zone_errors(draft, draft.airspace)
    if not draft.airspace.no_fly:
        return
    wrong = [error for index, ring in enumerate(draft.airspace.no_fly)
             for number, corner in enumerate(ring)
             for error in point_errors(draft, ("airspace", "no_fly", index, number), corner)]
    yield from wrong
    if draft.coordinate_system is None or wrong:
        return
    rings = _rings_m(draft, draft.airspace.no_fly)
    for index, ring in enumerate(rings):
        yield from _ring_errors(index, ring)


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
