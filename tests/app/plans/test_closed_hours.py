"""Zones with hours: flights to and from places in them keep to when they are open."""

import json
import random
import re
from datetime import datetime, timedelta
from typing import Any

import httpx
import numpy as np
import pytest

from tests.app.maps.airspace.published import circle, ed269, zone
from tests.app.plans.asking import planned, refused
from tests.app.plans.flights.asking import files_of, sent
from tests.app.plans.test_buffers import nearest, ring
from tests.app.plans.test_closures import BEHIND, DEPOT, asked, wall
from tests.seeds import often

Data = dict[str, Any]
START = datetime.fromisoformat("2026-11-26T08:00:00+00:00")
HOUR = 3600
NINE_TO_ONE = {"permanent": "NO", "schedule": [
    {"day": ["ANY"], "startTime": "09:00:00Z", "endTime": "13:00:00Z"}]}


def closed(*hours: tuple[str, str]) -> Data:
    """Return a period of any days with some hours."""
    return {"permanent": "NO", "schedule": [
        {"day": ["ANY"], "startTime": f"{begin}:00Z", "endTime": f"{end}:00Z"}
        for begin, end in hours]}


def harbour(*at: list[float], **changed: Any) -> Data:
    """Return a file of a zone around the customer, closed from nine to one."""
    places = at or (BEHIND,)
    return ed269(zone(*[circle(400, list(place)) for place in places],
                      applicability=[NINE_TO_ONE], **changed))


def day(*zones: Data, latest: float = 10 * HOUR, **changed: Any) -> Data:
    """Return a request of eight o'clock, of a customer whom a drone is to serve."""
    request = asked(*zones, plan_start=START.isoformat(), **changed)
    request["fleet"][0]["shift"] = {"latest": latest}
    return request


def seconds(instant: str) -> float:
    """Return an instant in seconds since plan start."""
    return (datetime.fromisoformat(instant) - START).total_seconds()


def airborne(plan: Data) -> list[tuple[float, float]]:
    """Return when each flight is in the air."""
    return [(seconds(sortie["launch_time"]), seconds(sortie["recovery_time"]))
            for route in plan["routes"] for trip in route["trips"] for sortie in trip["sorties"]]


def test_who_lies_in_a_zone_with_hours_is_served_outside_of_them(client: httpx.Client) -> None:
    plan = planned(client, day(harbour()))
    (begin, end), = airborne(plan)
    assert plan["unassigned"] == []
    assert end <= HOUR or begin >= 5 * HOUR


@pytest.mark.parametrize(("window", "before"), [
    ({"latest": 3 * HOUR}, True), ({"earliest": 2 * HOUR}, False)])
def test_flights_are_brought_forward_or_held(client: httpx.Client, window: Data,
                                             before: bool) -> None:
    request = day(harbour())
    request["customers"][0]["time_window"] = window
    (begin, end), = airborne(planned(client, request))
    assert end <= HOUR if before else begin >= 5 * HOUR


def test_a_depot_in_a_zone_with_hours_holds_all_flights(client: httpx.Client) -> None:
    request = day(harbour(DEPOT))
    request["customers"][0]["time_window"] = {"earliest": 1.5 * HOUR}
    (begin, _), = airborne(planned(client, request))
    assert begin >= 5 * HOUR


def test_vehicles_that_fly_keep_to_the_hours(client: httpx.Client) -> None:
    request = day(harbour())
    request["fleet"] = [{"id": "quad", "flies": True, "count": 1, "capacity": [9],
                         "shift": {"latest": 10 * HOUR}}]
    request["customers"][0]["time_window"] = {"earliest": 2 * HOUR}
    (route,) = planned(client, request)["routes"]
    stops = route["trips"][0]["stops"]
    assert seconds(stops[0]["departure"]) >= 5 * HOUR


def test_whom_no_hour_suits_is_told_when_the_zone_is_closed_and_which_shift_would_do(
        client: httpx.Client) -> None:
    request = day(harbour(), latest=4.5 * HOUR)
    request["fleet"][0]["shift"]["earliest"] = HOUR
    (left,) = planned(client, request)["unassigned"]
    (reason,) = left["reasons"]
    assert reason["code"] == "SHIFT"
    assert ("The zone Harbour (FIN0001) is closed to flights from 09:00:00 until 13:00:00."
            in reason["message"])
    remedy = reason["remedy"]
    assert remedy.startswith("fits if truck's shift ended ")
    for number, unit in re.findall(r"(\d+) (h|min|s)\b", remedy):
        request["fleet"][0]["shift"]["latest"] += int(number) * {"h": HOUR, "min": 60, "s": 1}[unit]
    assert planned(client, request)["unassigned"] == []


def test_whom_its_window_keeps_in_the_hours_is_told_so(client: httpx.Client) -> None:
    request = day(harbour())
    request["customers"][0]["time_window"] = {"earliest": 2 * HOUR, "latest": 3 * HOUR}
    (left,) = planned(client, request)["unassigned"]
    (reason,) = left["reasons"]
    assert reason["code"] == "TIME_WINDOW"
    assert "is closed to flights from 09:00:00 until 13:00:00." in reason["message"]


@pytest.mark.parametrize(("window", "is_bound"), [
    ({"earliest": 2 * HOUR, "latest": 3 * HOUR}, True), ({"latest": 3 * HOUR}, False)])
