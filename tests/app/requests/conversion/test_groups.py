"""Vehicles that customers name become groups, as few as need be."""

import json
from typing import Any

import pytest

from app.requests.conversion.problem import to_problem
from app.requests.reading import read_request
from model.problem import Problem

Request = dict[str, Any]


@pytest.fixture
def request_of() -> Request:
    return {
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": name, "location": [1, 1], "demand": [1]} for name in "ABC"],
        "fleet": [{"id": "truck", "count": 6, "capacity": [9]},
                  {"id": "van", "count": 2, "capacity": [9]}]}


def problem_of(request: Request, *vehicles: Any) -> Problem:
    customers = [customer | {"vehicles": stated} for customer, stated
                 in zip(request["customers"], vehicles, strict=True)]
    body = json.dumps(request | {"customers": customers}).encode()
    return to_problem(read_request(body, policies=None))


def test_types_alone_need_no_groups(request_of: Request) -> None:
    problem = problem_of(request_of, {"allowed": ["van"]}, {"forbidden": ["van"]}, None)
    assert [(kind.id, kind.count, kind.numbers) for kind in problem.vehicle_types] == [
        ("truck", 6, ()), ("van", 2, ())]
    assert problem.may_serve is not None
    assert problem.may_serve.tolist() == [[False, True, True], [True, False, True]]
    either: tuple[Any, ...] = (None, {})
    for nothing in either:
        assert problem_of(request_of, nothing, None, None).may_serve is None


def test_vehicles_are_told_apart_only_by_whom_they_serve(request_of: Request) -> None:
    problem = problem_of(request_of, {"allowed": ["truck-2", "truck-5", "van"]},
                         {"forbidden": ["truck-4", "truck-6"]},
                         {"allowed": ["truck", "truck-1", "van-1"]})
    assert problem.may_serve is not None
    found = [(kind.id, kind.numbers, row) for kind, row
             in zip(problem.vehicle_types, problem.may_serve.tolist(), strict=True)]
    assert found == [
        ("truck", (0, 2), [False, True, True]),
        ("truck-2, truck-5", (1, 4), [True, True, True]),
        ("truck-4, truck-6", (3, 5), [False, False, True]),
        ("van", (1,), [True, True, False]),
        ("van-1", (0,), [True, True, True])]
    truck = problem.vehicle_types[1]
    assert (truck.type_id, truck.count, truck.vehicle_name(1)) == ("truck", 2, "truck-5")
    assert problem.find_vehicle("truck", 4) == (1, 1)
    assert problem.find_vehicle("van", 7) == (3, 7)
    assert problem.vehicle_types[0].capacity == truck.capacity


def test_where_all_are_named_there_is_no_rest(request_of: Request) -> None:
    problem = problem_of(request_of, {"allowed": ["van-2", "van-1"]}, {"forbidden": ["truck-1"]},
                         None)
    assert [(kind.id, kind.numbers) for kind in problem.vehicle_types] == [
        ("truck", (1, 2, 3, 4, 5)), ("truck-1", (0,)), ("van-1, van-2", (0, 1))]


def test_a_name_of_a_type_and_of_a_vehicle_means_the_type(request_of: Request) -> None:
    request_of["fleet"][1]["id"] = "truck-2"
    problem = problem_of(request_of, {"allowed": ["truck-2"]}, None, None)
    assert problem.may_serve is not None
    assert problem.may_serve.tolist() == [[False, True, True], [True, True, True]]


def test_customers_tell_vehicles_apart_by_what_they_cost(request_of: Request) -> None:
    a, b, c = request_of["customers"]
    a["vehicle_costs"] = {"truck": 5, "truck-1": 0, "van": 3}
    b["vehicle_costs"] = {"truck-2": 4, "truck-1": 0}
    c["vehicles"] = {"forbidden": ["truck-2"]}
    problem = to_problem(read_request(json.dumps(request_of).encode(), policies=None))
    assert problem.vehicle_costs is not None
    assert problem.may_serve is not None
    assert [(kind.id, kind.numbers) for kind in problem.vehicle_types] == [
        ("truck", (2, 3, 4, 5)), ("truck-1", (0,)), ("truck-2", (1,)), ("van", ())]
    assert problem.vehicle_costs.tolist() == [[5, 0, 0], [0, 0, 0], [5, 4, 0], [3, 0, 0]]
    assert problem.may_serve[:, 2].tolist() == [True, True, False, True]
