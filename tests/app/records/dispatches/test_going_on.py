"""Planning on from what drivers told."""

from collections.abc import Iterable
from datetime import UTC, datetime, timedelta
from typing import Any

import httpx
import pytest

from app.console.routes import STATIC_DIR
from app.records.dispatches.doubts import Answers
from app.records.dispatches.going_on import GROUNDING, OnTheRoad, going_on
from app.records.dispatches.schemas import DispatchRequest, DoubtfulReply, GoingOnReply
from app.records.dispatches.standing import ToldStep
from app.records.dispatches.steps import StepMaker
from tests.app.records.dispatches.days import (
    DEPART, DOOR, FIRST, LAUNCH, NEXT_DOOR, PLAN, PROBLEM, RECOVER, RETURN, SECOND, Data,
    dispatched, event, holding, token_of,
)

pytestmark = pytest.mark.slow

REQUEST = DispatchRequest.model_validate({"problem": PROBLEM, "plan": PLAN}, strict=False)


def gone_on(told: dict[str, dict[str, ToldStep]], now: float, served: Iterable[str] = (),
            unserved: Iterable[str] = ()) -> GoingOnReply:
    """Return how to plan on, by what was told of each vehicle, and of whom nobody told."""
    maker = StepMaker(REQUEST.problem)
    vehicles = {route.vehicle: OnTheRoad(maker.steps(route), told.get(route.vehicle, {}))
                for route in REQUEST.plan.routes}
    answers = Answers(frozenset(served), frozenset(unserved))
    return going_on(REQUEST.plan, vehicles, now, answers).reply


def route_of(reply: GoingOnReply, vehicle: str) -> Data:
    """Return a vehicle's first trip."""
    routes: list[Data] = reply.replan["plan"]["routes"]
    return dict(next(route for route in routes if route["vehicle"] == vehicle)["trips"][0])


def times(trip: Data) -> list[tuple[str, float, float]]:
    """Return where a truck is and when."""
    return [(stop["id"], stop["arrival"], stop["departure"]) for stop in trip["stops"]]


def done(times: dict[str, float]) -> dict[str, ToldStep]:
    """Return what was told of steps."""
    return {step: ToldStep("done", time) for step, time in times.items()}


def test_vehicle_that_told_nothing_is_where_the_plan_has_it() -> None:
    reply = gone_on({}, 30_200)
    assert (reply.told, reply.failed) == ([], [])
    assert times(route_of(reply, "van-1")) == [
        (stop["id"], stop["arrival"], stop["departure"])
        for stop in PLAN["routes"][1]["trips"][0]["stops"]]


def test_what_was_told_counts_and_all_behind_is_later() -> None:
    reply = gone_on({"van-1": done({DEPART: 30_500, DOOR: 30_900})}, 31_000)
    assert reply.told == ["van-1"]
    assert times(route_of(reply, "van-1")) == [
        ("hub", 30_000, 30_500), ("D", 30_640, 30_900), ("E", 31_000, 31_060),
        ("hub", 31_300, 31_300)]


def test_what_should_be_over_but_was_not_told_is_over_in_a_moment() -> None:
    (_, first, second, home) = times(route_of(gone_on({"van-1": done({DEPART: 30_000})}, 35_000),
                                              "van-1"))
    assert first == ("D", 30_140, 35_060)
    assert second[1] == 35_160
    assert home[1] > second[2]


def test_customer_passed_over_is_still_to_be_served() -> None:
    trip = route_of(gone_on({"van-1": done({DEPART: 30_000, NEXT_DOOR: 30_300})}, 30_400), "van-1")
    assert [stop["id"] for stop in trip["stops"]] == ["hub", "E", "D", "hub"]
    assert trip["stops"][1]["departure"] == 30_300
    assert trip["stops"][2]["departure"] > 30_400


def test_whoever_was_not_served_is_open_again_once_the_parcel_is_back() -> None:
    told = {**done({DEPART: 30_000}), DOOR: ToldStep("failed", 30_200, "Nobody there")}
    reply = gone_on({"van-1": told}, 30_250)
    trip = route_of(reply, "van-1")
    assert [stop["id"] for stop in trip["stops"]] == ["hub", "E", "hub"]
    (failed,) = reply.failed
    assert (failed.customer, failed.reason, failed.is_open) == ("D", "Nobody there", True)
    assert failed.parcel_back == trip["stops"][-1]["arrival"]


