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
from dataclasses import dataclass, field, replace

import numpy as np

from model.engine.alarm import Alarm
from model.engine.library import call
from model.problem import IntArray
from model.search.ejection import by_ejection, can_eject
from model.search.limits import Cooling, SearchLimits
from model.search.route.layout import NOWHERE, ProblemData
from model.search.route.state import Searcher
from model.search.sharing import go_on_from_best
from model.search.temperature import Heat
from model.search.worker import SearchThread

MOST_STARTS, TURNS_A_START, STARTS_UNTIL = 5, 25, 0.65
"""How often the rest of a search begins from the plan by the fewest vehicles, before plans are
bred; turns for each customer of one; and the share of the search until which it does."""

MOVES = 20
"""Random moves before each start but the first, by customers."""

EJECTED_SHARE = 0.3
"""Of the time of a start, or of a child, in which all its shipments are inserted at most."""

MOST_CHILDREN, TURNS_A_CHILD, CHILDREN_UNTIL = 10_000, 6, 0.95
"""How many plans are bred at most; turns for each customer of one; and the share of the search
until which they are."""

MOST_IN_VAIN = 15
"""So many in a row of which none takes a place, and the search begins once more."""

MOST_BARREN = 50
"""So many exchanges in a row that bring no other plan, and none is bred any more: by a route or two
there may be no other, and exchanges make no turns by which the search would end."""

HOT_OF_STARTS, HOT_OF_CHILDREN, HOT_OF_LAST = 3.0, 0.2, 0.5
"""First temperatures by the cost of a leg: of starts, of children, and of what follows."""

ALIKE = 0.8
"""From how many same legs on, as a share, plans are taken for one, of which the better is kept."""

SAME = 1e-6
"""Costs that differ by less are taken for one."""


@dataclass(frozen=True, eq=False)
class _Plan:
    """A plan for all shipments."""

    cost: float
    nodes: IntArray  # of each route in order, without where vehicles begin, then NOWHERE
    follower: IntArray  # (node,) who follows, or NOWHERE

    @classmethod
    def of(cls, searcher: Searcher) -> "_Plan":
        """Return the plan as it is."""
        number = len(searcher.absences)
        nodes, follower = np.empty(2 * number, np.int64), np.full(number + 1, NOWHERE)
        nodes = nodes[:call("tandem_write_served", searcher, nodes)]
        follower[nodes[:-1]] = nodes[1:]
        return cls(float(searcher.value.cost), nodes, follower[:-1])

    def alike(self, other: "_Plan") -> float:
        """Return to which share two plans are the same."""
        return float((self.follower == other.follower).mean())


def spans_of_rest(data: ProblemData, searcher: Searcher,
                  workers: list[SearchThread]) -> Iterator[Cooling]:
    """Yield the parts of the rest of a search, each going on from another plan. In place."""
    first, limits = workers[0], workers[0].limits
    share, number = limits.share(first.turns), 0
    if can_eject(data):
        number = min(MOST_STARTS, int((STARTS_UNTIL - share) * first.expected() / TURNS_A_START))
    if number > 1:
        breeder = _Breeder(data, searcher, workers, [worker.heat for worker in workers])
        for end in np.linspace(share, STARTS_UNTIL, number + 1)[1:].tolist():
            yield from breeder.start(end, bool(breeder.plans))
        yield from breeder.children((STARTS_UNTIL - share) / number)
        breeder.heat(HOT_OF_LAST)
        go_on_from_best(data, searcher)
    if not limits.over(first.turns):
        yield Cooling(limits.share(first.turns), 1.0, 1.0)


