"""Rests are placed as brute force does, and all plans keep driving rules by two judges."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations_with_replacement, pairwise, permutations, product

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.breaks import BreakDecision, window_of
from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import (
    FULL_SPEED, REST, UNLIMITED, DrivingRules, DroneType, Problem, SpeedProfile, VehicleType,
)
from model.search.improve import SearchConfig, improve
from model.policy.extract import extract
from model.solution import Solution
from benchmarks.quality.driving_law import Law, offences
from tests.model.rollouts import roll
from tests.model.tiny import draw_tiny, with_drone_types, with_gaps, with_setups
from tests.model.tiny_breaks import short_day, with_breaks
from tests.model.tiny_driving import drawn_rules, with_driving
from tests.model.tiny_shipments import with_shipments

pytestmark = pytest.mark.slow

MINUTE = 60_000


def drawn(rng: np.random.Generator) -> Problem:
    """Draw two customers with windows, and one truck whose driver has to rest."""
    return short_day(rng, lambda truck: replace(
        truck, driving=drawn_rules(rng), max_travel_duration=int(rng.integers(4, 40)) * MINUTE))


def with_paid_breaks(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return the same, whose driver may have breaks, too."""
    kind, = with_breaks(rng, problem).vehicle_types
    breaks = tuple([replace(each, paid=True, max_load=None) for each in kind.breaks])
    return replace(problem, vehicle_types=(replace(kind, breaks=breaks),))


State = tuple[int, int, int, int, bool, int]
"""Leg, minutes of it that are driven, driven and worked since the last rest, half rested, and the
first break that may come next."""


