"""Improvement of a plan until a deadline, by several threads that share what they find."""

import math
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from model.engine.alarm import Alarm
from model.engine.instance import Instance, pack
from model.engine.library import call
from model.engine.pausing import EndedError, never, pausing
from model.problem import Problem
from model.search.beginning.construct import begin_anew, begin_by_types
from model.search.beginning.packing import (
    comes_by_trips, packed_anew, packed_plan, timed, with_single_trips)
from model.search.beginning.translate import best_plan, make_searcher
from model.search.ejection import by_ejection
from model.search.fewer_flown import FewerFlown, fewer_may_pay
from model.search.fewer_vehicles import FEWER_SHARE, search_fewer
from model.search.first_plan import first_plan
from model.search.neighbourhood.neighbourhood import Neighbourhood, make_neighbourhood
from model.search.linked.layout import Linked
from model.search.limits import WHOLE, Cooling, SearchLimits
from model.search.linked_rooms import linked_rooms
from model.search.memetic import spans_of_rest
from model.search.problem_data import make_data, only_loads_limit
from model.search.route.layout import NOWHERE, ProblemData
from model.search.route.state import Searcher
from model.search.sharing import Crew, go_on_from_best
from model.search.starts import Starting, Starts, starting_of
from model.search.strategy import ALL_MOVES, Moves
from model.search.temperature import Heat
from model.search.worker import SearchThread
from model.solution import Solution, renumbered

BY_TRUCK_FROM, BY_TRUCK_SHARE = 30, 0.15
"""Number of customers from which on a plan with drones begins with trucks alone, and the share."""

BY_TRIP_SHARE, BY_TRIP_SHARE_FOR_FEWER, BY_TRIP_COOLED = 0.8, 0.6, 0.6
"""The share that trips of who flies take first, the same where fewer vehicles may be tried then,
and through how much of the cooling they go."""

MOST_BEGINNING = 0.05
"""Share of the time after which no other type of vehicle is tried at the beginning; thousands of
customers have what other plans have, since the search is far from done with what it begins with."""

BEGINNING_SHARE = 0.3
"""Share of the time after which no other plan by insertion is tried, where there is one of all."""

GRACE, BEGINNING = 0.03, 0.25
"""Seconds that it may take even where no time is left, and to begin where there is no plan."""

LARGE_FROM = 2000
"""Number of customers from which on a search is far from done with what it begins with."""

LARGE_BY_TRUCK_SHARE = 0.6
"""The share by trucks alone there: a turn with drones takes many times as long."""

IN_PARTS_FROM = 800
"""Number of customers from which on a search of few turns stays near one of them for a while: what
it looks at then is in the processor's cache. Where drones fly, from `LARGE_FROM` on."""

FEW_TURNS = 300
"""Turns for each customer below which it does; with more it pays only past the cache."""

LARGER_THAN_CACHE = 20_000
"""Number of customers from which on a search stays near one after another however long it is."""

STAY = 200
"""Turns for which it does."""

Reading = Callable[[int, int], float]
"""Seconds that a plan of so many routes and sorties takes to read."""

REHEAT = 0.3
"""First temperature of what follows from the best of them, by that of a start."""


@dataclass(frozen=True)
class SearchConfig:
    """How to search."""

    seed: int = 0
    threads: int = 1
    turns: int | None = None  # of all threads together; None: until the deadline
    hot: float | None = None  # first temperature by the cost of a leg; None: by the problem
    cold: float | None = None  # last
    cooled: float = 0.0  # share of the cooling that earlier searches for this plan went through
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
    cost: float  # as the search counts it; infinite if it ended before it began
    first_cost: float  # of the routes that it began with; 0 if there are none
    turns: int
    whole: bool  # nothing was cut short


