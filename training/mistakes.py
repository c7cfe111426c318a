"""Which decisions of a plan cost something, found by completing what was decided before and after.

A beginning is worth what the search makes of it at best. Where that rises from one cut to the next,
some decision in between is to blame, and halving finds it.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from model.problem import UNLIMITED, IntArray, Problem
from model.simulation.actions import DRIVE, NUM_KINDS, OPEN, RETURN
from training.completion import (
    CompletionSetting, Routes, complete, cost_of, is_cut, open_type, to_actions, to_routes,
    what_is_left,
)

LEAST_RISE = 0.004
"""Share of the plan's cost from which a rise is some decision's."""

NO_RISE = 0.001
"""Share up to which no decision between two cuts is to blame."""

FEWEST_CUTS, MOST_CUTS, ACTIONS_BETWEEN = 9, 17, 6
"""Into how many parts a plan is cut, by its actions."""

FIRST_TURNS, TURNS_EACH = 150, 10
"""Turns of a completion, and for each customer left."""

PATH = 9
"""Decisions of a better plan that are kept, the better choice first."""


@dataclass(frozen=True)
class Mistake:
    """A decision that cost something."""

    step: int  # number of the action
    better: tuple[IntArray, ...]  # what could have followed instead, one of these; all cost as much
    rise: float  # by the plan's cost


@dataclass(frozen=True)
class Judgement:
    """What is known of a plan's decisions."""

    mistakes: list[Mistake]
    fine: np.ndarray  # (action,) no decision nearby costs anything
    completions: int  # that it took
    worth: dict[int, float] = field(default_factory=dict)  # by length of a beginning: its cost


