"""What permits ask of drones, over HTTP."""

from typing import Any

import httpx
import pytest
from tests.app.plans.asking import planned, refused

Request = dict[str, Any]


def by_drone(request: Request, **drones: Any) -> Request:
    """Return a request all of whose customers one drone serves."""
    for customer in request["customers"]:
        customer["served_by"] = "drone"
    request["fleet"][0]["drones"] = {"count": 1, "capacity": [10], **drones}
    return request


def farthest_km(request: Request) -> float:
    """Return how far customers lie from the only depot."""
    (x, y), = [depot["location"] for depot in request["depots"]]
    unit = request["planar_unit"] / 1000
    return max(((east - x)**2 + (north - y)**2) ** 0.5 * unit
               for east, north in (each["location"] for each in request["customers"]))


def test_nobody_is_flown_to_from_farther_away_than_max_range(client: httpx.Client,
                                                             smallest: Request) -> None:
    metres = 1000 * farthest_km(smallest)
    request = by_drone(smallest, max_range=metres + 1)
    plan = planned(client, request)
    assert plan["unassigned"] == []
    request["fleet"][0]["drones"]["max_range"] = metres - 1
    left_out, = planned(client, request)["unassigned"]
    reason, = left_out["reasons"]
    assert (reason["code"], reason["remedy"]) == (
        "RANGE", "fits if max_range were 0.1 km longer")
    verdict = client.post("/check", json={"problem": request, "plan": plan}).json()
    assert "MAX_RANGE" in {broken["code"] for broken in verdict["violations"]}


def test_max_range_is_measured_whatever_matrices_say(client: httpx.Client,
                                                     smallest: Request) -> None:
    size = len(smallest["customers"]) + 1
    table = {"durations": [[10] * size] * size, "distances": [[1] * size] * size}
    request = by_drone(smallest, max_range=1000 * farthest_km(smallest) - 1)
    request["matrices"] = {"truck": table, "drone": table}
    for index, place in enumerate([*request["depots"], *request["customers"]]):
        place["location_index"] = index
    assert len(planned(client, request)["unassigned"]) == 1
    del request["customers"][0]["location"]
    answer = client.post("/plan", json=request)
    assert answer.status_code == 422
    error, = answer.json()["errors"]
    assert (error["code"], error["path"]) == ("MISSING_LOCATION", "$.customers[0].location")
    assert "$.fleet[0].drones.max_range" in error["message"]


def test_explain_tells_what_max_range_is_worth(client: httpx.Client, smallest: Request) -> None:
    request = by_drone(smallest, max_range=1000 * farthest_km(smallest) - 500)
    plan = planned(client, request)
    (left_out,) = plan["unassigned"]
    told = client.post("/explain", json={
        "problem": request, "plan": plan, "customer": left_out["id"]}).json()
    rule, = [each for each in told["binding"] if each["rule"] == "drones.max_range"]
    assert (rule["slack"], rule["unit"]) == (None, "km")
    assert rule["saves_per_unit"] > 0


def broken(client: httpx.Client, request: Request, sorties: list[Request],
           stops: int = 0) -> set[str]:
    """Return the rules that a plan breaks on whose only trip the truck serves the first customers.
    """
    served = [{"kind": "customer", "id": each["id"]} for each in request["customers"][:stops]]
    depot = {"kind": "depot", "id": "hub"}
    plan = {"routes": [{"vehicle": "truck-1", "type": "truck", "trips": [
        {"stops": [depot, *served, depot], "sorties": sorties}]}]}
    verdict = client.post("/check", json={"problem": request, "plan": plan})
    assert verdict.status_code == 200, verdict.text
    return {violation["code"] for violation in verdict.json()["violations"]}


def sortie(number: int, customer: str, launch: int, recovery: int) -> Request:
    """Return a sortie as plans state it."""
    return {"drone": f"truck-1/drone-{number}", "launch_stop": launch, "recovery_stop": recovery,
            "customers": [{"id": customer}]}