def test_vehicle_that_broke_down_does_nothing_more() -> None:
    broken = {"vehicle": ToldStep("failed", 30_250, "Broken down")}
    reply = gone_on({"van-1": {**done({DEPART: 30_000, DOOR: 30_200}), **broken}}, 30_300)
    assert reply.broken == reply.replan["unavailable"] == ["van-1"]
    assert times(route_of(reply, "van-1"))[1][2] == 30_200
    alone = gone_on({"van-1": broken}, 30_300)
    assert (alone.broken, alone.told, alone.failed) == (["van-1"], ["van-1"], [])
    assert route_of(alone, "van-1")["stops"][1]["service_start"] > 30_300
    assert gone_on({"van-1": done({DEPART: 30_000})}, 30_300).broken == []


def doubts(reply: GoingOnReply) -> dict[str, bool]:
    """Return of whom nobody told, and whether they are held to be served."""
    return {doubt.customer: doubt.is_served for doubt in reply.doubtful}


def test_whom_the_plan_has_as_served_and_nobody_told_is_in_doubt() -> None:
    silent = gone_on({}, 30_400)
    assert doubts(silent) == {"A": True, "D": True, "E": True}
    assert silent.replan["doubtful"] == ["A", "D", "E"]
    told = gone_on({"van-1": done({DEPART: 30_000, NEXT_DOOR: 30_300})}, 30_400)
    assert doubts(told) == {"A": True, "D": False}
    assert gone_on({"van-1": done({DEPART: 30_000, DOOR: 30_200})}, 30_250).doubtful[0] == (
        DoubtfulReply(customer="A", vehicle="truck-1", time=30_160, is_served=True))


def test_broken_vehicle_has_served_those_alone_of_whom_it_told() -> None:
    broken = {"vehicle": ToldStep("failed", 30_390, "Broken down")}
    reply = gone_on({"van-1": broken, "truck-1": done({DEPART: 30_000, FIRST: 30_150}) | broken},
                    30_400)
    assert doubts(reply) == {"D": False, "E": False}
    van, truck = (route_of(reply, name)["stops"] for name in ("van-1", "truck-1"))
    assert van[0]["departure"] <= 30_400  # its parcels are aboard
    assert min(stop["service_start"] for stop in van[1:]) > 30_400
    assert [stop["service_start"] > 30_400 for stop in truck[1:]] == [False, True, True]
    knows = gone_on({"van-1": broken}, 30_400, served=["D"])
    assert doubts(knows) == {"A": True, "D": True, "E": False}
    assert [stop["service_start"] > 30_400 for stop in route_of(knows, "van-1")["stops"]] == [
        False, False, True, True]


def test_silent_vehicle_is_where_somebody_knows_it_to_be() -> None:
    nothing = gone_on({}, 30_400, unserved=["D", "E"])
    assert (doubts(nothing), nothing.failed) == ({"A": True, "D": False, "E": False}, [])
    assert route_of(nothing, "van-1")["stops"][0]["departure"] > 30_400
    some = gone_on({}, 30_400, unserved=["D"])
    assert doubts(some) == {"A": True, "D": False, "E": True}
    assert [(failed.customer, failed.is_open) for failed in some.failed] == [("D", True)]
    assert [stop["id"] for stop in route_of(some, "van-1")["stops"]] == ["hub", "E", "hub"]


def test_vehicle_that_is_back_has_served_those_alone_of_whom_it_told() -> None:
    back = {"van-1": done({DEPART: 30_000, DOOR: 30_200, RETURN: 30_600})}
    reply = gone_on(back, 30_700)
    assert doubts(reply)["E"] is False
    assert [(failed.customer, failed.is_open) for failed in reply.failed] == [("E", True)]
    assert [stop["id"] for stop in route_of(reply, "van-1")["stops"]] == ["hub", "D", "hub"]
    assert gone_on(back, 30_700, served=["E"]).failed == []


@pytest.mark.parametrize("now", [30_470, 30_500, 31_000])
@pytest.mark.parametrize("second", [30_110, 30_460])  # earlier than planned, and as planned
def test_truck_with_drones_has_served_those_alone_of_whom_it_told(now: float,
                                                                  second: float) -> None:
    told = {"truck-1": done({DEPART: 30_000, SECOND: second})}
    reply = gone_on(told, now)
    assert doubts(reply) == {"A": False, "C": False, "D": True, "E": True}
    assert {(failed.customer, failed.is_open) for failed in reply.failed} == {
        ("A", True), ("C", True)}
    assert reply.replan["doubtful"] == ["D", "E"]
    trip = route_of(reply, "truck-1")
    assert ([stop["id"] for stop in trip["stops"]], trip["sorties"]) == (["hub", "B", "hub"], [])
    assert trip["stops"][1]["departure"] == second
    knows = gone_on(told, now, served=["A", "C"])
    assert (doubts(knows)["A"], doubts(knows)["C"], knows.failed) == (True, True, [])


