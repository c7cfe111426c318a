"""All warnings about one request."""

from collections.abc import Collection

import numpy as np

from app.requests.conversion.places import PlacedRequest
from app.requests.ends import stated_path
from app.requests.warnings.fleets import fleet_warnings
from app.requests.warnings.places import crow_warnings, place_warnings
from app.requests.warnings.rulebook import law_warnings, rule_warnings
from app.requests.warnings.survey import METRES_A_SECOND, Survey
from app.requests.warnings.times import time_warnings
from app.requests.warnings.warning import RequestWarning, Warnings, amount_text, warning_at
from app.requests.warnings.winds import wind_warnings
from app.schemas.request import PlanRequest
from app.schemas.vehicle import VehicleTypeInput


def warnings_of(request: PlanRequest,
                road_profiles: Collection[str] = ()) -> tuple[RequestWarning, ...]:
    """Return what looks wrong with a valid request, in time linear in its size.

    Parameters
    ----------
    road_profiles
        Profiles for which the service has roads.
    """
    survey = Survey(request, frozenset(road_profiles))
    found = (*place_warnings(survey), *time_warnings(survey), *fleet_warnings(survey),
             *matrix_warnings(survey), *crow_warnings(survey), *road_warnings(survey),
             *wind_warnings(survey), *rule_warnings(survey), *law_warnings(survey))
    return tuple([each._replace(path=stated_path(request, each.path)) for each in found])


SLOW_KMH, FAST_KMH = 0.5, 400.0
"""Speeds that half of all legs have at least, and at most."""

SAMPLE_ROWS = 10


def matrix_warnings(survey: Survey) -> Warnings:
    """Yield warnings about matrices by whose legs nothing drives."""
    for name, matrix in (survey.request.matrices or {}).items():
        if matrix.distances is None:
            continue
        rows = range(0, len(matrix.durations), max(1, len(matrix.durations) // SAMPLE_ROWS))
        seconds = np.concatenate([matrix.durations[row] for row in rows] or [np.empty(0)])
        metres = np.concatenate([matrix.distances[row] for row in rows] or [np.empty(0)])
        some = (seconds > 0) & (metres > 0)
        if not some.any():
            continue
        speed = float(np.median(metres[some] / seconds[some])) * METRES_A_SECOND
        if not SLOW_KMH <= speed <= FAST_KMH:
            hint = ("durations that are in minutes or hours" if speed > FAST_KMH
                    else "distances that are in kilometres or miles")
            yield warning_at(
                "MATRIX_UNITS", ("matrices", name),
                f"By this matrix, half of all legs are driven at {amount_text(speed)} km/h: "
                f"durations are seconds and distances metres, so look for {hint}.")


ROADS_ALONE = ("Roads alone know it: leave {name} out, or plan with roads (coordinate_system "
               "geographic, a profile of TANDEM_ROADS, no matrix for it).")


def road_warnings(survey: Survey) -> Warnings:
    """Yield a warning for what no vehicle type avoids, and for sides of streets that none knows."""
    fleet = list(enumerate(survey.request.fleet))
    for index, kind in fleet:
        if kind.avoid and not _is_on_roads(survey, kind):
            yield warning_at(
                "AVOID_WITHOUT_ROADS", ("fleet", index, "avoid"),
                f"Vehicles of type {kind.id!r} drive on no roads, so they don't avoid "
                f"{' and '.join(kind.avoid)}. {ROADS_ALONE.format(name='avoid')}")
            break
    driving = [kind for _, kind in fleet if not kind.flies]
    placed = PlacedRequest(survey.request)
    if placed.curb is None or any(_is_on_roads(survey, kind) for kind in driving):
        return
    yield warning_at(
        "APPROACH_WITHOUT_ROADS", placed.curb_path,
        "No vehicle drives on roads, so none comes to one side of the street. "
        + ROADS_ALONE.format(name="approach"))


def _is_on_roads(survey: Survey, kind: VehicleTypeInput) -> bool:
    """Tell whether vehicles of a type drive on the service's roads."""
    return (survey.is_geographic and survey.request.roads != "none" and not kind.flies
            and survey.is_located(kind) and kind.profile in survey.road_profiles)
