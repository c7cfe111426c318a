"""Random problems, planned, changed while under way, and planned on."""

from collections.abc import Callable, Collection
from dataclasses import replace
from typing import get_args

import numpy as np
import pytest

from model.judge.check import check
from model.judge.launches import launch_begins
from model.planner import Planner, PlanOptions
from model.problem import Balance, Fairness, Measure, Problem, Travel
from model.replanning.replan import Replanning, Terms
from model.replanning.rested import has_clock
from model.solution import Route, Solution, Trip, Vehicle
from tests.model.fliers import from_few_hubs, with_fliers
from tests.model.street import served
from tests.model.permits import with_closings, with_few_airborne, with_ranges, with_storms
from tests.model.tiny import (
    draw_late, draw_tiny, with_charging, with_duty, with_energy, with_goods, with_limits_aboard,
    with_open_ends, with_open_reloads, with_own_durations, with_pickups, with_reloads, with_setups,
    with_table, with_turnaround,
)
from tests.model.tiny_breaks import with_breaks
from tests.model.tiny_choices import with_choices
from tests.model.tiny_company import with_order, with_order_across, with_relations
from tests.model.tiny_driving import with_driving
from tests.model.tiny_hours import with_hours_apart
from tests.model.tiny_launches import (
    draw_for_drones, with_few_launch_places, with_launch_sites, with_some_revisits,
)
from tests.model.tiny_prices import with_vehicle_costs
from tests.seeds import seeds
from training.instances import VARIANTS, generate

pytestmark = pytest.mark.slow

OPTIONS = PlanOptions("any", time_limit=600.0, search_iterations=40)


def nobody(problem: Problem) -> Solution:
    """Return the plan that serves nobody."""
    return Solution((), problem.left_out(()))


def part_of(problem: Problem, customers: list[int]) -> Problem:
    """Return a problem with some of its customers."""
    nodes = [*range(problem.num_depots), *customers]
    grid = np.ix_(nodes, nodes)
    return replace(problem, customers=tuple(map(problem.customer_at, customers)),
                   travel=tuple(Travel(kind.duration[grid], kind.distance[grid])
                                for kind in problem.travel),
                   coordinates=problem.coordinates[nodes],
                   relations=problem.relations_among(nodes), choices=problem.choices_among(nodes),
                   may_serve=None if problem.may_serve is None else
                   problem.may_serve[:, np.array(customers) - problem.num_depots],
                   vehicle_costs=problem.vehicle_costs_of(
                       range(len(problem.vehicle_types)), customers))


def renumbered(trip: Trip, nodes: dict[int, int]) -> Trip:
    """Return a trip with other nodes."""
    return Trip(tuple(replace(stop, node=nodes[stop.node]) for stop in trip.stops),
                tuple(replace(sortie, visits=tuple(replace(visit, node=nodes[visit.node])
                                                   for visit in sortie.visits))
                      for sortie in trip.sorties), trip.breaks)


def instants(plan: Solution) -> list[int]:
    """Return when anything of a plan happens."""
    stops = [stop for route in plan.routes for trip in route.trips for stop in trip.stops]
    sorties = [sortie for route in plan.routes for trip in route.trips for sortie in trip.sorties]
    return [*(time for stop in stops for time in (stop.arrival, stop.departure)),
            *(time for sortie in sorties for time in (sortie.launch_time, sortie.recovery_time))]


def begun(problem: Problem, route: Route, now: int) -> list[tuple[int, list[int], list[int]]]:
    """Return the trips that have begun: number, stops left, sorties launched."""
    kind = problem.vehicle_types[route.vehicle_type]
    found = []
    for number, trip in enumerate(route.trips):
        left = [index for index, stop in enumerate(trip.stops) if stop.departure <= now]
        launched = [index for index, begin in enumerate(launch_begins(trip.sorties, kind))
                    if begin <= now]
        if left or launched:
            found.append((number, left, launched))
    return found


def settled(problem: Problem, plan: Solution, now: int) -> set[int]:
    """Return the customers who can't be cancelled any more."""
    nodes = set()
    for route in plan.routes:
        for number, left, launched in begun(problem, route, now):
            trip = route.trips[number]
            if has_clock(problem.vehicle_types[route.vehicle_type]):
                left, launched = [*range(len(trip.stops))], [*range(len(trip.sorties))]
            nodes |= {stop.node for stop in trip.stops[:len(left) + 1]}
            for index in launched:
                nodes |= {visit.node for visit in trip.sorties[index].visits}
                nodes.add(trip.stops[trip.sorties[index].recovery_stop].node)
    return nodes


