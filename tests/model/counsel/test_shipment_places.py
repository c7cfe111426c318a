"""Where whole shipments fit plans, and what they cost elsewhere, against all ways there are."""

import math
import time
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import count, product

import numpy as np
import pytest

from model.counsel import binding
from model.counsel.alternatives import find_alternatives, here_of
from model.counsel.bench import Bench
from model.counsel.binding import find_binding
from model.counsel.fitting import find_fits, new_violations
from model.judge.check import check
from model.judge.ends import with_ends
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import read_route, time_route
from model.judge.timing import RouteDecision, SortieDecision, TripDecision
from model.problem import Problem, Shipment
from model.solution import Solution
from tests.model.search.mixed_days import with_missing_legs
from tests.model.tiny import draw_tiny, with_gaps, with_table
from tests.model.tiny_shipments import with_flown_parts, with_flown_shipments, with_shipments
from tests.seeds import seeds


def bench_of(problem: Problem, solution: Solution, node: int) -> Bench:
    return Bench(problem, solution, node, shipment=problem.shipment_at.get(node))


def greedy(problem: Problem) -> Solution:
    """Serve everyone, shipments as wholes, where it costs least, one after another."""
    solution = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    for node in range(problem.num_depots, problem.num_nodes):
        if problem.unit_of(node) == node and node in solution.unassigned:
            best, = find_fits(bench_of(problem, solution, node), 1).places[:1] or [None]
            if best is not None and best.trial.evaluation.is_feasible:
                solution = best.trial.solution
    return solution


def with_stop(trip: TripDecision, place: int, node: int) -> TripDecision:
    return replace(trip, operations=None, nodes=(*trip.nodes[:place], node, *trip.nodes[place:]),
                   sorties=tuple([replace(
                       each, launch_stop=each.launch_stop + (each.launch_stop >= place),
                       recovery_stop=each.recovery_stop + (each.recovery_stop >= place))
                       for each in trip.sorties]))


def ways(problem: Problem, kind: int, trip: TripDecision,
         nodes: tuple[int, ...]) -> Iterator[TripDecision]:
    """Yield a trip with some ends more, by truck and by its drones, in all ways."""
    if not nodes:
        yield trip
        return
    node, *others = nodes
    left = tuple(others)
    for place in range(1, len(trip.nodes)):
        yield from ways(problem, kind, with_stop(trip, place, node), left)
    if problem.customer_at(node).served_by == "truck":
        return
    vehicles = problem.vehicle_types[kind]
    numbers, places = range(vehicles.num_drones), range(len(trip.nodes))
    for drone, launch, recovery in product(numbers, places, places):
        if launch <= recovery <= launch + 1:
            own = SortieDecision((node,), launch, recovery, drone)
            yield from ways(problem, kind, replace(
                trip, operations=None, sorties=(*trip.sorties, own)), left)
    for index, sortie in enumerate(trip.sorties):
        for visit in range(len(sortie.nodes) + 1):
            flown = replace(sortie, nodes=(*sortie.nodes[:visit], node, *sortie.nodes[visit:]))
            sorties = (*trip.sorties[:index], flown, *trip.sorties[index + 1:])
            yield from ways(problem, kind, replace(trip, sorties=sorties), left)


def routes(problem: Problem, solution: Solution,
           nodes: tuple[int, ...]) -> Iterator[tuple[int, RouteDecision]]:
    """Yield a plan's route with some nodes more, and its index, in all ways."""
    used = [read_route(problem, route) for route in solution.routes]
    for index, kind in enumerate(problem.vehicle_types):
        taken = {each.vehicle for each in used if each.vehicle_type == index}
        used += [RouteDecision(index, number, ()) for number in range(kind.count)
                 if number not in taken][:1]
    for place, decision in enumerate(used):
        index = min(place, len(solution.routes))
        kind = problem.vehicle_types[decision.vehicle_type]
        for number, trip in enumerate(decision.trips):
            for way in ways(problem, decision.vehicle_type, trip, nodes):
                trips = (*decision.trips[:number], way, *decision.trips[number + 1:])
                yield index, replace(decision, trips=trips)
        if len(decision.trips) < kind.max_trips:
            for number in range(len(decision.trips) + 1):
                empty = TripDecision((kind.begins_at, kind.ends_at))
                for way in ways(problem, decision.vehicle_type, empty, nodes):
                    trips = (*decision.trips[:number], way, *decision.trips[number:])
                    yield index, replace(decision, trips=with_ends(kind, trips))


def cheapest(problem: Problem, solution: Solution, shipment: Shipment) -> float:
    """Return the lowest cost at which a plan has a shipment more, by all ways there are."""
    best = math.inf
    unassigned = tuple([node for node in solution.unassigned if node not in shipment.nodes])
    for index, decision in routes(problem, solution, shipment.nodes):
        timed = time_route(problem, decision, "", EVERYTHING_OPEN)
        if not timed.judged.violations:
            plan = Solution((*solution.routes[:index], timed.route, *solution.routes[index + 1:]),
                            unassigned)
            evaluation = check(problem, plan)
            if evaluation.is_feasible:
                best = min(best, evaluation.cost.total)
    return best


