"""`POST /flights`: what is asked for, and what is refused."""

import copy
import io
import zipfile

import httpx
import pytest
from lxml import etree

from app.plans.flights.flight import NOTE
from tests.app.plans.asking import documented, refused
from tests.app.plans.flights.asking import ZONE, Data, city, files_of, plan_file, planned, sent

MEDIA_TYPES = {
    "qgc-plan": ("application/json", ".plan"),
    "qgc-wpl": ("text/plain; charset=utf-8", ".waypoints"),
    "kml": ("application/vnd.google-earth.kml+xml", ".kml"),
    "dji-wpml": ("application/vnd.google-earth.kmz", ".kmz"),
    "geojson": ("application/geo+json", ".geojson"),
}


@pytest.mark.parametrize("file_format", MEDIA_TYPES)
def test_one_drone_is_one_file_of_its_kind(client: httpx.Client, file_format: str) -> None:
    problem = city(airspace={})
    reply = sent(client, problem, planned(client, problem), file_format, "vehicle")
    media_type, ending = MEDIA_TYPES[file_format]
    assert reply.headers["content-type"] == media_type
    assert list(files_of(reply)) == [f"van-1-drone-1{ending}"]


@pytest.mark.parametrize("file_format", MEDIA_TYPES)
def test_each_flight_is_a_file_of_a_zip(client: httpx.Client, file_format: str) -> None:
    problem = city(airspace={})
    plan = planned(client, problem)
    files = files_of(sent(client, problem, plan, file_format))
    ending = MEDIA_TYPES[file_format][1]
    assert list(files) == [f"van-1-drone-1-flight-{number}{ending}" for number in (1, 2, 3)]


def test_documented_example_is_answered(client: httpx.Client) -> None:
    files = files_of(client.post("/flights", json=documented("flights")))
    mission = plan_file(files, "van-1-drone-1.plan")
    assert (mission["fileType"], mission["comment"]) == ("Plan", NOTE)
    operation = client.get("/openapi.json").json()["paths"]["/flights"]["post"]
    body = operation["requestBody"]["content"]["application/json"]
    assert body["examples"]["flights"]["value"] == documented("flights")
    told = {name.partition(";")[0] for name, _ in MEDIA_TYPES.values()} | {"application/zip"}
    assert set(operation["responses"]["200"]["content"]) == told


def test_note_speaks_of_no_permission() -> None:
    assert "no permission to fly" in NOTE
    assert "authori" not in NOTE


def test_plane_has_no_flights(client: httpx.Client, with_drones: Data) -> None:
    plan = client.post("/plan", json=with_drones).json()
    body = {"problem": with_drones, "plan": plan, "format": "kml"}
    assert refused(client, body, "/flights") == [
        ("FLIGHTS_ON_PLANE", "$.problem.coordinate_system")]


def test_plans_without_flights_are_told(client: httpx.Client) -> None:
    problem = city()
    problem["customers"] = problem["customers"][:1]
    plan = client.post("/plan", json=problem).json()
    assert refused(client, {"problem": problem, "plan": plan, "format": "kml"}, "/flights") == [
        ("NO_FLIGHTS", "$.plan.routes")]


def test_plans_that_break_rules_are_not_written(client: httpx.Client) -> None:
    problem = city()
    plan = planned(client, problem)
    now_closed = city(drones={"endurance": 100})
    codes = {code for code, _ in refused(
        client, {"problem": now_closed, "plan": plan, "format": "kml"}, "/flights")}
    assert codes == {"ILLEGAL_PLAN"}


def test_unknown_formats_and_fields_are_refused(client: httpx.Client) -> None:
    problem = city()
    body = {"problem": problem, "plan": planned(client, problem), "format": "gpx", "way": 1}
    assert set(refused(client, body, "/flights")) == {
        ("UNKNOWN_VALUE", "$.format"), ("UNKNOWN_FIELD", "$.way")}
    del body["format"]
    assert ("MISSING_FIELD", "$.format") in refused(client, body, "/flights")


def test_drones_too_fast_or_low_for_wpml_are_told(client: httpx.Client) -> None:
    problem = city(drones={"speed_kmh": 60})
    body = {"problem": problem, "plan": planned(client, problem), "format": "dji-wpml"}
    assert refused(client, body, "/flights") == [("BEYOND_FORMAT", "$.format")]
    low = city(drones={"altitude": 0})
    body = {"problem": low, "plan": planned(client, low), "format": "dji-wpml"}
    assert refused(client, body, "/flights") == [("BEYOND_FORMAT", "$.format")]


