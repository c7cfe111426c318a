"""Plans of random problems under all rules, in regions and put together again."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.planner import Planner, PlanOptions
from model.problem import Problem
from model.search.regions.dividing import divide
from model.search.regions.part import part_of
from model.search.regions.region import Region, put_back
from model.solution import Solution
from tests.model.street import NO_POLICY
from tests.model.tiny import (
    with_dimensions, with_goods, with_own_costs, with_pickups, with_reloads, with_setups,
    with_table,
)
from tests.model.tiny_company import with_order, with_relations
from tests.model.tiny_hours import with_hours
from tests.model.tiny_launches import (
    with_few_launch_places, with_launch_sites, with_some_revisits,
)
from tests.model.tiny_prices import with_vehicle_costs
from training.instances import VARIANTS, generate

OPTIONS = PlanOptions("any", time_limit=600.0, search_iterations=30)
PLANNER = Planner(NO_POLICY)
SEEDS = range(14)
MORE_RULES = (with_own_costs, with_pickups, with_dimensions, with_goods,
              with_table, with_reloads, with_setups, with_hours, with_few_launch_places,
              with_launch_sites, with_some_revisits, with_vehicle_costs, with_relations, with_order)


def drawn(seed: int, customers: int = 24) -> Problem:
    """Return a problem of one of all kinds, most of them with rules of another."""
    rng = np.random.default_rng(seed)
    problem = generate(rng, customers, list(VARIANTS)[seed % len(VARIANTS)])
    return MORE_RULES[seed % len(MORE_RULES)](rng, problem)


def nobody(problem: Problem) -> Solution:
    """Return the plan that serves nobody."""
    return Solution((), tuple(range(problem.num_depots, problem.num_nodes)))


def planned(problem: Problem, keep: int | None = None) -> Solution:
    """Return a plan, of its first routes alone if so many are to be kept."""
    plan = PLANNER.plan(problem, OPTIONS, start=nobody(problem)).solution
    routes = plan.routes if keep is None else plan.routes[:keep]
    served = {node for route in routes for node in route.served}
    return Solution(routes, tuple(node for node in range(problem.num_depots, problem.num_nodes)
                                  if node not in served))


@pytest.mark.parametrize("seed", SEEDS)
def test_regions_cost_what_the_whole_does_and_keep_its_rules(seed: int) -> None:
    problem = drawn(seed)
    plan = planned(problem, keep=None if seed % 3 else 2)
    whole = check(problem, plan)
    regions = divide(problem, plan, 2, np.random.default_rng(seed))
    total = 0.0
    for region in regions:
        part = part_of(problem, region)
        inside = part.inward(region.plan)
        judged = check(part.problem, inside)
        assert judged.violations == ()
        assert part.outward(inside) == region.plan
        total += judged.cost.total
    assert total == pytest.approx(whole.cost.total, rel=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_found_for_a_region_makes_the_whole_cheaper_by_as_much(seed: int) -> None:
    problem = drawn(seed)
    plan = planned(problem, keep=1 + seed % 3)
    before = check(problem, plan).cost.total
    for region in divide(problem, plan, 2, np.random.default_rng(seed)):
        part = part_of(problem, region)
        start = part.inward(region.plan)
        found = PLANNER.plan(part.problem, replace(OPTIONS, seed=seed), start=start)
        merged = put_back(plan, region, part.outward(found.solution))
        assert merged is not None
        judged = check(problem, merged)
        assert judged.violations == ()
        saved = check(part.problem, start).cost.total - found.evaluation.cost.total
        assert judged.cost.total == pytest.approx(before - saved, abs=1e-9 * before)
        assert saved >= 0
        # The next region is still what it was.
        plan, before = merged, judged.cost.total


@pytest.mark.parametrize("seed", SEEDS)
def test_regions_share_all_there_is(seed: int) -> None:
    problem = drawn(seed)
    plan = planned(problem, keep=3)
    regions = divide(problem, plan, 3, np.random.default_rng(seed))
    routes = [route for region in regions for route in region.plan.routes]
    assert Counter(routes) == Counter(plan.routes)
    assert sorted(node for region in regions for node in region.plan.unassigned) == sorted(
        plan.unassigned)
    vehicles = Counter(vehicle for region in regions for vehicle in region.vehicles)
    assert set(vehicles.values()) == {1}
    there = {(kind, number) for kind, each in enumerate(problem.vehicle_types)
             for number in range(each.count)}
    assert set(vehicles) <= there


def regions_of() -> tuple[Problem, Solution, tuple[Region, ...]]:
    problem = generate(np.random.default_rng(0), 60, "cvrp")
    plan = planned(problem, keep=4)
    return problem, plan, divide(problem, plan, 2, np.random.default_rng(0))


def test_borders_are_others_each_time() -> None:
    problem, plan, _ = regions_of()
    rng = np.random.default_rng(1)
    drawings = {frozenset(frozenset(route.driven_by for route in region.plan.routes)
                          for region in divide(problem, plan, 2, rng)) for _ in range(20)}
    assert len(drawings) > 1


def test_regions_are_of_about_one_size() -> None:
    problem = generate(np.random.default_rng(3), 120, "cvrp")
    plan = planned(problem)
    routes = [route.served for route in plan.routes]
    for seed in range(5):
        regions = divide(problem, plan, 3, np.random.default_rng(seed))
        sizes = [sum(len(route.served) for route in region.plan.routes)
                 for region in regions]
        assert max(sizes) - min(sizes) <= 2 * max(map(len, routes))


def test_stale_region_is_refused() -> None:
    _, plan, (first, second) = regions_of()
    assert put_back(plan, first, first.plan) is not None
    # A route of it was changed.
    route = first.plan.routes[0]
    trip = replace(route.trips[0], stops=route.trips[0].stops[:-2] + route.trips[0].stops[-1:])
    changed = replace(plan, routes=tuple(replace(each, trips=(trip,)) if each == route else each
                                         for each in plan.routes))
    assert put_back(changed, first, first.plan) is None
    assert put_back(changed, second, second.plan) is not None
    # Somebody is served by now whom it left out.
    assert plan.unassigned
    node = (first.plan.unassigned or second.plan.unassigned)[0]
    left = first if node in first.plan.unassigned else second
    served = replace(plan, unassigned=tuple(set(plan.unassigned) - {node}))
    assert put_back(served, left, left.plan) is None


def test_vehicle_that_got_a_route_meanwhile_is_not_used_twice() -> None:
    _, plan, (first, second) = regions_of()
    kind, number = first.spare[0]
    moved = replace(second.plan.routes[0], vehicle_type=kind, vehicle=number)
    taken = replace(plan, routes=tuple(moved if route == second.plan.routes[0] else route
                                       for route in plan.routes))
    found = replace(first.plan, routes=(
        replace(first.plan.routes[0], vehicle_type=kind, vehicle=number),
        *first.plan.routes[1:]))
    assert put_back(plan, first, found) is not None
    assert put_back(taken, first, found) is None
    # Unless nobody needs it.
    assert put_back(taken, first, first.plan) is not None


def test_plan_without_routes_has_no_regions() -> None:
    problem, _, _ = regions_of()
    assert divide(problem, nobody(problem), 3, np.random.default_rng(0)) == ()
    with pytest.raises(ValueError, match="0 customers"):
        part_of(problem, Region(Solution(())))