@pytest.mark.parametrize("seed", seeds(24))
def test_the_best_offer_is_the_best_of_all(seed: int) -> None:
    rng = np.random.default_rng(seed)
    problem = (with_flown_shipments if seed % 3 == 2 else with_shipments)(rng, draw_tiny(rng))
    problem = with_gaps(rng, problem, 0.3) if seed % 4 == 1 else problem
    problem = with_table(rng, problem) if seed % 4 == 3 else problem
    solution = greedy(problem)
    assert check(problem, solution).is_feasible
    for shipment in problem.shipments:
        left_out = bench_of(problem, solution, shipment.pickup).left_out.solution
        assert {*shipment.nodes} <= {*left_out.unassigned}
        bench = bench_of(problem, left_out, shipment.pickup)
        fits = find_fits(bench, 3)
        assert fits.is_complete
        best = fits.places[0].trial
        assert best.evaluation == check(problem, best.solution)
        lowest = cheapest(problem, left_out, shipment)
        if lowest < math.inf:
            assert not new_violations(bench, best)
            assert best.evaluation.cost.total <= lowest + 1e-9
        else:
            assert new_violations(bench, best) or seed % 3 == 2


def test_the_best_offer_may_be_flown_on_from_the_pickup() -> None:
    rng = np.random.default_rng(18)
    problem = with_flown_shipments(rng, draw_tiny(rng))
    solution, on = greedy(problem), 0
    for shipment in problem.shipments:
        left_out = bench_of(problem, solution, shipment.pickup).left_out.solution
        bench = bench_of(problem, left_out, shipment.pickup)
        best = find_fits(bench, 1).places[0].trial
        assert best.evaluation == check(problem, best.solution)
        assert best.evaluation.cost.total <= cheapest(problem, left_out, shipment) + 1e-9
        on += best.place is not None and any(place.flown_on for _, place in best.place.ends)
    assert on > 0


@pytest.mark.parametrize("seed", [6, 7])
def test_what_breaks_only_because_a_shipment_is_missed_excuses_no_place(seed: int) -> None:
    """Between those who are beside an end there may be no way."""
    rng = np.random.default_rng(seed)
    problem = with_missing_legs(rng, with_shipments(rng, draw_tiny(rng)))
    solution = greedy(problem)
    assert check(problem, solution).is_feasible
    for shipment in problem.shipments:
        bench = bench_of(problem, solution, shipment.pickup)
        for place in find_fits(bench, 5).places if bench.found else ():
            broken = new_violations(bench, place.trial)
            assert bool(broken) != place.trial.evaluation.is_feasible


@pytest.mark.parametrize("seed", seeds(12))
def test_what_else_could_be_done_is_what_the_judge_says(seed: int) -> None:
    rng = np.random.default_rng(100 + seed)
    problem = (with_shipments, with_flown_shipments, with_shipments,
               with_flown_parts)[seed % 4](rng, draw_tiny(rng))
    problem = with_gaps(rng, problem, 0.5)
    solution = greedy(problem)
    for shipment in problem.shipments:
        bench = bench_of(problem, solution, shipment.pickup)
        found = find_alternatives(bench)
        for each in found.alternatives:
            assert (each.window is None) == (each.node is None)
            if each.node is None:
                assert each.trial.evaluation == check(problem, each.trial.solution)
        here = here_of(bench)
        assert (here is None) == (bench.found is None)
        if here is not None:
            back = bench.put(here)
            stay = not any(trip.sorties for route in solution.routes for trip in route.trips)
            assert not stay or (back.evaluation.cost.total
                                <= bench.plan.evaluation.cost.total + 1e-9)
            kinds = [each.kind for each in found.alternatives]
            assert kinds[-1] == "unassigned"
        cost = min([bench.plan, *[each.trial for each in found.alternatives if each.node is None]],
                   key=lambda trial: trial.rank).evaluation.cost.total
        for bound in find_binding(bench, found)[0]:
            assert 0 <= bound.saves_per_unit <= cost + 1e-9


@pytest.mark.parametrize("seed", [0, 2, 5])
def test_little_time_has_the_likeliest_places_looked_at_and_tried(
        seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """By a clock that goes on by one whenever it is read."""
    rng = np.random.default_rng(seed)
    problem = (with_flown_shipments if seed % 3 == 2 else with_shipments)(rng, draw_tiny(rng))
    solution = greedy(problem)
    shipment = problem.shipments[0]
    bench = bench_of(problem, solution, shipment.pickup)
    whole, every = find_fits(bench, 3), bench.guesses()
    num_guesses = sum(map(len, every.values()))
    for read in (5, 10, 20, 40, 80, 20 * num_guesses):
        clock = count()
        monkeypatch.setattr(time, "perf_counter", partial(next, clock))
        cut = bench.guesses(until=read)
        looked = next(clock)
        found = find_fits(bench, 3, looked + read)
        over = next(clock) - looked - read
        others = find_alternatives(bench, 0)
        limits = find_binding(bench, others, 0)
        monkeypatch.undo()
        assert looked <= read + len(problem.vehicle_types) + 9
        assert all({*some} <= {*every[group]} for group, some in cut.items())
        assert over <= 5
        assert found == whole if found.is_complete else read < 20 * num_guesses
        assert (limits, others.is_complete) == (((), False), False)


def test_looking_for_where_a_shipment_is_leaves_time_to_find_what_binds(
        monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(0)
    problem = with_shipments(rng, draw_tiny(rng))
    bench = bench_of(problem, greedy(problem), problem.shipments[0].pickup)
    found, asked = find_alternatives(bench), list[float]()
    monkeypatch.setattr(binding, "here_of", lambda _, until: asked.append(until))
    begun = time.perf_counter()
    find_binding(bench, found, begun + 1000)
    assert [begun + 490 < until < begun + 750 for until in asked] == [True]
