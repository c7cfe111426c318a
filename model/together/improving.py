"""A search among customers some of whom can be served only together.

The search inserts one customer at a time, and what it takes out of a group never comes back: so
few customers begin with the best of all plans by trucks, more with a search, strings of those that
it leaves out, and a search that goes on from there.
"""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from model.judge.check import check
from model.problem import Problem
from model.search.improve import GRACE, Improved, Progress
from model.search.reserve import usual_reserve
from model.solution import Solution
from model.together.exact import MOST_CUSTOMERS, best_by_trucks
from model.together.filling import Filling
from model.together.joint import Joint
from model.together.pulling import Pulling, nobody_served

EXACT_SHARE = 0.8
"""Most of the time that the best plan of few customers may take."""

FIRST_SHARE, FILLED_SHARE, LAST_SHARE = 0.15, 0.7, 0.9
"""Shares of the time after which a first search ends that leaves somebody out, strings have been
put in, and a second search ends, after which more are put in."""

FIRST_TURNS = 0.4
"""Share of the turns after which a first search ends that leaves somebody out."""

STRINGS, PULLS_OF_SOME = 8, 3
"""So many strings are tried between two searches that break limits, of which each so many-th pulls
in everybody."""

TURNS_A_PULL, FEWEST_PULLS = 2000, 4
"""Where turns are counted, so many stand for one of these, of which there are some."""

COOLED = 0.5
"""Share of the cooling that the second search leaves out, so that groups stay."""


class SearchPart(NamedTuple):
    """A part of a search."""

    made: int = 0  # turns of all that are over
    cooled: float = 0.0  # share of the cooling that is left out
    deadline: float | None = None  # None: that of the whole


ALL = SearchPart()

Search = Callable[
    [Solution | None, SearchPart, Callable[[], bool], Callable[[Progress], None]], Improved]
"""Searches from a plan, or from none; asks whether to stop, and tells of what it finds."""


@dataclass(frozen=True)
class SearchTerms:
    """How long to search, and whom to tell."""

    seed: int
    turns: int | None
    deadline: float | None  # on `time.perf_counter`
    should_stop: Callable[[], bool]
    on_progress: Callable[[Progress], None]

    def until(self, share: float) -> float | None:
        """Return when a share of what time is left from now on is over."""
        now = time.perf_counter()
        return None if self.deadline is None else now + share * max(0.0, self.deadline - now)

    def ended(self) -> bool:
        """Tell whether the time is over, or somebody says so."""
        return self.should_stop() or (self.deadline is not None
                                      and time.perf_counter() >= self.deadline)


def improve_together(problem: Problem, joint: Joint, begun: Solution | None, terms: SearchTerms,
                     search: Search) -> Improved:
    """Search from a plan, or from none, also for strings of customers; with shipments, for groups
    of few.
    """
    lacks_some = begun is None or bool(begun.unassigned)
    if problem.num_customers <= MOST_CUSTOMERS and (joint.is_sure or lacks_some):
        least, until = time.perf_counter() + GRACE, terms.until(EXACT_SHARE)
        best = best_by_trucks(problem, _ended(terms, until and max(until, least)))
        if best is not None:
            return search(_cheapest(problem, begun, best), ALL, terms.should_stop,
                          terms.on_progress)
    if problem.shipments:
        return search(begun, ALL, terms.should_stop, terms.on_progress)
    return _Stages(problem, joint, terms, search).run(begun)


def _ended(terms: SearchTerms, deadline: float | None) -> Callable[[], bool]:
    end = math.inf if deadline is None else deadline
    return lambda: time.perf_counter() >= end or terms.should_stop()


def _cheapest(problem: Problem, *plans: Solution | None) -> Solution:
    known = [plan for plan in plans if plan is not None]
    return min(known, key=lambda plan: check(problem, plan).cost.total)


