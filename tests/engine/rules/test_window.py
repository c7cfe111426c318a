"""Tests of the engine's meaning of windows against the judge's, and of its inverses."""

import numpy as np
import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.engine.instance import pack
from model.engine.records import Records
from model.problem import MS_PER_HOUR, UNLIMITED, Problem
from model.solution import Route, Solution
from tests.engine.rules.asking import asked
from tests.model.tiny import MINUTE, draw_tiny, with_gaps

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


def times(place: Records, arrival: int) -> tuple[int, ...]:
    return asked("service_at", 5, place, len(place), arrival)


def last_arrivals(place: Records, arrival: int, leave: int) -> tuple[int, ...]:
    return asked("last_arrivals", 4, place, len(place), arrival, leave)


def within_block(place: Records, time: int, d: int, c: int) -> tuple[int, ...]:
    return asked("within_block", 4, place, len(place), time, d, c)


def window(place: Records, arrival: int) -> int:
    return asked("window_of", 1, place, len(place), arrival)[0]


def extent(place: Records) -> tuple[int, ...]:
    return asked("extent_of", 2, place, len(place))


def drawn(seed: int, count: int = 150) -> list[tuple[Problem, int, Records, int]]:
    """Return problems, one customer's node and rows in each, and an instant."""
    rng = np.random.default_rng(seed)
    found: list[tuple[Problem, int, Records, int]] = []
    for _ in range(count):
        problem = draw_tiny(rng)
        if len(found) % 2:
            problem = with_gaps(rng, problem)
        node = int(rng.integers(problem.num_depots, problem.num_nodes))
        found.append((problem, node, pack([problem]).node[0, 0, node],
                      int(rng.integers(0, 70)) * MINUTE))
    return found


def visit(problem: Problem, node: int, start: int) -> Route:
    """Return a truck's trip to one customer, as the judge times it."""
    depot = problem.vehicle_types[0].depot
    decision = TripDecision((depot, node, depot), start=start)
    return schedule(problem, RouteDecision(0, 0, (decision,)))


def leaves_by(place: Records, arrival: int, leave: int) -> bool:
    """Tell whether an arrival is allowed and lets a truck leave by an instant."""
    _, end, _, _, forbidden = times(place, arrival)
    return end <= leave and not forbidden


def test_service_begins_and_ends_when_the_judge_says() -> None:
    for problem, node, place, start in drawn(seed=1):
        stop = visit(problem, node, start).trips[0].stops[1]
        begin, end, wait, _, _ = times(place, stop.arrival)
        assert (begin, end) == (stop.service_start, stop.departure)
        assert wait == stop.service_start - stop.arrival


def test_an_arrival_is_late_or_too_late_when_the_judge_says() -> None:
    hard = soft = 0
    for problem, node, place, start in drawn(seed=2):
        route = visit(problem, node, start)
        others = tuple(other for other in range(problem.num_depots, problem.num_nodes)
                       if other != node)
        judged = check(problem, Solution((route,), others))
        _, _, _, late, forbidden = times(place, route.trips[0].stops[1].arrival)
        customer = problem.customer_at(node)
        rate = customer.late_cost_per_hour
        assert forbidden == any(v.code == "TIME_WINDOW" for v in judged.violations)
        assert forbidden == (late > 0 and rate is None)
        assert judged.cost.lateness == pytest.approx(
            0.0 if rate is None or not late else late / MS_PER_HOUR * rate + customer.late_cost)
        hard, soft = hard + forbidden, soft + (judged.cost.lateness > 0)
    assert hard > 10 < soft


def test_last_arrivals_are_the_last_ones_that_will_do() -> None:
    for _, _, place, arrival in drawn(seed=4):
        leave = arrival + 5 * MINUTE
        late, latest, free, same = last_arrivals(place, arrival, leave)
        allowed = times(place, arrival)[3]
        assert times(place, late)[3] <= allowed < times(place, late + 1)[3]
        if times(place, 0)[1] <= leave:
            assert leaves_by(place, latest, leave)
            assert not leaves_by(place, latest + 1, leave)
            assert free == min(late, latest) or times(place, free)[4]
        windows = {times(place, other)[0]
                   for other in range(arrival, min(same, 120 * MINUTE) + 1, MINUTE)
                   if times(place, other)[2] > 0}
        assert len(windows) <= 1
        assert same == late or times(place, same + 1)[2] > 0


def test_a_pair_stands_for_all_arrivals_at_the_beginning_of_a_block() -> None:
    rng = np.random.default_rng(5)
    for _, _, place, time in drawn(seed=5):
        d, c = (int(value) * MINUTE for value in rng.integers(0, 40, 2))
        if times(place, c)[4]:
            continue
        start_d, start_c, first, last = within_block(place, time, d, c)
        serving = window(place, max(time + d, c))
        for other in range(0, 80 * MINUTE, 5 * MINUTE):
            arrival = max(other + d, c)
            begin, _, _, _, forbidden = times(place, arrival)
            allowed = not forbidden and window(place, arrival) == serving
            assert (first <= other <= last) == allowed
            if allowed:
                assert max(other + start_d, start_c) == begin


def test_windows_are_as_wide_as_they_are_stated() -> None:
    for problem, node, place, _ in drawn(seed=6):
        customer = problem.customer_at(node)
        between = sum(opens - closes for closes, opens in customer.gaps)
        assert extent(place) == (customer.latest, customer.latest - customer.earliest - between)
    assert UNLIMITED in {extent(place)[0] for _, _, place, _ in drawn(seed=6)}