@dataclass(frozen=True)
class _Team:
    """All threads."""

    whole: Searcher
    workers: list[SearchThread]
    limits: SearchLimits
    pool: ThreadPoolExecutor
    after_round: Callable[[int], None]  # told of the turns of all

    def over(self, span: Cooling = WHOLE) -> bool:
        """Tell whether the search, or a span of it, ends."""
        return self.limits.over(self.workers[0].turns, span)

    def share(self) -> float:
        """Return the share of the search that is over; 1 once it must end."""
        turns = self.workers[0].turns
        return 1.0 if self.over() else self.limits.share(turns)

    def search(self, crew: Crew | Starts, span: Cooling, rounds: float = math.inf) -> None:
        """Search in rounds until the end of a span, or for a number of rounds; for one at least."""
        while True:
            stay = STAY if self._is_in_parts() else 0
            for worker, (data, part) in zip(self.workers, crew.spread(), strict=True):
                worker.set_out(data, part, span)
                part.count.stay = stay
                if stay == 0:
                    part.count.focus = NOWHERE
            list(self.pool.map(SearchThread.run, self.workers))
            crew.gather()
            self.after_round(sum(worker.turns for worker in self.workers))
            rounds -= 1
            if rounds <= 0 or self.over(span):
                return

    def _is_in_parts(self) -> bool:
        """Tell whether to stay near one customer after another, as far as is known."""
        least = LARGE_FROM if self.workers[0].heat.drones else IN_PARTS_FROM
        customers, turns = int(self.whole.count.customers), self._expected_turns()
        pays = customers >= LARGER_THAN_CACHE or turns < FEW_TURNS
        return customers >= least and turns > 0 and pays

    def _expected_turns(self) -> float:
        """Return how many turns for each customer there are in all, as far as is known."""
        return min(worker.expected() for worker in self.workers)

    def num_starts(self, starting: Starting) -> int:
        """Return how often to begin, by how many turns there is time for."""
        return min(starting.most, int(starting.share * self._expected_turns() / starting.turns))


