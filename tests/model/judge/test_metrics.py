from dataclasses import replace

import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import Overtime
from model.solution import Cost, Solution

MINUTE = 60_000
KM = 1_000_000

# to a (arrival 2, departure 7), b (9, 14), back at 18; 4 km
# c by drone: take-off 3, at c 5 to 10, at b 11, recovered 12; 3 km
C_BY_DRONE = TripDecision((0, 1, 2, 0), (SortieDecision((3,), 1, 2),), start=0)


def plan(problem, trip):
    """One route of this trip; d, if there, is unassigned."""
    route = schedule(problem, RouteDecision(0, 0, (trip,)))
    return Solution((route,), tuple(range(4, problem.num_nodes)))


def test_cost_by_term(tiny_problem, customers, truck, drones):
    paid = replace(truck, fixed_cost=20.0, cost_per_km=1.5, cost_per_hour=60.0,
                   drones=replace(drones, cost_per_km=0.5, cost_per_hour=6.0))
    problem = tiny_problem(*customers, truck=paid, unassigned_cost=100.0)
    evaluation = check(problem, plan(problem, C_BY_DRONE))
    # truck 4 km and 18 min; flight 3 km and 9 min with its recovery; d is left out
    assert evaluation.cost.fixed == 20.0
    assert evaluation.cost.distance == pytest.approx(4 * 1.5 + 3 * 0.5)
    assert evaluation.cost.time == pytest.approx(18.0 + 0.9)
    assert evaluation.cost.unassigned == 100.0
    assert evaluation.cost.total == pytest.approx(146.4)
    assert evaluation.routes[0].cost == pytest.approx(46.4)


def test_each_customer_of_the_truck_costs_a_stop(tiny_problem, customers, truck, drones):
    paid = replace(truck, cost_per_stop=2.5, drones=drones)
    problem = tiny_problem(*customers[:3], truck=paid)
    assert check(problem, plan(problem, C_BY_DRONE)).cost == Cost(stops=5.0)


@pytest.mark.parametrize(("shift_ends", "longest", "expected"), [
    (18, None, 0), (18, 18, 0), (15, None, 3), (17, 12, 6), (12, 17, 6), (100, 17, 1)])
def test_overtime_is_what_is_past_shift_or_working_duration_the_longer(
        shift_ends, longest, expected, tiny_problem, customers, truck, drones):
    # 18 minutes of work, from 0 on
    kind = replace(truck, drones=drones, cost_per_hour=60.0, latest=shift_ends * MINUTE,
                   max_working_duration=longest and longest * MINUTE,
                   overtime=Overtime(30.0, 10 * MINUTE))
    problem = tiny_problem(*customers[:3], truck=kind)
    evaluation = check(problem, plan(problem, C_BY_DRONE))
    assert evaluation.violations == ()
    assert evaluation.cost == Cost(time=18.0, overtime=0.5 * expected)
    assert evaluation.routes[0].overtime == expected * MINUTE
    assert evaluation.routes[0].working_rate == (longest and 18 / longest)


def test_sorties_of_a_trip_are_counted_but_no_stops(tiny_problem, customers, truck, drones):
    carrier = replace(truck, drones=drones, max_stops=2, max_sorties=1)
    problem = tiny_problem(*customers, truck=carrier)
    solution = plan(problem, C_BY_DRONE)
    assert check(problem, solution).violations == ()
    grounded = tiny_problem(*customers, truck=replace(carrier, max_sorties=0))
    assert [item.code for item in check(grounded, solution).violations] == ["MAX_SORTIES"]


def test_each_sortie_of_a_trip_takes_a_battery(tiny_problem, customers, truck, drones):
    sorties = (SortieDecision((3,), 1, 1), SortieDecision((4,), 1, 2))
    for batteries, broken in ((2, []), (1, ["routes[0].trips[0].sorties[1]"])):
        carrier = replace(truck, drones=replace(drones, batteries=batteries), max_trips=2)
        problem = tiny_problem(*customers, truck=carrier)
        both = plan(problem, TripDecision((0, 1, 2, 0), sorties))
        found = check(problem, both).violations
        assert [item.path for item in found if item.code == "BATTERIES"] == broken
        # The next trip begins with new ones.
        trips = (TripDecision((0, 1, 0), sorties[:1]),
                 TripDecision((0, 2, 0), (SortieDecision((4,), 1, 1),)))
        each = Solution((schedule(problem, RouteDecision(0, 0, trips)),))
        assert check(problem, each).violations == ()


def test_leaving_out_costs_what_the_customer_states(tiny_problem, customers, truck):
    problem = tiny_problem(replace(customers[0], unassigned_cost=0.0), *customers[1:3],
                           replace(customers[3], unassigned_cost=7.5), truck=truck,
                           unassigned_cost=100.0)
    assert check(problem, Solution((), (1, 2, 3, 4))).cost == Cost(unassigned=207.5)


