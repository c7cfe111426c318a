"""Improvement of a plan until a deadline, by several threads that share what they find."""

import math
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from model.instance import TYPE_DRONES, Instance
from model.problem import Problem
from model.search.anneal import anneal, begin_anew
from model.search.layout import World
from model.search.sharing import Crew
from model.search.state import (
    I_CUSTOMERS, I_MISSING, V_BEST, V_COOLING, V_COST, V_TEMPERATURE, Searcher,
)
from model.search.translate import first_plan, leg_cost, make_searcher, read_plan
from model.search.world import ALL_MOVES, Moves, has_single_drones, make_world
from model.solution import Solution

ROUNDS = 40
"""How often threads share their routes."""

SHORTEST_ROUND = 0.005
"""Seconds that threads search for at least before they share their routes."""

LONGEST_ROUND = 0.5
"""Seconds after which they share them at the latest, and the caller hears of the best."""

SLICE = 0.003
"""Seconds between two looks at the clock."""

HOT, COLD = 1.0, 0.1
"""First temperature by what a customer costs, last by what a leg between customers does."""

FULL_HEAT = 2600
"""Turns for each customer from which on the first temperature is reached; less, by their root."""

LEAST_HEAT = 0.3
"""Share of the first temperature that is reached even in the shortest search."""

LEAST_HOT = 1.0
"""The first temperature is at least this by a leg."""

HOT_WITH_DRONES, COLD_WITH_DRONES = 0.5, 0.005
"""Both by a leg where trips are split between truck and drone, which many small changes do."""

HOT_FROM_TRUCKS = 0.2
"""The same where the search began with trucks alone."""

BY_TRUCK_FROM, BY_TRUCK_SHARE = 30, 0.15
"""Number of customers from which on a plan with single drones begins with one by trucks alone, and
the share of the time that this takes."""

MOST_BEGINNING = 0.05
"""Share of the time after which no other type of vehicle is tried at the beginning."""

FIRST_SLICE = 8
"""Turns before the first look at the clock."""


@dataclass(frozen=True)
class SearchConfig:
    """How to search."""

    seed: int = 0
    threads: int = 1
    turns: int | None = None  # of all threads together; None: until the deadline
    hot: float | None = None  # first temperature by the cost of a leg; None: by the problem
    cold: float | None = None  # last
    moves: Moves = ALL_MOVES


@dataclass(frozen=True)
class Progress:
    """The best routes so far."""

    cost: float  # as the search counts it
    turns: int
    plan: Callable[[], Solution]  # valid during the call it is given to


@dataclass(frozen=True)
class Improved:
    """The best plan found."""

    solution: Solution
    cost: float  # as the search counts it
    first_cost: float  # of the routes that it began with
    turns: int


@dataclass(frozen=True)
class _Limits:
    """When a search ends, for each thread."""

    began: float
    deadline: float  # infinite if only turns count
    turns: int | None
    should_stop: Callable[[], bool]

    def share(self) -> float:
        """Return how much of the time is over, 0 to 1."""
        return min(1.0, (time.perf_counter() - self.began) / (self.deadline - self.began))

    def round_end(self, turns: int) -> tuple[float, float]:
        """Return after how many turns and when the round ends that begins after `turns`."""
        if self.turns is not None:
            return min(self.turns, turns + math.ceil(self.turns / ROUNDS)), self.deadline
        length = (self.deadline - self.began) / ROUNDS
        length = min(LONGEST_ROUND, max(SHORTEST_ROUND, length))
        return math.inf, min(self.deadline, time.perf_counter() + length)

    def over(self, turns: int) -> bool:
        """Tell whether the search ends after `turns`."""
        return (self.should_stop() or time.perf_counter() >= self.deadline
                or (self.turns is not None and turns >= self.turns))


@dataclass(frozen=True)
class _Costs:
    """What the temperature goes by."""

    first: float  # of the routes that the search began with
    customer: float  # of a customer served, on average
    leg: float  # between two customers
    from_trucks: bool  # they were made for trucks alone

    @classmethod
    def of(cls, world: World, searcher: Searcher, from_trucks: bool) -> "_Costs":
        """Measure the routes as they are."""
        first = float(searcher.value[V_COST])
        missing = int(searcher.count[I_MISSING])
        served = max(1, int(searcher.count[I_CUSTOMERS]) - missing)
        return cls(first, (first - missing * world.unassigned_cost) / served,
                   leg_cost(world, searcher), from_trucks)


