"""Vehicles that fly from depots by themselves, over HTTP."""

from itertools import accumulate, pairwise
from typing import Any

import httpx
import pytest
from tests.app.plans.asking import planned

Request = dict[str, Any]

ENERGY = {"battery_wh": 100, "reserve": 0, "power": {"cruise_w": 200, "cruise_w_per_kg": 20}}


def by_air(request: Request, **stated: object) -> Request:
    """Return a request all of whose customers drones of the depot serve."""
    request["options"] = {"time_limit": 60, "search_iterations": 300}
    kind = request["fleet"][0]
    kind |= {"flies": True, "speed_kmh": 60, "max_trips": 10, "launch_duration": 20,
             "recovery_duration": 10, **stated}
    return request


def searched(client: httpx.Client, searching: httpx.Client, request: Request) -> Request:
    """Return the plan that a search makes of a service's first one."""
    plan = planned(client, request)
    return planned(searching, request | {"replan": {"plan": plan}})


def trips_of(plan: Request) -> list[Request]:
    """Return all trips."""
    return [trip for route in plan["routes"] for trip in route["trips"]]


def is_feasible(client: httpx.Client, request: Request, plan: Request) -> bool:
    """Tell whether the judge finds nothing wrong with a plan that was sent back."""
    answer = client.post("/check", json={"problem": request, "plan": plan}).json()
    return bool(answer["feasible"])


def test_drones_fly_from_the_depot(client: httpx.Client, smallest: Request) -> None:
    for customer in smallest["customers"]:
        customer["served_by"] = "drone"
    request = by_air(smallest, energy=ENERGY)
    plan = planned(client, request)
    assert plan["status"] == "complete"
    for trip in trips_of(plan):
        first, *_, last = trip["stops"]
        assert first["departure"] - first["arrival"] == 20
        assert last["departure"] - last["arrival"] == 10
        assert 0 < trip["energy_wh"] <= 100
        left = [stop["energy_left_wh"] for stop in trip["stops"]]
        assert left == sorted(left, reverse=True)
        assert (left[0], left[-1]) == (100, pytest.approx(100 - trip["energy_wh"]))
    summary = plan["summary"]
    assert summary["distance"] == 0
    assert summary["drone_distance"] == pytest.approx(
        sum(trip["distance"] for trip in trips_of(plan)))
    assert summary["energy_wh"] == pytest.approx(
        sum(trip["energy_wh"] for trip in trips_of(plan)))
    assert is_feasible(client, request, plan)


def test_trips_end_within_endurance(client: httpx.Client, searching: httpx.Client,
                                    smallest: Request) -> None:
    whole, = trips_of(planned(client, by_air(smallest)))
    limit = whole["duration"] - 31
    request = by_air(smallest, endurance=limit)
    plan = searched(client, searching, request)
    assert all(trip["duration"] - 30 <= limit for trip in trips_of(plan))
    assert len(trips_of(plan)) > 1 or plan["unassigned"]
    assert is_feasible(searching, request, plan)


def test_who_may_not_be_served_by_air_is_told_so(client: httpx.Client, smallest: Request) -> None:
    smallest["customers"][0]["served_by"] = "truck"
    plan = planned(client, by_air(smallest))
    left_out, = plan["unassigned"]
    reason, = left_out["reasons"]
    assert reason["code"] == "KIND"
    assert reason["remedy"] == "fits if a drone may serve it"


@pytest.mark.parametrize(("limit", "remedy"), [
    ({"endurance": 60}, "fits if endurance were"),
    ({"energy": {**ENERGY, "battery_wh": 0.5}}, "fits with a battery of")])
def test_who_is_too_far_away_is_told_what_would_help(
        client: httpx.Client, smallest: Request, limit: Request, remedy: str) -> None:
    plan = planned(client, by_air(smallest, **limit))
    assert plan["unassigned"]
    for left_out in plan["unassigned"]:
        reason, = left_out["reasons"]
        assert reason["code"] == "RANGE"
        assert reason["remedy"].startswith(remedy)


