"""Zones in requests: who is flown to, around what, and what those left out are told."""

import json
from typing import Any

import httpx
import pytest

from app.requests.conversion.problem import to_problem
from app.requests.reading import read_request
from app.requests.refusal import LISTED_BYTES
from tests.app.maps.airspace.published import circle, ed269, ed318, geojson, layer, volume, zone
from tests.app.plans.asking import planned

DEPOT, BEHIND = [24.90, 60.17], [24.96, 60.17]
WALL = [[24.92, 60.15], [24.94, 60.15], [24.94, 60.19], [24.92, 60.19]]
WALL_AREA = {"type": "Polygon", "coordinates": [WALL]}
STRAIGHT_M = 3317.6


def asked(*zones: dict[str, Any], altitude: float = 100, **more: Any) -> dict[str, Any]:
    """Return a request of a customer behind a wall, whom a drone is to serve."""
    stated = ("cleared", "conditional", "ground")
    airspace: dict[str, Any] = {name: more.pop(name) for name in stated
                                if name in more}
    return {
        "coordinate_system": "geographic",
        "depots": [{"id": "hub", "location": DEPOT}],
        "customers": [{"id": "behind", "location": BEHIND, "demand": [1], "served_by": "drone"}],
        "fleet": [{"id": "truck", "count": 1, "capacity": [9], "shift": {"latest": 28_800},
                   "drones": {"count": 1, "capacity": [9], "altitude": altitude}}],
        "airspace": {"zones": list(zones), **airspace}, "options": {"search_iterations": 0}} | more


def flown(client: httpx.Client, request: dict[str, Any]) -> float:
    """Return the metres flown to the customer and back."""
    plan = planned(client, request)
    return float(plan["summary"]["drone_distance"])


def wall(**changed: Any) -> dict[str, Any]:
    return volume(horizontalProjection=WALL_AREA, **changed)


def test_a_zone_is_flown_around(client: httpx.Client) -> None:
    free = flown(client, asked())
    assert free == pytest.approx(2 * STRAIGHT_M, rel=1e-3)
    # At the nearest two corners, 2,224 m north or south of the straight line.
    around = 2 * (2 * (1105.6**2 + 2224**2) ** 0.5 + 1105.9)
    assert flown(client, asked(ed269(zone(wall())))) == pytest.approx(around, rel=3e-3)


@pytest.mark.parametrize(("stated", "more"), [
    (ed269(zone(wall(upperLimit=80))), {}),
    (ed269(zone(wall(lowerLimit=120))), {}),
    (ed269(zone(wall(lowerLimit=120, uomDimensions="FT"))), {"altitude": 30}),
    (ed269(zone(wall(), restriction="NO_RESTRICTION")), {}),
    (ed269(zone(wall(), restriction="CONDITIONAL")), {"conditional": "allow"}),
    (ed269(zone(wall())), {"cleared": ["FIN0001"]}),
    (ed318(WALL_AREA | {"layer": layer(9000, 10_000, reference="AMSL")}), {}),
    (ed318(WALL_AREA | {"layer": layer(300, 900, reference="AMSL")}),
     {"ground": {"lowest": 0, "highest": 150}}),
    (ed269(zone(wall(), applicability=[{"permanent": "NO",
                                        "endDateTime": "2026-11-25T00:00:00Z"}])),
     {"plan_start": "2026-11-26T08:00:00Z"}),
])
def test_a_zone_that_does_not_count_is_flown_through(
        client: httpx.Client, stated: dict[str, Any], more: dict[str, Any]) -> None:
    assert flown(client, asked(stated, **more)) == pytest.approx(2 * STRAIGHT_M, rel=1e-3)


