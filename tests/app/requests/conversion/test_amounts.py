"""Amounts are counted exactly: as finely as they are stated, or they are refused."""

import json
from typing import Any

import pytest

from app.plans.checking import answer_check
from app.plans.replies import plan_reply
from app.plans.service import plan_options
from app.plans.task import task_of
from app.requests.bounds import UNBOUNDED
from app.requests.conversion.problem import to_problem
from app.requests.reading import read_request
from app.schemas.errors import InvalidRequestError
from app.schemas.request import PlanRequest
from tests.app.conftest import FirstFitPlanner

Data = dict[str, Any]


def request_of(demands: list[list[float]], capacity: list[float], **fleet: Any) -> Data:
    """Return a request for one truck and customers along a street."""
    return {
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": str(index), "location": [index, 0], "demand": demand}
                      for index, demand in enumerate(demands, start=1)],
        "fleet": [{"id": "truck", "count": 1, "capacity": capacity, **fleet}],
    }


def read(request: Data) -> PlanRequest:
    return read_request(json.dumps(request).encode(), None)


def planned(request: Data) -> Data:
    """Return the reply to a request, by a planner that serves whom it can in order."""
    valid = read(request)
    options = plan_options(valid.options)
    problem = to_problem(valid)
    return plan_reply(problem, options, FirstFitPlanner().plan(problem, options))


def errors_of(request: Data) -> list[tuple[str, str, str]]:
    with pytest.raises(InvalidRequestError) as refused:
        read(request)
    return [(error.code, error.path, error.message) for error in refused.value.errors]


def test_what_is_finer_than_thousandths_adds_up_exactly() -> None:
    reply = planned(request_of([[0.0004]] * 100, [0.001]))
    assert reply["summary"]["served"] == 2
    (trip,) = reply["routes"][0]["trips"]
    assert [stop["load"] for stop in trip["stops"]] == [[0.0008], [0.0004], [0.0], [0.0]]
    assert trip["load"] == [0.0008]
    assert trip["load_rate"] == 0.8
    (reason,) = planned(request_of([[0.0004]], [0.0003]))["unassigned"][0]["reasons"]
    assert reason["message"] == "Its demand of 0.0004 exceeds the capacity of 0.0003."
    assert "0.0004" in reason["remedy"]


def test_each_dimension_is_counted_by_itself() -> None:
    problem = to_problem(read(request_of([[0.00012, 1e8], [0.5, 3]], [2, 1e9])))
    assert problem.amount_decimals == (5, 3)
    assert [customer.demand for customer in problem.customers] == [(12, 10**11), (50_000, 3000)]
    assert problem.vehicle_types[0].capacity == (200_000, 10**12)


def test_payloads_of_drones_are_counted_as_finely() -> None:
    drones = {"count": 1, "capacity": [0.00035]}
    request = request_of([[0.0004], [0.0003]], [1], drones=drones)
    for customer in request["customers"]:
        customer["served_by"] = "drone"
    reply = planned(request)
    assert [left["id"] for left in reply["unassigned"]] == ["1"]
    problem = to_problem(read(request))
    assert problem.vehicle_types[0].drones is not None
    assert problem.vehicle_types[0].drones.capacity == (35,)


def test_usual_amounts_are_thousandths_and_noise_of_floats_is_none() -> None:
    noisy = [0.1 + 0.2, sum([0.1] * 10), 1.1 * 3, 4.35 * 100, 1e6 * 0.1, sum([0.001] * 1000), 1e9]
    problem = to_problem(read(request_of([[amount] for amount in noisy], [1e9])))
    assert problem.amount_decimals == (3,)
    assert [customer.demand[0] for customer in problem.customers] == [
        300, 1000, 3300, 435_000, 10**8, 1000, 10**12]


def test_what_cannot_be_held_is_refused_with_the_finest_step() -> None:
    thirds = request_of([[1 / 3], [0.25]], [2.0])
    ((code, path, message),) = errors_of(thirds)
    assert (code, path) == ("TOO_FINE", "$.customers[0].demand[0]")
    assert "steps of 1e-09" in message
    assert "0.3333333333333333" in message
    beside = request_of([[0.0004]], [1e9], drones={"count": 1, "capacity": [0.0001]})
    found = errors_of(beside)
    assert [(code, path) for code, path, _ in found] == [
        ("TOO_FINE", "$.fleet[0].drones.capacity[0]"), ("TOO_FINE", "$.customers[0].demand[0]")]
    assert "Beside an amount of 1e+09, amounts are counted in steps of 0.001" in found[1][2]
    assert errors_of(request_of([[1e-12]], [1]))[0][0] == "TOO_FINE"
    assert errors_of(request_of([[66.66666666666667]], [200]))[0][0] == "TOO_FINE"


def test_replies_and_judgements_tell_amounts_as_they_were_sent() -> None:
    request = request_of([[0.1234567, 3.3], [0.0000003, 0.1]], [0.123457, 3.4])
    reply = planned(request)
    assert reply["routes"][0]["trips"][0]["load"] == [0.123457, 3.4]
    judged = json.loads(answer_check(
        json.dumps({"problem": request, "plan": reply}).encode(), UNBOUNDED))
    assert judged["feasible"]
    request["fleet"][0]["capacity"] = [0.1234569, 3.4]
    judged = json.loads(answer_check(
        json.dumps({"problem": request, "plan": reply}).encode(), UNBOUNDED))
    assert [violation["message"] for violation in judged["violations"]] == [
        "load 0.123457, 3.4 exceeds 0.1234569, 3.4"]


def test_a_plan_that_goes_on_is_counted_as_finely() -> None:
    request = request_of([[0.0004]] * 3, [0.001])
    reply = planned(request)
    plan = {key: reply[key] for key in ("routes", "unassigned")}
    task = task_of(read({**request, "replan": {"plan": plan, "freeze_before": 0}}))
    assert task.problem.amount_decimals == (4,)
    assert task.replanning is not None