def test_batteries_are_swapped_or_charged_between_trips(
        client: httpx.Client, searching: httpx.Client, smallest: Request) -> None:
    one_each = {"max_stops": 1, "energy": ENERGY, "count": 1}
    request = by_air(smallest, **one_each, turnaround={"swap_duration": 300})
    swapped = searched(client, searching, request)
    first, second = trips_of(swapped)[:2]
    assert second["stops"][0]["arrival"] - first["stops"][-1]["departure"] >= 300
    most = max(trip["energy_wh"] for trip in trips_of(swapped))
    one_each["energy"] = {**ENERGY, "battery_wh": most + 0.01}
    request = by_air(smallest, **one_each, turnaround={"charge_w": 50})
    charged = searched(client, searching, request)
    first, second = trips_of(charged)[:2]
    missing = first["energy_wh"] + second["energy_wh"] - most - 0.01
    rested = second["stops"][0]["arrival"] - first["stops"][-1]["departure"]
    behind, then = (trip["stops"][stop]["energy_left_wh"]
                    for trip, stop in ((first, -1), (second, 0)))
    assert then == pytest.approx(min(most + 0.01, behind + 50 * rested / 3600), abs=1e-4)
    assert rested >= missing / 50 * 3600 - 0.01
    assert is_feasible(searching, request, charged)


@pytest.mark.parametrize(("stated", "field"), [
    ({"drones": {"count": 1, "capacity": [1]}}, "drones"),
    ({"end": "open"}, "end"),
    ({"max_sorties": 2}, "max_sorties"),
    ({"turnaround": {"batteries": 3}}, "turnaround.batteries"),
    ({"speed_profile": [{"from": 0, "factor": 0.5}]}, "speed_profile")])
def test_what_only_trucks_have_is_refused(client: httpx.Client, smallest: Request,
                                          stated: Request, field: str) -> None:
    answer = client.post("/plan", json=by_air(smallest, **stated))
    assert answer.status_code == 422
    error, = answer.json()["errors"]
    assert (error["code"], error["path"]) == ("NOT_WHERE_IT_FLIES", f"$.fleet[0].{field}")


def test_what_only_fliers_have_is_refused_of_trucks(client: httpx.Client,
                                                    smallest: Request) -> None:
    smallest["fleet"][0]["endurance"] = 600
    answer = client.post("/plan", json=smallest)
    assert answer.status_code == 422
    error, = answer.json()["errors"]
    assert error["code"] == "ONLY_WHERE_IT_FLIES"


def test_no_depot_may_forbid_that_its_drones_take_off(client: httpx.Client,
                                                      smallest: Request) -> None:
    smallest["depots"][0]["launch"] = False
    answer = client.post("/plan", json=by_air(smallest))
    assert answer.status_code == 422
    error, = answer.json()["errors"]
    assert error["path"] == "$.fleet[0].depot"


