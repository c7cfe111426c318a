"""Times of day over HTTP: what is stated is planned, told as asked for, and can be sent again."""

from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from pydantic_core import to_json

from app.requests.reading import read_request
from app.schemas.errors import InvalidRequestError
from app.schemas.request import PlanRequest
from app.schemas.times import read_body
from tests.app.plans.asking import planned

Request = dict[str, Any]
HOUR = 3600


@pytest.fixture
def day(smallest: Request) -> Request:
    """Return a request whose only stops take time."""
    smallest |= {"plan_start": "2026-03-29T00:00", "time_zone": "Europe/Berlin"}
    for customer in smallest["customers"]:
        customer["service_duration"] = "0:10"
    smallest["fleet"][0]["shift"] = {"earliest": "01:00", "latest": "18:00"}
    return smallest


def refused(client: httpx.Client, request: Request, path: str = "/plan") -> dict[str, str]:
    reply = client.post(path, json=request)
    assert reply.status_code == 422, reply.text
    return {error["path"]: error["code"] for error in reply.json()["errors"]}


def instants(plan: Request) -> Iterator[Any]:
    yield plan["summary"]["makespan"]
    for route in plan["routes"]:
        for trip in route["trips"]:
            for halt in [*trip["stops"], *(visit for sortie in trip["sorties"]
                                           for visit in sortie["customers"])]:
                yield from (halt["arrival"], halt["service_start"], halt["departure"])
            for sortie in trip["sorties"]:
                yield from (sortie["launch_time"], sortie["recovery_time"])


@pytest.mark.parametrize(("plan_start", "zone", "opens"), [
    ("2026-03-29T00:00", "Europe/Berlin", 6.5),
    ("2026-10-25T00:00", "Europe/Berlin", 8.5),
    ("2026-03-30T00:00", "Europe/Berlin", 7.5),
    ("2026-03-29T05:00+02:00", "Europe/Berlin", 2.5),
    ("2026-03-29T05:00+02:00", None, 2.5),
    ("2026-03-08T00:00", "America/New_York", 6.5),
    ("2026-11-01T00:00", "America/New_York", 8.5),
    ("2026-05-04T00:00", "Pacific/Kiritimati", 7.5),
])
def test_windows_open_by_the_wall_clock(client: httpx.Client, day: Request, plan_start: str,
                                        zone: str | None, opens: float) -> None:
    day |= {"plan_start": plan_start, "time_zone": zone}
    day["customers"][0]["time_window"] = {"earliest": "07:30", "latest": "07:30"}
    told = {}
    for times in ("seconds", "iso", "clock"):
        plan = planned(client, day | {"options": {"times": times, "time_limit": 0}})
        told[times] = next(stop["service_start"] for stop in plan["routes"][0]["trips"][0]["stops"]
                           if stop["id"] == day["customers"][0]["id"])
    assert told["seconds"] == opens * HOUR
    assert told["iso"].startswith(plan_start[:10] + "T07:30:00")
    assert told["clock"] == "07:30:00"


