"""Plans of shipments by as few vehicles as can be, bred from several others.

Such plans are far apart: from some no turn leads to others. So the search begins several times, and
routes of one plan are exchanged for some of another that serve nearly the same shipments. Whoever
fits nowhere then is inserted by ejecting others, and a short search follows.

References
----------
Nagata and Kobayashi (2010), a memetic algorithm for the pickup and delivery problem with time
windows using selective route exchange crossover, PPSN XI.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from model.engine.alarm import Alarm
from model.engine.library import call
from model.problem import IntArray
from model.search.ejection import by_ejection, can_eject
from model.search.limits import Limits, Span
from model.search.route.layout import NOWHERE, ProblemData
from model.search.route.state import Searcher
from model.search.sharing import go_on_from_best
from model.search.temperature import Heat
from model.search.worker import Worker

MOST_STARTS, TURNS_A_START, STARTS_UNTIL = 5, 25, 0.65
"""How often the rest of a search begins from the plan by the fewest vehicles; turns for each
customer of one; and the share of the search until which it does."""

MOVES = 20
"""Random moves before each start but the first, by customers."""

EJECTED_SHARE = 0.3
"""Of the time of a start, or of a child, in which all its shipments are inserted at most."""

MOST_CHILDREN, TURNS_A_CHILD, CHILDREN_UNTIL = 10_000, 10, 0.95
"""How many plans are bred at most; turns for each customer of one; and the share of the search
until which they are."""

HOT_OF_STARTS, HOT_OF_CHILDREN, HOT_OF_LAST = 3.0, 0.3, 0.5
"""First temperatures by the cost of a leg: of starts, of children, and of what follows."""

ALIKE = 0.8
"""From how many same legs on, as a share, plans are taken for one, of which the better is kept."""


@dataclass(frozen=True, eq=False)
class _Plan:
    """A plan for all shipments."""

    cost: float
    nodes: IntArray  # of each route in order, without where vehicles begin, then NOWHERE

    follower: IntArray  # (node,) who follows, or NOWHERE

    @classmethod
    def of(cls, searcher: Searcher) -> "_Plan":
        """Return the plan as it is."""
        now, parts, end = searcher.now, list[IntArray](), np.array([NOWHERE], np.int64)
        for slot in searcher.active[:searcher.count.active].tolist():
            parts.extend([now.stop["node"][slot, 1:now.route["length"][slot] - 1], end])
        nodes, follower = np.concatenate(parts), np.full(len(now.where) + 1, NOWHERE)
        follower[nodes[:-1]] = nodes[1:]
        return cls(float(searcher.value.cost), nodes, follower[:-1])

    def alike(self, other: "_Plan") -> float:
        """Return to which share two plans are the same."""
        return float((self.follower == other.follower).mean())


def spans_of_rest(data: ProblemData, searcher: Searcher, workers: list[Worker]) -> Iterator[Span]:
    """Yield the parts of the rest of a search, each going on from another plan. In place."""
    first, limits = workers[0], workers[0].limits
    share, number = limits.share(first.turns), 0
    if can_eject(data):
        number = min(MOST_STARTS, int((STARTS_UNTIL - share) * first.expected() / TURNS_A_START))
    if number > 1:
        heats = [worker.heat for worker in workers]
        plans = list[_Plan]()
        _heat(workers, heats, HOT_OF_STARTS)
        for span in _starts(data, searcher, workers, number):
            yield span
            _add(plans, searcher)
        _heat(workers, heats, HOT_OF_CHILDREN)
        yield from _children(data, searcher, workers, plans)
        _heat(workers, heats, HOT_OF_LAST)
        go_on_from_best(data, searcher)
    if not limits.over(first.turns):
        yield Span(limits.share(first.turns), 1.0, 1.0)


def _starts(data: ProblemData, searcher: Searcher, workers: list[Worker],
            number: int) -> Iterator[Span]:
    """Yield as many parts, each but the first beginning elsewhere. In place."""
    first, limits = workers[0], workers[0].limits
    share = limits.share(first.turns)
    for end in np.linspace(share, STARTS_UNTIL, number + 1)[1:].tolist():
        span = Span(limits.share(first.turns), end, 1.0)
        if limits.over(first.turns, span):
            continue
        if span.begin > share:
            go_on_from_best(data, searcher)
            _begin_elsewhere(data, searcher, workers, span)
        yield span


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
        if _insert_missing(data, searcher, workers, span, False):
            return
        go_on_from_best(data, searcher)
    _move_at_random(data, searcher, limits, span, False)


def _move_at_random(data: ProblemData, searcher: Searcher, limits: Limits, span: Span,
                    by_one_more: bool) -> None:
    """Move shipments at random while there is time in a span, by a vehicle more, too. In place."""
    with Alarm(min(limits.span_end(span)[1], limits.deadline), limits.should_stop) as alarm:
        call("tandem_move_shipments", data._replace(deadline=alarm.setting), searcher,
             MOVES * data.num_nodes, by_one_more)


def _insert_missing(data: ProblemData, searcher: Searcher, workers: list[Worker], span: Span,
                    gently: bool) -> bool:
    """Insert all who are left out at the beginning of a span, or tell that this fails. In place."""
    soon = replace(span, end=span.begin + EJECTED_SHARE * (span.end - span.begin))
    eject = by_ejection(data, searcher, workers, soon, gently)
    return eject is not None and eject()


def _children(data: ProblemData, searcher: Searcher, workers: list[Worker],
              plans: list[_Plan]) -> Iterator[Span]:
    """Yield parts that go on from routes of two plans, whose child may take a place. In place."""
    first, limits = workers[0], workers[0].limits
    rng = np.random.default_rng(int(searcher.rng[0]))
    for _ in range(MOST_CHILDREN if len(plans) > 1 else 0):
        begin = limits.share(first.turns)
        span = Span(begin, begin + TURNS_A_CHILD / first.expected(), 1.0)
        if span.end > CHILDREN_UNTIL or limits.over(first.turns):
            return
        one, other = rng.permutation(len(plans))[:2].tolist()
        made = call("tandem_exchange_routes", data, searcher, plans[one].nodes, plans[other].nodes)
        if made and searcher.count.missing > 0:
            made = _insert_missing(data, searcher, workers, span, True)
        if made and not limits.over(first.turns, span):
            yield span
            _add(plans, searcher, plans[one])


def _add(plans: list[_Plan], searcher: Searcher, parent: _Plan | None = None) -> None:
    """Let the plan as it is take the place of one much like it, or its parent, if it is better.

    In place. Without either it is added; not at all where not all are served.
    """
    if searcher.count.missing > 0:
        return
    plan = _Plan.of(searcher)
    rival = max(plans, key=plan.alike, default=parent)
    if rival is None or plan.alike(rival) < ALIKE:
        rival = parent
    if rival is None:
        plans.append(plan)
    elif plan.cost < rival.cost:
        plans[plans.index(rival)] = plan


def _heat(workers: list[Worker], heats: list[Heat], hot: float) -> None:
    """Let workers begin at a temperature by the cost of a leg, where none was stated. In place."""
    for worker, heat in zip(workers, heats, strict=True):
        worker.heat = replace(heat, hot=heat.hot or hot)
