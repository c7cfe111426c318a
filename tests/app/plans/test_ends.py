"""Where vehicles begin and end, over HTTP: planned, replied, checked and gone on from."""

from typing import Any

import httpx
import pytest

from tests.app.plans.asking import judged, planned_and_judged

Request = dict[str, Any]


@pytest.fixture
def street() -> Request:
    """Return a request with a depot, two customers and a place beyond, each 1 km from the next."""
    return {
        "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": "near", "location": [1, 0], "demand": [1], "service_duration": 60},
                      {"id": "far", "location": [2, 0], "demand": [1], "service_duration": 60}],
        "fleet": [{"id": "van", "count": 1, "capacity": [2], "speed_kmh": 60}],
        "options": {"time_limit": 0},
    }


def errors_of(client: httpx.Client, path: str, request: Request) -> list[tuple[str, str]]:
    """Return the codes and paths of a refusal."""
    reply = client.post(path, json=request)
    assert reply.status_code == 422, reply.text
    return [(error["code"], error["path"]) for error in reply.json()["errors"]]


def stops_of(plan: Request) -> list[tuple[str, str]]:
    """Return the stops of the only trip."""
    (route,) = plan["routes"]
    (trip,) = route["trips"]
    return [(stop["kind"], stop["id"]) for stop in trip["stops"]]


def test_an_open_route_ends_at_its_last_stop(client: httpx.Client, street: Request) -> None:
    street["fleet"][0]["end"] = "open"
    plan = planned_and_judged(client, street)
    assert stops_of(plan) == [("depot", "hub"), ("customer", "near"), ("customer", "far")]
    trip = plan["routes"][0]["trips"][0]
    assert trip["distance"] == plan["summary"]["distance"] == 2000
    # 1 km a minute, a minute of service at each of two.
    assert trip["duration"] == plan["summary"]["makespan"] == 240
    assert trip["stops"][-1]["departure"] == 240
    assert [stop["load"] for stop in trip["stops"]] == [[2], [1], [0]]


def test_routes_begin_and_end_at_places_of_their_own(client: httpx.Client,
                                                     street: Request) -> None:
    street["fleet"][0] |= {"start_location": [0, 1], "end": {"location": [3, 0]}}
    plan = planned_and_judged(client, street)
    assert stops_of(plan) == [("start", "van"), ("customer", "near"), ("customer", "far"),
                              ("end", "van")]
    assert plan["summary"]["distance"] == pytest.approx(2**0.5 * 1000 + 2000, abs=1)


def test_places_have_rows_in_matrices(client: httpx.Client, street: Request) -> None:
    for index, place in enumerate([*street["depots"], *street["customers"]]):
        place |= {"location_index": index}
    legs = [[abs(row - column) * 60 for column in range(6)] for row in range(6)]
    street["matrices"] = {"truck": {"durations": legs, "distances": legs}}
    street["fleet"][0] |= {"start_location_index": 5, "end": {"location_index": 4}}
    plan = planned_and_judged(client, street)
    assert stops_of(plan)[0] == ("start", "van")
    assert plan["summary"]["distance"] == (4 + 1 + 2) * 60
    street["fleet"][0] |= {"end": {"location": [3, 0]}, "start_location_index": 9}
    assert errors_of(client, "/plan", street) == [
        ("MATRIX_SIZE", "$.fleet[0].start_location_index"),
        ("MISSING_LOCATION_INDEX", "$.fleet[0].end.location_index")]
    street["fleet"][0] |= {"end": "open", "start_location_index": None}
    assert stops_of(planned_and_judged(client, street))[-1] == ("customer", "far")


@pytest.mark.parametrize(("change", "error"), [
    ({"end": "home"}, ("UNKNOWN_VALUE", "$.fleet[0].end")),
    ({"end": {"place": [1, 1]}}, ("UNKNOWN_FIELD", "$.fleet[0].end.place")),
    ({"end": {"location": [1]}}, ("MISSING_FIELD", "$.fleet[0].end.location[1]")),
    ({"end": None}, ("WRONG_TYPE", "$.fleet[0].end")),
    ({"end": {}}, ("MISSING_LOCATION", "$.fleet[0].end.location")),
    ({"start_location": [1e9, 0]}, ("LOCATION_TOO_FAR", "$.fleet[0].start_location")),
])
def test_wrong_places_are_refused(client: httpx.Client, street: Request, change: Request,
                                  error: tuple[str, str]) -> None:
    street["fleet"][0] |= change
    assert errors_of(client, "/plan", street) == [error]


