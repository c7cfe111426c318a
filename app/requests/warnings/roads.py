"""Warnings about what is asked of roads by a request whose vehicles drive on none."""

from app.requests.conversion.places import PlacedRequest
from app.requests.warnings.survey import Survey
from app.requests.warnings.warning import Warnings, warning_at
from app.schemas.vehicle import VehicleTypeInput

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
