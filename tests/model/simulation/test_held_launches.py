"""Launches held back for windows: by the checker, the simulator, the search and the remedies."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from model.counsel.explain import Reason, explain
from model.counsel.trial import small_problem
from model.engine.instance import pack
from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import Problem, SpeedProfile
from model.search.improve import SearchConfig, improve
from model.simulation.actions import DRIVE, LAUNCH, OPEN, RETURN, apply, encode_action, reset
from model.policy.extract import extract
from model.solution import Solution, Trip
from tests.model.mask_oracle import legal_codes
from tests.model.remedies import applied
from tests.model.rollouts import legal, roll
from tests.model.simulation.test_simulator import walk
from tests.model.tiny import draw_late, with_energy, with_gaps
from tests.seeds import often, seeds

pytestmark = pytest.mark.slow

MINUTE = 60_000


@pytest.fixture
def late(tiny_problem, customers, truck, drones) -> Problem:
    """Customers a, b and c by truck, d by drone from minute 60 on, which flies for 13 minutes.

    By truck 2 minutes a kilometre, by air 1; a launch and a recovery take a minute each.
    """
    *others, d = customers
    truck = replace(truck, count=1, drones=replace(drones, endurance=13 * MINUTE))
    by_truck = [replace(customer, served_by="truck") for customer in others]
    return tiny_problem(*by_truck, replace(d, served_by="drone", earliest=60 * MINUTE),
                        truck=truck)


def with_drones(problem: Problem, **changes: object) -> Problem:
    """Return the problem with drones of another kind."""
    kind, = problem.vehicle_types
    assert kind.drones is not None
    drones = replace(kind.drones, **changes)  # type: ignore[arg-type]
    return replace(problem, vehicle_types=(replace(kind, drones=drones),))


def changed(problem: Problem, node: int, **changes: object) -> Problem:
    """Return the problem with another customer at a node."""
    customers = list(problem.customers)
    customers[node - 1] = replace(customers[node - 1], **changes)  # type: ignore[arg-type]
    return replace(problem, customers=tuple(customers))


def timed(problem: Problem, *sorties: SortieDecision) -> Trip:
    """Return the trip to a, b and c with sorties, legal and as soon as possible."""
    decision = TripDecision((0, 1, 2, 3, 0), sorties)
    route = schedule(problem, RouteDecision(0, 0, (decision,)))
    served = {1, 2, 3}.union(*(sortie.nodes for sortie in sorties))
    left = tuple(node for node in range(1, problem.num_nodes) if node not in served)
    assert check(problem, Solution((route,), left)).violations == ()
    return route.trips[0]


def minutes(*times: int) -> list[float]:
    return [time / MINUTE for time in times]


def searched(problem: Problem, turns: int = 200, seed: int = 0) -> Solution:
    """Return the plan that the search finds from nothing, found legal."""
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    config = SearchConfig(seed, turns=turns)
    solution = improve(problem, pack([problem]), nobody, config).solution
    assert check(problem, solution).violations == ()
    return solution


def decoded(problem: Problem, *actions: tuple[int, int]) -> Solution:
    """Return the plan that actions make, each found legal."""
    instance = pack([problem])
    state = reset(instance, np.zeros(1, np.int64))
    codes = [encode_action(*action) for action in actions]
    for code in codes:
        assert code in legal(problem, instance, state)
        apply(instance, state, 0, code)
    solution = extract(problem, instance, codes)
    assert check(problem, solution).violations == ()
    return solution


def test_a_launch_is_held_back_until_the_drone_need_not_wait_longer_than_it_can_fly(late):
    # Served from 60 to 65 and at b by 67, 13 minutes after 54; the truck is at a from 2 on.
    trip = timed(late, SortieDecision((4,), 1, 2))
    sortie, = trip.sorties
    assert minutes(sortie.launch_time, sortie.recovery_start) == [54, 67]
    assert minutes(sortie.visits[0].arrival, sortie.visits[0].service_start) == [57, 60]
    assert minutes(trip.stops[1].departure, trip.stops[2].arrival) == [54, 56]


def test_it_is_held_back_as_long_if_waiting_for_the_truck_does_not_count(late):
    trip = timed(with_drones(late, endurance_includes_waiting=False), SortieDecision((4,), 1, 2))
    assert minutes(trip.sorties[0].launch_time) == [54]


def test_the_latest_window_of_a_sortie_decides(late):
    # c from 50, served until 55, d from 60 until 65, at b by 67.
    late = changed(late, 3, served_by="drone", earliest=50 * MINUTE)
    late = with_drones(late, endurance=20 * MINUTE, max_customers_per_sortie=2)
    decision = TripDecision((0, 1, 2, 0), (SortieDecision((3, 4), 1, 2),))
    route = schedule(late, RouteDecision(0, 0, (decision,)))
    assert check(late, Solution((route,))).violations == ()
    assert minutes(route.trips[0].sorties[0].launch_time) == [47]


def test_a_flight_that_need_not_wait_takes_off_at_once(late):
    trip = timed(changed(late, 4, earliest=10 * MINUTE), SortieDecision((4,), 1, 2))
    assert minutes(trip.sorties[0].launch_time) == [4]  # 10 to 15, at b by 17
    trip = timed(changed(late, 4, earliest=9 * MINUTE), SortieDecision((4,), 1, 2))
    assert minutes(trip.sorties[0].launch_time) == [3]


def test_a_take_off_too_soon_is_no_legal_plan(late):
    decision = TripDecision((0, 1, 2, 3, 0), (SortieDecision((4,), 1, 2),))
    route = schedule(late, RouteDecision(0, 0, (decision,)))
    trip, = route.trips
    sortie = replace(trip.sorties[0], launch_time=53 * MINUTE)
    early = replace(route, trips=(replace(trip, sorties=(sortie,)),))
    assert check(late, Solution((early,))).violations


@pytest.mark.parametrize("counts", [True, False])
def test_a_drone_that_can_start_at_once_goes_before_one_held_back(late, counts):
    late = with_drones(late, count=2, endurance_includes_waiting=counts)
    late = changed(late, 3, served_by="drone")
    # d is launched first by the policy, but c's drone can be back before.
    solution = decoded(late, (OPEN, 0), (DRIVE, 1), (LAUNCH, 4), (LAUNCH, 3), (DRIVE, 2),
                       (RETURN, 0))
    first, second = sorted(solution.routes[0].trips[0].sorties, key=lambda item: item.launch_time)
    assert (first.visits[0].node, second.visits[0].node) == (3, 4)
    # The trip begins as late as costs nothing.
    assert minutes(second.launch_time, second.visits[0].arrival) == [57, 60]


def test_a_drone_held_at_the_depot_is_no_work_before_it_takes_off(late):
    truck, = late.vehicle_types
    late = replace(late, vehicle_types=(replace(truck, max_working_duration=16 * MINUTE),))
    late = small_problem(late, 0, [4], truck.drones)
    # 4 minutes out, 5 of service, 4 back, a minute to recover.
    solution = decoded(late, (OPEN, 0), (LAUNCH, 1), (RETURN, 0))
    assert check(late, solution).routes[0].working_duration == 14 * MINUTE
    assert searched(late).unassigned == ()


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("several", [False, True])
@pytest.mark.parametrize("on_battery", [False, True])
def test_the_mask_is_exact_where_launches_are_held_back(several: bool, on_battery: bool) -> None:
    for seed in range(often(85 if not several and not on_battery else 40)):
        rng = np.random.default_rng(seed)
        problem = draw_late(rng)
        if several:
            problem = with_gaps(rng, problem)
        if on_battery:
            problem = with_energy(rng, problem)
        for codes, position in walk(problem, rng):
            expected = legal_codes(problem, position.vehicle, position.served, position.used)
            assert sorted(codes) == sorted(expected), f"seed {seed}"


def held(problem: Problem, solution: Solution) -> Iterator[int]:
    """Yield customers whose drones would not have been back in time if launched at once."""
    for route in solution.routes:
        drones = problem.vehicle_types[route.vehicle_type].drones
        for trip in route.trips:
            for sortie in trip.sorties:
                assert drones is not None
                stop = trip.stops[sortie.launch_stop]
                soonest = stop.arrival + drones.launch_duration
                if sortie.recovery_start - soonest > drones.endurance < (
                        sortie.visits[0].service_start - soonest):
                    yield sortie.visits[0].node


def test_random_rollouts_and_searches_hold_launches_and_pass_the_checker() -> None:
    by_policy = by_search = 0
    for seed in seeds(110):
        problem = draw_late(np.random.default_rng(seed))
        rollout = roll([problem], seed).rollouts[0]
        solution = extract(problem, pack([problem]), rollout.actions)
        evaluation = check(problem, solution)
        assert evaluation.violations == (), f"seed {seed}"
        assert rollout.cost.sum() == pytest.approx(evaluation.cost.total, rel=1e-9)
        by_policy += len(list(held(problem, solution)))
        by_search += len(list(held(problem, searched(problem))))
    assert by_policy > often(5)
    assert by_search > often(5)


def test_plans_state_their_order_where_launches_and_recoveries_take_no_time() -> None:
    for seed in seeds(100):
        problem = draw_late(np.random.default_rng(seed))
        kinds = tuple(replace(kind, drones=replace(
            kind.drones, count=3, launch_duration=0, recovery_duration=0))
            for kind in problem.vehicle_types if kind.drones is not None)
        customers = tuple(replace(customer, skills=frozenset(), served_by="either" if (
            customer.served_by == "truck") else "drone") for customer in problem.customers)
        problem = replace(problem, vehicle_types=kinds, customers=customers)
        rollout = roll([problem], 0).rollouts[0]
        evaluation = check(problem, extract(problem, pack([problem]), rollout.actions))
        assert evaluation.violations == (), f"seed {seed}"
        assert rollout.cost.sum() == pytest.approx(evaluation.cost.total, rel=1e-9)
        searched(problem, 20)


@pytest.mark.parametrize("change", [
    {}, {"served_by": "either"}, {"latest": 60 * MINUTE}, {"release_time": 30 * MINUTE},
    {"late_cost_per_hour": 9.0, "latest": 61 * MINUTE}, {"early_cost_per_hour": 6.0},
], ids=str)
@pytest.mark.parametrize("counts", [True, False])
def test_the_search_serves_whoever_a_launch_must_be_held_for(late, change, counts):
    # By truck, d is out of reach: the way there and back takes 16 minutes.
    late = with_drones(changed(late, 4, **change), endurance_includes_waiting=counts)
    truck = replace(late.vehicle_types[0], max_trip_distance=6_500_000)
    assert searched(replace(late, vehicle_types=(truck,))).unassigned == ()


@pytest.mark.parametrize("counts", [True, False])
def test_a_held_launch_and_speeds_by_time_of_day(late, counts):
    late = with_drones(late, endurance_includes_waiting=counts)
    truck = replace(late.vehicle_types[0], cost_per_hour=10.0, speed_profile=SpeedProfile(
        (5 * MINUTE, 50 * MINUTE), (1_000_000, 500_000, 1_000_000)))
    assert searched(replace(late, vehicle_types=(truck,)), 300).unassigned == ()


def test_a_trip_for_each_window(late):
    truck = replace(late.vehicle_types[0], max_trips=3, reload_duration=5 * MINUTE,
                    capacity=(2000,))
    late = changed(replace(late, vehicle_types=(truck,)), 1, served_by="drone",
                   earliest=120 * MINUTE)
    assert searched(late, 1000).unassigned == ()


def lone_reasons(seed: int) -> Iterator[tuple[Problem, Reason]]:
    """Yield problems of one customer and one vehicle, and why nobody serves whom."""
    problem = draw_late(np.random.default_rng(seed))
    for kind in range(len(problem.vehicle_types)):
        for node in range(problem.num_depots, problem.num_nodes):
            lone = replace(small_problem(problem, kind, [node]), unassigned_cost=1e6)
            reason, = explain(lone, Solution((), (1,)), 1)
            yield lone, reason


def is_served(problem: Problem) -> bool:
    """Tell whether policy and search both can serve the only customer."""
    instance = pack([problem])
    opens = legal(problem, instance, reset(instance, np.zeros(1, np.int64)))
    return bool(opens) and not searched(problem, 20).unassigned


@pytest.mark.thorough
def test_a_remedy_for_a_lone_customer_is_never_false_and_none_is_needed_where_one_fits() -> None:
    remedies = 0
    for seed in seeds(110):
        for problem, reason in lone_reasons(seed):
            if reason.code == "SEARCH":
                assert is_served(problem), f"seed {seed}"
            elif reason.remedy is not None:
                remedies += 1
                assert is_served(applied(problem, reason, 1)), f"seed {seed}: {reason.remedy}"
    assert remedies > often(100)


def test_a_customer_whose_window_opens_after_that_of_the_stop_to_fly_from(late):
    # No flight of 11 minutes leads from the depot to d; a has to be reached by minute 10.
    late = with_drones(changed(late, 3, latest=10 * MINUTE), endurance=9 * MINUTE)
    reason, = explain(late, Solution((), (1, 2, 3, 4)), 4)
    assert (reason.code, reason.remedy) == ("SEARCH", None)


