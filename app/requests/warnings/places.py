"""Warnings about places: swapped, in degrees, far apart, on top of each other."""

import math
from collections import Counter

import numpy as np

from app.requests.conversion.leg_origins import AS_THE_CROW_FLIES
from app.requests.warnings.homes import far_from_home
from app.requests.warnings.survey import Survey
from app.requests.warnings.warning import Warnings, amount_text, customers_text, warning_at
from app.schemas.fields import Location, point_of
from model.problem import BoolArray, FloatArray

DAY_HOURS = 10.0
"""A day's drive: no driver in the European Union may drive longer on one day."""

POLAR_DEG = 73.0
"""Degrees of latitude beyond which hardly anybody lives."""

SEA = (
    ((51.6, 71), (-10, 11)), ((48.7, 51.6), (-10, 4.5)), ((47.5, 48.8), (11.25, 13.5)),
    ((45.3, 50), (11.6, 12.6)), ((52.3, 56), (12.85, 15.3)), ((54.8, 71), (9, 16.5)),
    ((58.5, 66), (16, 20)), ((60, 66), (20, 24.9)), ((60, 62.5), (24.9, 25.05)),
    ((-35, 5), (-72, -38)), ((0, 8), (2, 4)), ((-1.6, -0.6), (36.3, 37.2)),
    ((-58, -32), (12, 36)), ((-30, -19), (19, 36)), ((40.25, 42), (-10, -3.3)),
    ((47.4, 53), (18.8, 21.5)),
)
"""Longitudes and latitudes of open sea, and of sand, where cities would be if theirs were swapped:
northern Europe's, South America's, southern Africa's, Madrid, Budapest, Warsaw."""

TINY_M = 20.0
"""Metres within which no problem of vehicles lies."""

DEGREE_WIDTH = 5.0
"""How many times farther than they are wide degrees lie from the origin, which planes seldom do."""

DEGREES_M = 1e4
"""A unit of as many metres is meant for degrees."""

FINE_SHARE = 0.5
"""Share of coordinates that have more than two digits behind the point if they are degrees."""

LEAST_AT_ONE, SHARE_AT_ONE = 5, 0.25
"""Customers, and their share of all, who have the same coordinates because a geocoder had no
better."""

ZERO_AWAY = 5.0
"""How many times farther than the others customers at [0, 0] are if that is no place."""


def place_warnings(survey: Survey) -> Warnings:
    """Yield warnings about where places are."""
    if survey.located_types and len(survey.bases):
        wrong_unit = list(_degrees(survey) if not survey.is_geographic else _all_swapped(survey))
        yield from wrong_unit
        if wrong_unit:
            return
        yield from _small(survey)
        at_zero = _at_zero(survey)
        yield from _zero(survey, at_zero)
        yield from _far(survey, at_zero)
        yield from _areas(survey)
    yield from _at_one_point(survey)


def crow_warnings(survey: Survey) -> Warnings:
    """Yield a warning if trucks drive as the crow flies on the globe and nobody asked for it."""
    if not survey.is_geographic or survey.request.roads == "none":
        return
    for index, kind in enumerate(survey.request.fleet):
        if (not kind.flies and survey.is_located(kind)
                and kind.profile not in survey.road_profiles):
            yield warning_at("AS_THE_CROW_FLIES", ("fleet", index, "profile"), AS_THE_CROW_FLIES)
            return


def _degrees(survey: Survey) -> Warnings:
    everywhere = _everywhere(survey)
    sizes = np.abs(everywhere)
    within = ((sizes[:, 0] <= 180) & (sizes[:, 1] <= 180) & (sizes.min(axis=1) <= 90)).all()
    fine = np.abs(np.round(everywhere, 2) - everywhere) > 1e-9
    unit = survey.request.planar_unit
    if not within or sizes.max() <= 1 or unit >= DEGREES_M:
        return
    width, away = _width(everywhere), float(np.hypot(*everywhere.mean(axis=0)))
    is_tiny = away >= width and width * unit <= 5 * TINY_M
    if fine.mean() <= FINE_SHARE:
        # Degrees may be as rough where nobody has said that places are on a plane.
        stated = survey.request.model_fields_set & {"coordinate_system", "planar_unit"}
        is_meant = not stated and is_tiny and survey.is_lifelike
    else:
        is_meant = is_tiny or away >= DEGREE_WIDTH * width
    if is_meant:
        first = survey.bases[0].tolist()
        yield warning_at(
            "LOOKS_LIKE_DEGREES", ("coordinate_system",),
            f"Places such as {first} look like degrees. On a plane all of them lie within "
            f"{amount_text(width * unit)} m: if they are [longitude, latitude], state "
            '"coordinate_system": "geographic".')


def _small(survey: Survey) -> Warnings:
    if survey.is_geographic or "planar_unit" in survey.request.model_fields_set:
        return
    width = _width(_everywhere(survey))
    if 0 < width < TINY_M and survey.is_lifelike:
        yield warning_at(
            "PLACES_WITHIN_METRES", ("planar_unit",),
            f"All places lie within {amount_text(width)} m, as planar coordinates are metres: if "
            "they are kilometres, state \"planar_unit\": 1000.")