def test_work_counts_from_when_it_is_said_to(tiny_problem, customers, truck):
    begun = replace(truck, cost_per_hour=60.0, earliest=5 * MINUTE, works_since=2 * MINUTE)
    problem = tiny_problem(*customers[:2], truck=begun)
    late = TripDecision((0, 1, 2, 0), start=9 * MINUTE)
    evaluation = check(problem, plan(problem, late))
    assert evaluation.violations == ()
    # 18 minutes from the departure
    assert evaluation.routes[0].working_duration == 25 * MINUTE
    assert evaluation.cost.time == pytest.approx(25.0)


def test_a_busy_truck_leaves_later_than_its_drone(tiny_problem, customers, truck, drones):
    busy = replace(truck, drones=drones, busy_until=4 * MINUTE)
    problem = tiny_problem(*customers[:3], truck=busy)
    trip = TripDecision((0, 1, 0), (SortieDecision((2,), 0, 1),), start=0)
    evaluation = check(problem, replace(plan(problem, trip), unassigned=(3,)))
    assert evaluation.violations == ()
    route = plan(problem, trip).routes[0]
    assert route.trips[0].stops[0].departure == 4 * MINUTE
    assert route.trips[0].sorties[0].launch_time == MINUTE


def test_what_else_is_aboard_counts(tiny_problem, customers, truck):
    loaded = replace(truck, initial_load=(8000,))
    problem = tiny_problem(*customers[:2], truck=loaded)
    evaluation = check(problem, plan(problem, TripDecision((0, 1, 2, 0))))
    assert evaluation.violations == ()
    trip = evaluation.routes[0].trips[0]
    assert (trip.load, trip.load_rate) == ((10_000,), 1.0)
    assert trip.stop_loads == ((10_000,), (9000,), (8000,), (8000,))
    more = tiny_problem(*customers[:2], truck=replace(loaded, initial_load=(8001,)))
    assert [item.code for item in check(more, plan(more, TripDecision((0, 1, 2, 0)))).violations
            ] == ["CAPACITY"]


def test_soft_windows_cost(tiny_problem, customers, truck, drones):
    a = replace(customers[0], earliest=4 * MINUTE, early_cost_per_hour=30.0)  # waits 2 min
    b = replace(customers[1], latest=8 * MINUTE, late_cost_per_hour=60.0)  # reached at 11
    c = replace(customers[2], latest=2 * MINUTE, late_cost_per_hour=120.0)  # reached at 5
    problem = tiny_problem(a, b, c, truck=replace(truck, drones=drones))
    evaluation = check(problem, plan(problem, C_BY_DRONE))
    assert evaluation.violations == ()
    assert evaluation.cost == Cost(lateness=3.0 + 6.0, earliness=1.0)


def test_being_late_at_all_costs_once(tiny_problem, customers, truck):
    a, b = (replace(customer, latest=8 * MINUTE, late_cost_per_hour=60.0, late_cost=5.0)
            for customer in customers[:2])
    problem = tiny_problem(a, b, truck=truck)  # b is reached at 9
    assert check(problem, plan(problem, TripDecision((0, 1, 2, 0)))).cost == Cost(lateness=6.0)
    hard = tiny_problem(replace(a, late_cost_per_hour=None), truck=truck)
    assert check(hard, plan(hard, TripDecision((0, 1, 0)))).cost == Cost()


def test_waiting_between_two_windows_costs(tiny_problem, customers, truck):
    a = replace(customers[0], gaps=((MINUTE, 6 * MINUTE),), early_cost_per_hour=30.0)
    problem = tiny_problem(a, truck=truck)  # reached at 2, waits 4
    assert check(problem, plan(problem, TripDecision((0, 1, 0)))).cost == Cost(earliness=2.0)


def test_metrics_of_a_route(tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers[:3], truck=replace(
        truck, drones=drones, max_working_duration=36 * MINUTE))
    evaluation = check(problem, plan(problem, C_BY_DRONE))
    route = evaluation.routes[0]
    assert (route.working_duration, route.working_rate) == (18 * MINUTE, 0.5)
    trip = route.trips[0]
    assert (trip.load, trip.load_rate) == ((3000,), 0.3)
    assert (trip.distance, trip.duration) == (4 * KM, 18 * MINUTE)
    assert trip.stop_loads == ((3000,), (1000,), (0,), (0,))  # c's parcel leaves with the drone
    assert (trip.sorties[0].distance, trip.sorties[0].duration) == (3 * KM, 9 * MINUTE)
    assert evaluation.makespan == 18 * MINUTE


def test_plan_without_routes_has_no_makespan(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    evaluation = check(problem, Solution((), (1, 2, 3, 4)))
    assert (evaluation.violations, evaluation.makespan) == ((), 0)
    assert evaluation.cost == Cost(unassigned=4000.0)


def test_working_rate_needs_a_limit(tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones))
    assert check(problem, plan(problem, C_BY_DRONE)).routes[0].working_rate is None
