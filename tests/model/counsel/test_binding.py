from dataclasses import replace

import numpy as np
import pytest

from model.counsel.alternatives import find_alternatives
from model.counsel.bench import Bench
from model.counsel.binding import find_binding
from model.judge.breaks import BreakDecision
from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision
from model.problem import (
    MAX_QUANTITY, MICROJOULES_PER_WH, Break, DrivingRules, Energy, Fairness, IncompatibleGoods,
    Overtime, Shipment,
)
from model.solution import Solution, Trip
from tests.model.counsel.test_alternatives import A, B, C, D, MINUTE, greedy, plan, route
from tests.model.tiny import draw_tiny, with_duty
from tests.seeds import seeds


def binding(problem, solution, node):
    bench = Bench(problem, solution, node)
    found, is_complete = find_binding(bench, find_alternatives(bench))
    assert is_complete
    return {each.limit.field: (each.limit.slack, each.saves_per_unit) for each in found}


def test_minute_of_a_window_saves_what_waiting_costs(tiny_problem, customers, truck):
    a, b, c, d = customers
    problem = tiny_problem(replace(a, latest=2 * MINUTE), replace(b, earliest=30 * MINUTE), c, d,
                           truck=replace(truck, count=1, cost_per_hour=60.0))
    # a has to be reached at 2, so that the truck waits for b from 9 to 30.
    solution = plan(problem, route(A, B, C, D, start=0))
    assert binding(problem, solution, B) == {"time_window.earliest": (0.0, pytest.approx(1.0))}
    assert binding(problem, solution, A)["time_window.latest"] == (0.0, pytest.approx(1.0))


def test_unit_of_capacity_saves_a_trip_of_his_own(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=replace(truck, capacity=(3000,), cost_per_km=1.0))
    solution = plan(problem, route(A, B, C), route(D, vehicle=1))
    # With one more, a rides to d for nothing, and so did b; the other way round, d adds 2 km.
    assert binding(problem, solution, A) == {"capacity": (0.0, 0.0)}
    assert binding(problem, solution, D) == {"capacity": (2.0, pytest.approx(6.0))}


def test_minute_of_the_shift_or_of_work_lets_others_stay_at_home(tiny_problem, customers, truck):
    limits = replace(truck, latest=35 * MINUTE, cost_per_km=1.0)
    problem = tiny_problem(*customers, truck=limits)
    solution = plan(problem, route(A, B, C), route(D, vehicle=1))
    # All four take 36 minutes.
    assert binding(problem, solution, D)["shift.latest"] == (14.0, pytest.approx(6.0))
    problem = tiny_problem(*customers, truck=replace(limits, latest=10**9,
                                                     max_working_duration=35 * MINUTE))
    assert binding(problem, solution, D)["max_working_duration"] == (14.0, pytest.approx(6.0))


def test_setup_counts_before_a_window_though_the_plan_does_not_state_it(tiny_problem, customers,
                                                                         truck):
    a, b, c, d = customers
    problem = tiny_problem(replace(a, setup_duration=2 * MINUTE, latest=4 * MINUTE), b, c, d,
                           truck=truck)
    timed, = plan(problem, route(A, start=0)).routes
    stops = tuple(replace(stop, setup=0) for stop in timed.trips[0].stops)
    stated = Solution((replace(timed, trips=(Trip(stops),)),), (B, C, D))
    assert binding(problem, stated, A) == {"time_window.latest": (0.0, 0.0)}


def test_minute_aboard_saves_what_it_costs_to_come_sooner(tiny_problem, customers, truck):
    a, b, c, d = customers
    problem = tiny_problem(a, b, c, replace(d, max_time_aboard=17 * MINUTE),
                           truck=replace(truck, cost_per_km=1.0))
    solution = plan(problem, route(A, B, C), route(D, vehicle=1))
    # Behind a and b, and before c, d is served after 18 minutes; before b, it is a detour of 2 km.
    assert binding(problem, solution, D)["max_time_aboard"] == (9.0, pytest.approx(2.0))


def test_minute_of_overtime_or_a_stop_more_lets_others_stay_at_home(tiny_problem, customers,
                                                                    truck):
    tired = replace(truck, latest=30 * MINUTE, cost_per_km=1.0, overtime=Overtime(0.0, 5 * MINUTE))
    solution = plan(tiny_problem(*customers, truck=tired), route(A, B, C), route(D, vehicle=1))
    found = binding(tiny_problem(*customers, truck=tired), solution, D)
    assert found["overtime.max_duration"] == (5.0, pytest.approx(6.0))
    few = tiny_problem(*customers, truck=replace(truck, cost_per_km=1.0, max_stops=3))
    assert binding(few, solution, D)["max_stops"] == (2.0, pytest.approx(6.0))


