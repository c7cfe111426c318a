"""Swapped places that are found by what else a request says of where it is."""

from typing import Any

import pytest

from app.requests.warnings.finding import warnings_of
from app.schemas.request import PlanRequest

TOWNS = {"Zürich": (8.54, 47.37), "Vienna": (16.37, 48.21), "Rome": (12.5, 41.9),
         "Madrid": (-3.7, 40.4), "Athens": (23.73, 37.98), "Lisbon": (-9.14, 38.72)}

PHONE = "+41 44 123 45 67"


def warned(place: tuple[float, float], phone: str = "", **stated: Any) -> bool:
    lon, lat = place
    request = PlanRequest.model_validate({
        "coordinate_system": "geographic", "roads": "none",
        "depots": [{"id": "hub", "location": (lon, lat)}],
        "customers": [{"id": str(number), "location": (lon + number / 100, lat + number / 90),
                       "demand": [1], "info": {"phone": phone}} for number in range(4)],
        "fleet": [{"id": "van", "count": 1, "capacity": [9]}], **stated})
    return "LOOKS_SWAPPED" in {warning.code for warning in warnings_of(request)}


def turned(place: tuple[float, float]) -> tuple[float, float]:
    return place[1], place[0]


HINTS: dict[str, dict[str, Any]] = {
    "zone": {"plan_start": "2026-11-23T00:00", "time_zone": "Europe/Zurich"},
    "currency": {"currency": "EUR"}, "phones": {"phone": PHONE}}


@pytest.mark.parametrize("hint", HINTS)
@pytest.mark.parametrize("town", TOWNS)
def test_towns_are_found_by_each_hint(town: str, hint: str) -> None:
    assert warned(turned(TOWNS[town]), **HINTS[hint])
    assert not warned(TOWNS[town], **HINTS[hint])


def test_madrid_lies_in_the_sea_if_swapped_and_zuerich_in_a_town() -> None:
    assert warned(turned(TOWNS["Madrid"]))
    assert not warned(turned(TOWNS["Zürich"]))


@pytest.mark.parametrize(("place", "stated"), [
    ((55.45, -20.88), {"currency": "EUR"}),  # Réunion
    ((-61.0, 14.6), {"currency": "EUR", "plan_start": "2026-11-23T00:00",
                     "time_zone": "America/Martinique"}),
    ((45.23, -12.78), {"currency": "EUR"}),  # Mayotte
    ((47.36, 8.48), {"currency": "SOS"}), ((39.67, -4.05), {"currency": "KES"}),
    ((-99.13, 19.43), {"plan_start": "2026-11-23T00:00", "time_zone": "America/Mexico_City"}),
    ((131.9, 43.1), {"plan_start": "2026-11-23T00:00", "time_zone": "Asia/Vladivostok"}),
    ((36.82, -1.29), {"phone": "+254 20 123 4567"}),
    ((87.6, 43.8), {"plan_start": "2026-11-23T00:00", "time_zone": "Asia/Shanghai"}),
])
def test_places_overseas_raise_no_alarm(
        place: tuple[float, float], stated: dict[str, Any]) -> None:
    assert not warned(place, **stated)