def test_seconds_and_times_of_day_ask_for_the_same(client: httpx.Client, smallest: Request,
                                                   ) -> None:
    customer, vehicle = smallest["customers"][0], smallest["fleet"][0]
    customer |= {"time_window": {"earliest": 3600, "latest": 7200}, "service_duration": 600,
                 "setup_duration": 90, "release_time": 1800, "max_time_aboard": 3600,
                 "service_duration_by_type": {vehicle["id"]: 600}}
    vehicle |= {"shift": {"earliest": 900, "latest": 40000}, "max_working_duration": 36000,
                "reload_duration": 600, "speed_profile": [{"from": 7200, "factor": 0.5}],
                "overtime": {"max_duration": 1800, "cost_per_hour": 30},
                "drones": {"count": 1, "capacity": [5], "endurance": 1500, "launch_duration": 60,
                           "recovery_duration": 30, "turnaround": {"swap_duration": 45}}}
    stated = planned(client, smallest)
    customer |= {"time_window": {"earliest": "07:00", "latest": "2026-05-04T06:00:00Z"},
                 "service_duration": "PT10M", "setup_duration": "0:01:30",
                 "release_time": "06:30", "max_time_aboard": "1:00",
                 "service_duration_by_type": {vehicle["id"]: "PT600S"}}
    vehicle |= {"shift": {"earliest": "06:15:00", "latest": "2026-05-04 17:06:40"},
                "max_working_duration": "10:00", "reload_duration": "PT0.1666666667H",
                "speed_profile": [{"from": "08:00", "factor": 0.5}],
                "overtime": {"max_duration": "PT30M", "cost_per_hour": 30}}
    vehicle["drones"] |= {"endurance": "0:25", "launch_duration": "PT1M",
                          "recovery_duration": "PT30S", "turnaround": {"swap_duration": "0:00:45"}}
    told = planned(client, smallest | {
        "plan_start": "2026-05-04T06:00+02:00", "options": {"times": "seconds"}})
    for plan in (stated, told):
        plan["solver"]["elapsed"] = {}
    assert told.pop("plan_start") == "2026-05-04T06:00+02:00"
    assert told == stated


@pytest.mark.parametrize("times", ["seconds", "iso", "clock", None])
def test_what_is_replied_can_be_sent_again(client: httpx.Client, day: Request,
                                           times: str | None) -> None:
    day["fleet"][0]["drones"] = {"count": 1, "capacity": [20], "endurance": "0:30"}
    day["customers"][0] |= {"served_by": "drone"}
    day["options"] = {"times": times} if times else {}
    plan = planned(client, day)
    kind = float if times == "seconds" else str
    assert all(isinstance(instant, kind) for instant in instants(plan))
    checked = client.post("/check", json={"problem": day, "plan": plan}).json()
    assert checked["feasible"], checked
    assert checked["summary"] == plan["summary"]
    explained = client.post("/explain", json={
        "problem": day, "plan": plan, "customer": day["customers"][1]["id"]}).json()
    assert isinstance(explained["here"]["service_start"], kind), explained
    on = planned(client, day | {"replan": {"plan": plan, "freeze_before": "01:00"}})
    assert on["replan"]["settled"]


def test_currency_zone_and_dimensions_are_repeated(client: httpx.Client, day: Request) -> None:
    stated = {"currency": "CHF", "load_dimensions": [{"name": "weight", "unit": "kg"}],
              "plan_start": "2026-03-29T00:00", "time_zone": "Europe/Berlin"}
    plan = planned(client, day | stated)
    assert {name: plan[name] for name in stated} == stated
    assert refused(client, day | {"load_dimensions": [{"name": "a"}, {"name": "b"}]}) == {
        "$.load_dimensions": "DIMENSION_MISMATCH"}
    assert "$.currency" in refused(client, day | {"currency": "euro"})


def test_openings_before_plan_start_hold_from_then_on(client: httpx.Client, day: Request) -> None:
    day |= {"plan_start": "2026-05-04T14:00"}
    day["customers"][0] |= {"time_window": {"earliest": "08:00", "latest": "17:00"},
                            "release_time": "2026-05-03T18:00"}
    plan = planned(client, day)
    assert plan["summary"]["served"] == 2
    day["customers"][0]["time_window"]["latest"] = "12:00"
    assert refused(client, day) == {
        "$.customers[0].time_window.latest": "BEFORE_PLAN_START"}
    day["customers"][0]["time_window"]["latest"] = "+1 12:00"
    assert planned(client, day)["summary"]["served"] == 2


def test_large_numbers_are_unix_time(client: httpx.Client, day: Request) -> None:
    midnight = 1774738800  # 2026-03-29T00:00 in Berlin
    day["customers"][0]["time_window"] = {"earliest": midnight + 7 * HOUR,
                                          "latest": midnight + 7 * HOUR + 0.25}
    day["customers"][1]["release_time"] = midnight - 1
    start = planned(client, day | {"options": {"times": "seconds"}})
    stops = [stop for route in start["routes"] for trip in route["trips"] for stop in trip["stops"]]
    assert 7.0 * HOUR in [stop["service_start"] for stop in stops]
    day["customers"][0]["time_window"] = {"latest": midnight - 1}
    assert refused(client, day) == {"$.customers[0].time_window.latest": "BEFORE_PLAN_START"}
    day["customers"][0]["time_window"] = {"latest": 1e10}
    assert refused(client, day) == {"$.customers[0].time_window.latest": "OUT_OF_RANGE"}