def _all_swapped(survey: Survey) -> Warnings:
    everywhere = _everywhere(survey)
    turned = everywhere[:, ::-1]
    on_globe = np.abs(turned[:, 1]) <= 90
    nowhere = _is_empty(everywhere) & ~_is_empty(turned)
    elsewhere = far_from_home(survey.request, everywhere) & ~far_from_home(survey.request, turned)
    for lost, where in ((nowhere, "in the open sea, in a desert or near a pole"),
                        (elsewhere, "far from where time zone, currency or telephone numbers are")):
        lost &= on_globe
        if lost[:len(survey.bases)].any() and lost.mean() > 0.5:
            lon, lat = survey.bases[0].tolist()
            yield warning_at(
                "LOOKS_SWAPPED", ("depots", 0, "location"),
                f"Places such as {[lon, lat]} lie {where}; swapped they don't. "
                f"A location is [longitude, latitude]: write {[lat, lon]}.")
            return


def _is_empty(points: FloatArray) -> BoolArray:
    """Tell which points are where nobody lives."""
    lon, lat = points.T
    empty = np.abs(lat) > POLAR_DEG
    for (west, east), (south, north) in SEA:
        empty |= (west <= lon) & (lon <= east) & (south <= lat) & (lat <= north)
    return empty


def _at_zero(survey: Survey) -> BoolArray:
    """Tell which customers are at [0, 0] because nobody knew where they are."""
    zero = (survey.points == 0).all(axis=1)
    if survey.is_geographic or not zero.any():
        return zero
    others = survey.metres[~zero & np.isfinite(survey.metres)]
    away = survey.metres_to(np.zeros((1, 2)))[0]
    return zero if len(others) and away > ZERO_AWAY * others.max() else zero & False


def _zero(survey: Survey, at_zero: BoolArray) -> Warnings:
    if at_zero.any():
        index = int(at_zero.argmax())
        yield warning_at(
            "LOCATION_AT_ZERO", ("customers", index, "location"),
            f"{customers_text(int(at_zero.sum()), len(at_zero))} at [0, 0], far from the "
            f"others, such as {survey.customers[index].id!r}: that often stands for an address "
            "that was not found. State where they are.")


def _far(survey: Survey, at_zero: BoolArray) -> Warnings:
    """Yield warnings of customers farther away than a day's drive, swapped ones apart."""
    if not survey.is_lifelike:
        return
    reach = survey.fastest_kmh * DAY_HOURS * 1000
    far = (survey.metres > reach) & ~at_zero
    if not far.any():
        return
    swapped = far & (np.abs(survey.points[:, 0]) <= 90) if survey.is_geographic else far & False
    turned = survey.metres_to(survey.points[:, ::-1])
    swapped &= turned <= reach
    count = len(far)
    if swapped.any():
        index = int(swapped.argmax())
        point = survey.points[index].tolist()
        yield warning_at(
            "LOOKS_SWAPPED", ("customers", index, "location"),
            f"{customers_text(int(swapped.sum()), count)} far from every depot, and would be near "
            f"one if longitude and latitude were swapped, such as {survey.customers[index].id!r}: "
            f"{amount_text(survey.metres[index] / 1000)} km, swapped "
            f"{amount_text(turned[index] / 1000)} km. A location is [longitude, latitude]: write "
            f"{point[::-1]}, or swap the depot's.")
    far &= ~swapped
    if far.any():
        index = int(np.where(far, survey.metres, -1.0).argmax())
        hours = survey.metres[index] / 1000 / survey.fastest_kmh
        yield warning_at(
            "FAR_APART", ("customers", index, "location"),
            f"{customers_text(int(far.sum()), count)} farther than a day's drive "
            f"({DAY_HOURS:g} h) from every depot. {survey.customers[index].id!r} lies "
            f"{amount_text(survey.metres[index] / 1000)} km away in a straight line, "
            f"{amount_text(hours)} h at {survey.fastest_kmh:g} km/h: check its location"
            + ("." if survey.is_geographic else ", coordinate_system and planar_unit."))


def _areas(survey: Survey) -> Warnings:
    reach = max(survey.fastest_kmh * DAY_HOURS * 1000, float(np.nanmax(survey.metres, initial=0)))
    for index, area in enumerate(survey.request.airspace.no_fly):
        if survey.is_lifelike and survey.metres_to(np.array(area, float)).min() > reach:
            yield warning_at(
                "AREA_ELSEWHERE", ("airspace", "no_fly", index),
                f"No corner of this no-fly area is within a day's drive of a depot: it begins at "
                f"{list(area[0])}. Check its corners, or leave it out.")


def _at_one_point(survey: Survey) -> Warnings:
    places: list[Location | int | None] = (
        [point_of(customer.location) for customer in survey.customers] if survey.located_types
        else [customer.location_index for customer in survey.customers])
    counts = Counter(places)
    counts.pop(None, None)
    for point, count in counts.most_common(1):
        if count >= max(LEAST_AT_ONE, SHARE_AT_ONE * len(survey.customers)):
            where = list(point) if isinstance(point, tuple) else f"location_index {point}"
            yield warning_at(
                "CUSTOMERS_AT_ONE_POINT", ("customers", places.index(point)),
                f"{customers_text(count, len(survey.customers))} at one point, {where}: if "
                "that is where a geocoder puts a whole town, state where each of them is.")


def _everywhere(survey: Survey) -> FloatArray:
    stated = survey.points[np.isfinite(survey.points[:, 0])]
    return np.concatenate([survey.bases, stated])


def _width(points: FloatArray) -> float:
    return math.hypot(*np.ptp(points, axis=0).tolist())
