"""Missions as MAVLink's own reader and QGroundControl's documented fields have them."""

from itertools import pairwise
from math import cos, hypot, radians
from pathlib import Path
from typing import Any

import httpx
import pytest
from pymavlink import mavutil
from shapely import LineString, Polygon

from tests.app.plans.flights.asking import (
    ZONE, Data, city, files_of, plan_file, planned, sent, way_points,
)

MAV = mavutil.mavlink
NAMES = {getattr(MAV, f"MAV_CMD_{name}"): name for name in (
    "NAV_WAYPOINT", "NAV_LOITER_TIME", "NAV_LAND", "NAV_TAKEOFF", "NAV_DELAY", "DO_CHANGE_SPEED",
    "NAV_FENCE_POLYGON_VERTEX_EXCLUSION")}


def commands(items: list[Any]) -> list[str]:
    return [NAMES[item.command] for item in items]


def sorties(plan: Data) -> list[Data]:
    return [sortie for route in plan["routes"] for trip in route["trips"]
            for sortie in trip["sorties"]]


def missions(client: httpx.Client, problem: Data, folder: Path) -> tuple[Data, list[list[Any]]]:
    """Return a plan and the items of each of its flights, home left out."""
    plan = planned(client, problem)
    files = files_of(sent(client, problem, plan, "qgc-wpl"))
    return plan, [way_points(folder, content)[1:] for name, content in files.items()
                  if "fence" not in name]


def metres(start: Any, end: Any) -> float:
    return hypot((end.x - start.x) * 111_195, (end.y - start.y) * 111_195 * cos(radians(60.17)))


def test_drone_lands_at_its_customer_and_where_its_truck_is(
        client: httpx.Client, tmp_path: Path) -> None:
    plan, flown = missions(client, city(airspace={}), tmp_path)
    for sortie, items in zip(sorties(plan), flown, strict=True):
        assert commands(items) == [
            "NAV_TAKEOFF", "DO_CHANGE_SPEED", "NAV_WAYPOINT", "NAV_LAND", "NAV_DELAY",
            "NAV_TAKEOFF", "NAV_WAYPOINT", "NAV_LAND"]
        assert items[4].param1 == pytest.approx(60)
        assert items[1].param2 == pytest.approx(50 / 3.6, abs=1e-3)
        places = {"hub": (24.9415, 60.1708), "shop": (24.9522, 60.1675),
                  **{customer["id"]: tuple(customer["location"])
                     for customer in city()["customers"]}}
        stops = plan["routes"][0]["trips"][0]["stops"]
        expected = [places[stops[sortie["launch_stop"]]["id"]],
                    places[sortie["customers"][0]["id"]],
                    places[stops[sortie["recovery_stop"]]["id"]]]
        found = [items[0], items[3], items[-1]]
        assert [(item.y, item.x) for item in found] == [pytest.approx(place) for place in expected]


def test_drone_that_hovers_does_not_land(client: httpx.Client, tmp_path: Path) -> None:
    energy = {"battery_wh": 500, "power": {"cruise_w": 100}, "lands": False}
    _, flown = missions(client, city(airspace={}, drones={"energy": energy}), tmp_path)
    for items in flown:
        assert commands(items) == ["NAV_TAKEOFF", "DO_CHANGE_SPEED", "NAV_LOITER_TIME",
                                   "NAV_WAYPOINT", "NAV_LAND"]
        assert (items[2].param1, items[2].z) == (60, 100)


def test_heights_are_relative(client: httpx.Client, tmp_path: Path) -> None:
    _, flown = missions(client, city(), tmp_path)
    for item in (item for items in flown for item in items):
        name = NAMES[item.command]
        if name in ("NAV_DELAY", "DO_CHANGE_SPEED"):
            assert item.frame == MAV.MAV_FRAME_MISSION
        else:
            assert item.frame == MAV.MAV_FRAME_GLOBAL_RELATIVE_ALT
            assert item.z == (0 if name == "NAV_LAND" else 100)


def test_flights_stay_out_of_the_zone_and_the_fence_is_the_zone(
        client: httpx.Client, tmp_path: Path) -> None:
    plan, flown = missions(client, city(), tmp_path)
    bends = 0
    for items in flown:
        way = LineString([(item.y, item.x) for item in items if item.x])
        bends += len(way.coords) > 6
        assert not way.intersects(Polygon(ZONE))
    assert bends == 1
    files = files_of(sent(client, city(), plan, "qgc-wpl"))
    fence = way_points(tmp_path, files["van-1-drone-1-flight-1-fence.waypoints"])
    assert commands(fence) == ["NAV_FENCE_POLYGON_VERTEX_EXCLUSION"] * 4
    assert [item.param1 for item in fence] == [4] * 4
    assert [[item.y, item.x] for item in fence] == ZONE


def test_speeds_over_ground_are_those_of_the_wind(client: httpx.Client, tmp_path: Path) -> None:
    wind = {"speed_kmh": 20, "direction_deg": 90}
    plan, flown = missions(client, city(airspace={"wind": wind}), tmp_path)
    for sortie, items in zip(sorties(plan), flown, strict=True):
        speeds = [item.param2 for item in items if NAMES[item.command] == "DO_CHANGE_SPEED"]
        assert len(speeds) == 2
        assert min(speeds) < 50 / 3.6 < max(speeds)
        visit = sortie["customers"][0]
        assert metres(items[0], items[3]) / speeds[0] == pytest.approx(
            visit["arrival"] - sortie["launch_time"], rel=1e-3)