@pytest.mark.parametrize(("stated", "more"), [
    (ed269(zone(wall(upperLimit=80))), {"altitude": 80}),
    (ed269(zone(wall(lowerLimit=120, upperLimit=500, uomDimensions="FT"))), {"altitude": 40}),
    (ed269(zone(wall(), restriction="CONDITIONAL")), {}),
    (ed269(zone(wall(), restriction="REQ_AUTHORISATION")), {"cleared": ["FIN0002"]}),
    (geojson(WALL_AREA), {"altitude": 5000}),
    (ed318(WALL_AREA | {"layer": layer(300, 900, reference="AMSL")}), {}),
    (ed318(WALL_AREA | {"layer": layer(300, 900, reference="AMSL")}),
     {"ground": {"lowest": 0, "highest": 210}}),
    (ed269(zone(wall(), applicability=[{"permanent": "NO",
                                        "endDateTime": "2026-11-26T09:00:00Z"}])),
     {"plan_start": "2026-11-26T08:00:00Z"}),
])
def test_a_zone_that_counts_is_flown_around(
        client: httpx.Client, stated: dict[str, Any], more: dict[str, Any]) -> None:
    assert flown(client, asked(stated, **more)) > 2.5 * STRAIGHT_M


def test_drones_at_several_altitudes_meet_different_zones() -> None:
    request = asked(ed269(zone(wall(lowerLimit=90))))
    high = request["fleet"][0]["drones"] | {"id": "high"}
    request["fleet"][0]["drones"] = [high, high | {"id": "low", "altitude": 60}]
    problem = to_problem(read_request(json.dumps(request).encode(), None))
    around, through = (problem.travel[drones.travel].arrays()[1][0, 1] / 1000
                       for drones in problem.vehicle_types[0].drone_types)
    assert through == pytest.approx(STRAIGHT_M, rel=1e-3)
    assert around > 1.5 * STRAIGHT_M


@pytest.mark.parametrize("upper", [150, 40])
def test_who_lies_in_a_zone_is_told_which_and_whose(client: httpx.Client, upper: int) -> None:
    stated = ed269(zone(circle(400, BEHIND, upperLimit=upper)))
    (left,) = planned(client, asked(stated))["unassigned"]
    (reason,) = left["reasons"]
    assert reason["code"] == "AIRSPACE"
    assert reason["message"] == (
        f"It lies in the zone Harbour (FIN0001), where flying is prohibited from the ground to "
        f"{upper} m above the ground. Its authority: Port, tower@port.example.")
    assert reason["zone"] == {
        "holds": "customer", "name": "Harbour", "identifier": "FIN0001",
        "restriction": "PROHIBITED", "lower": {"value": 0, "unit": "M", "reference": "AGL"},
        "upper": {"value": upper, "unit": "M", "reference": "AGL"},
        "authority": "Port, tower@port.example",
        "message": reason["message"].removeprefix("It lies in ")}
    assert reason["remedy"] == "fits if a truck may serve it"


@pytest.mark.parametrize("end", ["pickup", "delivery"])
def test_a_shipment_of_vehicles_that_fly_is_told_which_zone_keeps_them_off(
        client: httpx.Client, end: str) -> None:
    request = asked(ed269(zone(circle(400, BEHIND))), customers=[
        {"id": "s", "location": DEPOT, "demand": [1]}])
    (kind,) = request["fleet"]
    kind["flies"] = kind.pop("drones") is not None
    ends = {"pickup": DEPOT, "delivery": DEPOT} | {end: BEHIND}
    request["shipments"] = [{"id": "s", "amount": [1]} | {
        name: {"location": place, "served_by": "either"} for name, place in ends.items()}]
    (left,) = planned(client, request)["unassigned"]
    (reason,) = left["reasons"]
    assert (left["kind"], reason["code"]) == ("shipment", "AIRSPACE")
    assert reason["message"].startswith("It lies in the zone Harbour (FIN0001)")


def test_who_lies_behind_a_zone_is_told_which(client: httpx.Client) -> None:
    outer = [[24.95, 60.16], [24.97, 60.16], [24.97, 60.18], [24.95, 60.18]]
    inner = [[24.955, 60.165], [24.965, 60.165], [24.965, 60.175], [24.955, 60.175]]
    ring = ed269(zone(volume(
        horizontalProjection={"type": "Polygon", "coordinates": [outer, inner]})))
    (left,) = planned(client, asked(ring))["unassigned"]
    (reason,) = left["reasons"]
    assert reason["code"] == "AIRSPACE"
    assert reason["message"].startswith(
        "No flight leads there from the depot around the zone Harbour (FIN0001), ")
    assert reason["zone"]["holds"] == "way"


def test_a_depot_in_a_zone_is_told(client: httpx.Client) -> None:
    (left,) = planned(client, asked(ed269(zone(circle(400, DEPOT, upperLimit=99999)))))[
        "unassigned"]
    (reason,) = left["reasons"]
    assert reason["message"].startswith("The depot lies in the zone Harbour")
    assert (reason["zone"]["holds"], reason["zone"]["upper"]) == ("depot", None)


