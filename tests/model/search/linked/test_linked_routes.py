"""Linked stops tell what their routes are, whatever is done to them and taken back."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.engine.instance import pack
from model.problem import UNLIMITED, Depot, Points, Problem, StraightLegs, Travel
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher, read_routes
from model.search.improve import SearchConfig, improve
from model.search.linked.engine import anneal_linked, tie, write_back
from model.search.linked.layout import Linked
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.problem_data import are_timed, can_be_linked, make_data
from model.solution import Solution
from tests.model.search.found import copied, read_plan, served_by
from tests.seeds import often
from training.instances import generate

BATCHES, TURNS = often(60), 20


def loads_alone(size: int) -> Problem:
    """Return a problem where nothing but loads limits routes."""
    return generate(np.random.default_rng(8), size, "cvrp")


def with_windows(size: int) -> Problem:
    """Return one with hard windows."""
    return generate(np.random.default_rng(8), size, "vrptw")


def with_few_vehicles(size: int) -> Problem:
    """Return one where somebody has to be left out, now one and then another."""
    problem = with_windows(size)
    (kind,) = problem.vehicle_types
    return replace(problem, vehicle_types=(replace(kind, count=3),))


def with_two_depots(size: int) -> Problem:
    """Return one with windows and two depots, from one of which half of the customers are served.
    """
    problem = with_windows(size)
    (kind,) = problem.vehicle_types
    count, at = problem.num_nodes, problem.coordinates
    order = np.insert(np.arange(count), 1, count // 2)
    customers = tuple(replace(each, skills=frozenset({"far"}) if number % 2 else frozenset())
                      for number, each in enumerate(problem.customers))
    types = (replace(kind, id="near", count=size), replace(
        kind, id="far", count=size, depot=1, skills=frozenset({"far"})))
    travel = tuple(Travel(*(legs[np.ix_(order, order)] for legs in each.arrays()))
                   for each in problem.travel)
    return replace(problem, depots=(*problem.depots, Depot("other")), customers=customers,
                   vehicle_types=types, travel=travel, coordinates=at[order])


def with_other_shifts(size: int) -> Problem:
    """Return one with windows and two depots, whose vehicles end at other times, and few of each.
    """
    problem = with_two_depots(size)
    day = max(each.latest for each in problem.customers if each.latest < UNLIMITED)
    return replace(
        problem, customers=tuple(replace(each, skills=frozenset()) for each in problem.customers),
        vehicle_types=tuple(replace(kind, skills=frozenset(), latest=day // number)
                            for number, kind in enumerate(problem.vehicle_types, 1)))


def with_several_types(size: int) -> Problem:
    """Return one with windows, and few vehicles of each of four types that cost otherwise."""
    problem = with_windows(size)
    (kind,) = problem.vehicle_types
    types = tuple(replace(
        kind, id=str(number), count=2 + size // 12, capacity=(kind.capacity[0] * number // 2,),
        fixed_cost=problem.unassigned_cost / 50 * number ** 1.5,
        cost_per_km=kind.cost_per_km * (0.7 + 0.2 * number),
        cost_per_stop=problem.unassigned_cost / 1000 * number) for number in range(1, 5))
    return replace(problem, vehicle_types=types)


def with_one_way_streets(size: int) -> Problem:
    """Return one whose legs take longer uphill, so that none is longer than a way through others.
    """
    problem = with_windows(size)
    height = np.random.default_rng(3).integers(0, 10**5, problem.num_nodes)
    climb = np.maximum(0, height - height[:, None])
    travel = tuple(Travel(*(legs + climb for legs in each.arrays())) for each in problem.travel)
    return replace(problem, travel=travel)


def with_legs_stated_anyhow(size: int) -> Problem:
    """Return one where many a direct leg is longer than the way through a customer."""
    problem = with_windows(size)
    drawn = np.random.default_rng(3)
    shape = (problem.num_nodes, problem.num_nodes)
    longer = np.where(drawn.random(shape) < 0.5, 20, 1)
    travel = tuple(Travel(*(legs * longer for legs in each.arrays())) for each in problem.travel)
    return replace(problem, travel=travel)


def on_the_globe(size: int) -> Problem:
    """Return one whose legs are computed."""
    problem = with_windows(size)
    at = np.array([8.5, 47.4]) + np.random.default_rng(4).normal(
        0, 0.1, (problem.num_nodes, 2))
    legs = StraightLegs(Points.geographic(at), 1e3)
    return replace(problem, travel=(Travel.along(legs),))


def both_ways(problem: Problem, each: int) -> Problem:
    """Return a problem where every other customer has something picked up as well, and one in
    `each` nothing delivered.
    """
    return replace(problem, customers=tuple(
        replace(customer, pickup=customer.demand if number % 2 or not number % each else (0,),
                demand=customer.demand if number % each else (0,))
        for number, customer in enumerate(problem.customers)))


def with_loads_both_ways(size: int) -> Problem:
    """Return one with several types and loads both ways."""
    return both_ways(with_several_types(size), 3)


def with_pickups(size: int) -> Problem:
    """Return one with loads both ways and vehicles of one type."""
    return both_ways(with_windows(size), 3)


def with_pickups_last(size: int) -> Problem:
    """Return one where each trip delivers something first, then picks up."""
    problem = with_pickups(size)
    return replace(problem, vehicle_types=tuple(
        replace(kind, pickups="last") for kind in problem.vehicle_types))


def with_many_dimensions(size: int) -> Problem:
    """Return one with windows where what is scarce is the last of five dimensions."""
    problem = with_windows(size)
    return replace(
        problem, amount_decimals=problem.amount_decimals * 5,
        customers=tuple(replace(each, demand=(1, 0, 0, 0, *each.demand))
                                 for each in problem.customers),
        vehicle_types=tuple(replace(kind, capacity=(size, 0, 0, 0, *kind.capacity))
                            for kind in problem.vehicle_types))


def with_few_stops(size: int) -> Problem:
    """Return one with several types whose trips have few stops, the more the larger they are."""
    problem = with_several_types(size)
    return replace(problem, vehicle_types=tuple(
        replace(kind, max_stops=3 + number) for number, kind in enumerate(problem.vehicle_types)))


def with_other_legs(size: int) -> Problem:
    """Return one with several types, half of which drive a third farther, now and then less far."""
    problem = with_several_types(size)
    drawn = np.random.default_rng(5).random((problem.num_nodes, problem.num_nodes))
    farther = np.where(drawn < 0.2, 3, 6)
    travel, *_ = (each.arrays() for each in problem.travel)
    other = Travel(*(legs * farther // 4 for legs in travel))
    return replace(problem, travel=(Travel(*travel), other), vehicle_types=tuple(
        replace(kind, travel=number % 2) for number, kind in enumerate(problem.vehicle_types)))


def with_some_dearer(size: int) -> Problem:
    """Return one where somebody has to be left out, which costs more of some than of others."""
    problem = with_few_vehicles(size)
    return replace(problem, customers=tuple(
        replace(each, unassigned_cost=problem.unassigned_cost * (1 + number % 5))
        for number, each in enumerate(problem.customers)))


def begun(problem: Problem, moments: int | None = None) -> tuple[ProblemData, Searcher, Linked]:
    """Return a search that has planned a problem by insertion, its stops linked.

    `moments`: how many changes of times can be noted in a turn.
    """
    data = make_data(problem, pack([problem], legs=False))
    assert can_be_linked(data)
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(3))
    linked = Linked(data, searcher, are_timed(data), moments=moments)
    begin_anew(data, searcher, True, linked=linked)
    searcher.value.temperature = searcher.value.cost / problem.num_customers
    searcher.value.cooling = 1.0
    tie(data, searcher, linked)
    return data, searcher, linked


def routes_of(data: ProblemData, searcher: Searcher, linked: Linked) -> list[list[int]]:
    """Return the customers of all routes as they are, which are written back and linked again."""
    write_back(data, searcher, linked)
    types = [route.vehicle_type for route in read_routes(data, copied(data, searcher))]
    assert (searcher.used == np.bincount(types, minlength=data.num_types)).all()
    tie(data, searcher, linked)
    return served_by(searcher)


@pytest.mark.thorough_after(5)
@pytest.mark.parametrize("make", [
    loads_alone, with_windows, with_few_vehicles, with_two_depots, with_other_shifts,
    with_several_types, with_one_way_streets, with_legs_stated_anyhow, on_the_globe,
    with_loads_both_ways, with_pickups_last, with_many_dimensions, with_few_stops, with_other_legs,
    with_some_dearer])
@pytest.mark.parametrize("size", [40, 420])
def test_links_agree_and_costs_add_up(make, size) -> None:  # type: ignore[no-untyped-def]
    problem = make(size)
    data, searcher, linked = begun(problem)
    everybody = set(range(data.num_depots, data.num_nodes))
    best, left_out, used = float(searcher.value.best), 0, searcher.used.copy()
    for _ in range(BATCHES):
        anneal_linked(data, searcher, linked, TURNS)
        missing = searcher.missing[:searcher.count.missing].tolist()
        assert float(searcher.value.best) <= best
        best, left_out = float(searcher.value.best), left_out + len(missing)
        cost = float(searcher.value.cost)
        served = [node for nodes in routes_of(data, searcher, linked) for node in nodes]
        assert sorted(served + missing) == sorted(everybody)
        # Counted anew from the legs of all routes.
        assert float(searcher.value.cost) == pytest.approx(cost, rel=1e-9)
        assert float(searcher.value.best) == pytest.approx(best, rel=1e-9)
    if make is with_few_vehicles:
        assert left_out > 0
    if make is with_several_types:
        assert (searcher.used != used).any()
    write_back(data, searcher, linked)
    assert check(problem, read_plan(data, searcher)).violations == ()


@pytest.mark.parametrize("make", [
    loads_alone, with_windows, with_several_types, with_one_way_streets, with_legs_stated_anyhow,
    with_pickups])
@pytest.mark.parametrize("moments", [None, 3])
def test_what_is_refused_leaves_no_trace(make, moments) -> None:  # type: ignore[no-untyped-def]
    # With three moments, fewer times can be noted than a turn changes.
    problem = make(120)
    data, searcher, linked = begun(problem, moments)
    for _ in range(5):
        anneal_linked(data, searcher, linked, TURNS)
    routes = routes_of(data, searcher, linked)
    runs, cost = searcher.cost.copy(), float(searcher.value.cost)
    temperature = float(searcher.value.temperature)
    # No plan is cheaper by so much, and nothing is given up before all are inserted.
    searcher.value.temperature = -1e12
    whole_turns = data._replace(strategy=data.strategy._replace(give_up_early=False))
    anneal_linked(whole_turns, searcher, linked, 200)
    assert sorted(routes_of(data, searcher, linked)) == sorted(routes)
    assert sorted(searcher.cost) == sorted(runs)
    assert float(searcher.value.cost) == pytest.approx(cost, rel=1e-9)
    # Times are as they were, or later turns break windows.
    anneal_linked(whole_turns, searcher, linked, 200)
    searcher.value.temperature = temperature
    anneal_linked(data, searcher, linked, 200)
    write_back(data, searcher, linked)
    assert check(problem, read_plan(data, searcher)).violations == ()


def test_turns_by_turns_are_the_same_again() -> None:
    plans = []
    for _ in range(2):
        data, searcher, linked = begun(with_windows(60))
        anneal_linked(data, searcher, linked, 500)
        write_back(data, searcher, linked)
        plans.append(read_plan(data, searcher))
    assert plans[0] == plans[1]


@pytest.mark.parametrize(("stops", "longer"), [(60, True), (12, False)])
def test_strings_grow_on_long_routes_alone(stops: int, longer: bool) -> None:
    problem = loads_alone(240)
    (kind,) = problem.vehicle_types
    carried = sum(each.demand[0] for each in problem.customers)
    problem = replace(problem, vehicle_types=(
        replace(kind, capacity=(carried * stops // problem.num_customers,)),))
    plans = []
    for longest in (10.0, 20.0):
        data, searcher, linked = begun(problem)
        searcher.value.longest = longest
        anneal_linked(data, searcher, linked, 300)
        write_back(data, searcher, linked)
        plans.append(read_plan(data, searcher))
    assert (plans[0] != plans[1]) == longer


def test_plans_are_sound_whatever_legs_are_stated() -> None:
    problem = with_legs_stated_anyhow(30)
    found = improve(problem, pack([problem]), Solution((), tuple(range(1, 31))),
                    SearchConfig(seed=1, turns=20_000))
    assert check(problem, found.solution).violations == ()
    assert len(found.solution.unassigned) < 30