class _Watch:
    """Ends a search whose best plan leaves somebody out after a share of it."""

    def __init__(self, terms: SearchTerms) -> None:
        self._terms = terms
        self._due = terms.until(FIRST_SHARE)
        self._is_over = False
        self.has_ended = False  # before its time

    def should_stop(self) -> bool:
        return self.has_ended or self._terms.should_stop()

    def on_progress(self, progress: Progress) -> None:
        self._terms.on_progress(progress)
        if not self._is_over and self._has_come(progress.turns):
            self._is_over = True
            self.has_ended = bool(progress.plan().unassigned)

    def _has_come(self, turns: int) -> bool:
        """Tell whether the share is over."""
        if self._terms.turns is not None:
            return turns >= FIRST_TURNS * self._terms.turns
        return self._due is not None and time.perf_counter() >= self._due


class _Stages:
    """Searches, and strings between them."""

    def __init__(self, problem: Problem, joint: Joint, terms: SearchTerms, search: Search) -> None:
        self._problem = problem
        self._joint = joint
        self._terms = terms
        self._search = search
        self._rng = np.random.default_rng(terms.seed)
        self._whole = True
        self._has_filled = False
        self._judging = 0.0  # seconds that comparing two plans takes

    def run(self, begun: Solution | None) -> Improved:
        """Return the best plan of all stages; of one where that leaves nobody out."""
        terms, watch = self._terms, _Watch(self._terms)
        filled, last = terms.until(FILLED_SHARE), terms.until(LAST_SHARE)
        first = self._search(begun, ALL, watch.should_stop, watch.on_progress)
        if not first.solution.unassigned:
            return first
        searched = time.perf_counter()
        plan = _cheapest(self._problem, begun, first.solution, first.solution)
        self._judging = time.perf_counter() - searched
        plan = self._filled(plan, filled, first.turns)
        rest = ALL._replace(made=first.turns, cooled=COOLED,
                            deadline=last if plan.unassigned else self._end(0.0))
        second = self._search(plan, rest, terms.should_stop, terms.on_progress)
        turns = first.turns + second.turns
        plan = _cheapest(self._problem, plan, second.solution)
        plan = self._filled(plan, self._end(usual_reserve(self._problem)), turns)
        is_whole = (first.whole or watch.has_ended) and second.whole and self._whole
        return replace(second, solution=plan, turns=turns, first_cost=first.first_cost,
                       whole=is_whole)

    def _end(self, reserve: float) -> float | None:
        """Return when there is as much time left as plans take to be compared, and some more."""
        end = self._terms.deadline
        return None if end is None else end - 4 * self._judging - reserve

    def _filled(self, plan: Solution, deadline: float | None, turns: int) -> Solution:
        """Return a plan with strings of those left out, as far as it costs less."""
        ended = _ended(self._terms, deadline)
        if not plan.unassigned or ended():
            return plan
        begins = [plan] if self._has_filled else [plan, nobody_served(self._problem)]
        self._has_filled = True
        filled = [self._with_strings(begun, 0, ended) for begun in begins]
        better = self._pulled(_cheapest(self._problem, plan, *filled), deadline, ended)
        self._whole = self._whole and not ended()
        if better is not plan:
            cost = check(self._problem, better).cost.total
            self._terms.on_progress(Progress(cost, turns, lambda: better))
        return better

    def _pulled(self, plan: Solution, deadline: float | None,
                ended: Callable[[], bool]) -> Solution:
        """Return a plan with more customers, as long as there is time."""
        pulling = Pulling(self._problem, self._joint, ended,
                          math.inf if deadline is None else deadline, self._rng)
        most = math.inf
        if self._terms.turns is not None:
            most = max(FEWEST_PULLS, self._terms.turns // TURNS_A_PULL)
        number = 0
        while number < most and plan.unassigned and not ended():
            plan = pulling.pull(plan, number % PULLS_OF_SOME == 0)
            plan = _cheapest(self._problem, plan, self._with_strings(plan, STRINGS, ended))
            number += 1
        return plan

    def _with_strings(self, plan: Solution, rounds: int, ended: Callable[[], bool]) -> Solution:
        filling = Filling(self._problem, plan, self._joint, ended, self._rng)
        filling.fill(rounds)
        return filling.plan