def assert_unchanged(problem: Problem, before: Solution, after: Solution, now: int,
                     broken: frozenset[Vehicle]) -> None:
    """Hold all that had departed by now against the new plan, to the millisecond."""
    routes = {route.driven_by: route for route in after.routes}
    for route in before.routes:
        vehicle = route.driven_by
        if vehicle in broken:
            continue
        for number, left, launched in begun(problem, route, now):
            old, new = route.trips[number], routes[vehicle].trips[number]
            assert [new.stops[index] for index in left] == [old.stops[index] for index in left]
            assert new.breaks == old.breaks
            flights = {(sortie.drone, sortie.launch_stop, sortie.launch_time, sortie.visits)
                       for sortie in new.sorties}
            for index in launched:
                sortie = old.sorties[index]
                assert (sortie.drone, sortie.launch_stop, sortie.launch_time,
                        sortie.visits) in flights


def something_happens(rng: np.random.Generator, problem: Problem, latest: int) -> Problem:
    """Change windows, demands, releases and shifts."""
    customers = list(problem.customers)
    for index, customer in enumerate(customers):
        if rng.random() < 0.1:
            closing = int(rng.integers(0, latest + 1))
            customers[index] = replace(
                customer, earliest=min(customer.earliest, closing), latest=closing,
                gaps=tuple(gap for gap in customer.gaps if gap[1] <= closing))
        elif rng.random() < 0.05:
            customers[index] = replace(customer, release_time=int(rng.integers(0, latest + 1)))
        elif rng.random() < 0.05:
            doubled = tuple(2 * amount for amount in customer.demand)
            customers[index] = replace(customer, demand=doubled)
    kinds = problem.vehicle_types
    if rng.random() < 0.1:
        end = int(latest * rng.random())
        kinds = tuple(replace(kind, latest=max(kind.earliest, min(kind.latest, end)))
                      for kind in kinds)
    return replace(problem, customers=tuple(customers), vehicle_types=kinds)


def lost(rng: np.random.Generator, problem: Problem) -> dict[Vehicle, frozenset[int]]:
    """Return drones of one vehicle of each type, none of some."""
    return {Vehicle(index, int(rng.integers(kind.count))): frozenset(
                range(int(rng.integers(kind.num_drones + 1))))
            for index, kind in enumerate(problem.vehicle_types)}