def improve(problem: Problem, instance: Instance, solution: Solution, config: SearchConfig,
            deadline: float | None = None, should_stop: Callable[[], bool] = never,
            on_progress: Callable[[Progress], None] = lambda _: None,
            reading: Reading = lambda routes, sorties: 0.0,
            given_cost: float = math.inf) -> Improved:
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
        Asked every few milliseconds, from several threads, and between rounds.
    on_progress
        Told of the best routes so far, `ROUNDS` times or each `LONGEST_ROUND`.
    reading
        How long before the deadline the search ends, by the numbers of routes and sorties of its
        best plan: what reading that takes and what the caller does with it.
    given_cost
        What the plan given costs: where it is late and none is found that costs less, that one is
        returned, and no other read, which may take longer than the search.

    Returns
    -------
    The best plan found. It may be worse than the one given if the search can't represent that; it
    is that one if there was no time to begin.

    Raises
    ------
    ValueError
        If there is neither a deadline nor a number of turns.
    """
    if deadline is None and config.turns is None:
        raise ValueError("deadline, turns: None, None is not allowed")
    began, end = time.perf_counter(), math.inf if deadline is None else deadline
    # Where no routes are given, a late plan is better than none.
    latest, grace = (end, GRACE) if solution.routes else (math.inf, BEGINNING)
    found = Improved(solution, math.inf, 0.0, 0, False)
    try:
        neighbourhood = make_neighbourhood(
            problem, instance, pausing(should_stop, latest, GRACE), along=True)
        with Alarm(max(end, time.perf_counter() + grace), should_stop) as alarm:
            limits = SearchLimits(began, end,
                                  None if config.turns is None else config.turns // config.threads,
                                  lambda: alarm.has_rung or should_stop())
            task = _Task(problem, instance, neighbourhood, config, limits, alarm, reading,
                         given_cost if solution.routes else math.inf)
            trucks_first = not solution.routes and _trucks_come_first(problem, config.moves)
            if trucks_first:
                found = _plan_by_truck(task)
            elif not solution.routes and comes_by_trips(problem):
                found = _plan_by_trip(task)
                task = replace(task, by_trip=True, config=replace(config, cooled=BY_TRIP_COOLED))
            if alarm.has_rung:
                return found
            return _improved(task, found.solution, trucks_first, on_progress)
    except EndedError:
        return found


@dataclass(frozen=True)
class _Task:
    """What is to be planned, and until when."""

    problem: Problem
    instance: Instance
    neighbourhood: Neighbourhood
    config: SearchConfig
    limits: SearchLimits
    alarm: Alarm
    reading: Reading
    given_cost: float = math.inf  # of the plan that is given
    by_trip: bool = False  # it goes on from trips that were packed


def _improved(task: _Task, solution: Solution, from_trucks: bool,
              on_progress: Callable[[Progress], None]) -> Improved:
    """Search for a better plan than the one given, which trucks alone made if `from_trucks`."""
    problem, config, limits = task.problem, task.config, task.limits
    data = make_data(problem, task.instance, config.moves, task.neighbourhood, task.alarm.setting)
    numbering, fresh = task.neighbourhood.numbering, not solution.routes
    plan = (first_plan(problem, data, numbering) if fresh
            else renumbered(solution, numbering.number.tolist().__getitem__))
    seeds = np.random.SeedSequence(config.seed).spawn(config.threads + 1)
    whole = make_searcher(problem, data, plan, seeds[0])
    is_large = problem.num_customers >= LARGE_FROM
    linked = linked_rooms(data, whole, config.threads)
    _begin(data, whole, linked[0], fresh, fresh and bool(plan.routes), task)
    limits.reading = task.reading(*call("tandem_size_of_best", whole))
    heat = Heat.of(data, whole, is_large, from_trucks, config.hot, config.cold)
    first_cost = float(whole.value.cost)
    workers = [SearchThread(data, whole, limits, heat, cooled=config.cooled, linked=room)
               for room in linked]

    node = numbering.node.tolist()

    def best(searcher: Searcher = whole) -> Solution:
        return best_plan(data, searcher, node)

    def after_round(turns: int) -> None:
        limits.reading = task.reading(*call("tandem_size_of_best", whole))
        on_progress(Progress(float(whole.value.best), turns, best))

    crew = Crew(data, problem.coordinates[numbering.node], whole, seeds[1:])
    with ThreadPoolExecutor(config.threads) as pool, suppress(EndedError):
        team = _Team(whole, workers, limits, pool, after_round)
        if task.by_trip and fewer_may_pay(problem):
            team.search(crew, WHOLE, rounds=1)
            FewerFlown(problem, data, whole, node, team.share).run(
                lambda: team.search(crew, WHOLE, rounds=1))
        _search(team, data, crew, seeds[1:])
    found = whole
    with suppress(EndedError):
        found = packed_anew(problem, data, whole, node)
    cost, is_late = float(found.value.best), task.alarm.has_rung
    in_vain = is_late and max(first_cost, task.given_cost) <= cost < math.inf
    return Improved(solution if in_vain else best(found), cost, first_cost,
                    sum(worker.turns for worker in workers), not is_late)


def _begin(data: ProblemData, whole: Searcher, linked: Linked | None, fresh: bool,
           by_savings: bool, task: _Task) -> None:
    """Insert the customers left out; if nothing was given, plan all anew where that is better.

    In place. `by_savings`: what there is was made so. Where the clock ends the search, it ends
    other beginnings early, once there is one.
    """
    limits, deadline = task.limits, math.inf
    is_large = task.problem.num_customers >= LARGE_FROM
    if limits.turns is None:
        deadline = limits.began + (limits.deadline - limits.began) * BEGINNING_SHARE
    # Savings are far better than insertion there, which in large problems takes its time.
    is_best = by_savings and is_large and only_loads_limit(data)
    with task.alarm.sooner(deadline) as alarm:
        hurried = data._replace(deadline=alarm.setting)
        begin_anew(data, whole, fresh and not is_best, hurried, linked)
        if fresh and data.strategy.change_vehicles and not by_savings:
            most = BEGINNING_SHARE if is_large else MOST_BEGINNING
            begin_by_types(hurried, whole, lambda: limits.turns is None and limits.share(0) > most)


def _search(team: _Team, data: ProblemData, crew: Crew,
            seeds: list[np.random.SeedSequence]) -> None:
    """Search until the end. In place.

    Where there is time, threads begin several times, and the search goes on from the best: which
    plans it can reach is settled while it is hot, however slowly it cools. In large problems the
    parts of a plan differ, not the whole.
    """
    whole, first = team.whole, team.workers[0]
    if first.heat.vehicles_first:
        _search_by_fewer(team, data, crew)
        return
    starting = None if first.cooled > 0.0 else starting_of(data, first.heat)
    rest = WHOLE
    starts = None if starting is None else Starts(data, whole, seeds, first.linked)
    team.search(crew, WHOLE, rounds=1)
    if starting is not None and starts is not None and (count := team.num_starts(starting)) > 1:
        ends = np.linspace(team.limits.share(first.turns), starting.share, count + 1)
        for number, end in enumerate(ends[1:].tolist()):
            span = Cooling(team.limits.share(first.turns), end, 1.0)
            if not team.over(span):
                starts.begin(starting.anew and number > 0, fewer=number % 2 == 1)
                team.search(starts, span)
        go_on_from_best(data, whole)
        rest = Cooling(team.limits.share(first.turns), 1.0, REHEAT)
    if not team.over():
        team.search(crew, rest)


def _search_by_fewer(team: _Team, data: ProblemData, crew: Crew) -> None:
    """Search for plans by fewer vehicles first, then for shorter ones. In place."""
    first = team.workers[0]
    team.search(crew, WHOLE, rounds=1)
    span = Cooling(team.limits.share(first.turns), FEWER_SHARE, 1.0)
    if not team.over(span):
        search_fewer(data, team.whole, lambda: team.search(crew, span, rounds=1),
                     lambda: team.over(span), by_ejection(data, team.whole, team.workers, span))
    for rest in spans_of_rest(data, team.whole, team.workers):
        team.search(crew, rest)


def _trucks_come_first(problem: Problem, moves: Moves) -> bool:
    """Tell whether a search that is given no plan begins with one by trucks alone."""
    has_drones = any(kind.drones is not None for kind in problem.vehicle_types)
    return problem.num_customers >= BY_TRUCK_FROM and has_drones and moves.flights


def _plan_by_truck(task: _Task) -> Improved:
    """Return a plan without flights, to which the drones' then are added.

    The order of the customers is found sooner so; whom no truck can serve is left out.
    """
    moves = replace(task.config.moves, loops=False, crossings=False)
    is_large = task.problem.num_customers >= LARGE_FROM
    return _beforehand(replace(task, config=replace(task.config, moves=moves)),
                       LARGE_BY_TRUCK_SHARE if is_large else BY_TRUCK_SHARE)


def _plan_by_trip(task: _Task) -> Improved:
    """Return a plan whose trips were found as if each were a vehicle's own, then packed."""
    single = with_single_trips(task.problem)
    found = _beforehand(replace(task, problem=single, instance=pack([single], False)),
                        BY_TRIP_SHARE_FOR_FEWER if fewer_may_pay(task.problem) else BY_TRIP_SHARE)
    data = make_data(task.problem, task.instance, task.config.moves, task.neighbourhood)
    return replace(found, solution=timed(task.problem, data, task.neighbourhood.numbering,
                                         packed_plan(task.problem, found.solution)))


def _beforehand(task: _Task, share: float) -> Improved:
    """Return what a search that is given no plan finds in a share of the time."""
    limits, threads = task.limits, task.config.threads
    turns = None if task.config.turns is None else math.ceil(task.config.turns * share)
    deadline = limits.began + (limits.deadline - limits.began) * share
    limits = replace(limits, began=time.perf_counter(), end=deadline,
                     turns=turns and turns // threads)
    task = replace(task, config=replace(task.config, turns=turns), limits=limits)
    return _improved(task, Solution((), ()), False, lambda _: None)