def test_explain_lists_the_zones_around_a_customer(client: httpx.Client) -> None:
    request = asked(ed269(zone(circle(400, BEHIND), restriction="REQ_AUTHORISATION")))
    request["customers"][0]["served_by"] = "either"
    plan = planned(client, request)
    reply = client.post("/explain", json={"problem": request, "plan": plan,
                                          "customer": "behind"}).json()
    (told,) = reply["zones"]
    assert (told["holds"], told["restriction"]) == ("customer", "REQ_AUTHORISATION")
    assert told["message"] == (
        "the zone Harbour (FIN0001), where flying takes an authorisation from the ground to 120 m "
        "above the ground. Its authority: Port, tower@port.example.")


def test_zones_on_the_way_around_areas_are_flown_around(client: httpx.Client) -> None:
    request = asked(geojson({"type": "Polygon", "coordinates": [
        [[24.91, 60.185], [24.95, 60.185], [24.95, 60.21], [24.91, 60.21]]]}))
    request["airspace"]["no_fly"] = [
        [[24.92, 60.15], [24.94, 60.15], [24.94, 60.186], [24.92, 60.186]]]
    alone = request | {"airspace": {"no_fly": request["airspace"]["no_fly"]}}
    flown, straighter = (planned(client, each)["summary"]["drone_distance"]
                         for each in (request, alone))
    assert flown > straighter + 500


BOWTIE = [[24.90, 60.20], [24.92, 60.21], [24.92, 60.20], [24.90, 60.21]]


@pytest.mark.parametrize(("changes", "code", "path"), [
    ({"coordinate_system": "planar"}, "ZONES_ON_PLANE", "$.airspace.zones"),
    ({"zones": [ed269(zone(wall(lowerVerticalReference="FL")))]}, "UNKNOWN_VALUE",
     "$.airspace.zones[0].data.features[0].geometry[0].lowerVerticalReference"),
    ({"zones": [geojson({"type": "Polygon", "coordinates": [BOWTIE]})]}, "ZONE_UNREADABLE",
     "$.airspace.zones[0].data.features[0].geometry.coordinates"),
    ({"zones": [{"format": "openair", "data": ""}]}, "UNKNOWN_VALUE", "$.airspace.zones[0]"),
    ({"zones": [{"format": "kml", "data": "hello"}]}, "ZONE_UNREADABLE",
     "$.airspace.zones[0].data"),
    ({"ground": {"lowest": 5, "highest": 4}}, "OUT_OF_RANGE", "$.airspace.ground.highest"),
])
def test_what_is_wrong_with_zones_is_told(client: httpx.Client, changes: dict[str, Any],
                                          code: str, path: str) -> None:
    request = asked(ed269(zone(wall())))
    for name, value in changes.items():
        (request if name in request else request["airspace"])[name] = value
    reply = client.post("/plan", json=request)
    assert reply.status_code == 422
    assert (code, path) in {(error["code"], error["path"]) for error in reply.json()["errors"]}


def mask(*holes: list[list[float]]) -> dict[str, Any]:
    """Return a zone that closes the world but for holes."""
    edge = [[-180, -90], [180, -90], [180, 90], [-180, 90]]
    return geojson({"type": "Polygon", "coordinates": [edge, *holes]}, identifier="mask")


def test_flights_stay_in_the_hole_of_a_mask(client: httpx.Client) -> None:
    square = [[24.8, 60.1], [25.0, 60.1], [25.0, 60.2], [24.8, 60.2]]
    assert flown(client, asked(mask(square))) == pytest.approx(2 * STRAIGHT_M, rel=1e-3)
    # A bay in the hole's south edge lies between the two, the way leads north around it.
    bay = [[24.8, 60.1], [24.92, 60.1], [24.92, 60.19], [24.94, 60.19], [24.94, 60.1],
           [25.0, 60.1], [25.0, 60.3], [24.8, 60.3]]
    around = 2 * (2 * (1105.6**2 + 2224**2) ** 0.5 + 1105.9)
    assert flown(client, asked(mask(bay))) == pytest.approx(around, rel=3e-3)


