"""From a wind by the hour to the hours in which drones may fly."""

import json
from typing import Any

import pytest

from app.requests.conversion.problem import to_problem
from app.schemas.request import PlanRequest
from app.schemas.times import read_body
from model.problem import MAX_STORMS, UNLIMITED, Problem

Request = dict[str, Any]
HOUR = 3_600_000


def problem_of(request: Request) -> Problem:
    return to_problem(read_body(PlanRequest, json.dumps(request).encode()))


def windy(request: Request, wind: object, shift: Request | None = None,
          **drones: Any) -> Request:
    """Return a request with a wind, and a drone on its truck."""
    request["airspace"] = {"wind": wind}
    request["fleet"][0] |= {"drones": {"count": 1, "capacity": [10], "speed_kmh": 60, **drones},
                            "shift": shift or {}}
    return request


def hours(*gusts: float, **fields: Any) -> list[Request]:
    """Return a calm wind with such gusts, hour after hour."""
    return [{"from": 3600 * hour, "speed_kmh": 0, "gust_kmh": gust, **fields}
            for hour, gust in enumerate(gusts)]


def storms_of(request: Request) -> list[tuple[float, float]]:
    """Return the hours from and until when drones stay aboard."""
    drones = problem_of(request).vehicle_types[0].drones
    assert drones is not None
    return [(begin / HOUR, UNLIMITED if end == UNLIMITED else end / HOUR)
            for begin, end in drones.storms]


@pytest.mark.parametrize(("gusts", "storms"), [
    ((10, 50, 60, 20), [(1, 3)]), ((50, 10, 50), [(0, 1), (2, UNLIMITED)]), ((40, 40), [])])
def test_drones_stay_aboard_while_gusts_are_too_strong(
        smallest: Request, gusts: tuple[float, ...], storms: list[tuple[float, float]]) -> None:
    assert storms_of(windy(smallest, hours(*gusts), max_wind_kmh=40)) == storms


def test_wind_counts_where_no_gusts_are_stated(smallest: Request) -> None:
    assert storms_of(windy(smallest, {"speed_kmh": 50}, max_wind_kmh=40)) == [(0, UNLIMITED)]
    wind = [{"from": 0, "speed_kmh": 30}, {"from": 3600, "speed_kmh": 50}]
    assert storms_of(windy(smallest, wind, max_wind_kmh=40)) == [(1, UNLIMITED)]


@pytest.mark.parametrize("wind", [
    [{"from": 0, "speed_kmh": 45, "gust_kmh": 20}, {"from": 3600, "speed_kmh": 10, "gust_kmh": 0}],
    {"open_meteo": {"hourly": {
        "time": ["2026-06-01T00:00", "2026-06-01T01:00"], "wind_speed_10m": [45, 10],
        "wind_direction_10m": [0, 0], "wind_gusts_10m": [20, 20]}}},
    {"open_meteo": {"hourly_units": {"wind_speed_10m": "m/s", "wind_gusts_10m": "km/h"}, "hourly": {
        "time": ["2026-06-01T00:00", "2026-06-01T01:00"], "wind_speed_10m": [12, 10],
        "wind_direction_10m": [0, 0], "wind_gusts_10m": [39, 39]}}},
    {"open_meteo": {"hourly": {
        "time": ["2026-06-01T00:00", "2026-06-01T01:00"], "wind_speed_10m": [45, 10],
        "wind_direction_10m": [0, 0], "wind_gusts_10m": [None, None]}}}])
def test_drones_stay_aboard_while_wind_is_too_strong_whatever_gusts_say(smallest: Request,
                                                                        wind: object) -> None:
    request = windy(smallest | {"plan_start": "2026-06-01T00:00Z"}, wind, max_wind_kmh=40)
    assert storms_of(request) == [(0, 1)]


def test_only_hours_of_the_shift_count(smallest: Request) -> None:
    gusts = hours(50, 10, 50, 10, 50)
    shift = {"earliest": 1.5 * 3600, "latest": 3.5 * 3600}
    assert storms_of(windy(smallest, gusts, shift, max_wind_kmh=40)) == [(2, 3)]


def test_many_storms_become_fewer_that_last_longer(smallest: Request) -> None:
    gusts = hours(*(50, 10) * (MAX_STORMS + 2))
    storms = storms_of(windy(smallest, gusts, max_wind_kmh=40))
    assert len(storms) == MAX_STORMS
    assert all(any(begin <= hour and hour + 1 <= end for begin, end in storms)
               for hour in range(0, 2 * MAX_STORMS, 2))


def flight_ms(request: Request, start: int, end: int) -> int:
    """Return how long a flight takes between two nodes."""
    problem = problem_of(request)
    drones = problem.vehicle_types[0].drones
    assert drones is not None
    return problem.travel[drones.travel].duration.item(start, end)


def test_each_leg_takes_as_long_as_in_its_worst_hour(smallest: Request) -> None:
    # 6 km eastwards and back: 30 km/h from the west and then from the east, at 60 km/h.
    west, east = ({"from": 3600 * hour, "speed_kmh": 30, "direction_deg": direction}
                  for hour, direction in enumerate((270, 90)))
    assert flight_ms(windy(smallest, [west]), 0, 2) == 240_000
    assert flight_ms(windy(smallest, [west]), 2, 0) == 720_000
    assert [flight_ms(windy(smallest, [west, east]), *leg) for leg in ((0, 2), (2, 0))] == [
        720_000, 720_000]
    morning = windy(smallest, [west, east], {"latest": 1800})
    assert flight_ms(morning, 0, 2) == 240_000


def test_hours_that_are_not_flown_are_not_the_worst(smallest: Request) -> None:
    wind = [{"from": 0, "speed_kmh": 0}, {"from": 3600, "speed_kmh": 50}]
    assert flight_ms(windy(smallest, wind), 0, 2) > 360_000
    assert flight_ms(windy(smallest, wind, max_wind_kmh=40), 0, 2) == 360_000


def forecast(unit: str = "m/s", **hourly: Any) -> Request:
    """Return what Open-Meteo replies for two hours."""
    return {"open_meteo": {
        "latitude": 52.52, "longitude": 13.41, "utc_offset_seconds": 7200, "elevation": 38.0,
        "timezone": "Europe/Berlin", "timezone_abbreviation": "CEST", "generationtime_ms": 0.05,
        "hourly_units": {"time": "iso8601", "wind_speed_10m": unit, "wind_direction_10m": "°",
                         "wind_gusts_10m": unit},
        "hourly": {"time": ["2026-06-01T07:00", "2026-06-01T08:00", "2026-06-01T09:00"],
                   "wind_speed_10m": [2.0, 5.0, 2.0], "wind_direction_10m": [270, 270, 270],
                   "wind_gusts_10m": [4.0, 12.0, 4.0], **hourly}}}


def test_a_forecast_is_taken_as_it_is(smallest: Request) -> None:
    request = windy(smallest, forecast(), max_wind_kmh=40)
    request["plan_start"] = "2026-06-01T06:30:00+02:00"
    assert storms_of(request) == [(1.5, 2.5)]
    for unit in ("km/h", "kn", "mp/h"):
        request["airspace"]["wind"] = forecast(unit)
        assert storms_of(request) == []
    unix = [1_780_290_000 + 3600 * hour for hour in range(3)]
    request["airspace"]["wind"] = forecast(time=unix)
    assert storms_of(request) == [(1.5, 2.5)]
