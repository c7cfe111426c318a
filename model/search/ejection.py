"""Shipments left out, inserted by ejecting others.

References
----------
Nagata and Kobayashi (2010), guided ejection search for the pickup and delivery problem with time
windows, EvoCOP.
Curtois, Landa-Silva, Qu and Laesanklang (2018), large neighbourhood search with adaptive guided
ejection search for the pickup and delivery problem with time windows, EURO Journal on
Transportation and Logistics 7:151-192.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from model.engine.alarm import Alarm
from model.engine.library import call
from model.problem import UNLIMITED
from model.search.limits import Limits, Span
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.sharing import go_on_from_best
from model.search.worker import Worker

MOST_STARTS, TURNS_A_START, STARTS_UNTIL = 5, 25, 0.9
"""How often the rest of a search begins from the plan by the fewest vehicles, its shipments moved
at random; turns for each customer of one; and the share of the search until which it does. Where
vehicles are few no turn leads from some plans to others."""

HOT_OF_STARTS = 3.0
"""First temperature of each by the cost of a leg."""

MOVES = 20
"""Random moves before each but the first, by customers."""

EJECTED_SHARE = 0.3
"""Of the time of a start, in which it finds where to begin at most."""

MOST_ROUNDS = 10**9
"""More than there is time for."""

LIMITS = "max_trip_distance", "max_working_duration", "max_travel_duration"
"""Of vehicles, which aren't looked at."""


def can_eject(data: ProblemData) -> bool:
    """Tell whether all are ends of shipments, and windows and loads alone limit vehicles."""
    if not len(data.pair) or data.num_types > 1:
        return False
    kind, how, first = data.type[0], data.evaluation[0], data.num_depots
    once = (kind["max_trips"] == 1 and not how["priced"] and not kind["must_rest"]
            and all(kind[most] >= UNLIMITED for most in LIMITS))
    anyhow = not (kind["lifo"] or kind["pickup_order"] or kind["changes_ends"]
                  or kind["keeps_hours"] or len(data.goods) or len(data.setup) or len(data.hub))
    pair, nodes = data.pair[first:], range(first, data.num_nodes)
    paired = (pair["partner"] >= 0).all() and (pair["next_place"] == list(nodes)).all()
    own = data.place["release"].any() or data.amount[first:, :, :3].any()
    return bool(once and anyhow and paired and data.place.shape[2] == 1 and not own)


def can_be_rows(data: ProblemData) -> bool:
    """Tell whether routes can be rows of shipments, whose ways alone cost."""
    how, fairness, kind = data.evaluation[0], data.fairness, data.type[0]
    whole = fairness.makespan > 0 or fairness.balance > 0 or fairness.min_vehicles > 0
    return can_eject(data) and bool(
        how["by_detour"] and not how["timed"] and not whole
        and kind["drones"] == 0 and not kind["flies"])


def by_ejection(data: ProblemData, searcher: Searcher, workers: list[Worker],
                span: Span) -> Callable[[], bool] | None:
    """Return what inserts all shipments left out among the routes; None where that can't be.

    It changes the search in place until the span of it ends, and tells whether all are inserted; if
    not, routes are as they were, or the best ones. Rounds count as turns of each worker.
    """
    limits = workers[0].limits

    def eject() -> bool:
        most, end = limits.span_end(span)
        with Alarm(min(end, limits.deadline), limits.should_stop) as alarm:
            made, done = call("tandem_eject", data._replace(deadline=alarm.setting), searcher,
                              int(min(most - workers[0].turns, MOST_ROUNDS)))
        for worker in workers:
            worker.turns += made
        return bool(done)

    return eject if can_eject(data) else None


def _begin_elsewhere(data: ProblemData, searcher: Searcher, workers: list[Worker],
                     span: Span) -> None:
    """Go on from another plan by as few vehicles as the best, which no moves may lead to. In place.

    Shipments are moved at random by a vehicle more, and a route is given up; where not all of its
    shipments can be inserted soon, they are moved at random by those that there are.
    """
    used, limits = int(searcher.count.active), workers[0].limits
    _move_at_random(data, searcher, limits, span, True)
    if searcher.count.active > used:
        call("tandem_give_up_route", data, searcher)
        soon = replace(span, end=span.begin + EJECTED_SHARE * (span.end - span.begin))
        eject = by_ejection(data, searcher, workers, soon)
        if eject is not None and eject():
            return
        go_on_from_best(data, searcher)
    _move_at_random(data, searcher, limits, span, False)


def spans_of_rest(data: ProblemData, searcher: Searcher, workers: list[Worker]) -> Iterator[Span]:
    """Yield the parts of the rest of a search, each going on from the best plan. In place."""
    first, limits = workers[0], workers[0].limits
    share, number = limits.share(first.turns), 0
    if can_eject(data):
        number = min(MOST_STARTS, int((STARTS_UNTIL - share) * first.expected() / TURNS_A_START))
    if number > 1:
        for worker in workers:
            worker.heat = replace(worker.heat, hot=worker.heat.hot or HOT_OF_STARTS)
        for end in np.linspace(share, STARTS_UNTIL, number + 1)[1:].tolist():
            span = Span(limits.share(first.turns), end, 1.0)
            if limits.over(first.turns, span):
                continue
            if span.begin > share:
                go_on_from_best(data, searcher)
                _begin_elsewhere(data, searcher, workers, span)
            yield span
        go_on_from_best(data, searcher)
    if not limits.over(first.turns):
        yield Span(limits.share(first.turns), 1.0, 1.0)


def _move_at_random(data: ProblemData, searcher: Searcher, limits: Limits, span: Span,
                    by_one_more: bool) -> None:
    """Move shipments at random while there is time in a span, by a vehicle more, too. In place."""
    with Alarm(min(limits.span_end(span)[1], limits.deadline), limits.should_stop) as alarm:
        call("tandem_move_shipments", data._replace(deadline=alarm.setting), searcher,
             MOVES * data.num_nodes, by_one_more)