def test_drone_that_was_launched_flies_to_its_end_until_its_truck_has_left_without_a_word() -> None:
    flying = done({DEPART: 30_000, FIRST: 30_160, LAUNCH: 30_130})
    reply = gone_on({"truck-1": flying}, 30_500)
    assert (doubts(reply), reply.failed) == (
        {"B": False, "C": True, "D": True, "E": True}, [])
    assert reply.replan["doubtful"] == ["C", "D", "E"]
    left = gone_on({"truck-1": flying | done({SECOND: 30_460, RETURN: 30_700})}, 30_700)
    assert doubts(left)["C"] is False
    assert [(failed.customer, failed.is_open) for failed in left.failed] == [("C", False)]
    assert left.replan["doubtful"] == ["C", "D", "E"]
    assert left.grounded == []


def test_customer_at_a_stop_where_a_drone_was_launched_stays_in_the_plan_in_doubt() -> None:
    told = {"truck-1": done({DEPART: 30_000, LAUNCH: 30_130, SECOND: 30_460, RECOVER: 30_465})}
    reply = gone_on(told, 30_500)
    assert doubts(reply)["A"] is False
    assert [(failed.customer, failed.is_open) for failed in reply.failed] == [("A", False)]
    assert reply.replan["doubtful"] == ["A", "D", "E"]
    assert gone_on(told, 30_500, unserved=["A"]).replan["doubtful"] == ["D", "E"]


def test_orders_of_a_broken_vehicle_that_told_nothing_are_planned_again(
        searching: httpx.Client) -> None:
    start = datetime.now(UTC) - timedelta(seconds=30_500)
    sent = dispatched(searching, plan_start=start.isoformat())
    told_at(searching, token_of(sent["links"][1]), event(
        "1", "vehicle", datetime.now(UTC).isoformat(), "failed", reason="Broken down"))
    going = searching.get(f"/dispatches/{sent['id']}/replan", params={"unserved": "A"}).json()
    GoingOnReply.model_validate(going)
    assert {doubt["customer"]: doubt["is_served"] for doubt in going["doubtful"]} == {
        "A": False, "B": True, "C": True, "D": False, "E": False}
    plan = searching.post("/plan", json=PROBLEM | {
        "replan": going["replan"], "options": {"time_limit": 0.3}}).json()
    servants = {stop["id"]: route["vehicle"] for route in plan["routes"]
                for trip in route["trips"] for stop in trip["stops"]}
    assert "van-1" not in servants.values()
    assert {"D", "E"} <= servants.keys()
    assert plan["replan"]["doubtful"] == ["B", "C"]
    assert {parcel["id"] for parcel in plan["replan"]["parcels"]} == {"D", "E"}


def test_drone_that_was_not_launched_leaves_its_customers_open() -> None:
    told = {**done({DEPART: 30_000}), LAUNCH: ToldStep("failed", 30_140, "No wind")}
    reply = gone_on({"truck-1": told}, 30_150)
    assert route_of(reply, "truck-1")["sorties"] == []
    assert [(failed.customer, failed.is_open) for failed in reply.failed] == [("C", True)]


@pytest.mark.parametrize(("step", "reason", "grounded"), [
    (LAUNCH, "Drone is broken", ["truck-1/drone-1"]), (LAUNCH, "Too much wind", []),
    (RECOVER, "Did not come back", ["truck-1/drone-1"]), (RECOVER, "Came back with the parcel", []),
])
def test_drone_that_is_lost_is_launched_no_more(step: str, reason: str,
                                                grounded: list[str]) -> None:
    told = {**done({DEPART: 30_000}), step: ToldStep("failed", 30_450, reason)}
    reply = gone_on({"truck-1": told}, 30_460)
    assert reply.grounded == reply.replan.get("unavailable", []) == grounded


def test_what_grounds_a_drone_is_what_the_page_offers() -> None:
    page = (STATIC_DIR / "texts" / "reasons" / "en.js").read_text("utf-8")
    assert [reason for reason in GROUNDING if f"'{reason}'" not in page] == []


def test_stop_where_a_drone_is_met_stays_though_nobody_was_served() -> None:
    told = {**done({DEPART: 30_000, LAUNCH: 30_150}), FIRST: ToldStep("failed", 30_200, "Shut")}
    reply = gone_on({"truck-1": told}, 30_210)
    assert [stop["id"] for stop in route_of(reply, "truck-1")["stops"]] == ["hub", "A", "B", "hub"]
    assert [(failed.customer, failed.is_open) for failed in reply.failed] == [("A", False)]