@dataclass
class _Worker:
    """One thread's search."""

    world: World
    searcher: Searcher
    config: SearchConfig
    limits: _Limits
    costs: _Costs
    turns: int = 0
    pace: float = 0.0  # seconds a turn takes

    def run(self) -> None:
        """Search for one round."""
        most, end = self.limits.round_end(self.turns)
        while self.turns < most and not self.limits.should_stop():
            now = time.perf_counter()
            if now >= end:
                return
            self._anneal(int(min(most - self.turns, self._slice(end - now))))

    def _heat(self) -> tuple[float, float]:
        """Return the first and the last temperature."""
        costs = self.costs
        if (self.world.type[:, TYPE_DRONES] == 1).any():
            hot, cold = HOT_WITH_DRONES, COLD_WITH_DRONES
            if costs.from_trucks:
                hot = HOT_FROM_TRUCKS
        else:
            hot, cold = max(LEAST_HOT, self._haste() * HOT * costs.customer / costs.leg), COLD
        return costs.leg * (self.config.hot or hot), costs.leg * (self.config.cold or cold)

    def _haste(self) -> float:
        """Return the share of the first temperature that there is time for."""
        if self.world.num_types > 1:
            return 1.0  # the start by insertion is too far from good
        turns: float = self.limits.turns or 0
        if self.limits.turns is None and self.pace > 0.0:
            turns = (self.limits.deadline - self.limits.began) / self.pace
        share = turns / max(1, int(self.searcher.count[I_CUSTOMERS])) / FULL_HEAT
        return min(1.0, max(LEAST_HEAT, math.sqrt(share)))

    def _slice(self, seconds: float) -> float:
        if self.limits.turns is not None and self.limits.deadline == math.inf:
            return math.ceil(self.limits.turns / (4 * ROUNDS))
        if self.pace == 0.0:
            return FIRST_SLICE
        return max(1.0, min(SLICE, seconds) / self.pace)

    def _anneal(self, turns: int) -> None:
        value = self.searcher.value
        if self.limits.turns is None:
            hot, cold = self._heat()
            value[V_TEMPERATURE] = hot * (cold / hot) ** self.limits.share()
            value[V_COOLING] = 1.0
        elif self.turns == 0:
            # By turns alone, so that the clock changes nothing.
            hot, cold = self._heat()
            value[V_TEMPERATURE] = hot
            value[V_COOLING] = (cold / hot) ** (1 / self.limits.turns)
        began = time.perf_counter()
        anneal(self.world, self.searcher, turns)
        self.turns += turns
        self.pace = (time.perf_counter() - began) / turns


def improve(problem: Problem, instance: Instance, solution: Solution, config: SearchConfig,
            deadline: float | None = None, should_stop: Callable[[], bool] = lambda: False,
            on_progress: Callable[[Progress], None] = lambda _: None) -> Improved:
    """Search for a better plan than the one given.

    Parameters
    ----------
    problem
        The problem planned.
    instance
        The same, packed alone.
    solution
        Any plan, or one without routes, from which the search builds one.
    config
        With a number of turns, the same seed and number of threads give the same plan, unless
        the deadline or `should_stop` ends the search before.
    deadline
        On `time.perf_counter`; None: no limit.
    should_stop
        Asked every few milliseconds, from several threads.
    on_progress
        Told of the best routes so far, `ROUNDS` times or each `LONGEST_ROUND`.

    Returns
    -------
    The best plan found. It may be worse than the one given if the search can't represent that.

    Raises
    ------
    ValueError
        If there is neither a deadline nor a number of turns.
    """
    if deadline is None and config.turns is None:
        raise ValueError("deadline, turns: None, None is not allowed")
    limits = _Limits(time.perf_counter(), math.inf if deadline is None else deadline,
                     None if config.turns is None else config.turns // config.threads, should_stop)
    by_truck = not solution.routes and trucks_come_first(problem, config.moves)
    if by_truck:
        solution = _plan_by_truck(problem, instance, config, limits)
    world = make_world(problem, instance, config.moves)
    fresh = not solution.routes
    if fresh:
        solution = first_plan(problem, world)
    seeds = np.random.SeedSequence(config.seed).spawn(config.threads + 1)
    whole = make_searcher(problem, world, solution, seeds[0])
    begin_anew(world, whole, fresh)
    if fresh and world.mixed:
        _begin_by_types(world, whole, limits)
    costs = _Costs.of(world, whole, by_truck)
    crew = Crew(world, problem.coordinates, whole, seeds[1:])
    workers = [_Worker(world, whole, config, limits, costs) for _ in range(config.threads)]
    with ThreadPoolExecutor(config.threads) as pool:
        while True:
            for worker, part in zip(workers, crew.spread(), strict=True):
                worker.searcher = part
            list(pool.map(_Worker.run, workers))
            crew.gather()
            on_progress(Progress(float(whole.value[V_BEST]), sum(w.turns for w in workers),
                                 partial(read_plan, world, whole)))
            if limits.over(workers[0].turns):
                break
    return Improved(read_plan(world, whole), float(whole.value[V_BEST]), costs.first,
                    sum(worker.turns for worker in workers))


def _begin_by_types(world: World, whole: Searcher, limits: _Limits) -> None:
    """Plan anew by vehicles of one type after another as far as they go. In place: the best plan.

    What a route costs its first customer says nothing of how many more a larger vehicle serves.
    """
    alone = whole.alone
    dearest = float(alone[np.isfinite(alone)].max(initial=0.0))
    for k in range(world.num_types):
        if limits.turns is None and limits.share() > MOST_BEGINNING:
            return
        others_last = alone + dearest
        others_last[k] = alone[k]
        begin_anew(world, whole._replace(alone=others_last), True)


def trucks_come_first(problem: Problem, moves: Moves = ALL_MOVES) -> bool:
    """Tell whether a search that is given no plan begins with one by trucks alone."""
    return problem.num_customers >= BY_TRUCK_FROM and has_single_drones(problem, moves)


def _plan_by_truck(problem: Problem, instance: Instance, config: SearchConfig,
                   limits: _Limits) -> Solution:
    """Return a plan without flights, to which the drones' then are added.

    The order of the customers is found sooner so; whom no truck can serve is left out.
    """
    turns = None if config.turns is None else math.ceil(config.turns * BY_TRUCK_SHARE)
    deadline = limits.began + (limits.deadline - limits.began) * BY_TRUCK_SHARE
    by_truck = replace(config, turns=turns,
                       moves=replace(config.moves, loops=False, crossings=False))
    found = improve(problem, instance, Solution((), ()), by_truck,
                    None if math.isinf(deadline) else deadline, limits.should_stop)
    return found.solution