def test_few_drones_are_in_the_air_at_once(client: httpx.Client, smallest: Request) -> None:
    request = by_drone(smallest, count=2)
    both = [sortie(1, "A", 0, 1), sortie(2, "B", 0, 1)]
    assert broken(client, request, both) == set()
    request["fleet"][0]["max_airborne"] = 1
    assert broken(client, request, both) == {"MAX_AIRBORNE"}
    assert broken(client, request, [sortie(1, "A", 0, 0), sortie(2, "B", 0, 0)]) == set()
    assert planned(client, request)["unassigned"] == []


def test_a_truck_waits_for_its_drones(client: httpx.Client, smallest: Request) -> None:
    request = by_drone(smallest)
    request["customers"][0]["served_by"] = "truck"
    across = [sortie(1, "B", 0, 1)]
    assert broken(client, request, across, 1) == set()
    request["fleet"][0]["truck_waits"] = True
    assert broken(client, request, across, 1) == {"TRUCK_WAITS"}
    assert broken(client, request, [sortie(1, "B", 1, 1)], 1) == set()


def test_a_flight_waits_until_the_wind_is_weaker(client: httpx.Client, smallest: Request) -> None:
    request = by_drone(smallest, max_wind_kmh=40)
    request["airspace"] = {"wind": [{"from": 0, "speed_kmh": 10, "gust_kmh": 60},
                                    {"from": 1800, "speed_kmh": 10, "gust_kmh": 20}]}
    plan = planned(client, request)
    assert plan["unassigned"] == []
    sorties = [each for route in plan["routes"] for trip in route["trips"]
               for each in trip["sorties"]]
    assert min(each["launch_time"] for each in sorties) >= 1800
    request["airspace"]["wind"][1]["gust_kmh"] = 60
    verdict = client.post("/check", json={"problem": request, "plan": plan}).json()
    assert "WIND" in {each["code"] for each in verdict["violations"]}
    for left_out in planned(client, request)["unassigned"]:
        reason, = left_out["reasons"]
        assert (reason["code"], reason["remedy"]) == ("WIND", "fits without max_wind_kmh")


@pytest.mark.parametrize(("wind", "code", "path"), [
    ([{"from": 60, "speed_kmh": 1}, {"from": 60, "speed_kmh": 1}], "WIND_ORDER", "[1].from"),
    ([{"from": 60, "speed_kmh": 1}, {"from": 0, "speed_kmh": 1}], "WIND_ORDER", "[1].from"),
    ([], "WRONG_LENGTH", ""),
    ([{"from": 0}], "MISSING_FIELD", "[0].speed_kmh"),
    ({"open_meteo": {"hourly": {"time": ["2026-06-01T07:00"], "wind_speed_10m": [2],
                                "wind_direction_10m": [1, 2]}}},
     "WIND_HOURS", ".open_meteo.hourly.wind_direction_10m"),
    ({"open_meteo": {"hourly": {"time": ["2026-06-01T07:00"], "wind_speed_10m": [None],
                                "wind_direction_10m": [1]}}},
     "WIND_HOURS", ".open_meteo.hourly.wind_speed_10m[0]"),
    ({"open_meteo": {"hourly": {
        "time": ["2026-06-01T07:00", "2026-06-01T08:00"], "wind_speed_10m": [1, 1],
        "wind_direction_10m": [1, 1], "wind_gusts_10m": [5, None]}}},
     "WIND_HOURS", ".open_meteo.hourly.wind_gusts_10m[1]"),
    ({"open_meteo": {"hourly": {"time": ["today"], "wind_speed_10m": [1],
                                "wind_direction_10m": [1]}}},
     "WIND_HOURS", ".open_meteo.hourly.time[0]"),
    ({"open_meteo": {"hourly": {"time": [7200, 3600], "wind_speed_10m": [1, 1],
                                "wind_direction_10m": [1, 1]}}},
     "WIND_ORDER", ".open_meteo.hourly.time[1]")])
def test_hours_of_wind_that_make_no_sense_are_refused(
        client: httpx.Client, smallest: Request, wind: object, code: str, path: str) -> None:
    request = by_drone(smallest) | {"plan_start": "2026-06-01T06:00Z", "airspace": {"wind": wind}}
    assert refused(client, request, "/plan") == [(code, f"$.airspace.wind{path}")]


