"""Plans changed by hand: customers taken out, until no rule is broken."""

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from operator import gt

from model.judge.check import judge_route
from model.judge.ends import with_ends
from model.judge.past import EVERYTHING_OPEN, Past
from model.judge.rules import Violation
from model.judge.timing import Operation, RouteDecision, SortieDecision, TripDecision
from model.problem import Problem
from model.solution import Route

SINGLE_ROUNDS = 8
"""How often one customer is taken out of a route at a time; then twice as many each time."""

Timing = Callable[[RouteDecision], Route]

Broken = tuple[str, str, tuple[int, ...]]
"""A broken rule whatever else is in the route: code, message, and of which trip and of whom."""

_PLACE = re.compile(r"(?:\.trips\[(\d+)\](?:\.(stops|sorties)\[(\d+)\](?:\.visits\[(\d+)\])?)?)?")


def without(decision: TripDecision, gone: Collection[int]) -> TripDecision:
    """Return a trip without some customers; sorties go with the stops they begin or end at.

    Breaks behind a stop that goes are behind the one before it.
    """
    nodes = decision.nodes
    last = len(nodes) - 1
    stays = [index in (0, last) or node not in gone for index, node in enumerate(nodes)]
    shifted = [sum(stays[:index]) for index in range(len(nodes))]
    flown: dict[int, SortieDecision] = {}
    for number, sortie in enumerate(decision.sorties):
        visits = tuple(node for node in sortie.nodes if node not in gone)
        if visits and stays[sortie.launch_stop] and stays[sortie.recovery_stop]:
            flown[number] = SortieDecision(visits, shifted[sortie.launch_stop],
                                           shifted[sortie.recovery_stop], sortie.drone)
    renumbered = {number: index for index, number in enumerate(flown)}
    operations = decision.operations
    if operations is not None:
        operations = tuple(
            tuple(Operation(renumbered[operation.sortie], operation.is_launch)
                  for operation in group if operation.sortie in renumbered)
            for group, kept in zip(operations, stays, strict=True) if kept)
    kept_nodes = tuple(node for node, kept in zip(nodes, stays, strict=True) if kept)
    breaks = tuple([each._replace(stop=shifted[each.stop] - (not stays[each.stop]))
                    for each in decision.breaks if 0 <= each.stop < last])
    return TripDecision(kept_nodes, tuple(flown.values()), operations, decision.start, breaks,
                        decision.awaited)


def customers_of(problem: Problem, decision: TripDecision) -> list[int]:
    """Return whom a trip serves: the truck's customers in order, then the drones'.

    Among them those who are no more, of negative numbers.
    """
    return [*(node for node in decision.nodes[1:-1] if not problem.is_launch_site(node)),
            *(node for sortie in decision.sorties for node in sortie.nodes)]


def repaired(problem: Problem, decision: RouteDecision, fixed: Collection[int],
             timings: Sequence[Timing], past: Past = EVERYTHING_OPEN,
             excused: Collection[Broken] = ()) -> RouteDecision | None:
    """Return a route without the customers for whom it breaks rules; None if nobody is left.

    Parameters
    ----------
    problem
        Says what the rules are.
    decision
        The route; trips that serve nobody are left out, unless they have begun.
    fixed
        Customers who stay, whatever they break.
    timings
        Ways to time a route, the one that is to be preferred first.
    past
        What has happened.
    excused
        What is broken whoever is taken out, so that nobody is for that.
    """
    step, known = 1, len(past.trips.get(decision.driven_by, ()))
    for round_number in range(len(_customers_of_route(problem, decision)) + 1):
        trips = tuple(trip for number, trip in enumerate(decision.trips)
                      if number < known or customers_of(problem, trip))
        if len(trips) < len(decision.trips):
            trips = with_ends(problem.vehicle_types[decision.vehicle_type], trips)
        decision = replace(decision, trips=trips)
        if not trips:
            return None
        _, violations = _best_timed(problem, decision, timings, past, excused)
        blamed = _blamed(problem, decision, violations, frozenset(fixed))
        if not blamed:
            break
        gone = blamed[:step]
        decision = replace(decision, trips=tuple(without(trip, gone) for trip in trips))
        step *= 1 if round_number < SINGLE_ROUNDS else 2
    return decision


def repaired_route(problem: Problem, decision: RouteDecision, fixed: Collection[int],
                   timings: Sequence[Timing]) -> Route | None:
    """Return what `repaired` does with its times."""
    route, violations = _best_timed(problem, decision, timings, EVERYTHING_OPEN)
    if not violations and all(customers_of(problem, trip) for trip in decision.trips):
        return route
    mended = repaired(problem, decision, fixed, timings)
    return None if mended is None else _best_timed(problem, mended, timings, EVERYTHING_OPEN)[0]


