"""A plan on the wire reads back as the plan it was."""

import json
from typing import Any

import pytest

from app.plans.replies import plan_reply
from app.plans.service import plan_options
from app.requests.conversion.problem import to_problem
from app.requests.plan_reading import plan_to_solution
from app.requests.reading import read_request
from app.schemas.errors import InvalidRequestError, NotJsonError
from model.planner import Planner
from model.problem import Problem
from model.solution import Solution

Request = dict[str, Any]


def _planned(planner: Planner, request: Request) -> tuple[Problem, Solution, Any]:
    parsed = read_request(json.dumps(request).encode(), planner.policies)
    problem = to_problem(parsed)
    options = plan_options(parsed.options)
    result = planner.plan(problem, options)
    return problem, result.solution, plan_reply(problem, options, result)


def test_plan_survives_the_wire(planner: Planner, with_drones: Request) -> None:
    with_drones["customers"].append({"id": "E", "location": [1, 1], "demand": [99]})
    problem, solution, reply = _planned(planner, with_drones)
    assert len(solution.unassigned) == 1
    assert any(trip.sorties for route in solution.routes for trip in route.trips)
    assert plan_to_solution(json.dumps(reply).encode(), problem) == solution


def test_loads_leave_the_truck_where_they_are_served_or_launched(
        planner: Planner, smallest: Request) -> None:
    smallest["customers"].append({"id": "C", "location": [1, 1], "demand": [2.5],
                                  "served_by": "drone"})
    smallest["fleet"][0]["drones"] = {"count": 1, "capacity": [3]}
    _, _, reply = _planned(planner, smallest)
    (trip,) = reply["routes"][0]["trips"]
    assert trip["load"] == [17.5]
    assert trip["load_rate"] == 0.875
    assert [stop["load"] for stop in trip["stops"]] == [[15.0], [5.0], [0.0], [0.0]]
    assert [stop["kind"] for stop in trip["stops"]] == ["depot", "customer", "customer", "depot"]
    # 5 km to A, 5 km on to B, 6 km back; C is sqrt(2) km away.
    assert trip["distance"] == 16_000
    assert trip["sorties"][0]["distance"] == 2 * 1414.214
    assert reply["summary"] == {
        "customers": 3, "served": 3, "vehicles": 1, "trips": 1, "sorties": 1,
        "distance": 16_000, "drone_distance": 2 * 1414.214, "energy_wh": None,
        "must_unserved": 0, "vehicles_lacking": 0, "co2_kg": None,
        "load_rate": {"min": 0.875, "mean": 0.875, "max": 0.875},
        "makespan": trip["stops"][-1]["departure"]}
    assert reply["cost"]["total"] == pytest.approx(16 + 0.25 * 2.828428)


def test_working_rate_is_the_share_of_the_longest(planner: Planner, smallest: Request) -> None:
    assert _planned(planner, smallest)[2]["routes"][0]["working_rate"] is None
    smallest["fleet"][0]["max_working_duration"] = 14_400
    # 16 km at 40 km/h take 1440 s.
    assert _planned(planner, smallest)[2]["routes"][0]["working_rate"] == 0.1


@pytest.mark.parametrize(("old", "new", "code", "path"), [
    ('"A"', '"Z"', "UNKNOWN_CUSTOMER", "$.routes[0].trips[0].stops[1].id"),
    ('"hub"', '"moon"', "UNKNOWN_DEPOT", "$.routes[0].trips[0].stops[0].id"),
    ('"type": "truck"', '"type": "boat"', "UNKNOWN_VEHICLE_TYPE", "$.routes[0].type"),
    ('"truck-1"', '"truck-0"', "WRONG_NAME", "$.routes[0].vehicle"),
    ('"departure": 450.0', '"departure": "450"', "WRONG_TYPE",
     "$.routes[0].trips[0].stops[1].departure"),
])
def test_unknown_names_are_refused(planner: Planner, smallest: Request, old: str, new: str,
                                   code: str, path: str) -> None:
    problem, _, reply = _planned(planner, smallest)
    text = json.dumps(reply)
    assert old in text
    with pytest.raises(InvalidRequestError) as caught:
        plan_to_solution(text.replace(old, new).encode(), problem)
    assert (code, path) in [(error.code, error.path) for error in caught.value.errors]


def test_what_is_not_json_is_refused(planner: Planner, smallest: Request) -> None:
    with pytest.raises(NotJsonError):
        plan_to_solution(b"{", _planned(planner, smallest)[0])


@pytest.mark.parametrize("off", [0.0, 0.0004, -0.0004])
@pytest.mark.parametrize(("begins", "ends", "place"), [
    (0, 60, "departure"), (100, 160, "way"), (450, 510, "arrival")])
def test_where_a_break_lies_is_told_by_milliseconds(
        planner: Planner, smallest: Request, off: float, begins: int, ends: int,
        place: str) -> None:
    smallest["fleet"][0]["breaks"] = [
        {"id": "lunch", "duration": 60, "start": {"earliest": 0, "latest": 700},
         "at": "anywhere"}]
    problem = to_problem(read_request(json.dumps(smallest).encode(), planner.policies))
    times = [("depot", "hub", 0, 0), ("break", "lunch", begins + off, ends - off),
             ("customer", "A", 510, 510), ("depot", "hub", 960, 960)]
    trip = {"sorties": [], "stops": [
        {"kind": kind, "id": name, "arrival": arrival, "service_start": arrival,
         "departure": departure} for kind, name, arrival, departure in times]}
    plan = {"routes": [{"vehicle": "truck-1", "type": "truck", "trips": [trip]}]}
    (route,) = plan_to_solution(json.dumps(plan).encode(), problem).routes
    assert [taken.place for taken in route.trips[0].breaks] == [place]
