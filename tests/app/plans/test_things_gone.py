"""What the plan to go on from has and the request no longer: dropped, or too late and told."""

from typing import Any

import httpx
import pytest

from tests.app.plans.asking import judged

Data = dict[str, Any]


@pytest.fixture
def street() -> Data:
    """Return a van with a drone and a break, and a site from where it is launched."""
    return {
        "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": "a", "location": [1, 0], "demand": [1]},
                      {"id": "b", "location": [3, 0.1], "demand": [1]}],
        "launch_sites": [{"id": "field", "location": [3, 0]}],
        "fleet": [{"id": "van", "count": 1, "capacity": [9], "speed_kmh": 60,
                   "drones": {"count": 1, "capacity": [1], "speed_kmh": 60},
                   "breaks": [{"id": "tea", "duration": 60,
                               "start": {"earliest": 60, "latest": 600}}]}],
        "options": {"time_limit": 60, "search_iterations": 20}}


def stop(kind: str, name: str, arrival: float, departure: float) -> Data:
    """Return a stop at which service begins at once."""
    return {"kind": kind, "id": name, "arrival": arrival, "service_start": arrival,
            "departure": departure}


def tour(*breaks: Data) -> Data:
    """Return the van's trip: `a`, its breaks, and `b` by drone from the field."""
    later = 60 * len(breaks)
    stops = [stop("depot", "hub", 0, 0), stop("customer", "a", 60, 60), *breaks,
             stop("launch_site", "field", 180 + later, 192 + later),
             stop("depot", "hub", 372 + later, 372 + later)]
    place = len(stops) - 2
    flight = {"drone": "van-1/drone-1", "launch_stop": place, "recovery_stop": place,
              "launch_time": 180 + later, "recovery_time": 192 + later,
              "customers": [{"id": "b", "arrival": 186 + later, "service_start": 186 + later,
                             "departure": 186 + later}]}
    return {"routes": [{"vehicle": "van-1", "type": "van",
                        "trips": [{"stops": stops, "sorties": [flight]}]}]}


TEA = stop("break", "tea", 60, 120)


def asked(client: httpx.Client, request: Data, plan: Data, now: float | None,
          **terms: Any) -> httpx.Response:
    """Return the reply to planning on; what is planned has to be legal."""
    body = request | {"replan": {"plan": plan, "freeze_before": now, **terms}}
    reply = client.post("/plan", json=body)
    if reply.status_code == 200:
        assert judged(client, body, reply.json())["violations"] == []
    return reply


def refused(reply: httpx.Response) -> list[tuple[str, str]]:
    """Return code and path of each error of a refusal."""
    assert reply.status_code == 422, reply.text
    return [(error["code"], error["path"]) for error in reply.json()["errors"]]


def served(plan: Data) -> set[str]:
    """Return whom a plan serves."""
    return {each["id"] for route in plan["routes"] for trip in route["trips"] for each in (
        *(stop for stop in trip["stops"] if stop["kind"] == "customer"),
        *(visit for sortie in trip["sorties"] for visit in sortie["customers"]))}


@pytest.mark.parametrize("now", [None, 30])
def test_a_site_is_closed_before_anybody_drives_there(client: httpx.Client, street: Data,
                                                      now: float | None) -> None:
    del street["launch_sites"]
    del street["fleet"][0]["breaks"]
    reply = asked(client, street, tour(), now)
    assert reply.status_code == 200, reply.text
    assert served(reply.json()) == {"a", "b"}


@pytest.mark.parametrize("now", [100, 185, 300, 500])
def test_a_site_is_not_closed_once_a_vehicle_drives_there(client: httpx.Client, street: Data,
                                                          now: float) -> None:
    del street["launch_sites"]
    del street["fleet"][0]["breaks"]
    assert refused(asked(client, street, tour(), now)) == [
        ("UNKNOWN_DEPOT", "$.replan.plan.routes[0].trips[0].stops[2].id")]


@pytest.mark.parametrize("instead", [[], [{"id": "lunch", "duration": 60,
                                           "start": {"earliest": 60, "latest": 600}}]])