def test_hours_of_zones_bind_where_without_them_a_plan_would_cost_less(
        client: httpx.Client, window: Data, is_bound: bool) -> None:
    request = day(harbour())
    request["customers"][0]["time_window"] = window
    name = request["customers"][0]["id"]
    reply = client.post("/explain", json={
        "problem": request, "plan": planned(client, request), "customer": name}).json()
    told = [each for each in reply["binding"] if each["rule"] == "airspace.zones"]
    assert len(told) == is_bound
    for each in told:
        assert (each["at"], each["slack"], each["unit"]) == ("", None, "rule")
        assert each["saves_per_unit"] > 0


def test_a_zone_with_hours_that_holds_nobody_is_flown_around_all_day(client: httpx.Client) -> None:
    def flown(*zones: Data) -> float:
        return float(planned(client, day(*zones))["summary"]["drone_distance"])

    around = flown(ed269(zone(wall(), applicability=[NINE_TO_ONE])))
    assert around > 1.5 * flown()
    assert around == flown(ed269(zone(wall())))


@pytest.mark.parametrize("hours", [("00:00", "24:00"), ("00:00", "12:00")])
def test_a_zone_that_is_never_open_in_time_bars_whom_it_holds(
        client: httpx.Client, hours: tuple[str, str]) -> None:
    periods = [closed(hours, ("12:00", "24:00"))]
    request = day(ed269(zone(circle(400, BEHIND), applicability=periods)))
    (left,) = planned(client, request)["unassigned"]
    assert left["reasons"][0]["code"] == "AIRSPACE"


def test_a_flight_in_the_hours_is_no_legal_plan(client: httpx.Client) -> None:
    free = day()
    free["customers"][0]["time_window"] = {"earliest": 2 * HOUR, "latest": 3 * HOUR}
    plan = planned(client, free)
    timed = day(harbour())
    timed["customers"][0]["time_window"] = free["customers"][0]["time_window"]
    reply = client.post("/check", json={"problem": timed, "plan": plan}).json()
    assert reply["violations"] != []
    timed["customers"][0]["time_window"] = {"earliest": 5 * HOUR}
    plan = planned(client, timed)
    reply = client.post("/check", json={"problem": timed, "plan": plan}).json()
    assert reply["violations"] == []


def test_the_zone_that_a_flight_leads_to_is_no_fence_of_it(client: httpx.Client) -> None:
    request = day(harbour(), ed269(zone(circle(300, [24.93, 60.17]), identifier="X")))
    plan = planned(client, request)
    told, = files_of(sent(client, request, plan, "geojson", "vehicle")).values()
    areas = [each for each in json.loads(told)["features"]
             if each["properties"]["kind"] == "no_fly"]
    assert len(areas) == 1
    assert refused(client, {"problem": request, "plan": plan, "format": "kml", "per": "all"},
                   "/flights") == [("UNKNOWN_VALUE", "$.per")]


@pytest.mark.thorough
@pytest.mark.slow
def test_random_flights_meet_no_zone_in_its_hours(client: httpx.Client) -> None:
    """Zones of all hours, some of which hold depot and customers, judged by what was published."""
    rng, through, around = random.Random(11), 0, 0
    for _ in range(often(25)):
        hub, shapes = [10.0, 48.0], []
        for number in range(rng.randint(2, 8)):
            at = ring(hub, (rng.uniform(-2500, 2500), rng.uniform(-2500, 2500)))[0]
            opens, length = rng.randint(6, 16), rng.randint(1, 6)
            hours = [] if rng.random() < 0.3 else [(opens, opens + length)]
            radius = rng.choice((150.0, 500.0, 900.0))
            shapes.append((at, radius, hours, number))
        zones = [zone(circle(radius, at), identifier=str(number), applicability=[
            closed(*((f"{opens:02}:00", f"{closes:02}:00") for opens, closes in hours))
            if hours else {"permanent": "YES"}]) for at, radius, hours, number in shapes]
        request = day(ed269(*zones))
        request["airspace"]["buffer"] = rng.choice((0, 30))
        request["depots"][0]["location"] = hub
        request["customers"] = [
            {"id": str(number), "demand": [1], "served_by": "drone",
             "location": ring(hub, (rng.uniform(-3000, 3000), rng.uniform(-3000, 3000)))[0]}
            for number in range(7)]
        request["fleet"][0]["drones"] |= {"count": 2, "max_customers_per_sortie": 2}
        plan = planned(client, request | {"options": {"time_limit": 1, "search_iterations": 300}})
        if not airborne(plan):
            continue
        files = files_of(sent(client, request, plan, "geojson", "vehicle")).values()
        for line, begin, end in [each for told in files for each in flown(told)]:
            for at, radius, hours, _ in shapes:
                away = nearest(line, {"center": at, "radius": radius})
                if away >= request["airspace"]["buffer"]:
                    around += away < 40
                    continue
                through += 1
                assert hours
                for opens, closes in hours:
                    day_start = START.replace(hour=0)
                    assert (end <= day_start + timedelta(hours=opens)
                            or begin >= day_start + timedelta(hours=closes))
    assert through > often(5)
    assert around > often(5)


def flown(told: bytes) -> list[tuple[Any, datetime, datetime]]:
    """Return the lines of flights in a file, each with when it is in the air."""
    return [(np.array(each["geometry"]["coordinates"])[:, :2],
             datetime.fromisoformat(each["properties"]["launch_time"]),
             datetime.fromisoformat(each["properties"]["recovery_time"]))
            for each in json.loads(told)["features"] if each["properties"]["kind"] == "flight"]