def test_a_forecast_needs_the_start_of_the_plan(client: httpx.Client, smallest: Request) -> None:
    hourly = {"time": [3600], "wind_speed_10m": [1], "wind_direction_10m": [1]}
    request = by_drone(smallest) | {"airspace": {"wind": {"open_meteo": {"hourly": hourly}}}}
    assert refused(client, request, "/plan") == [
        ("MISSING_PLAN_START", "$.airspace.wind.open_meteo")]


def test_who_is_lost_to_the_worst_hour_is_warned_of(client: httpx.Client,
                                                    smallest: Request) -> None:
    request = by_drone(smallest, endurance=900)
    request["airspace"] = {"wind": [{"from": 0, "speed_kmh": 0}, {"from": 3600, "speed_kmh": 45}]}
    codes = [each["code"] for each in planned(client, request)["warnings"]]
    assert "WIND_AT_WORST" in codes
    request["fleet"][0]["drones"]["max_wind_kmh"] = 40
    codes = [each["code"] for each in planned(client, request)["warnings"]]
    assert "WIND_AT_WORST" not in codes


def test_a_rule_is_kept_by_its_name(client: httpx.Client, smallest: Request) -> None:
    request = by_drone(smallest, preset="eu-pdra-g01", count=2)
    plan = planned(client, request)
    assert len(plan["unassigned"]) == 2
    rule, = plan["rules"]
    assert (rule["preset"], rule["max_range"], rule["altitude"]) == ("eu-pdra-g01", 1000, 150)
    assert "PDRA-G01" in rule["source"]
    assert rule["planned"] == {"max_airborne": 1, "truck_waits": True, "max_range": 1000,
                               "altitude": 150}
    assert not [each for each in plan["warnings"] if each["code"] == "LOOSER_THAN_PRESET"]
    both = [sortie(1, "A", 0, 1), sortie(2, "B", 0, 1)]
    assert broken(client, request, both) == {"MAX_AIRBORNE", "TRUCK_WAITS", "MAX_RANGE"}


def test_what_is_stated_beside_a_rule_wins_and_is_warned_of(client: httpx.Client,
                                                            smallest: Request) -> None:
    request = by_drone(smallest, preset="eu-pdra-g01", count=2, max_range=9000, altitude=100)
    request["fleet"][0] |= {"max_airborne": 2, "truck_waits": False}
    plan = planned(client, request)
    assert plan["unassigned"] == []
    assert plan["rules"][0]["planned"] == {"max_airborne": 2, "truck_waits": False,
                                           "max_range": 9000, "altitude": 100}
    assert {each["path"] for each in plan["warnings"] if each["code"] == "LOOSER_THAN_PRESET"} == {
        "$.fleet[0].max_airborne", "$.fleet[0].truck_waits", "$.fleet[0].drones.max_range"}


@pytest.mark.parametrize(("preset", "max_range", "altitude"), [
    ("eu-pdra-g01", 1000, 150), ("eu-pdra-g02", None, 100), ("us-part-107", None, 121.92)])
def test_each_rule_sets_what_it_has_a_number_for(
        client: httpx.Client, smallest: Request, preset: str, max_range: float | None,
        altitude: float) -> None:
    rule, = planned(client, by_drone(smallest, preset=preset))["rules"]
    assert rule["planned"] == {"max_airborne": 1, "truck_waits": True, "max_range": max_range,
                               "altitude": altitude}


def test_without_a_rule_the_reply_names_none(client: httpx.Client, smallest: Request) -> None:
    assert "rules" not in planned(client, by_drone(smallest))


def test_what_a_customer_states_for_a_drone_counts_in_that_warning(client: httpx.Client,
                                                                   smallest: Request) -> None:
    request = by_drone(smallest, endurance=900, service_duration=0)
    request["airspace"] = {"wind": [{"from": 0, "speed_kmh": 0}, {"from": 3600, "speed_kmh": 45}]}
    name = f"{request['fleet'][0]['id']}/drone"
    for customer in request["customers"]:
        customer["service_duration_by_type"] = {name: 899}
    codes = [each["code"] for each in planned(client, request)["warnings"]]
    assert "WIND_AT_WORST" not in codes