class CompletionJudge:
    """Completions of the beginnings of one plan, which only get cheaper."""

    def __init__(self, setting: CompletionSetting, actions: IntArray, effort: float = 1.0) -> None:
        """`effort` times the usual turns."""
        self._setting, self._actions, self._effort = setting, actions, effort
        self.total = cost_of(setting, actions)
        self.completions = 0
        self._plan = {len(actions): actions}
        self._cost = {len(actions): self.total}
        self._reversible = _is_reversible(setting.problem)

    def judge(self) -> Judgement:
        """Return which decisions cost something, and near which ones none does."""
        number = np.clip(len(self._actions) // ACTIONS_BETWEEN, FEWEST_CUTS, MOST_CUTS)
        cuts = sorted({self._cut_at(place) for place in
                       np.linspace(0, len(self._actions), number + 1).round().astype(int).tolist()})
        for lower, upper in reversed(list(pairwise(cuts))):
            self._look(lower, upper, 1)
        fine = np.zeros(len(self._actions), np.bool_)
        mistakes = []
        for lower, upper in pairwise(cuts):
            if self._rise(lower, upper) <= NO_RISE:
                fine[lower:upper] = True
            mistakes += [mistake for low, high in self._steep(lower, upper)
                         if (mistake := self._confirmed(low, high)) is not None]
        return Judgement(mistakes, fine, self.completions, dict(self._cost))

    def _cut_at(self, place: int) -> int:
        while not is_cut(self._actions, place):
            place -= 1
        return place

    def _rise(self, lower: int, upper: int) -> float:
        return (self._cost[upper] - self._cost[lower]) / self.total

    def _steep(self, lower: int, upper: int) -> Iterator[tuple[int, int]]:
        """Yield cuts with one decision between them at which the cost rises."""
        if self._rise(lower, upper) <= LEAST_RISE:
            return
        between = [place for place in range(lower + 1, upper) if is_cut(self._actions, place)]
        if not between:
            yield lower, upper
            return
        middle = between[len(between) // 2]
        self._take_over(lower, middle)
        self._look(middle, upper, 1)
        yield from self._steep(lower, middle)
        yield from self._steep(middle, upper)

    def _confirmed(self, lower: int, upper: int) -> Mistake | None:
        """Look at both again, longer and by other chances; return what is left of the rise."""
        if upper < len(self._actions):
            self._look(upper, upper, 2)
        if self._rise(lower, upper) > LEAST_RISE:
            self._look(lower, lower, 2)
            self._take_over(lower, upper)
        rise = self._rise(lower, upper)
        return Mistake(*self._blame(lower, upper), rise) if rise > LEAST_RISE else None

    def _blame(self, lower: int, upper: int) -> tuple[int, tuple[IntArray, ...]]:
        """Return the wrong decision between two cuts, and the routes it could have begun instead.
        """
        plan = self._plan[lower][lower:]
        if upper == lower + 1:
            return lower, (_first_route(plan),)
        kind = int(self._actions[lower]) // NUM_KINDS
        routes = [(other, customers) for route in to_routes(plan, None)
                  for other, customers in self._ways(route)]
        actions = [to_actions(self._setting.problem, [route], False) for route in routes]
        alike = tuple(codes[1:] for codes, (other, _) in zip(actions, routes, strict=True)
                      if other == kind)
        return (upper - 1, alike) if alike else (lower, tuple(actions))

    def _ways(self, route: tuple[int, list[int]]) -> Routes:
        """Return a route, and its reverse if that is as good."""
        kind, customers = route
        if self._reversible and len(customers) > 1:
            return [route, (kind, customers[::-1])]
        return [route]

    def _take_over(self, lower: int, upper: int) -> None:
        """Complete the longer beginning as the shorter one if that goes the same way. In place."""
        begun = open_type(self._actions[:lower])
        wanted = to_routes(self._actions[lower:upper], begun)
        is_open = open_type(self._actions[:upper]) is not None
        left = to_routes(self._plan[lower][lower:], begun)
        taken: Routes = []
        for index, (kind, customers) in enumerate(wanted):
            partial = is_open and index == len(wanted) - 1
            fixed = begun is not None and index == 0
            match = next(
                ((place, way) for place, route in enumerate(left[:1] if fixed else left)
                 for way in ([route] if fixed else self._ways(route)) if way[0] == kind
                 and (way[1][:len(customers)] if partial else way[1]) == customers), None)
            if match is None:
                return
            del left[match[0]]
            taken.append(match[1])
        actions = to_actions(self._setting.problem, taken + left, begun is not None)
        self._keep(upper, np.concatenate([self._actions[:lower], actions]))

    def compare(self, steps: Sequence[int],
                choices: Sequence[Sequence[int]]) -> Iterator[list[float]]:
        """Yield what plans cost at best that go on by one choice or another.

        Parameters
        ----------
        steps
            Numbers of actions, descending.
        choices
            Codes that are legal there. To open a type costs nothing more if the search opens one
            at any time, since vehicles may come in any order; else its cost is told as nan.
        """
        later = len(self._actions)
        for step, codes in zip(steps, choices, strict=True):
            cut = self._cut_at(step)
            self._look(cut, later, 1)
            later = cut
            yield [self._chosen(cut, step, code) for code in codes]

    def _chosen(self, cut: int, step: int, code: int) -> float:
        """Return what a plan costs that makes a choice after its first actions. In place.

        It begins with the plan of the last cut before.
        """
        begun = open_type(self._actions[:cut])
        routes = to_routes(self._plan[cut][cut:], begun)
        target, what = divmod(code, NUM_KINDS)
        if what == OPEN:
            return self._cost[cut] if target in [kind for kind, _ in routes] else math.nan
        if what == RETURN:
            routes = routes[1:]
        elif step > cut:
            own = next((route for route in routes if target in route[1]), routes[0])
            routes.remove(own)
            kind = int(self._actions[cut]) // NUM_KINDS
            routes.insert(0, (kind, own[1]))
        routes = [(kind, [node for node in nodes if what != DRIVE or node != target])
                  for kind, nodes in routes]
        beginning = np.append(self._actions[:step], code)
        plan = self._completed(beginning, routes)
        cost = cost_of(self._setting, plan)
        if cost < self._cost[cut]:
            self._plan[cut], self._cost[cut] = plan, cost
        return cost

    def _completed(self, beginning: IntArray, routes: Routes) -> IntArray:
        """Return a plan with a beginning, and with routes that the search begins with."""
        self.completions += 1
        rest = what_is_left(self._setting, beginning)
        if rest is None:
            return beginning
        is_open = rest.open_kind is not None
        left = dict(zip(rest.kinds[is_open:],
                        (kind.count for kind in rest.problem.vehicle_types[is_open:]), strict=True))
        kept = routes[:is_open]
        for kind, nodes in routes[is_open:]:
            if nodes and left.get(kind, 0) > 0:
                left[kind] -= 1
                kept.append((kind, nodes))
        turns = FIRST_TURNS + TURNS_EACH * rest.problem.num_customers
        routes = complete(rest, kept, int(turns * self._effort), self.completions)
        return np.concatenate([beginning, to_actions(self._setting.problem, routes, is_open)])

    def _look(self, cut: int, begun_with: int, effort: int) -> None:
        """Complete what was decided before a cut, from the plan of a later one on. In place."""
        self.completions += 1
        start = min((begun_with, *([cut] if cut in self._plan else ())), key=self._cost.__getitem__)
        self._keep(cut, self._plan[start])
        rest = what_is_left(self._setting, self._actions[:cut])
        if rest is None:
            return
        turns = FIRST_TURNS + TURNS_EACH * rest.problem.num_customers
        begun = open_type(self._actions[:cut])
        routes = complete(rest, to_routes(self._plan[cut][cut:], begun),
                          int(turns * effort * self._effort), self.completions)
        self._keep(cut, np.concatenate([
            self._actions[:cut], to_actions(self._setting.problem, routes, begun is not None)]))

    def _keep(self, cut: int, plan: IntArray) -> None:
        """Keep the cheapest plan with a beginning. In place."""
        cost = cost_of(self._setting, plan)
        if cut not in self._cost or cost < self._cost[cut]:
            self._plan[cut], self._cost[cut] = plan, cost


def _first_route(plan: IntArray) -> IntArray:
    """Return the actions up to the first return."""
    last = int(np.argmax(plan % NUM_KINDS == RETURN))
    return plan[:last + 1]


def _is_reversible(problem: Problem) -> bool:
    """Tell whether routes cost the same in either direction."""
    return (all(customer.latest >= UNLIMITED and customer.earliest == 0
                for customer in problem.customers)
            and all(np.array_equal(matrix, matrix.T) for travel in problem.travel
                    for matrix in travel.arrays()))
