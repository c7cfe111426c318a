"""Lines of legs and flights in replies: from place to place, as long as what is flown."""

from itertools import pairwise
from typing import Any

import httpx
import numpy as np
import polyline
import pytest
from shapely import LineString, Polygon

from model.travel.matrices import LocalProjection
from tests.app.plans.asking import planned

NO_FLY = [[24.942, 60.165], [24.946, 60.165], [24.946, 60.178], [24.942, 60.178]]


def drawn(client: httpx.Client, request: dict[str, Any], geometry: bool = True) -> dict[str, Any]:
    """Return a plan, with geometry unless told otherwise."""
    return planned(client, request | {"options": {"time_limit": 0, "geometry": geometry}})


def city(**airspace: Any) -> dict[str, Any]:
    """Return a request with one customer for the truck and two that drones fly to."""
    return {
        "coordinate_system": "geographic",
        "depots": [{"id": "hub", "location": [24.940, 60.170]}],
        "customers": [
            {"id": "near", "location": [24.939, 60.172], "demand": [1], "served_by": "truck"},
            {"id": "behind", "location": [24.948, 60.171], "demand": [1], "served_by": "drone"},
            {"id": "clear", "location": [24.941, 60.174], "demand": [1], "served_by": "drone"}],
        "fleet": [{"id": "truck", "count": 1, "capacity": [9], "costs": {"per_km": 1},
                   "drones": {"count": 2, "capacity": [9]}}],
        "airspace": airspace,
    }


def places(line: str) -> list[tuple[float, float]]:
    """Return a line's places as requests state them."""
    return [(x, y) for y, x in polyline.decode(line, 6)]


def flights(sortie: dict[str, Any]) -> list[str]:
    return [*(visit["geometry"] for visit in sortie["customers"]), sortie["recovery_geometry"]]


def sorties(plan: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the sorties by their first customer."""
    return {sortie["customers"][0]["id"]: sortie for route in plan["routes"]
            for trip in route["trips"] for sortie in trip["sorties"]}


def metres(lines: list[str]) -> float:
    projection = LocalProjection.around(np.array([[24.941, 60.171]]))
    points = [projection.project(np.array(places(line))) for line in lines]
    return float(sum(np.hypot(*np.diff(line, axis=0).T).sum() for line in points))


def test_lines_lead_from_stop_to_stop(client: httpx.Client) -> None:
    plan = drawn(client, city())
    stops = plan["routes"][0]["trips"][0]["stops"]
    assert "geometry" not in stops[0]
    assert [places(stop["geometry"]) for stop in stops[1:]] == [
        [(24.940, 60.170), (24.939, 60.172)], [(24.939, 60.172), (24.940, 60.170)]]


def test_nothing_is_drawn_unless_asked_for(client: httpx.Client) -> None:
    assert "geometry" not in client.post("/plan", json=city() | {
        "options": {"time_limit": 0}}).text
    plan = drawn(client, city(), geometry=False)
    assert "geometry" not in str(plan)


@pytest.mark.parametrize("wind", [0, 30])
def test_flights_around_areas_are_drawn_as_they_are_flown(
        client: httpx.Client, wind: float) -> None:
    plan = drawn(client, city(no_fly=[NO_FLY], wind={"speed_kmh": wind, "direction_deg": 200}))
    found = sorties(plan)
    assert [len(places(line)) for line in flights(found["clear"])] == [2, 2]
    around = flights(found["behind"])
    assert all(len(places(line)) > 2 for line in around)
    for line in around:
        assert not Polygon(NO_FLY).buffer(-1e-5).intersects(LineString(places(line)))
    for sortie in found.values():
        assert metres(flights(sortie)) == pytest.approx(sortie["distance"], rel=2e-3)


def test_flights_are_chains_of_their_places(client: httpx.Client) -> None:
    plan = drawn(client, city(no_fly=[NO_FLY]))
    for customer, sortie in sorties(plan).items():
        (there, back) = map(places, flights(sortie))
        location = next(tuple(other["location"]) for other in city()["customers"]
                        if other["id"] == customer)
        assert there[-1] == back[0] == location


def test_planar_places_are_drawn_in_their_unit(client: httpx.Client,
                                               with_drones: dict[str, Any]) -> None:
    plan = drawn(client, with_drones)
    locations = {entry["id"]: tuple(entry["location"])
                 for entry in with_drones["depots"] + with_drones["customers"]}
    lines = 0
    for route in plan["routes"]:
        for trip in route["trips"]:
            for before, stop in pairwise(trip["stops"]):
                lines += 1
                assert places(stop["geometry"]) == [locations[before["id"]], locations[stop["id"]]]
    assert lines > 0


def test_places_without_locations_have_no_lines(client: httpx.Client) -> None:
    matrix = [[0, 60], [60, 0]]
    plan = drawn(client, {
        "depots": [{"id": "hub", "location_index": 0}],
        "customers": [{"id": "one", "location_index": 1, "demand": [1]}],
        "fleet": [{"id": "van", "count": 1, "capacity": [1], "profile": "road"}],
        "matrices": {"road": {"durations": matrix, "distances": matrix}}})
    assert [stop["geometry"] for stop in plan["routes"][0]["trips"][0]["stops"][1:]] == [None, None]


def test_plan_with_lines_can_be_checked_and_gone_on_from(client: httpx.Client) -> None:
    request = city(no_fly=[NO_FLY])
    plan = drawn(client, request)
    checked = client.post("/check", json={"problem": request, "plan": plan})
    assert checked.json()["violations"] == [], checked.text
