"""Improvement of a plan until a deadline, by several threads that share what they find."""

import math
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial

import numpy as np

from model.instance import TYPE_DRONES, Instance
from model.problem import Problem
from model.search.anneal import anneal, begin_anew
from model.search.layout import World
from model.search.state import I_MISSING, V_BEST, V_COOLING, V_COST, V_TEMPERATURE, Searcher, follow
from model.search.translate import first_plan, leg_cost, make_searcher, read_plan
from model.search.world import ALL_MOVES, Moves, make_world
from model.solution import Solution

ROUNDS = 40
"""How often threads share their routes."""

SLICE = 0.003
"""Seconds between two looks at the clock."""

HOT, COLD = 1.0, 0.1
"""First temperature by what a customer costs, last by what a leg between customers does."""

HOT_WITH_DRONES, COLD_WITH_DRONES = 0.5, 0.005
"""Both by a leg where trips are split between truck and drone, which many small changes do."""

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
        now = time.perf_counter()
        return math.inf, min(self.deadline, now + (self.deadline - self.began) / ROUNDS)

    def over(self, turns: int) -> bool:
        """Tell whether the search ends after `turns`."""
        return (self.should_stop() or time.perf_counter() >= self.deadline
                or (self.turns is not None and turns >= self.turns))


@dataclass
class _Worker:
    """One thread's search."""

    world: World
    searcher: Searcher
    config: SearchConfig
    limits: _Limits
    fresh: bool  # there was no plan to begin with
    turns: int = 0
    pace: float = 0.0  # seconds a turn takes
    hot: float = 0.0  # first temperature
    cold: float = 0.0  # last temperature
    first_cost: float = 0.0

    def run(self) -> None:
        """Search for one round."""
        if self.hot == 0.0:
            begin_anew(self.world, self.searcher, self.fresh)
            self.first_cost = float(self.searcher.value[V_COST])
            self._set_heat()
        most, end = self.limits.round_end(self.turns)
        while self.turns < most and not self.limits.should_stop():
            now = time.perf_counter()
            if now >= end:
                return
            self._anneal(int(min(most - self.turns, self._slice(end - now))))

    def _set_heat(self) -> None:
        leg = leg_cost(self.world, self.searcher)
        missing = float(self.searcher.count[I_MISSING]) * self.world.unassigned_cost
        customers = self.world.num_nodes - self.world.num_depots
        hot, cold = max(HOT * (self.first_cost - missing) / max(1, customers) / leg, 1.0), COLD
        if (self.world.type[:, TYPE_DRONES] == 1).any():
            hot, cold = HOT_WITH_DRONES, COLD_WITH_DRONES
        self.hot = leg * (self.config.hot or hot)
        self.cold = leg * (self.config.cold or cold)

    def _slice(self, seconds: float) -> float:
        if self.limits.turns is not None and self.limits.deadline == math.inf:
            return math.ceil(self.limits.turns / (4 * ROUNDS))
        if self.pace == 0.0:
            return FIRST_SLICE
        return max(1.0, min(SLICE, seconds) / self.pace)

    def _anneal(self, turns: int) -> None:
        ratio = self.cold / self.hot
        value = self.searcher.value
        if self.limits.turns is None:
            share = self.limits.share()
            value[V_TEMPERATURE] = self.hot * ratio**share
            value[V_COOLING] = 1.0
        elif self.turns == 0:
            # By turns alone, so that the clock changes nothing.
            value[V_TEMPERATURE] = self.hot
            value[V_COOLING] = ratio ** (1 / self.limits.turns)
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
        Told of the best routes so far, about `ROUNDS` times.

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
    world = make_world(problem, instance, config.moves)
    fresh = not solution.routes
    if fresh:
        solution = first_plan(problem, world)
    seeds = np.random.SeedSequence(config.seed).spawn(config.threads)
    workers = [_Worker(world, make_searcher(problem, world, solution, seed), config, limits,
                       fresh)
               for seed in seeds]
    with ThreadPoolExecutor(config.threads) as pool:
        while True:
            list(pool.map(_Worker.run, workers))
            best = _share(workers)
            on_progress(Progress(float(best.value[V_BEST]), sum(w.turns for w in workers),
                                 partial(read_plan, world, best)))
            if limits.over(workers[0].turns):
                break
    return Improved(read_plan(world, best), float(best.value[V_BEST]),
                    min(worker.first_cost for worker in workers),
                    sum(worker.turns for worker in workers))


def _share(workers: list[_Worker]) -> Searcher:
    """Let all threads go on from the cheapest routes; return that with the best. In place."""
    searchers = [worker.searcher for worker in workers]
    leader = min(searchers, key=lambda searcher: float(searcher.value[V_COST]))
    for searcher in searchers:
        if searcher is not leader:
            follow(searcher, leader)
    return min(searchers, key=lambda searcher: float(searcher.value[V_BEST]))