def test_large_numbers_need_a_day(client: httpx.Client, smallest: Request) -> None:
    smallest["customers"][0]["time_window"] = {"latest": 1774738800}
    smallest["fleet"][0]["shift"] = {"earliest": 1774738800}
    smallest["fleet"][0]["max_working_duration"] = 1774738800
    errors = client.post("/plan", json=smallest).json()["errors"]
    assert {error["path"]: error["code"] for error in errors} == {
        "$.customers[0].time_window.latest": "MISSING_PLAN_START",
        "$.fleet[0].shift.earliest": "MISSING_PLAN_START",
        "$.fleet[0].max_working_duration": "OUT_OF_RANGE"}
    assert all("plan_start" in error["message"] for error in errors
               if error["code"] == "MISSING_PLAN_START")
    assert refused(client, smallest | {"plan_start": "soon"}) == {
        "$.plan_start": "WRONG_TYPE", "$.fleet[0].max_working_duration": "OUT_OF_RANGE"}


def with_break(day: Request, start: Request, **fields: Any) -> Request:
    """Return a day whose drivers have a break."""
    stated = {"id": "lunch", "duration": "0:30", "start": start} | fields
    return day | {"fleet": [day["fleet"][0] | {"breaks": [stated]}]}


def test_a_break_after_departure_is_stated_by_lengths_of_time(client: httpx.Client,
                                                              day: Request) -> None:
    for start in ({"earliest": "PT5M", "latest": "PT1H30M"}, {"earliest": 300, "latest": 5400}):
        request = with_break(day, start, after_departure=True)
        read = read_body(PlanRequest, to_json(request)).fleet[0].breaks[0].start
        assert (read.earliest, read.latest) == (300, 5400)
        assert "errors" not in client.post("/plan", json=request).json()


def at_night(smallest: Request, **stated: Any) -> Request:
    """Return a request of a night's shift."""
    smallest |= {"plan_start": "2026-03-28T00:00", "time_zone": "Europe/Berlin"}
    smallest["fleet"][0]["shift"] = {"earliest": "21:00", "latest": "+1 06:00"}
    return smallest | stated


@pytest.mark.parametrize("plan_start", ["2026-03-28T00:00", "2026-03-28T20:00"])
def test_windows_of_a_night_are_on_the_day_after(client: httpx.Client, smallest: Request,
                                                 plan_start: str) -> None:
    request = at_night(smallest, plan_start=plan_start, options={"times": "iso"})
    # In that night the clock goes forward, from two to three.
    request["customers"][0]["time_windows"] = [
        {"earliest": "00:30", "latest": "01:00"}, {"earliest": "20:30", "latest": "21:00"}]
    request["customers"][1]["time_window"] = {"earliest": "03:30", "latest": "05:30"}
    plan = planned(client, request)
    assert not plan["unassigned"]
    stops = {stop["id"]: stop for stop in plan["routes"][0]["trips"][0]["stops"]}
    assert stops[request["customers"][0]["id"]]["service_start"] == "2026-03-29T00:30:00+01:00"
    assert stops[request["customers"][1]["id"]]["service_start"] == "2026-03-29T03:30:00+02:00"
    (warning,) = [each for each in plan["warnings"] if each["code"] == "WINDOWS_OF_NEXT_DAY"]
    assert "2 of " in warning["message"] or "All 2 " in warning["message"]
    assert "until 01:00. Write +1 01:00" in warning["message"]
    checked = client.post("/check", json={"problem": request, "plan": plan}).json()
    assert checked["feasible"], checked