def broken_by(problem: Problem, decision: RouteDecision, time: Timing,
              past: Past) -> frozenset[Broken]:
    """Return the rules that a route breaks."""
    return frozenset(_broken(decision, violation) for violation
                     in judge_route(problem, time(decision), "", past).violations)


def _broken(decision: RouteDecision, violation: Violation) -> Broken:
    """Return a broken rule by whom it concerns, as places shift with those who are taken out."""
    place = _PLACE.fullmatch(violation.path)
    if place is None or place[1] is None:
        return violation.code, violation.message, ()
    trip, number = decision.trips[int(place[1])], int(place[3] or 0)
    whom: tuple[int, ...] = (int(place[1]),)
    if place[2] == "stops":
        whom += (trip.nodes[number],)
    elif place[2] == "sorties":
        flight = trip.sorties[number]
        whom += (*flight.nodes, *([] if place[4] is None else [int(place[4])]))
    return violation.code, violation.message, whom


def _best_timed(problem: Problem, decision: RouteDecision, timings: Sequence[Timing], past: Past,
                excused: Collection[Broken] = ()) -> tuple[Route, list[Violation]]:
    """Return a route by the first of the timings that break fewest rules, and which it breaks.

    What is excused doesn't count.
    """
    best: tuple[Route, list[Violation]] | None = None
    for time in timings:
        route = time(decision)
        violations = [violation for violation in judge_route(problem, route, "", past).violations
                      if _broken(decision, violation) not in excused]
        if best is None or len(violations) < len(best[1]):
            best = route, violations
        if not violations:
            break
    if best is None:
        raise ValueError("timings: none is not allowed")
    return best


def _customers_of_route(problem: Problem, decision: RouteDecision) -> list[int]:
    """Return whom a route serves."""
    return [node for trip in decision.trips for node in customers_of(problem, trip)]


def _blamed(problem: Problem, decision: RouteDecision, violations: list[Violation],
            fixed: frozenset[int]) -> list[int]:
    """Return who could be taken out to break fewer rules, each once, the best choice first."""
    blamed: dict[int, None] = {}
    for violation in violations:
        nodes = [node for node in _at(problem, decision, violation) if node not in fixed]
        if not nodes:
            nodes = [node for trip in reversed(decision.trips) for node in _latest_first(trip)
                     if node not in fixed]
        blamed.update(dict.fromkeys(nodes))
    return list(blamed)


def _at(problem: Problem, decision: RouteDecision, violation: Violation) -> Iterator[int]:
    """Yield the customers where a rule is broken."""
    place = _PLACE.fullmatch(violation.path)
    if place is None or place[1] is None:
        yield from _latest_first(decision.trips[-1])
        return
    trip = decision.trips[int(place[1])]
    if place[2] == "stops":
        if 0 < int(place[3]) < len(trip.nodes) - 1:
            yield trip.nodes[int(place[3])]
    elif place[2] == "sorties":
        nodes = trip.sorties[int(place[3])].nodes
        yield from nodes if place[4] is None else [nodes[int(place[4])]]
    elif violation.code == "CAPACITY":
        yield from _relieving(problem, decision, trip)
    elif violation.code == "TRIP_DISTANCE":
        yield from _farthest(problem, decision, trip)
    else:
        yield from _latest_first(trip)


def _latest_first(trip: TripDecision) -> list[int]:
    """Return a trip's customers, the truck's last one first, then the drones'."""
    flown = [node for sortie in trip.sorties for node in sortie.nodes]
    return [*trip.nodes[-2:0:-1], *reversed(flown)]


def _relieving(problem: Problem, decision: RouteDecision, trip: TripDecision) -> list[int]:
    """Return a trip's customers, first the lightest without whom the rest fits, then the heavy."""
    customers = customers_of(problem, trip)
    each = {node: problem.customer_at(node) for node in customers}
    demands = {node: tuple(map(max, customer.demand, customer.taken_in))
               for node, customer in each.items()}
    capacity = problem.vehicle_types[decision.vehicle_type].capacity
    load = tuple(map(sum, zip(*demands.values(), strict=True)))

    def order(node: int) -> tuple[bool, int]:
        rest = [total - amount for total, amount in zip(load, demands[node], strict=True)]
        weight = sum(demands[node])
        return (True, -weight) if any(map(gt, rest, capacity)) else (False, weight)

    return sorted(customers, key=order)


def _farthest(problem: Problem, decision: RouteDecision, trip: TripDecision) -> list[int]:
    """Return the truck's customers on a trip, those with the longest detour first."""
    travel = problem.travel[problem.vehicle_types[decision.vehicle_type].travel]
    distance = travel.distance
    detours = {
        node: distance.item(before, node) + distance.item(node, behind)
        - distance.item(before, behind)
        for before, node, behind in zip(trip.nodes, trip.nodes[1:], trip.nodes[2:], strict=False)
    }
    return sorted(detours, key=lambda node: -detours[node])
