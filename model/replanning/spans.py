"""When those who are left may be served, by when those were who are served before or behind them.

They are as fixed instants to what is left: trucks wait for them, and drones don't.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from model.judge.lags import Awaited, soonest_after, starts_across, starts_of
from model.judge.timing import RouteDecision
from model.problem import SINCE_PLAN_START, UNLIMITED, BoolArray, Customer, Problem, Relation
from model.replanning.kept import Kept
from model.solution import Route, Vehicle

Span = tuple[int, int]
"""From when to when service may begin, in ms."""


def spans_left(problem: Problem, now: int, kept: Mapping[Vehicle, Kept],
               nodes: Sequence[int]) -> list[Span | None]:
    """Return from when to when those at nodes may be served; None: no settled one binds them."""
    starts = {node: start for own in kept.values()
              for node, start in starts_of(own.route.visits).items()}
    spans = dict[int, Span]()

    def narrow(node: int, soonest: int, latest: int) -> None:
        since, until = spans.get(node, (now, UNLIMITED))
        spans[node] = max(since, soonest), min(until, latest)

    for node, lags in problem.lags.items():
        for lag in lags:
            if node not in starts and lag.node in starts:
                narrow(node, starts[lag.node] + lag.least, starts[lag.node] + lag.most)
            elif node in starts and lag.node not in starts:
                narrow(lag.node, starts[node] - lag.most, starts[node] - lag.least)
    return [None if spans.get(node) == (now, UNLIMITED) else spans.get(node) for node in nodes]


def with_spans(customers: Sequence[Customer], first: int, spans: Sequence[Span | None],
               relations: Iterable[Relation]) -> tuple[Customer, ...]:
    """Return customers, from node `first` on, of whom trucks serve those whom others bind."""
    bound = {node for each in relations if each.across for node in each.nodes}
    return tuple([
        customer if span is None and node not in bound
        else replace(customer, span=span, served_by="truck")
        for node, (customer, span) in enumerate(zip(customers, spans, strict=True), first)])


def flown_alone(customers: Sequence[Customer], bound: Sequence[Customer]) -> BoolArray:
    """Mark those whom drones alone could serve, and none may."""
    return np.array([one.served_by == "drone" != other.served_by
                     for one, other in zip(customers, bound, strict=True)], np.bool_)


def awaiting(problem: Problem, decision: RouteDecision, others: Iterable[Route]) -> RouteDecision:
    """Return a route whose truck waits for whom other routes serve, as long as it takes."""
    if not problem.lags_across:
        return decision
    starts = {node: start for route in others
              for node, start in starts_across(problem, route).items()}
    return replace(decision, trips=tuple([replace(trip, awaited=tuple([
        Awaited(node, max([soonest_after(problem, node, starts),
                           *(each.until for each in trip.awaited if each.node == node)]))
        for node in trip.nodes[1:-1] if node in problem.lags_across]))
        for trip in decision.trips]))


def out_of_turn(problem: Problem, route: Route, others: Iterable[Route]) -> set[int]:
    """Return whom a route serves too late or too soon for whom others serve, or have served."""
    starts = {SINCE_PLAN_START: 0}
    for other in others:
        starts |= starts_across(problem, other)
    return {node for node, start in starts_across(problem, route).items()
            if any(lag.node in starts and not lag.least <= start - starts[lag.node] <= lag.most
                   for lag in problem.lags_across[node])}
