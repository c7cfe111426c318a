"""How much later a customer may be served than who is named before him, for him to be served."""

from collections.abc import Iterator
from dataclasses import replace

from model.counsel.diagnosis import up_to_tenth
from model.counsel.remedy import Remedy, remedy_of
from model.counsel.trial import attempts
from model.judge.check import check
from model.judge.clock import MS_PER_MINUTE
from model.judge.lags import starts_across, starts_of
from model.judge.relations import who_waits
from model.judge.timing import RouteDecision, TripDecision, read_decision, schedule
from model.problem import MAX_QUANTITY, Problem, Relation
from model.solution import Route, Solution

MOST_STOPS = 40
"""Of a route, among which a customer is tried."""


def lag_remedy(problem: Problem, solution: Solution, index: int, node: int) -> tuple[Remedy, ...]:
    """Return for which `max_lag` a vehicle of a type would serve a customer; none if none is known.

    As the plan serves the others; what is said is tried.
    """
    if not any(_limits(relation, node) for relation in problem.relations):
        return ()
    free = _with_lag(problem, node, MAX_QUANTITY)
    needed = _least_lag(free, solution, index, node)
    if needed is None:
        return ()
    needed = up_to_tenth(needed, MS_PER_MINUTE)
    if needed > MAX_QUANTITY or _least_lag(
            _with_lag(problem, node, needed), solution, index, node) is None:
        return ()
    return (remedy_of("lag", quantity=needed),)


def _limits(relation: Relation, node: int) -> bool:
    return relation.max_lag is not None and node in relation.nodes


def _with_lag(problem: Problem, node: int, lag: int) -> Problem:
    """Return a problem where orders of a customer leave so much time between two, or more."""
    return replace(problem, relations=tuple([
        replace(each, max_lag=max(lag, each.max_lag or 0)) if _limits(each, node) else each
        for each in problem.relations]))


def _least_lag(problem: Problem, solution: Solution, index: int, node: int) -> int | None:
    """Return the longest time between a customer and those next to him in his orders, where that
    is least; None: a vehicle of the type doesn't serve him.
    """
    across = any(each.across and _limits(each, node) for each in problem.relations)
    tried = (_with_others(problem, solution, index, node) if across
             else _on_route(problem, solution, index, node))
    return min(tried, default=None)


def _with_others(problem: Problem, solution: Solution, index: int, node: int) -> Iterator[int]:
    """Yield the longest lag of each trip alone that waits for those whom other vehicles serve."""
    _, bound = who_waits(problem, solution, node)
    if bound is None or node in problem.shipment_at:
        return
    starts = {other: start for route in solution.routes
              for other, start in starts_across(problem, route).items()}
    for attempt in attempts(bound, index, node):
        if not attempt.codes:
            own = starts_of(attempt.solution.routes[0].visits)
            yield _longest(problem, node, starts | {node: max(own.values())})


def _on_route(problem: Problem, solution: Solution, index: int, node: int) -> Iterator[int]:
    """Yield the longest lag of each place by truck on the route that serves the others."""
    others = {other for each in problem.relations if _limits(each, node) for other in each.nodes}
    for route in solution.routes:
        stops = [stop for trip in route.trips for stop in trip.stops]
        if (route.vehicle_type != index or len(stops) > MOST_STOPS
                or not others & {*route.served}):
            continue
        for tried in _places(problem, route, node):
            if not check(problem, Solution((tried,))).violations:
                yield _longest(problem, node, starts_of(tried.visits))


def _places(problem: Problem, route: Route, node: int) -> Iterator[Route]:
    """Yield a route without flights that serves one more customer, at each of its places."""
    kind = problem.vehicle_types[route.vehicle_type]
    if any(trip.sorties for trip in route.trips) or kind.breaks or kind.driving:
        return
    known = [read_decision(trip, kind) for trip in route.trips]
    for number, decision in enumerate(known):
        for place in range(1, len(decision.nodes)):
            nodes = (*decision.nodes[:place], node, *decision.nodes[place:])
            changed = [*known[:number], TripDecision(nodes),
                       *[replace(each, start=None) for each in known[number + 1:]]]
            yield schedule(problem, RouteDecision(route.vehicle_type, route.vehicle,
                                                  tuple(changed)))


def _longest(problem: Problem, node: int, starts: dict[int, int]) -> int:
    """Return the longest time between a customer and those next to him in his orders."""
    lags = [(one, behind) for each in problem.relations if _limits(each, node)
            for behind, (one, _, most) in each.lags(problem.first_place)
            if most == each.max_lag and node in (one, behind)]
    return max([starts[behind] - starts[one] for one, behind in lags
                if one in starts and behind in starts], default=0)