def test_flights_are_timed_by_what_was_told() -> None:
    told = done({DEPART: 30_100, LAUNCH: 30_400, FIRST: 30_420})
    trip = route_of(gone_on({"truck-1": told}, 30_500), "truck-1")
    (sortie,) = trip["sorties"]
    assert sortie["launch_time"] == 30_400
    assert sortie["customers"][0]["arrival"] == 30_400 + 120
    assert trip["stops"][1]["departure"] == 30_420
    later = done({DEPART: 30_100, LAUNCH: 30_400, FIRST: 30_420, RECOVER: 30_450, SECOND: 30_600})
    (sortie,) = route_of(gone_on({"truck-1": later}, 30_700), "truck-1")["sorties"]
    assert sortie["recovery_time"] == 30_450
    assert sortie["customers"][0]["departure"] <= 30_450


@pytest.mark.parametrize("told", [
    {"truck-1": done({DEPART: 30_100, LAUNCH: 30_101})},
    {"truck-1": done({SECOND: 30_050})},
    {"truck-1": done({DEPART: 30_000, LAUNCH: 30_130, SECOND: 30_460})},
    {"truck-1": done({DEPART: 30_000, LAUNCH: 30_130, RETURN: 30_200})},
    {"truck-1": done({DEPART: 30_000, RECOVER: 30_150, SECOND: 30_140})},
    {"truck-1": done({DEPART: 30_000, FIRST: 30_050, RETURN: 30_100})},
    {"truck-1": done({RECOVER: 30_050}), "van-1": done({RETURN: 30_010})},
    {"truck-1": done({DEPART: 29_000, LAUNCH: 29_001, FIRST: 29_002, SECOND: 29_003,
                     RECOVER: 29_004, RETURN: 29_005})},
    {"van-1": {DOOR: ToldStep("failed", 30_100, "x"), NEXT_DOOR: ToldStep("failed", 30_050, "x")}},
    {"van-1": {DOOR: ToldStep("failed", 30_100, "x"), NEXT_DOOR: ToldStep("failed", 30_150, "x"),
               RETURN: ToldStep("done", 30_200)}},
])
@pytest.mark.parametrize("now", [30_105, 30_400, 40_000])
def test_whatever_was_told_can_be_gone_on_from(
        client: httpx.Client, told: dict[str, dict[str, ToldStep]], now: float) -> None:
    reply = gone_on(told, now)
    served = {failed.customer for failed in reply.failed if failed.is_open}
    plan = reply.replan["plan"]
    checked = client.post("/check", json={
        "problem": PROBLEM | {"replan": reply.replan},
        "plan": {**plan, "unassigned": [{"id": name} for name in sorted(served)]}})
    assert checked.status_code == 200, checked.text
    codes = {violation["code"] for violation in checked.json()["violations"]}
    assert not codes & {"FROZEN", "PAST", "ABOARD", "STRUCTURE"}, checked.json()["violations"]


def told_at(client: httpx.Client, token: str, *events: Any) -> None:
    """Tell events now."""
    reply = client.post("/drive/events", headers=holding(token), json={
        "now": datetime.now(UTC).isoformat(), "events": list(events)})
    assert reply.status_code == 200, reply.text


def test_drivers_words_are_planned_on_from_over_http(searching: httpx.Client) -> None:
    start = datetime.now(UTC) - timedelta(seconds=30_500)
    sent = dispatched(searching, plan_start=start.isoformat())
    token = token_of(sent["links"][1])

    def at(seconds: float) -> str:
        return (start + timedelta(seconds=seconds)).isoformat()

    told_at(searching, token, event("1", DEPART, at(30_000)),
            event("2", DOOR, at(30_300), "failed", reason="Nobody there"))
    reply = searching.get(f"/dispatches/{sent['id']}/replan")
    assert reply.status_code == 200, reply.text
    GoingOnReply.model_validate_json(reply.text)
    going = reply.json()
    assert 30_500 <= going["replan"]["freeze_before"] < 30_600
    (failed,) = going["failed"]
    customers = [customer | ({"release_time": failed["parcel_back"]}
                             if customer["id"] == "D" else {})
                 for customer in PROBLEM["customers"]]
    plan = searching.post("/plan", json=PROBLEM | {
        "customers": customers, "replan": going["replan"],
        "options": {"time_limit": 0.3}}).json()
    served = {stop["id"]: stop for route in plan["routes"] for trip in route["trips"]
              for stop in trip["stops"] if stop["kind"] == "customer"}
    assert served["D"]["arrival"] > failed["parcel_back"] - 1
    first = next(route for route in plan["routes"] if route["vehicle"] == "van-1")["trips"][0]
    assert [stop["id"] for stop in first["stops"]] == ["hub", "E", "hub"]
    assert first["stops"][0]["departure"] == 30_000
