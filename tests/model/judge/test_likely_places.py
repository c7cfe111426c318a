"""Where breaks are put on routes with too many places to try all."""

import random
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from model.judge import placing
from model.judge.breaks import ON_A_LEG, BreakDecision, broken_breaks
from model.judge.placing import with_due_breaks
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import (
    UNLIMITED, Break, Customer, Depot, Problem, Travel, VehicleType,
)
from model.solution import Route

MINUTE = 60_000


def best_of_all(problem: Problem, decision: RouteDecision, number: int) -> tuple[int, int]:
    """Return the lateness and the end of a route with a break at the best of all its places."""
    kind, found = problem.vehicle_types[0], []
    for index, trip in enumerate(decision.trips):
        for stop, place in product(range(len(trip.nodes) - 1), ON_A_LEG):
            more = replace(trip, breaks=(BreakDecision(number, stop, place),))
            route = schedule(problem, replace(decision, trips=(
                *decision.trips[:index], more, *decision.trips[index + 1:])))
            if not any(broken_breaks(problem, kind, route.trips)):
                found.append(told(problem, route))
    return min(found)


def told(problem: Problem, route: Route) -> tuple[int, int]:
    """Return how late customers are served on a route, and when it ends."""
    return sum([max(0, stop.service_start - problem.customer_at(stop.node).latest)
                for trip in route.trips for stop in trip.customer_stops]), (
        route.trips[-1].stops[-1].departure)


@pytest.mark.parametrize("seed", range(6))
def test_the_best_place_of_a_break_is_found_on_routes_too_long_to_try_all(seed: int) -> None:
    problem, decision = long_day(random.Random(seed), 70)
    placed = with_due_breaks(problem, decision)
    assert sum(len(trip.breaks) for trip in placed.trips) == 1
    assert told(problem, schedule(problem, placed)) == best_of_all(problem, decision, 0)


def test_placing_breaks_on_a_long_route_times_it_a_few_times(
        monkeypatch: pytest.MonkeyPatch) -> None:
    problem, decision = long_day(random.Random(1), 300, 8)
    timed = list[RouteDecision]()

    def counted(problem: Problem, decision: RouteDecision) -> Route:
        timed.append(decision)
        return schedule(problem, decision)

    monkeypatch.setattr(placing, "schedule", counted)
    placed = with_due_breaks(problem, decision)
    assert sum(len(trip.breaks) for trip in placed.trips) == 8
    assert len(timed) <= 8 * (1 + placing.MOST_TIMED_STOPS // 300)


def long_day(rng: random.Random, number: int, breaks: int = 1) -> tuple[Problem, RouteDecision]:
    """Return many customers in a row, some with windows, on two trips with breaks anywhere."""
    places = np.cumsum([rng.randrange(1, 3) * MINUTE for _ in range(number + 1)])
    duration = np.abs(places[:, None] - places).astype(np.int64)
    customers = []
    for node in range(1, number + 1):
        opens = int(places[node]) + rng.randrange(5) * MINUTE
        is_timed = breaks == 1 and rng.random() < 0.2
        customers.append(Customer(
            f"c{node}", (0,), earliest=opens if is_timed else 0,
            latest=opens + 60 * MINUTE if is_timed else UNLIMITED))
    kind = VehicleType("truck", 1, (0,), 0, max_trips=2, breaks=tuple([
        Break(f"b{hour}", 5 * MINUTE, (20 + 30 * hour) * MINUTE, (60 + 30 * hour) * MINUTE,
              anywhere=True) for hour in range(breaks)]))
    problem = Problem((Depot("d"),), tuple(customers), (kind,), (Travel(duration, duration),),
                      np.zeros((number + 1, 2)), 100.0)
    half = number // 2
    return problem, RouteDecision(0, 0, (TripDecision((0, *range(1, half), 0)),
                                         TripDecision((0, *range(half, number + 1), 0))))
