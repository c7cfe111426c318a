"""What the search says of places, against what the judge says of each."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import chain

import numpy as np
import pytest

from model.counsel.bench import Bench, Drafted
from model.judge.places import Means
from model.problem import Problem
from model.search.priced_places import PlacePrices
from model.solution import Vehicle
from tests.model.counsel.test_shipment_places import bench_of, greedy
from tests.model.tiny import draw_tiny, with_gaps, with_table
from tests.model.tiny_shipments import with_flown_parts, with_flown_shipments, with_shipments
from tests.seeds import seeds

Change = Callable[[np.random.Generator, Problem], Problem]

CHANGES: tuple[Change, ...] = (
    lambda _, problem: problem, with_shipments, with_flown_shipments, with_flown_parts, with_gaps,
    with_table)


def benches(seed: int) -> Iterator[Bench]:
    """Yield what tries each customer and shipment of a plan elsewhere in it."""
    rng = np.random.default_rng(seed)
    problem = CHANGES[seed % len(CHANGES)](rng, draw_tiny(rng))
    solution = greedy(problem)
    for node in range(problem.num_depots, problem.num_nodes):
        if problem.unit_of(node) == node:
            yield bench_of(problem, solution, node)


def known_to_search(bench: Bench) -> set[Vehicle]:
    """Return the vehicles in use whose routes keep the rules as the search times them."""
    plan = bench.left_out.solution
    known = PlacePrices(bench.problem, plan).routes
    return {route.driven_by for index, route in enumerate(plan.routes)
            if index in known}


def as_told(bench: Bench, draft: Drafted) -> Drafted:
    return bench.as_searched(draft) if draft.timed.judged.violations else draft


@pytest.mark.thorough_after(8)
@pytest.mark.parametrize("seed", seeds(90))
def test_the_search_offers_what_is_legal_and_among_it_what_costs_least(seed: int) -> None:
    for bench in benches(seed):
        best: dict[tuple[Vehicle, Means], float] = {}
        for group, some in (bench.offers() or {}).items():
            assert [each.cost for each in some] == sorted(each.cost for each in some)
            drafts = [as_told(bench, bench.draft(each.place)) for each in some]
            assert not any(draft.timed.judged.violations for draft in drafts)
            best[group] = min(draft.added for draft in drafts)
        for group, guesses in bench.guesses(wanted=known_to_search(bench).__contains__).items():
            drafts = [bench.draft(guess.place) for guess in guesses]
            legal = [draft.added for draft in drafts if not draft.timed.judged.violations]
            # Of flights the judge may see some that the search doesn't.
            if legal and not bench.problem.vehicle_types[group[0].type].num_drones:
                assert best[group] <= min(legal) + 1e-9


@pytest.mark.parametrize("seed", seeds(60))
def test_the_search_prices_places_by_truck_as_the_judge_does(seed: int) -> None:
    """Where windows are hard and nothing flies: else it may see other times than the judge."""
    rng = np.random.default_rng(seed)
    problem = with_shipments(rng, draw_tiny(rng, drone_share=0.0))
    problem = replace(problem, customers=tuple([
        replace(each, late_cost_per_hour=None, late_cost=0.0, early_cost_per_hour=0.0)
        for each in problem.customers]))
    solution = greedy(problem)
    for node in range(problem.num_depots, problem.num_nodes):
        if problem.unit_of(node) == node:
            bench = bench_of(problem, solution, node)
            for each in chain.from_iterable((bench.offers() or {}).values()):
                assert bench.as_searched(bench.draft(each.place)).added == pytest.approx(each.cost)