def test_minute_of_endurance_lets_a_drone_go(tiny_problem, customers, truck, drones):
    carrier = replace(truck, count=1, cost_per_km=1.0, drones=replace(drones, endurance=6 * MINUTE))
    problem = tiny_problem(*customers, truck=carrier)
    # From c to d and back: one minute each way and five of service.
    solution = plan(problem, route(A, B, C, D))
    assert binding(problem, solution, D)["drones.endurance"] == (None, pytest.approx(2.0))


def test_battery_more_lets_a_drone_go(tiny_problem, customers, truck, drones):
    carrier = replace(truck, count=1, cost_per_km=1.0, drones=replace(drones, batteries=0))
    problem = tiny_problem(*customers, truck=carrier)
    solution = plan(problem, route(A, B, C, D))
    found = binding(problem, solution, D)
    assert found["drones.turnaround.batteries"] == (0.0, pytest.approx(2.0))


@pytest.mark.parametrize("stock", ["batteries", "chargers"])
def test_battery_or_charger_more_at_a_hub_lets_a_vehicle_fly_again(tiny_problem, customers, truck,
                                                                   stock):
    # What it has left isn't enough for another trip.
    charge, available = (10**6, 15 * 10**8) if stock == "chargers" else (0, 10**12)
    watts = (1000, 1000)
    energy = Energy(available, 0.5, (0, 1000), watts, watts, watts, watts, charge=charge)
    flying = replace(truck, count=1, capacity=(3000,), max_trips=9, flies=True, energy=energy)
    problem = tiny_problem(*customers, truck=flying)
    hub = replace(problem.depots[0], **{stock: 1 if stock == "batteries" else 0})
    problem = replace(problem, depots=(hub,))
    solution = replace(plan(problem, route(A, B, C)), unassigned=(D,))
    found = binding(problem, solution, D)
    assert found[f"depot.{stock}"][1] >= 1000
    assert binding(problem, solution, A).keys().isdisjoint({"depot.batteries", "depot.chargers"})