def wpml_of(reply: httpx.Response) -> dict[str, str]:
    """Return what holds for all way lines of the first file of a reply, in both of its parts."""
    content = next(iter(files_of(reply).values()))
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        parts = [etree.fromstring(archive.read(name)) for name in archive.namelist()]
    found = [{etree.QName(each).localname: each.text or "" for each in
              part.find(".//{*}missionConfig").iter()} for part in parts]
    assert found[0] == found[1]
    return found[0]


def test_what_way_lines_do_where_control_is_lost_is_asked_for(client: httpx.Client) -> None:
    problem = city()
    plan = planned(client, problem)
    body: Data = {"problem": problem, "plan": plan, "format": "dji-wpml"}
    told = wpml_of(client.post("/flights", json=body))
    assert (told["exitOnRCLost"], told["executeRCLostAction"]) == ("goContinue", "hover")
    assert (told["flyToWaylineMode"], told["droneEnumValue"]) == ("safely", "89")
    body["wpml"] = {"exit_on_rc_lost": "executeLostAction", "rc_lost_action": "landing",
                    "fly_to_wayline": "pointToPoint", "aircraft": 77, "aircraft_variant": 1}
    told = wpml_of(client.post("/flights", json=body))
    assert (told["exitOnRCLost"], told["executeRCLostAction"]) == ("executeLostAction", "landing")
    assert (told["flyToWaylineMode"], told["droneEnumValue"], told["droneSubEnumValue"]) == (
        "pointToPoint", "77", "1")
    body["wpml"] = {"exit_on_rc_lost": "land", "aircraft": -1, "drone": 1}
    assert set(refused(client, body, "/flights")) == {
        ("UNKNOWN_VALUE", "$.wpml.exit_on_rc_lost"), ("OUT_OF_RANGE", "$.wpml.aircraft"),
        ("UNKNOWN_FIELD", "$.wpml.drone")}


def test_no_flight_of_stated_durations_leads_through_a_zone(client: httpx.Client) -> None:
    """What a matrix says of durations says nothing of ways."""
    problem = city()
    seconds = [[0 if row == column else 120 for column in range(5)] for row in range(5)]
    problem["matrices"] = {"drone": {"durations": seconds}}
    for index, place in enumerate([*problem["depots"], *problem["customers"]]):
        place["location_index"] = index
    flights = plan_file(files_of(sent(client, problem, planned(client, problem), "geojson",
                                      "vehicle")), "van-1-drone-1.geojson")["features"]
    to_park = next(each for each in flights if each["properties"].get("customers") == ["park"])
    corners = [tuple(place[:2]) for place in to_park["geometry"]["coordinates"]]
    assert any(abs(x - 24.937) + abs(y - 60.176) < 1e-5 for x, y in corners)

    inside = copy.deepcopy(problem)
    inside["customers"][1]["location"] = [24.934, 60.173]
    body = {"problem": inside, "plan": planned(client, inside), "format": "kml"}
    assert refused(client, body, "/flights") == [("NO_WAY_AROUND", "$.problem.airspace")]


def test_odd_names_make_names_of_files(client: httpx.Client) -> None:
    problem = city(airspace={})
    problem["fleet"] = [{**problem["fleet"][0], "id": name} for name in ("../é ", "..\\è \u0001")]
    problem["customers"] = [
        {**customer, "vehicles": {"allowed": [problem["fleet"][index % 2]["id"]]},
         "id": customer["id"] + "\u0007"}
        for index, customer in enumerate(problem["customers"])]
    plan = planned(client, problem)
    assert plan["unassigned"] == []
    for file_format in MEDIA_TYPES:
        names = list(files_of(sent(client, problem, plan, file_format)))
        assert len(names) == len(set(names)) == 3
        assert all(name.isascii() and "/" not in name and not name.startswith(".")
                   for name in names)


def test_zones_far_away_are_left_out(client: httpx.Client) -> None:
    far = [[x + 1, y] for x, y in ZONE]
    problem = city(airspace={"no_fly": [ZONE, far]})
    flights = plan_file(files_of(sent(client, problem, planned(client, problem), "qgc-plan",
                                      "vehicle")), "van-1-drone-1.plan")
    assert [fence["polygon"] for fence in flights["geoFence"]["polygons"]] == [
        [[y, x] for x, y in ZONE]]
