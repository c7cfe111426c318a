"""Days on which trucks stop at launch sites, and come back to places, for their drones alone."""

import json

import httpx
import pytest

from app.records.dispatches.going_on import OnTheRoad, going_on
from app.records.dispatches.schemas import DispatchRequest, GoingOnReply
from app.records.dispatches.standing import ToldStep
from app.records.dispatches.steps import StepMaker
from app.requests.reading import read_request
from app.schemas.plan import PlanInput
from tests.app.plans.flights.asking import files_of
from tests.app.records.dispatches.days import (
    DEPART, FIRST, LAUNCH, PROBLEM, RECOVER, RETURN, Data, dispatched, event, holding, step_of,
    stop, token_of,
)

pytestmark = pytest.mark.slow

TRUCK = PROBLEM["fleet"][0]
SITES = PROBLEM | {
    "customers": PROBLEM["customers"][:3],
    "launch_sites": [{"id": "pier", "location": [11.54, 48.1]}],
    "fleet": [TRUCK | {"revisits": True}]}

SECOND_LAUNCH, SECOND_RECOVERY = step_of("launch", "B"), step_of("recover", "B")


def flight(customer: str, launch: int, recovery: int, takes_off: float, back: float) -> Data:
    """Return a flight to a customer."""
    return {"drone": "truck-1/drone-1", "launch_stop": launch, "recovery_stop": recovery,
            "launch_time": takes_off, "recovery_time": back, "customers": [
                {"id": customer, "arrival": takes_off + 30, "service_start": takes_off + 30,
                 "departure": takes_off + 90}]}


SITES_PLAN: Data = {"routes": [{"vehicle": "truck-1", "type": "truck", "trips": [{
    "stops": [stop("depot", "hub", 30_000, 30_000), stop("customer", "A", 30_100, 30_160),
              stop("launch_site", "pier", 30_300, 30_360),
              stop("launch_site", "A", 30_460, 30_560), stop("depot", "hub", 30_900, 30_950)],
    "sorties": [flight("C", 2, 3, 30_350, 30_500), flight("B", 3, 4, 30_560, 30_950)]}]}]}
"""From the pier to C and on to A, where the truck has been before, and from there to B."""


def test_driver_is_told_where_drones_leave_and_come_back(client: httpx.Client) -> None:
    (link,) = dispatched(client, problem=SITES, plan=SITES_PLAN)["links"]
    day = client.get("/drive/day", headers=holding(token_of(link))).json()
    assert [(step["id"], step["place"], step["place_kind"]) for step in day["steps"]] == [
        (DEPART, "hub", "depot"), (FIRST, "A", "customer"), (LAUNCH, "pier", "launch_site"),
        (RECOVER, "A", "launch_site"), (SECOND_LAUNCH, "A", "launch_site"),
        (RETURN, "hub", "depot"), (SECOND_RECOVERY, "hub", "depot")]
    assert [step["location"]["longitude"] for step in day["steps"][1:5]] == [
        11.51, 11.54, 11.51, 11.51]
    files = files_of(client.get("/drive/flights?format=geojson",
                                headers=holding(token_of(link))))
    assert [json.loads(content)["features"][0]["properties"]["customers"]
            for content in files.values()] == [["C"], ["B"]]


def test_driver_confirms_flights_from_launch_sites(client: httpx.Client) -> None:
    (link,) = dispatched(client, problem=SITES, plan=SITES_PLAN)["links"]
    reply = client.post("/drive/events", headers=holding(token_of(link)), json={
        "now": "2026-11-23T09:00:00Z", "events": [
            event("1", LAUNCH, "2026-11-23T08:25:50Z"),
            event("2", SECOND_LAUNCH, "2026-11-23T08:29:10Z", "failed", reason="Wind")]})
    assert [(step["id"], step["place"], step["state"]) for step in reply.json()["standing"]] == [
        (LAUNCH, "C", "done"), (SECOND_LAUNCH, "B", "failed")]


@pytest.mark.parametrize("name", ["quay", "E"])
def test_launch_site_that_is_none_is_refused(client: httpx.Client, name: str) -> None:
    plan = json.loads(json.dumps(SITES_PLAN).replace('"pier"', f'"{name}"'))
    reply = client.post("/dispatches", json={"problem": SITES, "plan": plan})
    assert reply.status_code == 422, reply.text


def gone_on(told: dict[str, ToldStep], now: float) -> GoingOnReply:
    """Return how to plan on, by what the driver told."""
    request = DispatchRequest.model_validate({"problem": SITES, "plan": SITES_PLAN}, strict=False)
    (route,) = request.plan.routes
    steps = StepMaker(request.problem).steps(route)
    return going_on(request.plan, {"truck-1": OnTheRoad(steps, told)}, now).reply


def stops_of(reply: GoingOnReply) -> list[tuple[str, str]]:
    """Return the kinds and names of the truck's stops to go on from."""
    return [(stop["kind"], stop["id"])
            for stop in reply.replan["plan"]["routes"][0]["trips"][0]["stops"]]


def test_launch_that_was_told_times_its_stop() -> None:
    reply = gone_on({DEPART: ToldStep("done", 30_000), LAUNCH: ToldStep("done", 30_500)}, 30_600)
    trip = reply.replan["plan"]["routes"][0]["trips"][0]
    assert trip["stops"][2]["departure"] == trip["sorties"][0]["launch_time"] == 30_500
    assert trip["stops"][3]["arrival"] == 30_600