def test_watt_hour_lets_a_drone_go(tiny_problem, customers, truck, drones):
    watts = (30_000, 30_000)
    # A minute there and one back: a watt-hour.
    energy = Energy(MICROJOULES_PER_WH // 2, 0.5, (0, 1000), watts, watts, watts, watts)
    carrier = replace(truck, count=1, cost_per_km=1.0, drones=replace(drones, energy=energy))
    problem = tiny_problem(*customers, truck=carrier)
    solution = plan(problem, route(A, B, C, D))
    assert binding(problem, solution, D)["drones.energy.battery_wh"] == (None, pytest.approx(2.0))


def test_customer_left_out_is_told_what_would_let_him_in(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=replace(truck, count=1, capacity=(3000,)))
    solution = plan(problem, route(A, B, C), unassigned=(D,))
    found = binding(problem, solution, D)
    assert found["capacity"] == (None, pytest.approx(1000.0))
    assert found["count"] == found["max_trips"] == (0.0, pytest.approx(1000.0))


@pytest.mark.parametrize("seed", seeds(15))
def test_what_is_saved_is_saved_by_a_plan_that_the_judge_accepts(seed):
    rng = np.random.default_rng(seed)
    problem = with_duty(rng, draw_tiny(rng))
    solution = greedy(problem)
    for node in range(problem.num_depots, problem.num_nodes):
        bench = Bench(problem, solution, node)
        found, _ = find_binding(bench, find_alternatives(bench))
        for each in found:
            slack = each.limit.slack
            assert each.saves_per_unit > 0 or (slack is not None and slack <= 0)
            # More of anything leaves a legal plan legal, and as cheap at most.
            relaxed = check(each.limit.problem, solution)
            assert {item.code for item in relaxed.violations} <= {"TIME_MISMATCH"}


def test_rules_that_send_another_vehicle_are_told_with_what_they_cost(tiny_problem, customers,
                                                                       truck):
    a, b, c, d = customers

    def two_types(*served, **skills):
        kinds = [replace(truck, id=name, count=1, cost_per_km=1.0,
                         skills=skills.get(name, frozenset())) for name in ("first", "other")]
        return replace(tiny_problem(*served, truck=truck), vehicle_types=tuple(kinds))

    free, crane = two_types(a, b, c, d), frozenset({"crane"})
    held = two_types(a, replace(b, goods=frozenset({"food"})),
                     replace(c, goods=frozenset({"paint"})), d)
    bound = {
        "vehicles": replace(free, may_serve=np.array([[True, True, False, True], [True] * 4])),
        "skills": two_types(a, b, replace(c, skills=crane), d, other=crane),
        "goods": replace(held, incompatible_goods=(IncompatibleGoods(frozenset({"food", "paint"})),
                                                   ))}
    solution = plan(free, route(A, B, D), RouteDecision(1, 0, (TripDecision((0, C, 0)),)))
    # The first passes c on its way to d; the other makes 6 km for it.
    for field, problem in bound.items():
        assert binding(problem, solution, C) == {field: (None, pytest.approx(6.0))}
    assert binding(free, solution, C) == {}


def test_order_of_pickups_is_told_with_what_it_costs(tiny_problem, customers, truck):
    a, *others = customers
    a = replace(a, demand=(0,), pickup=(1000,), latest=10 * MINUTE)
    problem = tiny_problem(a, *others, truck=replace(truck, cost_per_km=1.0, pickups="last"))
    # a has to be reached before all others are served.
    solution = plan(problem, route(B, C, D), unassigned=(A,))
    found = binding(replace(problem, unassigned_cost=50.0), solution, A)
    assert found["pickups"] == (None, pytest.approx(50.0))


def test_who_must_be_flown_to_is_told_what_that_costs(tiny_problem, customers, truck, drones):
    a, b, c, d = customers
    carrier = replace(truck, count=1, drones=replace(drones, cost_per_km=3.0))
    problem = tiny_problem(a, b, replace(c, served_by="drone"), d, truck=carrier)
    solution = plan(problem, route(A, B, D, sorties=(SortieDecision((C,), 2, 3),)))
    # From b to c and on to d: 2 km by air.
    assert binding(problem, solution, C)["served_by"] == (None, pytest.approx(6.0))


def test_ends_of_shipments_are_asked_about_whatever_goods_and_skills_they_have(
        tiny_problem, customers, truck):
    a, b, c, d = (replace(each, skills=frozenset({"cold"}), goods=frozenset({"food"}))
                  for each in customers)
    ends = (replace(each, demand=(0,)) for each in (c, d))
    problem = replace(
        tiny_problem(a, b, *ends, truck=replace(truck, count=2, skills=frozenset({"cold"}))),
        incompatible_goods=(IncompatibleGoods(frozenset({"food", "paint"})),),
        shipments=(Shipment("s", C, D, (1000,)),))
    solution = plan(problem, route(A, B, C, D))
    for end in (C, D):
        assert binding(problem, solution, end) == {}


def test_breaks_are_told_with_what_is_aboard_and_what_they_cost(tiny_problem, customers, truck):
    a, *others = customers
    lunch = Break("lunch", 10 * MINUTE, 0, 3 * MINUTE, after_departure=True, max_load=(1000,))
    problem = tiny_problem(replace(a, latest=20 * MINUTE), *others, truck=replace(
        truck, cost_per_hour=60.0, breaks=(lunch,)))
    trip = TripDecision((0, A, 0), breaks=(BreakDecision(0, 0, "departure"),))
    found = binding(problem, plan(problem, RouteDecision(0, 0, (trip,)), unassigned=(B, C, D)), A)
    assert found["breaks[lunch]"] == (None, pytest.approx(10.0))
    assert found["breaks[lunch].max_load"] == (0.0, 0.0)


def test_who_may_drive_for_longer_in_a_day_may_serve_another(tiny_problem, customers, truck):
    rules = DrivingRules(60 * MINUTE, MINUTE, (), 15 * MINUTE)
    problem = tiny_problem(*customers, truck=replace(truck, driving=rules), unassigned_cost=50.0)
    found = binding(problem, plan(problem, route(A, B, C), unassigned=(D,)), D)
    assert found["driving_rules.max_driving_per_day"] == (None, pytest.approx(50.0))


def test_fewer_vehicles_than_are_to_be_used_save_one(tiny_problem, customers, truck):
    problem = replace(
        tiny_problem(*customers, truck=replace(truck, count=2, fixed_cost=7.0)),
        fairness=Fairness(min_vehicles=2, too_few_cost=100.0))
    solution = plan(problem, route(A, B, C), RouteDecision(0, 1, (TripDecision((0, D, 0)),)))
    assert binding(problem, solution, D)["fairness.min_vehicles"] == (0.0, pytest.approx(7.0))


def test_limits_that_can_not_be_more_bind_nobody(tiny_problem, customers, truck, drones):
    most = replace(truck, capacity=(MAX_QUANTITY,), max_working_duration=MAX_QUANTITY,
                   max_trip_distance=MAX_QUANTITY, max_distance=MAX_QUANTITY,
                   max_travel_duration=MAX_QUANTITY,
                   drones=replace(drones, capacity=(MAX_QUANTITY,)))
    problem = tiny_problem(*customers, truck=most)
    assert binding(problem, plan(problem, route(A, B, C, D)), B) == {}
