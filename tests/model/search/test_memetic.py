"""Plans bred from others keep rules, and cost what the judge says."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

import model.search.memetic as memetic
from model.engine.instance import pack
from model.engine.library import call
from model.judge.check import check
from model.problem import IntArray
from model.search.improve import SearchConfig, improve
from model.search.limits import Cooling
from model.search.route.layout import NOWHERE, ProblemData
from model.search.route.state import Searcher
from model.solution import Solution
from tests.model.search.found import copied, nodes_of, read_plan
from tests.model.search.test_ejection import ROUNDS, begun
from tests.model.search.test_fewer_vehicles import planted


def as_it_is(data: ProblemData, searcher: Searcher) -> Solution:
    """Return the plan as it is."""
    return read_plan(data, copied(data, searcher))


def test_a_plan_bred_from_itself_is_that_plan() -> None:
    data, searcher = begun(planted(0, 4, True))
    nodes, before = nodes_of(searcher), as_it_is(data, searcher)
    for _ in range(20):
        assert call("tandem_exchange_routes", data, searcher, nodes, nodes)
        after = as_it_is(data, searcher)
        assert {route.trips for route in after.routes} == {route.trips for route in before.routes}


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize("seed", range(4))
def test_plans_bred_from_two_keep_rules_and_serve_all_in_the_end(seed: int) -> None:
    problem = planted(seed, 4, True)
    data, searcher = begun(problem)
    one, used = nodes_of(searcher), int(searcher.count.active)
    call("tandem_move_shipments", data, searcher, 400, False)
    other, found = nodes_of(searcher), set[float]()
    for _ in range(40):
        assert call("tandem_exchange_routes", data, searcher, one, other)
        plan = as_it_is(data, searcher)
        evaluation = check(problem, plan)
        assert evaluation.violations == ()
        assert evaluation.cost.total == pytest.approx(float(searcher.value.cost))
        assert len(plan.routes) <= used
        assert len(plan.unassigned) == 2 * searcher.count.missing
        if searcher.count.missing:
            call("tandem_eject", data, searcher, ROUNDS, True)
        assert check(problem, as_it_is(data, searcher)).violations == ()
        found.add(float(searcher.value.cost))
    assert len(found) > 5


def test_routes_come_from_both_plans() -> None:
    problem = planted(1, 4, True)
    data, searcher = begun(problem)
    one = nodes_of(searcher)
    call("tandem_move_shipments", data, searcher, 400, False)
    other = nodes_of(searcher)
    whole = [{tuple(route) for route in _routes(nodes)} for nodes in (one, other)]
    kept = np.zeros(2, np.int64)
    for _ in range(40):
        call("tandem_exchange_routes", data, searcher, one, other)
        made = {tuple(route) for route in _routes(nodes_of(searcher))}
        kept += [bool(made & routes) for routes in whole]
    assert (kept > 0).all()


def _routes(nodes: IntArray) -> Iterator[list[int]]:
    ends = np.flatnonzero(nodes == NOWHERE)
    for begin, end in zip([0, *(ends + 1)], ends, strict=False):
        yield nodes[begin:end].tolist()


def test_searches_breed_and_begin_once_more(monkeypatch: pytest.MonkeyPatch) -> None:
    problem, bred, started = planted(1, 4, True), list[Cooling](), list[float]()
    breed, start = memetic._Breeder.children, memetic._Breeder.start

    def record(breeder: memetic._Breeder, start_share: float) -> Iterator[Cooling]:
        for span in breed(breeder, start_share):
            bred.append(span)
            yield span

    def record_start(breeder: memetic._Breeder, end: float, elsewhere: bool) -> Iterator[Cooling]:
        started.append(end)
        yield from start(breeder, end, elsewhere)

    monkeypatch.setattr(memetic._Breeder, "children", record)
    monkeypatch.setattr(memetic._Breeder, "start", record_start)
    for name, value in (("TURNS_A_START", 5), ("TURNS_A_CHILD", 1), ("MOST_IN_VAIN", 5)):
        monkeypatch.setattr(memetic, name, value)
    nobody = Solution((), tuple(range(1, problem.num_nodes)))
    config = SearchConfig(turns=8000, seed=2)
    # Both are the same, as turns alone count.
    found, again = (improve(problem, pack([problem]), nobody, config) for _ in range(2))
    assert check(problem, found.solution).violations == ()
    assert found.solution == again.solution
    assert len(bred) > 10
    assert started[-1] > memetic.STARTS_UNTIL
    assert found.turns == config.turns


@pytest.mark.thorough
def test_breeding_ends_where_exchanges_bring_no_other_plan(monkeypatch: pytest.MonkeyPatch) -> None:
    tight, cross, number = planted(1, 4, True), memetic._Breeder._cross, 0

    def count(breeder: memetic._Breeder, one: memetic._Plan, other: memetic._Plan,
              span: Cooling) -> bool:
        nonlocal number
        number += 1
        return cross(breeder, one, other, span)

    monkeypatch.setattr(memetic._Breeder, "_cross", count)
    # One vehicle has time for all: a route exchanged is the whole of the other plan.
    problem = replace(
        tight, customers=tuple(replace(each, earliest=0, latest=10**9) for each in tight.customers),
        vehicle_types=(replace(tight.vehicle_types[0], count=1, latest=10**9),))
    nobody, turns = Solution((), tuple(range(1, problem.num_nodes))), 20_000
    found = improve(problem, pack([problem]), nobody, SearchConfig(turns=turns, seed=1))
    assert found.turns == turns
    assert 0 < number <= 3 * memetic.MOST_BARREN