@pytest.mark.parametrize("now", [None, 30])
def test_a_break_is_dropped_before_it_begins(client: httpx.Client, street: Data,
                                             now: float | None, instead: list[Data]) -> None:
    street["fleet"][0]["breaks"] = instead
    reply = asked(client, street, tour(TEA), now)
    assert reply.status_code == 200, reply.text
    told = [stop["id"] for trip in reply.json()["routes"][0]["trips"] for stop in trip["stops"]
            if stop["kind"] == "break"]
    assert "tea" not in told
    assert served(reply.json()) == {"a", "b"}


@pytest.mark.parametrize("now", [60, 150, 700])
def test_a_break_that_has_begun_is_not_dropped(client: httpx.Client, street: Data,
                                               now: float) -> None:
    street["fleet"][0]["breaks"] = []
    assert refused(asked(client, street, tour(TEA), now)) == [
        ("UNKNOWN_BREAK", "$.replan.plan.routes[0].trips[0].stops[2].id")]


def test_a_break_that_is_called_a_launch_site_is_told(client: httpx.Client,
                                                      street: Data) -> None:
    plan = tour(TEA | {"kind": "launch_site"})
    assert refused(asked(client, street, plan, None)) == [
        ("UNKNOWN_DEPOT", "$.replan.plan.routes[0].trips[0].stops[2].id")]


def test_a_rest_is_dropped_with_its_rules(client: httpx.Client, street: Data) -> None:
    street["fleet"][0]["breaks"] = []
    assert asked(client, street, tour(TEA | {"id": "rest"}), None).status_code == 200


@pytest.mark.parametrize("kind", ["start", "end"])
def test_trips_that_have_not_begun_lead_where_vehicles_do_now(client: httpx.Client, street: Data,
                                                              kind: str) -> None:
    plan = tour(TEA)
    stops = plan["routes"][0]["trips"][0]["stops"]
    stops[0 if kind == "start" else -1] |= {"kind": kind, "id": "van"}
    reply = asked(client, street, plan, None)
    assert reply.status_code == 200, reply.text
    (trip,) = reply.json()["routes"][0]["trips"]
    assert {trip["stops"][0]["id"], trip["stops"][-1]["id"]} == {"hub"}


def row(names: str, kind: Data, relations: list[Data]) -> Data:
    """Return customers in a row, a kilometre apart."""
    return {"planar_unit": 1000, "depots": [{"id": "d", "location": [0, 0]}],
            "customers": [{"id": name, "location": [place, 0], "demand": [1]}
                          for place, name in enumerate(names, 1)],
            "fleet": [{"id": "t", "count": 2, "capacity": [3]} | kind], "relations": relations,
            "options": {"time_limit": 60, "search_iterations": 20}}


@pytest.mark.parametrize("are_equal", [True, False])
def test_relations_cut_in_two_count_once(client: httpx.Client, are_equal: bool) -> None:
    names = "abcdefgh"
    pairs = [[one, other] for one in names[:4] for other in names[4:]] * 4
    if not are_equal:
        pairs = [[one, other, more] for one in names[:4] for other in names[4:7]
                 for more in names if more not in (one, other)][:62]
    request = row(names, {"max_trips": 2, "capacity": [4]},
                  [{"kind": "together", "customers": pair} for pair in pairs[:62]])
    stops = [stop("depot", "d", 0, 0)]
    stops += [stop("customer", name, 90 * place, 90 * place)
              for place, name in enumerate(names[:4], 1)]
    plan = {"routes": [{"vehicle": "t-1", "type": "t", "trips": [
        {"stops": [*stops, stop("depot", "d", 720, 720)]}]}]}
    reply = asked(client, request, plan, 10)
    assert reply.status_code == 200, reply.text
    assert {route["vehicle"] for route in reply.json()["routes"]} == {"t-1"}
    assert served(reply.json()) == set(names)


def test_places_are_kept_late_in_time(client: httpx.Client) -> None:
    late = 1e9
    request = row("ab", {}, [])
    request["customers"][0]["release_time"] = late
    plan = {"routes": [{"vehicle": "t-1", "type": "t", "trips": [{"stops": [
        stop("depot", "d", late, late), stop("customer", "a", late + 90, late + 90),
        stop("customer", "b", late + 180, late + 180), stop("depot", "d", late + 360, late + 360),
    ]}]}]}
    reply = asked(client, request, plan, None, pinned=["a"], keep_order=True)
    assert reply.status_code == 200, reply.text
    assert reply.json()["cost"]["total"] == pytest.approx(4.0)
