"""Who goes with whom: relations between customers, of those who are served."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain

from model.judge.lags import starts_across, starts_of
from model.judge.rules import TimedTrip, Violation, seconds
from model.problem import MAX_QUANTITY, SINCE_PLAN_START, UNLIMITED, Lag, Problem, Relation
from model.problem.altered import with_customers
from model.solution import Solution, Vehicle


def route_relations(problem: Problem, trips: Sequence[TimedTrip], path: str) -> Iterator[Violation]:
    """Relations that a route doesn't keep, each once."""
    if not problem.relations:
        return
    served = [frozenset(timed.decision.customers(problem.num_depots)) for timed in trips]
    for relation in problem.relations:
        there = [(index, node) for index, nodes in enumerate(served)
                 for node in relation.nodes if node in nodes]
        broken = [(one, other) for number, one in enumerate(there) for other in there[number + 1:]
                  if _is_broken(relation, one[0] == other[0])]
        if broken:
            (_, one), (index, other) = broken[-1]
            where = trips[index].path if relation.scope == "trip" else path
            yield _violation(problem, relation, one, other, where)
    yield from _lag_violations(problem, trips, path)


def plan_relations(problem: Problem, served: Sequence[Sequence[int]]) -> Iterator[Violation]:
    """Relations that routes break together, by whom each of them serves."""
    for relation in problem.relations:
        if not relation.keeps_together:
            continue
        there = [(number, node) for number, nodes in enumerate(served)
                 for node in relation.nodes if node in nodes]
        number, other = there[-1] if there else (0, 0)
        if there and there[0][0] != number:
            yield _violation(problem, relation, there[0][1], other, f"routes[{number}]")


def plan_orders(problem: Problem, starts: Sequence[Mapping[int, int]]) -> Iterator[Violation]:
    """Orders and lags that routes break together, by when each begins to serve whom."""
    elsewhere = {node: number for number, own in enumerate(starts) for node in own}
    for number, own in enumerate(starts):
        for node, start in own.items():
            for lag in problem.lags.get(node, ()):
                other = elsewhere.get(lag.node, number)
                if lag.node == SINCE_PLAN_START:
                    after = start
                elif other == number:
                    continue
                else:
                    after = start - starts[other][lag.node]
                if not lag.least <= after <= lag.most:
                    yield Violation("RELATION", _lag_words(problem, node, lag, after),
                                    f"routes[{number}]")


def _lag_violations(problem: Problem, trips: Sequence[TimedTrip], path: str) -> Iterator[Violation]:
    """Orders and lags that a vehicle doesn't keep."""
    starts = starts_of(chain.from_iterable([timed.trip.visits for timed in trips]))
    for node, start in starts.items():
        for lag in problem.lags.get(node, ()):
            after = start - starts.get(lag.node, start - lag.least)
            if not lag.least <= after <= lag.most:
                yield Violation("RELATION", _lag_words(problem, node, lag, after), path)


def _lag_words(problem: Problem, node: int, lag: Lag, after: int) -> str:
    other = problem.customer_at(node).id
    if lag.node == SINCE_PLAN_START:
        return (f"customer {other} is served at {seconds(after)}, not from {seconds(lag.least)} "
                f"to {seconds(lag.most)}")
    one = problem.customer_at(lag.node).id
    if after < 0:
        return f"customer {one} is to be served before {other}"
    limit = (f"at least {seconds(lag.least)}" if after < lag.least
             else f"at most {seconds(lag.most)}")
    return f"customer {other} is served {seconds(after)} after {one}, not {limit}"


def words_of(relation: Relation) -> str:
    """Say what a relation asks of two customers."""
    where = "on one trip" if relation.scope == "trip" else "by one vehicle"
    return f"{'may not be' if relation.kind == 'apart' else 'are to be'} served {where}"


def _is_broken(relation: Relation, is_one_trip: bool) -> bool:
    """Tell whether two whom a vehicle serves, on one trip or not, break a relation."""
    if relation.scope == "vehicle":
        return relation.kind == "apart"
    return relation.keeps_together != is_one_trip


def _violation(problem: Problem, relation: Relation, one: int, other: int,
               path: str) -> Violation:
    names = " and ".join(problem.customer_at(node).id for node in (one, other))
    return Violation("RELATION", f"customers {names} {words_of(relation)}", path)


def who_decides(problem: Problem, solution: Solution, node: int) -> tuple[str, Vehicle] | None:
    """Return with whom a customer is to be served, and by which vehicle; None if with nobody."""
    for relation in problem.relations:
        if not relation.keeps_together or node not in relation.nodes:
            continue
        for route in solution.routes:
            there = [other for other in relation.nodes if other in route.served]
            if there:
                names = " and ".join(problem.customer_at(other).id for other in there)
                return names, route.driven_by
    return None


def who_waits(problem: Problem, solution: Solution, node: int) -> tuple[str, Problem | None]:
    """Return for whom on any routes a customer's service has to wait, or who for it, by name.

    And a problem in which it begins when these, as they are planned, let it; None if never.
    """
    starts = {other: start for route in solution.routes
              for other, start in starts_across(problem, route).items() if other != node}
    starts[SINCE_PLAN_START] = 0
    lags = [lag for lag in problem.lags_across.get(node, ()) if lag.node in starts]
    names = " and ".join(dict.fromkeys([
        "those served before" if lag.node == SINCE_PLAN_START else problem.customer_at(lag.node).id
        for lag in lags]))
    customer = problem.customer_at(node)
    soonest = max([customer.earliest, *(starts[lag.node] + lag.least for lag in lags)])
    latest = min([UNLIMITED, *(starts[lag.node] + lag.most for lag in lags)])
    if customer.late_cost_per_hour is None:
        latest = min(latest, customer.latest)
    for closes, opens in customer.gaps:
        soonest = opens if closes < soonest < opens else soonest
        latest = closes if closes < latest < opens else latest
    if not lags or soonest > min(latest, MAX_QUANTITY):
        return names, None if lags else problem
    gaps = tuple([(closes, opens) for closes, opens in customer.gaps
                  if soonest <= closes and opens <= latest])
    bound = replace(customer, earliest=soonest, latest=latest, gaps=gaps,
                    late_cost_per_hour=None, late_cost=0.0)
    return names, with_customers(problem, {node: bound})


def kept_off(problem: Problem, solution: Solution, kind: int, node: int) -> dict[Vehicle, str]:
    """Return the vehicles of a type that don't serve a customer, and from whom that keeps him."""
    found: dict[Vehicle, str] = {}
    for relation in problem.relations:
        if relation.kind != "apart" or relation.scope == "trip" or node not in relation.nodes:
            continue
        for route in solution.routes:
            there = [other for other in relation.nodes if other in route.served]
            if there and route.vehicle_type == kind:
                name = problem.customer_at(there[0]).id
                found.setdefault(Vehicle(kind, route.vehicle), name)
    return found