def test_drones_fly_around_areas(client: httpx.Client, smallest: Request) -> None:
    request = by_air(smallest)
    straight = planned(client, request)["summary"]["drone_distance"]
    places = [place["location"] for place in (*request["depots"], *request["customers"])]
    (x, y), (to_x, to_y) = places[0], places[1]
    middle, step = ((x + to_x) / 2, (y + to_y) / 2), abs(to_x - x) / 20 + abs(to_y - y) / 20
    ring = [[middle[0] + step * dx, middle[1] + step * dy]
            for dx, dy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    request["airspace"] = {"no_fly": [ring]}
    around = planned(client, request)
    assert around["summary"]["drone_distance"] > straight
    assert is_feasible(client, request, around)


def test_trucks_and_drones_share_the_customers(client: httpx.Client, smallest: Request) -> None:
    truck = {**smallest["fleet"][0], "id": "van"}
    request = by_air(smallest)
    request["fleet"].append(truck)
    request["customers"][0]["served_by"] = "truck"
    request["customers"][1]["served_by"] = "drone"
    plan = planned(client, request)
    served = {stop["id"]: route["type"] for route in plan["routes"] for trip in route["trips"]
              for stop in trip["stops"] if stop["kind"] == "customer"}
    assert served[request["customers"][0]["id"]] == "van"
    assert served[request["customers"][1]["id"]] != "van"


def test_hubs_drones_serve_nobody_beyond_their_range(client: httpx.Client,
                                                     smallest: Request) -> None:
    request = by_air(smallest, max_range=5500)
    plan = planned(client, request)
    left_out, = plan["unassigned"]
    reason, = left_out["reasons"]
    assert (left_out["id"], reason["code"], reason["remedy"]) == (
        "B", "RANGE", "fits if max_range were 0.5 km longer")
    assert is_feasible(client, request, plan)
    farther = planned(client, by_air(request, max_range=6001))
    assert farther["unassigned"] == []
    assert not is_feasible(client, by_air(request, max_range=5500), farther)


def test_hubs_drones_fly_in_each_calm(
        client: httpx.Client, searching: httpx.Client, smallest: Request) -> None:
    request = by_air(smallest, max_wind_kmh=40, count=1, shift={"latest": 6 * 3600})
    request["airspace"] = {"wind": [{"from": 3600 * hour, "speed_kmh": 0, "gust_kmh": gust}
                                    for hour, gust in ((0, 10), (1, 60), (2, 10), (5, 60))]}
    early, late = request["customers"]
    early["time_window"] = {"latest": 3600}
    late["time_window"] = {"earliest": 7000, "latest": 5 * 3600}
    plan = planned(searching, request)
    assert plan["unassigned"] == []
    first, second = trips_of(plan)
    assert first["stops"][-1]["arrival"] <= 3600
    assert second["stops"][0]["departure"] >= 7200
    early["time_window"] = late["time_window"]
    assert is_feasible(client, request, plan) is False
    request["airspace"]["wind"] = {"speed_kmh": 50}
    assert len(planned(client, request)["unassigned"]) == 2


def test_hubs_drones_keep_a_rule_by_its_name(client: httpx.Client, smallest: Request) -> None:
    plan = planned(client, by_air(smallest, preset="eu-pdra-g01"))
    assert len(plan["unassigned"]) == 2
    rule, = plan["rules"]
    assert (rule["planned"]["max_range"], rule["planned"]["altitude"]) == (1000, 150)
    plan = planned(client, by_air(smallest, preset="eu-pdra-g01", max_range=7000))
    assert "$.fleet[0].max_range" in {each["path"] for each in plan["warnings"]}


def ones(request: Request) -> Request:
    """Return a request whose customers each have ordered as much as a vehicle carries."""
    for customer in request["customers"]:
        customer["demand"] = request["fleet"][0]["capacity"]
    return request


def test_trips_take_batteries_of_their_hub(
        client: httpx.Client, searching: httpx.Client, smallest: Request) -> None:
    request = by_air(ones(smallest))
    enough = planned(searching, request)
    assert "hubs" not in enough
    number = len(trips_of(enough))
    assert number > 1
    request["depots"][0]["batteries"] = number
    plan = planned(searching, request)
    assert plan["status"] == "complete"
    assert plan["hubs"] == [{"depot": request["depots"][0]["id"], "batteries_left": 0,
                             "chargers_left": None}]
    request["depots"][0]["batteries"] = number - 1
    short = planned(searching, request)
    assert len(trips_of(short)) == number - 1
    assert is_feasible(searching, request, short)
    broken = client.post("/check", json={"problem": request, "plan": plan}).json()["violations"]
    assert [each["code"] for each in broken] == ["BATTERIES"]
    assert {reason["code"] for left_out in short["unassigned"]
            for reason in left_out["reasons"]} == {"BATTERIES"}


def in_turn(client: httpx.Client, request: Request, chargers: int | None) -> Request:
    """Return a request of two drones for one parcel each trip, who are charged before each again.
    """
    first = request["customers"][0]
    request["customers"] = [first | {"id": f"c{number}", "demand": request["fleet"][0]["capacity"],
                                     "time_window": {"latest": 6000}} for number in range(6)]
    request = by_air(request, count=2, energy=ENERGY)
    most = trips_of(planned(client, request))[0]["energy_wh"]
    request["fleet"][0] |= {"energy": ENERGY | {"battery_wh": most * 1.01},
                            "turnaround": {"charge_w": 200}}
    request["depots"][0]["chargers"] = chargers
    return request


def charges_of(plan: Request) -> list[tuple[float, float]]:
    """Return from when until when drones are charged, in order."""
    return sorted((each["start"], each["end"]) for trip in trips_of(plan)
                  for each in trip.get("charging", ()))


def test_drones_are_charged_one_behind_the_other(
        client: httpx.Client, searching: httpx.Client, smallest: Request) -> None:
    request = in_turn(client, smallest, 1)
    plan = planned(searching, request)
    assert plan["status"] == "complete"
    charges = charges_of(plan)
    assert len(charges) == 4
    assert all(end <= start for (_, end), (start, _) in pairwise(charges))
    assert plan["hubs"][0]["chargers_left"] == 0
    assert all(stop["energy_left_wh"] >= 0 for trip in trips_of(plan) for stop in trip["stops"])
    assert is_feasible(client, request, plan)
    for trip in trips_of(plan):
        trip.pop("charging", None)
    assert is_feasible(client, request, plan)
    request["depots"][0]["chargers"] = 0
    answer = client.post("/check", json={"problem": request, "plan": plan}).json()
    assert {each["code"] for each in answer["violations"]} == {"CHARGERS"}
    short = planned(searching, request)
    assert len(trips_of(short)) == 2
    remedies = {reason[name] for left_out in short["unassigned"]
                for reason in left_out["reasons"] for name in ("remedy", "other_remedy")
                if reason.get(name)}
    assert f"fits with one more charger at {request['depots'][0]['id']}" in remedies
    request["depots"][0]["chargers"] = None
    assert charges_of(planned(searching, request)) == []


def test_a_day_goes_on_with_what_was_charged_by_then(
        client: httpx.Client, searching: httpx.Client, smallest: Request) -> None:
    request = in_turn(client, smallest, 1)
    plan = planned(searching, request)
    start, end = charges_of(plan)[1]
    for now in (start, (start + end) / 2, end):
        went_on = planned(searching, request | {"replan": {"plan": plan, "freeze_before": now}})
        assert went_on["status"] == "complete"
        before = [charge for charge in charges_of(plan) if charge[1] <= now]
        assert charges_of(went_on)[:len(before)] == before
        assert is_feasible(searching, request, went_on)
        made = [(charge[0], 1) for charge in charges_of(went_on)]
        made += [(charge[1], -1) for charge in charges_of(went_on)]
        assert max(accumulate(change for _, change in sorted(made))) == 1


def test_a_day_goes_on_with_the_batteries_that_are_left(
        searching: httpx.Client, smallest: Request) -> None:
    request = by_air(ones(smallest))
    plan = planned(searching, request)
    number = len(trips_of(plan))
    now = min(trip["stops"][0]["departure"] for trip in trips_of(plan))
    request["depots"][0]["batteries"] = number - 1
    went_on = planned(searching, request | {"replan": {"plan": plan, "freeze_before": now}})
    assert len(trips_of(went_on)) <= number - 1
    assert went_on["hubs"][0]["batteries_left"] == number - 1 - len(trips_of(went_on))


def test_the_best_places_are_those_that_the_hub_has_batteries_for(
        searching: httpx.Client, smallest: Request) -> None:
    request = by_air(ones(smallest))
    plan = planned(searching, request)
    number = len(trips_of(plan))

    def fits(batteries: int) -> Any:
        request["depots"][0]["batteries"] = batteries
        new = request["customers"][0] | {"id": "late", "demand": request["fleet"][0]["capacity"]}
        reply = searching.post("/fit", json={"problem": request, "plan": plan,
                                             "new_customer": new})
        assert reply.status_code == 200, reply.text
        return reply.json()["places"]

    enough = fits(number + 1)[0]
    assert enough["by"] == "drone"
    assert not enough["reasons"]
    assert all(place["reasons"] for place in fits(number))