def test_plans_that_end_elsewhere_break_a_rule(client: httpx.Client, street: Request) -> None:
    plan = planned_and_judged(client, street)
    for change in ({"end": "open"}, {"end": {"location": [3, 0]}}, {"start_location": [0, 1]}):
        problem = street | {"fleet": [street["fleet"][0] | change]}
        verdict = client.post("/check", json={"problem": problem, "plan": plan}).json()
        assert [broken["code"] for broken in verdict["violations"]] == ["DEPOT"]
    elsewhere = street | {"fleet": [street["fleet"][0] | {"end": {"location": [3, 0]}}]}
    plan = planned_and_judged(client, elsewhere)
    assert errors_of(client, "/check", {"problem": street, "plan": plan}) == [
        ("UNKNOWN_DEPOT", "$.plan.routes[0].trips[0].stops[3].id")]


def test_trips_meet_at_any_depot_to_reload_at(client: httpx.Client, street: Request) -> None:
    street["depots"].append({"id": "east", "location": [3, 0]})
    street["fleet"][0] |= {"capacity": [1], "max_trips": 2, "end": "open",
                           "reload_depots": ["east"]}
    # 1 km a minute, a minute of service at each of two: by the east, and ending at the second.
    times = [[("depot", "hub", 0, 0), ("customer", "near", 60, 120), ("depot", "east", 240, 240)],
             [("depot", "east", 240, 240), ("customer", "far", 300, 360)]]
    trips = [{"stops": [{"kind": kind, "id": name, "arrival": arrival, "service_start": arrival,
                         "departure": departure} for kind, name, arrival, departure in stops]}
             for stops in times]
    plan = {"routes": [{"vehicle": "van-1", "type": "van", "trips": trips}]}
    verdict = client.post("/check", json={"problem": street, "plan": plan}).json()
    assert verdict["violations"] == []
    assert (verdict["summary"]["distance"], verdict["summary"]["makespan"]) == (4000, 360)
    street["fleet"][0]["reload_depots"] = []
    verdict = client.post("/check", json={"problem": street, "plan": plan}).json()
    assert [broken["path"] for broken in verdict["violations"]] == [
        "$.plan.routes[0].trips[0].stops[2]"]
    street["fleet"][0]["reload_depots"] = ["west"]
    assert errors_of(client, "/plan", street) == [
        ("UNKNOWN_DEPOT", "$.fleet[0].reload_depots[0]")]


def test_flights_alone_may_be_an_open_route(client: httpx.Client, street: Request) -> None:
    street["fleet"][0] |= {"end": "open", "drones": {"count": 1, "capacity": [2], "speed_kmh": 60}}
    street["customers"] = [street["customers"][0] | {"served_by": "drone"}]
    plan = planned_and_judged(client, street)
    assert stops_of(plan) == [("depot", "hub")]
    (sortie,) = plan["routes"][0]["trips"][0]["sorties"]
    assert (sortie["launch_stop"], sortie["recovery_stop"]) == (0, 0)
    assert plan["routes"][0]["trips"][0]["duration"] == 180


def test_an_open_route_may_end_at_a_launch_site(client: httpx.Client, street: Request) -> None:
    street["fleet"][0] |= {"end": "open", "drones": {"count": 1, "capacity": [2], "speed_kmh": 60}}
    street["launch_sites"] = [{"id": "yard", "location": [2, 1]}]
    plan = planned_and_judged(client, street)
    trip = plan["routes"][0]["trips"][0]
    trip["stops"].append({"kind": "launch_site", "id": "yard", "arrival": 300,
                          "service_start": 300, "departure": 300})
    assert judged(client, street, plan)["violations"] == []


def test_a_day_under_way_ends_where_it_was_to(client: httpx.Client, street: Request) -> None:
    for change in ({"end": "open"}, {"end": {"location": [9, 0]}}):
        request = street | {"fleet": [street["fleet"][0] | change | {"capacity": [3]}]}
        plan = planned_and_judged(client, request)
        for now, settled in ((10, 1), (10_000, len(stops_of(plan)) - 1)):
            replan = {"plan": plan, "freeze_before": now}
            again = client.post("/plan", json=request | {"replan": replan})
            assert again.status_code == 200, again.text
            assert stops_of(again.json()) == stops_of(plan)
            assert again.json()["replan"]["settled"] == [
                {"vehicle": "van-1", "trip": 0, "stop": settled}]