def soonest_end(problem: Problem, nodes: tuple[int, ...], start: int) -> float:
    """Return when a route that begins then ends at best, minute by minute; infinite if never."""
    kind = problem.vehicle_types[0]
    rules = kind.driving
    assert rules is not None
    limits = (rules.max_driving // MINUTE, rules.max_work // MINUTE)
    legs = [problem.travel[0].duration.item(*leg) // MINUTE
            for leg in pairwise(nodes)]
    if (rules.driven_before // MINUTE + sum(legs) > rules.max_driving_per_day // MINUTE
            or sum(legs) * MINUTE > (kind.max_travel_duration or 0)):
        return np.inf
    first = (0, 0, rules.driven_before // MINUTE, rules.worked_before // MINUTE,
             rules.half_rested_before, 0)
    at: dict[int, set[State]] = {start: {first}}
    for now in range(start, 61):
        while at.get(now):
            state = at[now].pop()
            for length, then in (*_next(problem, nodes, legs, now, state),
                                 *_breaks(kind, legs, start, now, state)):
                if then[2] <= limits[0] and then[3] <= limits[1]:
                    if then[0] == len(legs):
                        if not _any_due(kind, then[5], start, now + length):
                            return now + length
                        continue
                    if now + length <= 60:
                        at.setdefault(now + length, set()).add(then)
    return np.inf


def _any_due(kind: VehicleType, number: int, begin: int, end: int) -> bool:
    """Tell whether breaks from a number on should have been taken on a route."""
    return any(window_of(each, begin * MINUTE)[1] < end * MINUTE
               and window_of(each, begin * MINUTE)[0] + each.duration > begin * MINUTE
               for each in kind.breaks[number:])


def _breaks(kind: VehicleType, legs: list[int], begin: int, now: int,
            state: State) -> Iterator[tuple[int, State]]:
    """Yield the breaks that may be taken next, and how long that lasts with waiting."""
    leg, come, driven, worked, half, number = state
    rules = kind.driving
    assert rules is not None
    for index, each in enumerate(kind.breaks[number:], number):
        earliest, latest = (instant // MINUTE for instant in window_of(each, begin * MINUTE))
        start = max(now, earliest)
        if start > latest or _any_due(replace(kind, breaks=kind.breaks[number:index]), 0, begin,
                                      999):
            continue
        if not (each.anywhere or come in (0, legs[leg])):
            continue
        if worked + start - now > rules.max_work // MINUTE:
            continue
        paused = worked + start - now + each.duration // MINUTE
        then = (leg, come, driven, paused, half, index + 1)
        if each.duration >= rules.rest or (half and each.duration >= rules.split[1]):
            then = leg, come, 0, 0, False, index + 1
        elif rules.split and each.duration >= rules.split[0]:
            then = leg, come, driven, worked + start - now, True, index + 1
        yield start - now + each.duration // MINUTE, then


def _next(problem: Problem, nodes: tuple[int, ...], legs: list[int], now: int,
          state: State) -> list[tuple[int, State]]:
    """Return what may be done next, and for how long."""
    leg, come, driven, worked, half, number = state
    rules = problem.vehicle_types[0].driving
    assert rules is not None
    ways: list[tuple[int, State]]
    if leg == len(legs) - 1 and come == legs[leg]:
        ways = [(0, (leg + 1, 0, driven, worked, half, number))]
    elif come < legs[leg]:
        ways = [(1, (leg, come + 1, driven + 1, worked + 1, half, number))]
    else:
        customer = problem.customers[nodes[leg + 1] - 1]
        ways = [(1, (leg, come, driven, worked + 1, half, number))]
        if customer.earliest <= now * MINUTE <= customer.latest:
            service = customer.service_duration // MINUTE
            stands = rules.other_work_interrupts and customer.service_duration >= rules.rest
            ways.append((service, (leg + 1, 0, 0 if stands else driven, worked + service, half,
                                   number)))
    ways.append((rules.rest // MINUTE, (leg, come, 0, 0, False, number)))
    if rules.split:
        part = rules.split[1 if half else 0] // MINUTE
        ways.append((part, (leg, come, 0, 0, False, number) if half
                     else (leg, come, driven, worked, True, number)))
    return ways


def cheapest(problem: Problem) -> float:
    """Return the cost of the cheapest plan by trying all, begun at every minute."""
    best = 2 * problem.unassigned_cost
    for count in (2, 1):
        for inner in permutations((1, 2), count):
            nodes = (0, *inner, 0)
            driven = sum(problem.travel[0].distance.item(*leg)
                         for leg in pairwise(nodes)) / 1e6
            left_out = (2 - count) * problem.unassigned_cost
            if driven + left_out < best:
                best = min(best, *(
                    driven + left_out + 0.5 * (soonest_end(problem, nodes, start) - start)
                    for start in range(40)))
    return best


@pytest.mark.parametrize(("seed", "beside"), [*product(range(6), [False]), *product(
    range(6, 12), [True])])
def test_search_finds_the_cheapest_plan_with_rests(seed: int, beside: bool) -> None:
    rng = np.random.default_rng(seed)
    problem = with_paid_breaks(rng, drawn(rng)) if beside else drawn(rng)
    found = improve(problem, pack([problem]), Solution((), (1, 2)),
                    SearchConfig(turns=200)).solution
    judged = check(problem, found)
    assert judged.violations == ()
    assert judged.cost.total == pytest.approx(cheapest(problem))


@pytest.mark.parametrize("seed", range(8))
def test_search_finds_the_cheapest_plan_where_service_interrupts_driving(seed: int) -> None:
    rng = np.random.default_rng([seed, 7])
    problem = drawn(rng)
    kind, = problem.vehicle_types
    rules = replace(drawn_rules(rng), split=(), half_rested_before=False, max_work=UNLIMITED,
                    max_driving=int(rng.integers(6, 12)) * MINUTE, max_driving_per_day=UNLIMITED,
                    rest=int(rng.integers(3, 8)) * MINUTE, other_work_interrupts=True)
    problem = replace(
        problem, vehicle_types=(replace(kind, driving=rules,
                                        max_travel_duration=60 * MINUTE),),
        customers=tuple([replace(each, service_duration=int(rng.integers(0, 9)) * MINUTE)
                         for each in problem.customers]))
    found = improve(problem, pack([problem]), Solution((), (1, 2)),
                    SearchConfig(turns=200)).solution
    assert check(problem, found).cost.total == pytest.approx(cheapest(problem))
    rests_by_law(problem, found)


def slowed(seed: int) -> Problem:
    """Draw two customers and a truck whose driver has to rest, and drives slowly at times."""
    rng = np.random.default_rng([seed, 5])
    problem = short_day(rng, lambda truck: replace(truck, driving=replace(
        drawn_rules(rng), split=(), half_rested_before=False)))
    times = tuple((np.cumsum(rng.integers(2, 12, 2)) * MINUTE).tolist())
    factors = tuple([FULL_SPEED // int(share) for share in rng.permutation([1, 2, 4])])
    kind = replace(problem.vehicle_types[0], speed_profile=SpeedProfile(times, factors))
    customers = problem.customers if seed % 2 else tuple([
        replace(each, earliest=0, latest=UNLIMITED) for each in problem.customers])
    return replace(problem, customers=customers, vehicle_types=(kind,))


@pytest.mark.parametrize(("seed", "cheapest"), [
    (7, 14.72), (11, 8.92), (20, 19.34), (34, 75.36), (38, 3.86)])
def test_search_finds_when_to_leave_and_to_rest_by_slow_hours(seed: int, cheapest: float) -> None:
    """Compare with the cheapest of all ways to rest twice that end first, begun at each minute."""
    problem = slowed(seed)
    found = improve(problem, pack([problem]), Solution((), (1, 2)),
                    SearchConfig(turns=100)).solution
    assert check(problem, found).cost.total <= cheapest + 1e-6
    rests_by_law(problem, found)


def with_a_drone(rng: np.random.Generator) -> Problem:
    """Draw a customer for a truck, whose driver has to rest, and one for its drone."""
    problem = short_day(rng, lambda truck: replace(truck, driving=drawn_rules(rng)))
    customers = tuple(replace(each, earliest=0, latest=UNLIMITED, served_by=by)
                      for each, by in zip(problem.customers, ("truck", "drone"), strict=True))
    drones = DroneType(1, (1,), travel=1, endurance=int(rng.integers(5, 30)) * MINUTE,
                       launch_duration=int(rng.integers(0, 2)) * MINUTE,
                       recovery_duration=int(rng.integers(0, 2)) * MINUTE, cost_per_km=0.1)
    kind = replace(problem.vehicle_types[0], drones=drones, cost_per_km=0.1)
    return replace(problem, customers=customers, vehicle_types=(kind,), travel=problem.travel * 2)


def rests_on(problem: Problem, nodes: tuple[int, ...]) -> Iterator[tuple[BreakDecision, ...]]:
    """Yield all ways to rest at most twice on a trip, minute by minute."""
    rules = problem.vehicle_types[0].driving
    assert rules is not None
    places = [(leg, driven) for leg, ends in enumerate(pairwise(nodes))
              for driven in range(0, problem.travel[0].duration.item(*ends) + 1, MINUTE)]
    for count in range(3):
        for where in combinations_with_replacement(places, count):
            for lengths in product((rules.rest, *rules.split), repeat=count):
                before = ((-1, 0), *where)
                yield tuple(
                    BreakDecision(REST, leg, "way", driven - (last[1] if last[0] == leg else 0),
                                  length)
                    for (leg, driven), last, length in zip(where, before, lengths, strict=False))


def cheapest_by_judge(problem: Problem) -> float:
    """Return the cost of the cheapest plan with a flight and at most two rests."""
    best = 2 * problem.unassigned_cost
    for nodes, flown in (((0, 1, 0), (2,)), ((0, 1, 0), ()), ((0, 0), (2,))):
        stops = range(len(nodes))
        ways = [(SortieDecision(flown, *ends),)
                for ends in combinations_with_replacement(stops, 2)] if flown else [()]
        left = tuple({1, 2} - {*nodes, *flown})
        for rests, sorties in product(rests_on(problem, nodes), ways):
            trip = TripDecision(nodes, sorties, breaks=rests)
            judged = check(problem, Solution((
                schedule(problem, RouteDecision(0, 0, (trip,))),), left))
            best = min(best, judged.cost.total if judged.is_feasible else best)
    return best


@pytest.mark.parametrize("seed", [13, 18, 28])
def test_search_finds_the_cheapest_plan_with_rests_while_a_drone_flies(seed: int) -> None:
    problem = with_a_drone(np.random.default_rng(seed))
    found = improve(problem, pack([problem]), Solution((), (1, 2)),
                    SearchConfig(turns=200)).solution
    assert check(problem, found).cost.total == pytest.approx(cheapest_by_judge(problem))
    assert rests_by_law(problem, found) == 1


CHANGES = with_gaps, with_setups, with_drone_types, with_shipments, with_breaks


def mixed(seed: int) -> Problem:
    rng = np.random.default_rng(seed)
    return with_driving(rng, CHANGES[seed % len(CHANGES)](rng, draw_tiny(rng)))


def law_of(rules: DrivingRules) -> Law:
    """Return rules as the law's judge reads them."""
    return Law(rules.max_driving, rules.rest, (rules.split[0], rules.split[1]) if rules.split
               else None, rules.max_driving_per_day, rules.max_work,
               rules.other_work_interrupts)


def rests_by_law(problem: Problem, plan: Solution) -> int:
    """Return how many rests there are in a plan, which is legal by both judges."""
    assert check(problem, plan).violations == ()
    for route in plan.routes:
        rules = problem.vehicle_types[route.vehicle_type].driving
        if rules is not None:
            assert list(offences(route, law_of(rules), rules.driven_before,
                                 rules.worked_before, rules.half_rested_before)) == []
    return sum(taken.number == REST for route in plan.routes for trip in route.trips
               for taken in trip.breaks)


def test_rollouts_and_search_keep_driving_rules() -> None:
    rolled = searched = flown = slow = 0
    for seed in range(120):
        problem = mixed(seed)
        instance, nodes = pack([problem]), range(problem.num_depots, problem.num_nodes)
        rollout = roll([problem], seed).rollouts[0]
        plan = extract(problem, instance, rollout.actions)
        rolled += rests_by_law(problem, plan)
        assert rollout.cost.sum() == pytest.approx(check(problem, plan).cost.total)
        found = improve(problem, instance, Solution((), tuple(nodes)),
                        SearchConfig(turns=100)).solution
        searched += rests_by_law(problem, found)
        flown += inside_flights(found)
        slow += sum(taken.number == REST for each in (plan, found) for route in each.routes
                    if problem.vehicle_types[route.vehicle_type].speed_profile
                    for trip in route.trips for taken in trip.breaks)
    assert rolled > 30
    assert searched > 15
    assert slow > 5
    assert flown > 3


def inside_flights(plan: Solution) -> int:
    """Return how many rests lie in the flight of a drone."""
    return sum(any(sortie.launch_time <= taken.start and taken.end <= sortie.recovery_start
                   for sortie in trip.sorties)
               for route in plan.routes for trip in route.trips for taken in trip.breaks)


def test_driving_rules_that_nobody_needs_change_no_plan() -> None:
    problem = drawn(np.random.default_rng(3))
    kind = problem.vehicle_types[0]
    plans = [improve(other, pack([other]), Solution((), (1, 2)), SearchConfig(turns=300)).solution
             for other in (replace(problem, vehicle_types=(replace(kind, driving=None),)),
                           replace(problem, vehicle_types=(replace(kind, driving=DrivingRules(
                               120 * MINUTE, MINUTE)),)))]
    assert plans[0] == plans[1]