def replan_and_check(planner: Planner, whole: Problem, rng: np.random.Generator,
                     allowed: Collection[str] = ("TIME_MISMATCH", "RELEASE")) -> None:
    """Plan a part of a problem, let things happen, and plan on.

    `allowed` are plain rules that a plan may break which goes on.
    """
    customers = np.arange(whole.num_depots, whole.num_nodes)
    new = set(rng.choice(customers, max(1, len(customers) // 6), replace=False).tolist())
    first = [int(node) for node in customers if node not in new]
    old = part_of(whole, first)
    plan = planner.plan(old, OPTIONS, start=nobody(old)).solution
    if not plan.routes:
        return
    times = instants(plan)
    now = int(rng.choice(times)) if rng.random() < 0.3 else int(
        min(times) + rng.choice([0.0, 0.4, 0.4, 0.7]) * (max(times) - min(times)))
    fixed = settled(old, plan, now)
    gone = {node for index, node in enumerate(first, old.num_depots)
            if index not in fixed and rng.random() < 0.1}
    kept = [int(node) for node in customers if node not in gone]
    here = {node: index for index, node in enumerate(kept, whole.num_depots)}
    nodes = {index: here.get(node, -1) for index, node in enumerate(first, old.num_depots)}
    nodes |= {depot: depot for depot in range(whole.num_depots)}
    given = Solution(tuple(
        replace(route, trips=tuple(renumbered(trip, nodes) for trip in route.trips))
        for route in plan.routes))
    problem = something_happens(rng, part_of(whole, kept), max(times))
    broken = frozenset(route.driven_by for route in plan.routes
                       if rng.random() < 0.15)
    pinned = frozenset(node for node in served(*given.routes) if rng.random() < 0.1)
    keeps_order = rng.random() < 0.5
    replanning = Replanning(problem, Terms(given, now, pinned, broken, grounded=lost(rng, problem),
                                           keeps_order=keeps_order))
    result = replanning.plan(planner, OPTIONS)
    assert replanning.check(result.solution).violations == ()
    assert result.final_cost <= result.decoded_cost
    assert_unchanged(problem, given, result.solution, now, broken)
    excused = {(item.code, item.path) for item in replanning.excused}
    # By the plain rules, only what had happened breaks any, or waited for the present.
    for item in check(problem, result.solution).violations:
        assert (item.code, item.path) in excused or item.code in allowed
    for node in result.solution.unassigned:
        assert len(replanning.reasons(result.solution, node)) == len(problem.vehicle_types)
    again = replanning.plan(planner, replace(OPTIONS, search_iterations=0), start=result.solution)
    assert_as_cheap(again.final_cost, result.final_cost, keeps_order)
    replan_later(planner, problem, result.solution, now + (max(times) - now) // 2, broken)


def assert_as_cheap(again: float, before: float, keeps_order: bool) -> None:
    """Fail if a plan gone on from has another cost; where order is kept, it may serve more."""
    if keeps_order:
        assert again <= before * (1 + 1e-9)
    else:
        assert again == pytest.approx(before)


def replan_later(planner: Planner, problem: Problem, plan: Solution, now: int,
                 broken: frozenset[Vehicle]) -> None:
    """Plan on from a plan that went on itself."""
    replanning = Replanning(problem, Terms(plan, now, unavailable=broken))
    result = replanning.plan(planner, OPTIONS)
    assert replanning.check(result.solution).violations == ()
    assert_unchanged(problem, plan, result.solution, now, broken)


@pytest.mark.thorough_after(8)
@pytest.mark.parametrize("seed", seeds(60))
def test_tiny_plans_go_on(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((seed, 5))
    replan_and_check(planner, draw_tiny(rng), rng)


@pytest.mark.parametrize("seed", seeds(30))
def test_tiny_plans_whose_launches_are_held_back_go_on(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((seed, 8))
    replan_and_check(planner, draw_late(rng), rng)


@pytest.mark.parametrize("seed", seeds(30))
def test_tiny_plans_go_on_in_overtime(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((seed, 10))
    replan_and_check(planner, with_duty(rng, draw_tiny(rng)), rng)


@pytest.mark.parametrize("seed", seeds(20))
def test_tiny_plans_that_pick_up_go_on(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((seed, 12))
    replan_and_check(planner, with_pickups(rng, with_duty(rng, draw_tiny(rng))), rng)


@pytest.mark.parametrize("seed", seeds(20))
def test_tiny_plans_go_on_by_who_may_serve_whom_at_what_cost(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((seed, 9))
    change = with_table if seed % 2 else with_vehicle_costs
    replan_and_check(planner, change(rng, draw_tiny(rng)), rng)


@pytest.mark.parametrize("seed", seeds(20))
def test_tiny_plans_on_batteries_go_on(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((seed, 10))
    draw = draw_late if seed % 2 else draw_tiny
    replan_and_check(planner, with_energy(rng, draw(rng)), rng)


@pytest.mark.parametrize("seed", seeds(20))
def test_tiny_plans_with_few_batteries_go_on(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((seed, 13))
    problem = with_turnaround(rng, draw_tiny(rng, drone_share=1.0))
    replan_and_check(planner, with_energy(rng, problem) if seed % 2 else problem, rng)


@pytest.mark.parametrize("seed", seeds(30))
def test_tiny_plans_on_charged_batteries_go_on(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((seed, 14))
    problem = with_charging(rng, draw_tiny(rng, drone_share=1.0), begun_share=0.0)
    anyone = tuple(replace(customer, served_by="either") for customer in problem.customers)
    replan_and_check(planner, replace(problem, customers=anyone), rng)


@pytest.mark.thorough_after(5)
@pytest.mark.parametrize("seed", seeds(40))
def test_tiny_plans_of_vehicles_that_fly_go_on(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((13, seed))
    replan_and_check(planner, with_fliers(rng, draw_tiny(rng)), rng)


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("seed", seeds(40))
def test_tiny_plans_from_hubs_that_have_little_go_on(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng((15, seed))
    replan_and_check(planner, from_few_hubs(rng, draw_tiny(rng)), rng)


@pytest.mark.parametrize("change", [
    with_open_ends, with_reloads, with_open_reloads, with_hours_apart])
@pytest.mark.parametrize("seed", seeds(10))
def test_tiny_plans_go_on_from_place_to_place(
        planner: Planner, seed: int,
        change: Callable[[np.random.Generator, Problem], Problem]) -> None:
    rng = np.random.default_rng((seed, 11))
    # Who begins no more trips may stay where the last one was to end.
    replan_and_check(planner, change(rng, draw_tiny(rng)), rng,
                     ("TIME_MISMATCH", "RELEASE", "DEPOT"))


def with_all_at_once(rng: np.random.Generator, problem: Problem) -> Problem:
    for change in (with_own_durations, with_goods, with_setups, with_pickups):
        if rng.random() < 0.5:
            problem = change(rng, problem)
    return with_limits_aboard(rng, problem)


def with_fairness(rng: np.random.Generator, problem: Problem) -> Problem:
    balance = Balance(get_args(Measure)[int(rng.integers(4))], float(rng.integers(0, 9)))
    return replace(problem, fairness=Fairness(
        float(rng.integers(0, 2)) * 30, balance, int(rng.integers(0, 4)), 40.0))


@pytest.mark.thorough_after(10)
@pytest.mark.parametrize("change", [
    with_fairness, with_own_durations, with_goods, with_setups, with_limits_aboard,
    with_all_at_once, with_ranges, with_few_airborne, with_few_launch_places, with_storms,
    with_closings,
    with_relations, with_order, with_order_across, with_choices, with_breaks, with_driving])
@pytest.mark.parametrize("seed", seeds(12))
def test_tiny_plans_go_on_by_what_else_is_stated(
        planner: Planner, change: Callable[[np.random.Generator, Problem], Problem],
        seed: int) -> None:
    rng = np.random.default_rng((seed, 10))
    replan_and_check(planner, change(rng, draw_tiny(rng)), rng)


@pytest.mark.parametrize("change", [with_breaks, with_driving])
def test_breaks_are_taken_in_plans_that_are_changed_before_the_day(
        planner: Planner, change: Callable[[np.random.Generator, Problem], Problem]) -> None:
    for seed in seeds(25):
        rng = np.random.default_rng((seed, 12))
        problem = change(rng, draw_tiny(rng, 0.0 if change is with_driving else 0.6))
        plan = planner.plan(problem, OPTIONS, start=nobody(problem))
        pinned = frozenset(node for node in served(*plan.solution.routes) if rng.random() < 0.3)
        replanning = Replanning(problem, Terms(plan.solution, pinned=pinned))
        as_it_was = replanning.plan(planner, replace(OPTIONS, search_iterations=0))
        assert as_it_was.final_cost <= plan.final_cost * (1 + 1e-9)
        busy = [route.driven_by for route in plan.solution.routes]
        lacking = Replanning(problem, Terms(plan.solution, unavailable=frozenset(busy[:1])))
        assert check(problem, lacking.plan(planner, OPTIONS).solution).violations == ()


@pytest.mark.parametrize("change", [with_launch_sites, with_some_revisits])
@pytest.mark.parametrize("seed", seeds(15))
def test_tiny_plans_go_on_from_launch_sites(
        planner: Planner, change: Callable[[np.random.Generator, Problem], Problem],
        seed: int) -> None:
    rng = np.random.default_rng((seed, 10))
    replan_and_check(planner, change(rng, draw_for_drones(rng)), rng)


@pytest.mark.thorough_after(6)
@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("seed", seeds(4))
def test_plans_of_all_classes_go_on(planner: Planner, variant: str, seed: int) -> None:
    rng = np.random.default_rng((seed, 6))
    replan_and_check(planner, generate(rng, 20, variant), rng)


@pytest.mark.parametrize("variant", VARIANTS)
def test_nobody_is_lost_who_was_served_and_nothing_happens(planner: Planner,
                                                           variant: str) -> None:
    problem = generate(np.random.default_rng(7), 20, variant)
    plan = planner.plan(problem, replace(OPTIONS, search_iterations=200),
                        start=nobody(problem)).solution
    times = instants(plan)
    now = min(times) + 2 * (max(times) - min(times)) // 5
    result = Replanning(problem, Terms(plan, now)).plan(planner, OPTIONS)
    assert set(result.solution.unassigned) <= set(plan.unassigned)
    assert result.final_cost <= check(problem, plan).cost.total * (1 + 1e-9)