def test_drone_waits_over_the_place_where_the_truck_comes_later(
        client: httpx.Client, tmp_path: Path) -> None:
    problem = city(airspace={})
    problem["customers"] = problem["customers"][:2]
    problem["fleet"][0]["speed_kmh"] = 3
    trip = {"stops": [{"kind": kind, "id": name} for kind, name in (
                ("depot", "hub"), ("customer", "shop"), ("depot", "hub"))],
            "sorties": [{"drone": "van-1/drone-1", "launch_stop": 0, "recovery_stop": 1,
                         "customers": [{"id": "park"}]}]}
    bare = {"routes": [{"vehicle": "van-1", "type": "van", "trips": [trip]}]}
    judged = client.post("/check", json={"problem": problem, "plan": bare}).json()
    assert judged["feasible"], judged["violations"]
    timed = {"routes": judged["routes"]}
    (content,) = files_of(sent(client, problem, timed, "qgc-wpl")).values()
    items = way_points(tmp_path, content)[1:]
    assert commands(items)[-2:] == ["NAV_LOITER_TIME", "NAV_LAND"]
    (sortie,) = sorties(timed)
    back = sortie["customers"][0]["departure"] + metres(items[3], items[-1]) / (50 / 3.6)
    assert back + items[-2].param1 == pytest.approx(sortie["recovery_time"] - 20, abs=2)


def test_trips_of_vehicles_that_fly_are_flights(client: httpx.Client, tmp_path: Path) -> None:
    problem = city()
    problem["customers"] = problem["customers"][1:3]
    problem["fleet"] = [{"id": "hopper", "flies": True, "count": 1, "capacity": [1],
                         "speed_kmh": 45, "max_trips": 2, "launch_duration": 20,
                         "recovery_duration": 30, "altitude": 80, "costs": {"per_km": 1}}]
    reply = client.post("/plan", json=problem)
    plan = reply.json()
    trips = [trip for route in plan["routes"] for trip in route["trips"]]
    files = files_of(sent(client, problem, plan, "kml"))
    assert list(files) == [
        f"hopper-1-flight-{number}.kml" for number in range(1, len(trips) + 1)]
    text = files_of(sent(client, problem, plan, "qgc-wpl", "vehicle"))
    items = way_points(tmp_path, text["hopper-1.waypoints"])[1:]
    assert {item.z for item in items if item.command == MAV.MAV_CMD_NAV_WAYPOINT} == {80}
    landed = [(item.y, item.x) for item in items if item.command == MAV.MAV_CMD_NAV_LAND]
    names = {(24.9415, 60.1708): "hub", **{
        tuple(customer["location"]): customer["id"] for customer in problem["customers"]}}
    assert [names[round(y, 4), round(x, 4)] for y, x in landed] == [
        stop["id"] for trip in trips for stop in trip["stops"][1:]]


def test_plan_holds_the_same_mission_and_the_fence(client: httpx.Client, tmp_path: Path) -> None:
    problem = city()
    plan = planned(client, problem)
    files = files_of(sent(client, problem, plan, "qgc-plan", "vehicle"))
    mission = plan_file(files, "van-1-drone-1.plan")
    text = files_of(sent(client, problem, plan, "qgc-wpl", "vehicle"))["van-1-drone-1.waypoints"]
    home, *items = way_points(tmp_path, text)
    assert mission["mission"]["plannedHomePosition"] == [home.x, home.y, 0]
    assert [(item["command"], item["frame"]) for item in mission["mission"]["items"]] == [
        (item.command, item.frame) for item in items]
    for told, item in zip(mission["mission"]["items"], items, strict=True):
        assert told["params"] == pytest.approx([
            item.param1, item.param2, item.param3, item.param4, item.x, item.y, item.z], abs=1e-3)
    assert [item["doJumpId"] for item in mission["mission"]["items"]] == list(
        range(1, len(items) + 1))
    (fence,) = mission["geoFence"]["polygons"]
    assert fence["inclusion"] is False
    rally = mission["rallyPoints"]["points"]
    stops = {(60.1708, 24.9415), (60.1675, 24.9522)}
    assert {(lat, lon) for lat, lon, _ in rally} <= stops


def test_flights_of_one_drone_follow_each_other_as_planned(
        client: httpx.Client, tmp_path: Path) -> None:
    problem = city(airspace={})
    plan = planned(client, problem)
    (content,) = files_of(sent(client, problem, plan, "qgc-wpl", "vehicle")).values()
    items = way_points(tmp_path, content)[1:]
    told = [NAMES[item.command] for item in items]
    assert told.count("NAV_LAND") == 2 * len(sorties(plan))
    rides = [items[index + 1].param1 for index, (name, after) in enumerate(pairwise(told))
             if name == "NAV_LAND" and after == "NAV_DELAY"][1::2]
    expected = [after["launch_time"] - before["recovery_time"]
                for before, after in pairwise(sorties(plan))]
    assert rides == pytest.approx(expected, abs=1e-2)