@dataclass(frozen=True, eq=False)
class _Breeder:
    """A search, and plans that it came to, no two of which are much alike."""

    data: ProblemData
    searcher: Searcher
    workers: list[SearchThread]
    heats: list[Heat]  # of the workers, as they were
    plans: list[_Plan] = field(default_factory=list)

    @property
    def limits(self) -> SearchLimits:
        """Return when the search ends."""
        return self.workers[0].limits

    @property
    def share(self) -> float:
        """Return the share of it that is over."""
        return self.limits.share(self.workers[0].turns)

    def is_over(self, span: Cooling) -> bool:
        """Tell whether a span of it is over."""
        return self.limits.over(self.workers[0].turns, span)

    def heat(self, hot: float) -> None:
        """Let workers begin at a temperature by the cost of a leg, where none was stated."""
        for worker, heat in zip(self.workers, self.heats, strict=True):
            worker.heat = replace(heat, hot=heat.hot or hot)

    def start(self, end: float, elsewhere: bool) -> Iterator[Cooling]:
        """Yield a part that begins with the best plan, or elsewhere, and keep what it comes to."""
        span = Cooling(self.share, end, 1.0)
        if self.is_over(span):
            return
        if elsewhere:
            go_on_from_best(self.data, self.searcher)
            self._begin_elsewhere(span)
        self.heat(HOT_OF_STARTS)
        yield span
        if self.searcher.count.missing == 0:
            plan = _Plan.of(self.searcher)
            rival = self._rival(plan, len(self.plans))
            if rival == len(self.plans) or plan.cost < self.plans[rival].cost:
                self.plans[rival:rival + 1] = [plan]

    def children(self, start_share: float) -> Iterator[Cooling]:
        """Yield parts that go on from routes of two plans, or begin anew where these bring nothing.

        A child takes the place of the plan most like it, or of its parent, if it is better.
        """
        rng, vain, barren = np.random.default_rng(int(self.searcher.rng[0])), 0, 0
        for _ in range(MOST_CHILDREN):
            begin, few = self.share, len(self.plans) < 2
            span = Cooling(begin, begin + TURNS_A_CHILD / self.workers[0].expected(), 1.0)
            if span.end > CHILDREN_UNTIL or self.is_over(span):
                return
            if (few or vain >= MOST_IN_VAIN) and begin + start_share <= CHILDREN_UNTIL:
                vain = 0
                yield from self.start(begin + start_share, True)
            elif few or barren == MOST_BARREN:
                return
            else:
                vain += 1
                one, other = rng.permutation(len(self.plans))[:2].tolist()
                if not self._cross(self.plans[one], self.plans[other], span):
                    barren += 1
                    continue
                barren = 0
                self.heat(HOT_OF_CHILDREN)
                yield span
                if self.searcher.count.missing == 0 and self._take_place(one):
                    vain = 0

    def _take_place(self, parent: int) -> bool:
        """Keep the plan as it is instead of that most like it, or its parent, if it is better."""
        child = _Plan.of(self.searcher)
        rival = self._rival(child, parent)
        if child.cost >= self.plans[rival].cost - SAME:
            return False
        self.plans[rival] = child
        return True

    def _rival(self, plan: _Plan, parent: int) -> int:
        """Return the number of the plan that is much like another, else that given."""
        alike = [plan.alike(other) for other in self.plans]
        return int(np.argmax(alike)) if max(alike, default=0.0) >= ALIKE else parent

    def _cross(self, one: _Plan, other: _Plan, span: Cooling) -> bool:
        """Go on from routes of two plans, or tell that this brings no other. In place."""
        made = call("tandem_exchange_routes", self.data, self.searcher, one.nodes, other.nodes)
        if made and self.searcher.count.missing > 0:
            made = self._insert_missing(span, True)
        cost = float(self.searcher.value.cost)
        return (bool(made) and all(abs(plan.cost - cost) > SAME for plan in self.plans)
                and not self.is_over(span))

    def _begin_elsewhere(self, span: Cooling) -> None:
        """Go on from another plan by as few vehicles, which no moves may lead to. In place.

        Shipments are moved at random by a vehicle more, and a route is given up; where not all of
        its shipments can be inserted soon, they are moved at random by those that there are.
        """
        used = int(self.searcher.count.active)
        self._move_at_random(span, True)
        if self.searcher.count.active > used:
            call("tandem_give_up_route", self.data, self.searcher)
            if self._insert_missing(span, False):
                return
            go_on_from_best(self.data, self.searcher)
        self._move_at_random(span, False)

    def _move_at_random(self, span: Cooling, by_one_more: bool) -> None:
        """Move shipments while there is time in a span, by a vehicle more, too. In place."""
        end = min(self.limits.span_end(span)[1], self.limits.deadline)
        with Alarm(end, self.limits.should_stop) as alarm:
            call("tandem_move_shipments", self.data._replace(deadline=alarm.setting),
                 self.searcher, MOVES * self.data.num_nodes, by_one_more)

    def _insert_missing(self, span: Cooling, gently: bool) -> bool:
        """Insert all left out at the beginning of a span, or tell that this fails. In place."""
        soon = replace(span, end=span.begin + EJECTED_SHARE * (span.end - span.begin))
        eject = by_ejection(self.data, self.searcher, self.workers, soon, gently)
        return eject is not None and eject()