def test_nobody_stops_where_nothing_was_launched() -> None:
    reply = gone_on({FIRST: ToldStep("done", 30_160), LAUNCH: ToldStep("failed", 30_350, "Wind"),
                     SECOND_LAUNCH: ToldStep("failed", 30_400, "Wind")}, 30_500)
    assert stops_of(reply) == [("depot", "hub"), ("customer", "A"), ("depot", "hub")]
    assert [(failed.customer, failed.is_open) for failed in reply.failed] == [
        ("C", True), ("B", True)]
    reply = gone_on({LAUNCH: ToldStep("failed", 30_350, "Wind")}, 30_400)
    assert ("launch_site", "pier") not in stops_of(reply)
    assert ("launch_site", "A") in stops_of(reply)


def test_stop_that_the_truck_comes_back_to_stays_though_nobody_was_served() -> None:
    reply = gone_on({FIRST: ToldStep("failed", 30_160, "Shut")}, 30_200)
    assert ("customer", "A") in stops_of(reply)
    assert [(failed.customer, failed.is_open) for failed in reply.failed] == [("A", False)]


def test_truck_goes_home_from_where_its_only_launch_failed(client: httpx.Client) -> None:
    problem = SITES | {"customers": [PROBLEM["customers"][2]]}
    plan = {"routes": [SITES_PLAN["routes"][0] | {"trips": [{
        "stops": [stop("depot", "hub", 30_000, 30_000), stop("launch_site", "pier", 30_300, 30_450),
                  stop("depot", "hub", 30_900, 30_900)],
        "sorties": [flight("C", 1, 1, 30_340, 30_450)]}]}]}
    request = DispatchRequest.model_validate({"problem": problem, "plan": plan}, strict=False)
    (route,) = request.plan.routes
    told = {DEPART: ToldStep("done", 30_000), LAUNCH: ToldStep("failed", 30_340, "Wind")}
    reply = going_on(request.plan, {"truck-1": OnTheRoad(
        StepMaker(request.problem).steps(route), told)}, 30_400).reply
    assert stops_of(reply) == [("depot", "hub"), ("launch_site", "pier"), ("depot", "hub")]
    again = client.post("/plan", json=problem | {"replan": reply.replan})
    assert again.status_code == 200, again.text


DONE = {step: ToldStep("done", time) for step, time in (
    (DEPART, 30_010.0), (FIRST, 30_180.0), (LAUNCH, 30_400.0), (RECOVER, 30_700.0),
    (SECOND_LAUNCH, 30_760.0), (SECOND_RECOVERY, 31_000.0), (RETURN, 31_000.0))}


@pytest.mark.thorough_after(8)
@pytest.mark.parametrize("told", [
    *(dict(list(DONE.items())[:count]) for count in range(1, len(DONE) + 1)),
    {LAUNCH: ToldStep("failed", 30_350, "Wind")},
    {DEPART: DONE[DEPART], LAUNCH: ToldStep("failed", 30_350, "Wind"),
     SECOND_LAUNCH: ToldStep("failed", 30_400, "Wind")},
    {FIRST: ToldStep("failed", 30_160, "Shut"), LAUNCH: ToldStep("failed", 30_161, "Wind"),
     SECOND_LAUNCH: ToldStep("failed", 30_161, "Wind")},
    {FIRST: ToldStep("failed", 30_160, "Shut"), LAUNCH: DONE[LAUNCH]},
])
@pytest.mark.parametrize("now", [30_050, 30_330, 30_500, 40_000])
def test_whatever_was_told_can_be_planned_on_from(client: httpx.Client, told: dict[str, ToldStep],
                                                  now: float) -> None:
    reply = gone_on(told, now)
    problem = SITES | {"replan": reply.replan}
    again = client.post("/plan", json=problem | {"options": {"search_iterations": 0}})
    assert again.status_code == 200, again.text
    checked = client.post("/check", json={"problem": problem, "plan": again.json()})
    codes = {violation["code"] for violation in checked.json()["violations"]}
    assert not codes & {"FROZEN", "PAST", "ABOARD", "STRUCTURE"}, checked.json()["violations"]


def test_driver_is_told_what_of_a_shipment_is_taken_in_and_handed_over() -> None:
    places = {name: {"location": [11.51, 48.1]} for name in ("mill", "farm", "shop")}
    problem = PROBLEM | {"customers": PROBLEM["customers"][:1], "shipments": [{
        "id": "s", "delivery": places["shop"],
        "pickups": [places[name] | {"id": name, "amount": [amount]}
                    for name, amount in (("mill", 1), ("farm", 2))]}]}
    stops = [stop("depot", "hub", 30_000, 30_000), stop("customer", "A", 30_100, 30_160),
             stop("pickup", "s", 30_200, 30_200) | {"part": "mill"},
             stop("pickup", "s", 30_300, 30_300) | {"part": "farm"},
             stop("delivery", "s", 30_400, 30_400), stop("depot", "hub", 30_500, 30_500)]
    (route,) = PlanInput.model_validate_json(json.dumps({"routes": [{
        "vehicle": "truck-1", "type": "truck", "trips": [{"stops": stops, "sorties": []}]}],
        "unassigned": []})).routes
    depart, *served, _ = StepMaker(read_request(json.dumps(problem).encode(), None)).steps(route)
    assert depart.load == [2]
    assert [(each.id, each.hand_over, each.take_in)
            for step in served for each in step.customers] == [
        ("A", [2], None), ("s/pickup/mill", [0], [1]), ("s/pickup/farm", [0], [2]),
        ("s/delivery", [3], None)]