@pytest.mark.parametrize(("window", "read"), [
    ({"earliest": "23:00", "latest": "02:00"}, (23, 26)),
    ({"latest": "05:00"}, (0, 29)),
    ({"earliest": "03:00", "latest": "+1 04:00"}, (3, 28)),
    ({"earliest": "03:00", "latest": "22:00"}, (3, 22)),
    ({"earliest": "03:00", "latest": "07:00"}, (3, 7)),
    ({"earliest": 10800, "latest": 18000}, (3, 5)),
    ({"earliest": "2026-03-27T03:00", "latest": "2026-03-27T05:00"}, (3, 5)),
])
def test_what_is_of_the_night_and_what_is_not(smallest: Request, window: Request,
                                              read: tuple[int, int]) -> None:
    request = at_night(smallest, plan_start="2026-03-27T00:00")
    request["customers"][0]["time_window"] = window
    request["customers"][0]["alternatives"] = [
        {"id": "there", "location": [1, 1], "time_window": window}]
    for customer in read_body(PlanRequest, to_json(request)).customers[::2]:
        assert (customer.time_window.earliest, customer.time_window.latest) == (
            read[0] * HOUR, read[1] * HOUR)


def test_windows_before_a_shift_of_the_day_stay_on_it(client: httpx.Client, day: Request) -> None:
    day["customers"][0]["time_window"] = {"earliest": "00:15", "latest": "00:45"}
    assert read_body(PlanRequest, to_json(day)).customers[0].time_window.latest == 2700
    day["plan_start"] = "2026-03-29T00:30"
    day["customers"][0]["time_window"] = {"earliest": "00:15", "latest": "00:20"}
    assert refused(client, day) == {"$.customers[0].time_window.latest": "BEFORE_PLAN_START"}


def test_breaks_of_a_night_are_on_the_day_after(smallest: Request) -> None:
    request = at_night(smallest)
    start = {"earliest": "01:00", "latest": "01:30"}
    read = read_body(PlanRequest, to_json(with_break(request, start))).fleet[0].breaks[0].start
    assert (read.earliest, read.latest) == (25 * HOUR, 25.5 * HOUR)


@pytest.mark.parametrize(("start", "says"), [
    ({"earliest": "5:30", "latest": "06:30:00"}, ("PT5H30M", "PT6H30M")),
    ({"latest": "2026-03-29T12:00"}, ("PT5H30M",)), ({"earliest": "+1 05:00"}, ("PT5H30M",))])
def test_a_break_after_departure_at_a_time_of_day_is_refused_with_how_to_write_it(
        client: httpx.Client, day: Request, start: Request, says: tuple[str, ...]) -> None:
    request = with_break(day, start, after_departure=True)
    errors = client.post("/plan", json=request).json()["errors"]
    assert [(error["code"], error["path"]) for error in errors] == [
        ("WRONG_TYPE", f"$.fleet[0].breaks[0].start.{name}") for name in start]
    assert all(words in error["message"] for words, error in zip(says, errors, strict=True))
    undated = {name: value for name, value in request.items()
               if name not in ("plan_start", "time_zone")}
    assert any("PT5H30M" in error["message"]
               for error in client.post("/plan", json=undated).json()["errors"])


def test_a_break_that_is_stated_by_instants_has_no_lengths_of_time(client: httpx.Client,
                                                                   day: Request) -> None:
    request = with_break(day, {"earliest": "PT5H", "latest": "P1"})
    assert refused(client, request) == {"$.fleet[0].breaks[0].start.latest": "WRONG_TYPE"}
    request = with_break(day, {"earliest": "PT5H", "latest": "12:00"})
    assert refused(client, request) == {"$.fleet[0].breaks[0].start.earliest": "WRONG_TYPE"}
    request = with_break(day, {"latest": "2026-03-01T00:00"})
    assert refused(client, request) == {"$.fleet[0].breaks[0].start.latest": "BEFORE_PLAN_START"}
    request = with_break(day, {"earliest": "PT2H", "latest": "PT1H"}, after_departure=True)
    (error,) = client.post("/plan", json=request).json()["errors"]
    assert error["message"].startswith("The window ends at 3600 s, before it starts at 7200 s")