@pytest.mark.parametrize("where", [[25.2, 60.17], [40.0, 55.0]])
def test_who_lies_outside_the_holes_of_a_mask_is_told(client: httpx.Client,
                                                      where: list[float]) -> None:
    square = [[24.8, 60.1], [25.0, 60.1], [25.0, 60.2], [24.8, 60.2]]
    request = asked(mask(square))
    request["customers"].append(
        {"id": "abroad", "location": where, "demand": [1], "served_by": "drone"})
    (left,) = planned(client, request)["unassigned"]
    (reason,) = left["reasons"]
    assert (left["id"], reason["code"], reason["zone"]["identifier"]) == (
        "abroad", "AIRSPACE", "mask")


def test_no_flight_leads_from_hole_to_hole_of_a_mask(client: httpx.Client) -> None:
    holes = [[[west, 60.1], [west + 0.03, 60.1], [west + 0.03, 60.2], [west, 60.2]]
             for west in (24.88, 24.94)]
    (left,) = planned(client, asked(mask(*holes)))["unassigned"]
    assert [reason["code"] for reason in left["reasons"]] == ["AIRSPACE"]


def test_a_zone_on_the_other_side_of_the_globe_bars_nobody(client: httpx.Client) -> None:
    antipode = [DEPOT[0] - 180, -DEPOT[1]]
    assert flown(client, asked(ed269(zone(circle(50_000, antipode))))) == pytest.approx(
        2 * STRAIGHT_M, rel=1e-3)


BELT = [[longitude, latitude] for latitude, longitudes in (
    (60.0, (-180, -90, 0, 90, 180)), (60.1, (180, 90, 0, -90, -180))) for longitude in longitudes]
WORLD = [[longitude, 60.0] for longitude in (0, 120, -120)]


@pytest.mark.parametrize(("stated", "words"), [
    (ed269(zone(wall(lowerVerticalReference="FL"))), "must be one of 'AGL', 'AMSL' or 'WGS84'"),
    (ed318(WALL_AREA | {"layer": layer(0, 90, reference="QNH")}), "must be one of 'AGL', 'AMSL'"),
    (geojson({"type": "Polygon", "coordinates": [BOWTIE]}), "list its corners once each, in order"),
    (geojson({"type": "Polygon", "coordinates": [BELT]}), "reaches around the world: split it"),
    (geojson({"type": "Polygon", "coordinates": [WORLD]}), "reaches around the world: split it"),
    (ed269(zone(circle(2e6))), "reaches around the world: a radius is in metres"),
    (geojson({"type": "Polygon", "coordinates": [[[200, 60], [201, 60], [201, 61]]]}),
     "is no longitude and latitude: correct it, or swap the two"),
])
def test_zones_that_make_no_sense_are_refused_in_words(
        client: httpx.Client, stated: dict[str, Any], words: str) -> None:
    reply = client.post("/plan", json=asked(stated))
    assert reply.status_code == 422
    for error in reply.json()["errors"]:
        assert words in error["message"]


def test_a_hundred_megabytes_of_zones_are_refused(client: httpx.Client) -> None:
    part = json.dumps(zone(wall())).encode() * 2**10
    reply = client.post("/plan", content=iter([part] * (1 + 100 * 2**20 // len(part))))
    assert (reply.status_code, reply.json()["title"]) == (413, "The body is too large")


def test_long_bodies_of_every_format_are_read() -> None:
    areas = {"type": "GeometryCollection",
             "geometries": [WALL_AREA, {"type": "MultiPolygon", "coordinates": [[WALL]]}]}
    alone = {"format": "geojson", "data": {
        "type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [[WALL]] * 300},
        "properties": {"name": {"text": "x"}, "upperLimit": "300", "applicability": None}}}
    many = [ed269(*[zone(wall(), circle(), region=index) for index in range(200)]),
            ed318(areas | {"layer": layer(0, 90, "FT")}), geojson(areas, note={"any": [1, {}]}),
            alone, {"format": "geojson", "data": WALL_AREA | {"bbox": [0, 1, 2, 3]}}]
    body = json.dumps(asked(*many, *[ed318(WALL_AREA)] * 90)).encode()
    assert len(body) > LISTED_BYTES
    assert len(read_request(body, None).airspace.zones) == 95
