"""Tests of packed problems."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import FAR, pack
from model.engine.type_rows import NO_PROFILE
from model.problem import UNLIMITED, Problem, Shipment, Travel
from model.problem.quantities import MAX_QUANTITY
from model.problem.shipment import MOST_DETOUR
from tests.model.rollouts import random_problems


def test_packing_nothing_is_an_error() -> None:
    with pytest.raises(ValueError, match="problems"):
        pack([])


def test_a_row_holds_the_same_numbers_whatever_is_packed_with_it() -> None:
    problems = random_problems(seed=51, count=40)
    together = pack(problems)
    for row, problem in enumerate(problems):
        alone = pack([problem])
        for name in vars(alone):
            one, padded = getattr(alone, name)[0], getattr(together, name)[row]
            inside = tuple(slice(length) for length in one.shape)
            np.testing.assert_array_equal(padded[inside], one, err_msg=name)


def test_columns_state_limits_windows_and_demands(tiny_problem, customers, truck, drones) -> None:
    soft = replace(customers[0], latest=5, late_cost_per_hour=2.0)
    problem = tiny_problem(soft, customers[1], truck=truck,
                           more_types=(replace(truck, max_working_duration=7, drones=drones),))
    instance = pack([problem])
    assert instance.size.tolist() == [(1, 2, 2, 1)]
    assert instance.node[0, 0, 1:, 0]["window_latest"].tolist() == [5, UNLIMITED]
    assert instance.node[0, 0, 1:, 0]["arrival_limit"].tolist() == [FAR, UNLIMITED]
    assert instance.node[0, 0, 1:, 0]["demand"][:, 0].tolist() == [1000, 1000]
    assert instance.price[0, 1].tolist() == (2.0, 0.0, 0.0)
    assert instance.type[0]["max_working_duration"].tolist() == [UNLIMITED, 7]
    assert instance.type[0]["capacity"][:, 0].tolist() == [10_000, 10_000]
    assert instance.type[0]["drones"].tolist() == [0, 1]
    assert (instance.type[0]["speed_changes"] == NO_PROFILE).all()


def test_leaving_out_costs_so_much_and_some_customers_more(tiny_problem, customers, truck) -> None:
    a, b, c, d = customers
    problem = tiny_problem(replace(a, unassigned_cost=25.0), replace(b, unassigned_cost=3.0), c, d,
                           truck=truck, unassigned_cost=10.0)
    instance = pack([problem, tiny_problem(a, b, truck=truck, unassigned_cost=10.0)])
    assert instance.unassigned_cost.tolist() == [3.0, 10.0]
    assert instance.unassigned_more.tolist() == [[0.0, 22.0, 0.0, 7.0, 7.0], [0.0] * 5]


def compatible(problem: Problem) -> tuple[list[bool], list[bool]]:
    """Return whom the first type may serve, by truck and by drone."""
    instance = pack([problem])
    return instance.can_drive[0, 0].tolist(), instance.can_fly[0, 0].tolist()


def test_kind_skills_capacity_and_payload_decide_who_may_serve_whom(
        tiny_problem, customers, truck, drones) -> None:
    a, b, c, d = customers
    customers = (replace(a, served_by="drone"), replace(b, served_by="truck"),
                 replace(c, skills=frozenset({"cold"})), replace(d, demand=(6000,)))
    by_truck, by_drone = compatible(tiny_problem(*customers, truck=replace(truck, drones=drones)))
    assert by_truck == [False, False, True, False, True]
    assert by_drone == [False, True, False, False, False]
    skilled = replace(truck, skills=frozenset({"cold", "lift"}), capacity=(5000,), drones=drones)
    by_truck, by_drone = compatible(tiny_problem(*customers, truck=skilled))
    assert by_truck == [False, False, True, True, False]
    assert by_drone == [False, True, False, True, False]
    assert not any(compatible(tiny_problem(*customers, truck=truck))[1])


def test_the_table_decides_who_may_serve_whom(tiny_problem, customers, truck, drones) -> None:
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones), more_types=(truck,))
    table = np.array([[True, False, True, False], [False, True, True, False]])
    instance = pack([replace(problem, may_serve=table)])
    assert instance.can_drive[0, :, 1:].tolist() == table.tolist()
    assert instance.can_fly[0, :, 1:].tolist() == [table[0].tolist(), [False] * 4]
def test_neighbours_are_the_nearest_other_customers_in_order(tiny_problem, customers,
                                                             truck) -> None:
    problem = tiny_problem(*customers, truck=truck, places=(0.0, 1.0, 2.5, 4.0, 8.0))
    neighbour = pack([problem]).neighbour[0]
    assert neighbour[0, :4].tolist() == [1, 2, 3, -1]
    assert neighbour[4, :4].tolist() == [3, 2, 1, -1]
    assert sorted(neighbour[2, :2].tolist()) == [1, 3]
    assert neighbour[1, 0] == 2


def test_a_single_customer_has_no_neighbour(tiny_problem, customers, truck) -> None:
    assert (pack([tiny_problem(customers[0], truck=truck)]).neighbour == -1).all()


def test_a_problem_without_customers_is_packed() -> None:
    problem, = random_problems(seed=3, count=1)
    nodes = slice(problem.num_depots)
    travel = tuple(replace(each, duration=each.duration[nodes, nodes],
                           distance=each.distance[nodes, nodes]) for each in problem.travel)
    empty = replace(problem, customers=(), travel=travel, may_serve=None,
                    coordinates=problem.coordinates[nodes])
    assert pack([empty]).can_drive.shape == (1, len(empty.vehicle_types), empty.num_nodes)


def test_a_detour_without_end_is_no_limit(tiny_problem, customers, truck) -> None:
    ends = [replace(customer, demand=(0,)) for customer in customers[:2]]
    problem = tiny_problem(*ends, truck=truck)
    legs = np.full((3, 3), MAX_QUANTITY) * ~np.eye(3, dtype=bool)
    travel = Travel(legs, legs)
    shipment = Shipment("s", 1, 2, (0,), max_detour=MOST_DETOUR)
    instance = pack([replace(problem, travel=(travel,), shipments=(shipment,))])
    assert instance.max_between[0, 0].tolist() == [FAR, FAR, FAR]