@pytest.mark.parametrize(("changes", "errors"), [
    ({"plan_start": None, "time_zone": None},
     {"$.fleet[0].shift.earliest": "MISSING_PLAN_START",
      "$.fleet[0].shift.latest": "MISSING_PLAN_START"}),
    ({"time_zone": None}, {"$.time_zone": "MISSING_FIELD"}),
    ({"time_zone": "Europe/Berlinn"}, {"$.time_zone": "UNKNOWN_TIME_ZONE"}),
    ({"plan_start": "29.03.2026"}, {"$.plan_start": "WRONG_TYPE"}),
    ({"plan_start": 1774735200}, {"$.plan_start": "WRONG_TYPE"}),
    ({"plan_start": "9999-12-31T23:59"}, {"$.plan_start": "OUT_OF_RANGE"}),
])
def test_what_tells_no_instant_is_refused_where_it_is(
        client: httpx.Client, day: Request, changes: Request, errors: dict[str, str]) -> None:
    assert refused(client, day | changes) == errors
    problem = {"problem": day | changes, "plan": {"routes": []}}
    assert refused(client, problem, "/check") == {
        path.replace("$", "$.problem"): code for path, code in errors.items()}


@pytest.mark.parametrize(("value", "code"), [
    ("7:30 AM", "WRONG_TYPE"), ("25:00", "WRONG_TYPE"), ("soon", "WRONG_TYPE"),
    (-1, "OUT_OF_RANGE"),
    (True, "WRONG_TYPE"), (["07:30"], "WRONG_TYPE"), ("2999-01-01T00:00", "OUT_OF_RANGE"),
])
def test_each_wrong_instant_is_one_error(client: httpx.Client, day: Request, value: Any,
                                         code: str) -> None:
    day["customers"][1]["time_window"] = {"latest": value}
    assert refused(client, day) == {"$.customers[1].time_window.latest": code}


@pytest.mark.parametrize("value", ["P1M", "P1Y", "-PT5M", "10", "10 min", "1:75", "PT", "P"])
def test_wrong_lengths_of_time_are_refused(client: httpx.Client, day: Request, value: str) -> None:
    day["customers"][1]["service_duration"] = value
    assert refused(client, day) == {"$.customers[1].service_duration": "WRONG_TYPE"}


def test_told_times_need_a_day(client: httpx.Client, smallest: Request) -> None:
    assert refused(client, smallest | {"options": {"times": "clock"}}) == {
        "$.options.times": "MISSING_PLAN_START"}


def test_a_request_that_was_read_holds_seconds() -> None:
    body = (b'{"depots": [], "customers": [], "fleet": [{"id": "v", "count": 1, "capacity": [1],'
            b' "shift": {"latest": "08:00"}}], "plan_start": "2026-05-04T06:00Z"}')
    assert read_body(PlanRequest, body).fleet[0].shift.latest == 2 * HOUR


def test_reading_ends_after_many_times_that_cannot_be_read() -> None:
    customers = [{"id": str(number), "location": [0, 0], "demand": [1], "service_duration": "x",
                  "setup_duration": "x", "release_time": "x", "max_time_aboard": "x"}
                 for number in range(6000)]
    body = to_json({"depots": [], "fleet": [], "customers": customers})
    with pytest.raises(InvalidRequestError) as refused:
        read_request(body, None)
    assert [error.code for error in refused.value.errors] == ["TOO_MANY_ERRORS"]


def test_reasons_speak_as_times_are_told(client: httpx.Client, day: Request) -> None:
    day["customers"][0]["time_window"] = {"earliest": "00:00", "latest": "00:30"}
    told = {}
    for times in ("seconds", "iso", "clock"):
        day["options"] = {**day.get("options", {}), "times": times}
        left_out = planned(client, day)["unassigned"]
        told[times] = [left_out[0]["reasons"][0][name] for name in ("message", "remedy")]
    assert all("minutes" in text for text in told["seconds"])
    assert told["iso"] == told["clock"]
    assert not any("minutes" in text for text in told["iso"])
    assert all(" min" in text or " h" in text for text in told["iso"])
