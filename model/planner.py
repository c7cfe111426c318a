"""The planner: decode, improve, check.

`Completed`, `Progress` and `PlanCheckError` are passed on to those who plan, who need no other part
for them.
"""

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, NamedTuple

from model.judge.accepting import Accepted, Judge
from model.judge.accepting import Completed as Completed
from model.judge.accepting import PlanCheckError as PlanCheckError
from model.judge.check import Evaluation
from model.judge.memory import Memory
from model.engine.alarm import Alarm
from model.engine.instance import Instance, pack
from model.engine.pausing import EndedError, Pause, never, pausing
from model.policy.decode import DecodeConfig, Policy, decode, load_policy, prepare
from model.policy.rolling import NOTHING
from model.problem import Problem, limits_chargers
from model.search.improve import GRACE, Improved, SearchConfig, improve
from model.search.improve import Progress as Progress
from model.search.reserve import more_by_plan, usual_reserve
from model.policy.extract import extract
from model.solution import Solution
from model.together.exact import MOST_CUSTOMERS
from model.together.improving import SearchPart, SearchTerms, improve_together
from model.together.joint import find_joint
from model.together.pulling import nobody_served

Start = Literal["policy", "insertion", "given"]

DECODING_SHARE = 0.1
"""Most of the time limit that the policy may take, by `decoding_seconds`; else the search plans
from nothing."""

DECODED_UP_TO = 2000
"""For how many customers at most policies plan: what they see grows by the square."""

MIXED_SHARE, MIXED_UP_TO = 0.4, 200
"""The same with drones or several types of vehicles, for so many customers at most: what the search
begins with there is dearer than the policy's plan."""

COMPLETING = 0.25
"""Seconds that it may take to put those back whom routes served that were refused."""

GIVE_UP_SHARE = 0.5
"""Share of the time limit after which the policy is given up where a search follows."""


LEAST_UNHURRIED, UNHURRIED_PER_CUSTOMER = 1.0, 2e-3
"""Seconds, and those for each customer, that an insertion of all may take which no time limit ends:
many times what it takes, but where each place of a customer has many trips timed anew."""


class Listener(NamedTuple):
    """What a caller may say and hear while a plan is improved."""

    should_stop: Callable[[], bool] = never
    on_progress: Callable[[Progress], None] = lambda _: None


ALONE = Listener()


@dataclass(frozen=True)
class PlanOptions:
    """How to plan."""

    policy: str
    decoding: Literal["greedy", "sample"] = "greedy"
    num_samples: int = 64
    temperature: float = 1.0
    seed: int = 0
    time_limit: float = 1.0  # seconds; 0: the decoded plan as it is, all samples of it
    search_iterations: int | None = None
    threads: int = 1  # of the search
    cooled: float = 0.0  # share of the search's cooling that is over, if it goes on from a plan


@dataclass(frozen=True)
class Elapsed:
    """Seconds by phase."""

    decode: float
    search: float
    check: float


@dataclass(frozen=True)
class PlanResult:
    """A checked plan and how it came about."""

    solution: Solution
    evaluation: Evaluation
    start: Start
    decoded_cost: float  # of the plan that the search began with
    final_cost: float
    search_iterations: int  # of all threads together
    threads: int
    deterministic: bool  # no clock and no listener had a say in it
    elapsed: Elapsed
    refused: int = 0  # plans on the way that the check refused: errors of the planner


class Planner:
    """Plans problems by named policies. Safe to call from several threads.

    `on_refused` is called for each plan found that the independent check refuses.
    """

    def __init__(self, policies: Mapping[str, Policy],
                 on_refused: Callable[[], None] = lambda: None) -> None:
        self._policies = dict(policies)
        self._on_refused = on_refused

    @property
    def policies(self) -> tuple[str, ...]:
        """Names of the loaded policies."""
        return tuple(self._policies)

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        """Plan a problem.

        Parameters
        ----------
        problem
            At least one customer.
        options
            How to plan.
        received_at
            When the time limit began to run, on `time.perf_counter`; None: now.
        listener
            Whether to stop improving, and whom to tell of the first plan and of improvements.
        start
            A plan without violations to improve, in place of the policy's.

        What the independent check refuses of what was found, or of `start`, is logged and counted,
        and the best plan stands for it that is accepted.

        Raises
        ------
        ValueError
            If the policy is not loaded.
        PlanCheckError
            If every plan fails the independent check.
        """
        self._require(options.policy)
        began, options = time.perf_counter(), _shared(problem, options)
        judge = Judge(Memory(problem), _completing(options.seed), self._on_refused)
        deadline = None
        if options.time_limit > 0:
            deadline = (began if received_at is None else received_at) + options.time_limit
        searches = options.search_iterations != 0 and deadline is not None
        by_policy = start is None and problem.num_customers <= DECODED_UP_TO and (
            not searches or policy_begins(problem, options))
        try:
            instance = pack([problem], by_policy, _pause(listener, deadline, start))
        except EndedError:
            return _unimproved(judge, start, options, began)
        decoded = began
        whole = True  # no clock cut the policy short
        if by_policy:
            give_up = _give_up(began, deadline, searches)
            start = self._decode(problem, instance, options, give_up, listener, searches)
            decoded = time.perf_counter()
            whole = decoded < give_up
            by_policy = start is not None
        first = None if start is None else judge.accepted(start)
        how: Start = "policy" if by_policy else "insertion" if first is None else "given"
        if first is not None:
            _tell(listener, first)
            if not searches:
                return _result(first, how, first.cost, options, None, whole, judge,
                               Elapsed(decoded - began, 0.0, time.perf_counter() - decoded))
        elif not searches:
            # No policy planned, so that the plan is what a search would begin with.
            options, deadline = replace(options, search_iterations=0), deadline or patience(problem)
        improved = _improve(problem, instance, first, options, deadline, listener)
        searched = time.perf_counter()
        last = judge.accepted(improved.solution)
        if first is not None and first.cost <= last.cost:
            last = first
        elapsed = Elapsed(decoded - began, searched - decoded, time.perf_counter() - searched)
        # By the search's sum, which rounds otherwise than the checker's.
        first_cost = max(improved.first_cost, last.cost) if first is None else first.cost
        return _result(last, how, first_cost, options, improved, whole, judge, elapsed)

    def _require(self, policy: str) -> None:
        if policy not in self._policies:
            raise ValueError(f"policy: {policy!r} is not one of {', '.join(self.policies)}")

    def _decode(self, problem: Problem, instance: Instance, options: PlanOptions,
                give_up: float, listener: Listener, searches: bool) -> Solution | None:
        """Return the policy's plan; None if there is none by the time to give up."""
        policy = self._policies[options.policy]
        config = DecodeConfig(options.decoding, options.num_samples, options.temperature,
                              options.seed)
        if searches:
            # In the time for more views a search comes further.
            config = replace(config, most_views=1)
        with Alarm(give_up, listener.should_stop) as alarm:
            if alarm.has_rung:
                return None
            view = prepare(problem, instance)
            found = decode(policy, view, config, give_up, alarm.setting)
        return None if found is NOTHING else extract(problem, instance, found.actions)


def _shared(problem: Problem, options: PlanOptions) -> PlanOptions:
    """Return options by which threads needn't know what others' vehicles do where that counts."""
    knows = (problem.fairness.is_stated or bool(problem.lags_across)
             or limits_chargers(problem))
    return replace(options, threads=1) if knows else options


def _give_up(began: float, deadline: float | None, searches: bool) -> float:
    """Return when the policy is given up: no sooner than a few customers take."""
    end = math.inf if deadline is None else deadline
    return max(began + GRACE, began + (end - began) * (GIVE_UP_SHARE if searches else 1.0))


def policy_begins(problem: Problem, options: PlanOptions) -> bool:
    """Tell whether the policy plans first, by the share of the time that this takes.

    From where that share is larger, a search from nothing came further, as far as
    `benchmarks.quality.ablation` can tell.
    """
    samples = options.num_samples if options.decoding == "sample" else None
    number = problem.num_customers
    kind, *others = problem.vehicle_types
    if problem.other_nodes or any(each.flies for each in problem.vehicle_types):
        # From policies' plans of who belongs together a search came no further than from nothing;
        # of what trips take in the air they know nothing.
        return False
    share = DECODING_SHARE
    if number <= MIXED_UP_TO and (others or kind.drones is not None):
        share = MIXED_SHARE
    elif kind.drones is not None and not others:
        # Trucks begin alone, by savings, to which drones are added.
        return False
    return decoding_seconds(number, samples) <= share * options.time_limit


def decoding_seconds(num_customers: int, num_samples: int | None) -> float:
    """Estimate how long the policy takes; `num_samples` is None where it plans greedily.

    By `pointer`, with half as much again for a busy machine; `attention` takes a third of it.
    """
    greedy = 1.2e-4 * num_customers * (1 + num_customers / 300)
    return greedy if num_samples is None else greedy * (1 + num_samples / 6)


def _pause(listener: Listener, deadline: float | None, start: Solution | None) -> Pause:
    """Return what ends the work before a search; if no route is given, a late one beats none."""
    latest = math.inf if deadline is None or start is None or not start.routes else deadline
    return pausing(listener.should_stop, latest, GRACE)


def _unimproved(judge: Judge, start: Solution | None, options: PlanOptions,
                began: float) -> PlanResult:
    """Return the plan given, or one that serves nobody, where nothing else was done."""
    packed = time.perf_counter()
    last = judge.accepted(nobody_served(judge.problem) if start is None else start)
    elapsed = Elapsed(packed - began, 0.0, time.perf_counter() - packed)
    return _result(last, "insertion" if start is None else "given", last.cost, options, None,
                   False, judge, elapsed)


def _tell(listener: Listener, first: Accepted) -> None:
    listener.on_progress(Progress(first.cost, 0, lambda: first.solution))


def _improve(problem: Problem, instance: Instance, first: Accepted | None, options: PlanOptions,
             deadline: float | None, listener: Listener) -> Improved:
    """Search from a plan, or from none; also for groups who may be served only together."""
    begun = None if first is None else first.solution
    turns = options.search_iterations
    terms = SearchTerms(options.seed, turns, deadline, listener.should_stop, listener.on_progress)
    whole = (turns == 0 or bool(problem.choices) or bool(problem.relations)
             or problem.fairness.is_stated
             or (bool(problem.shipments) and problem.num_customers > MOST_CUSTOMERS))
    joint = None if whole else find_joint(problem, terms.ended)
    if joint is None:
        return _search(problem, instance, begun, options, deadline, listener,
                       math.inf if first is None else first.cost)

    def search(begun: Solution | None, part: SearchPart, should_stop: Callable[[], bool],
               on_progress: Callable[[Progress], None]) -> Improved:
        own = replace(options, search_iterations=None if turns is None else turns - part.made,
                      cooled=max(part.cooled, options.cooled))
        return _search(problem, instance, begun, own, part.deadline or deadline, Listener(
            should_stop, lambda told: on_progress(replace(told, turns=part.made + told.turns))))

    return improve_together(problem, joint, begun, terms, search)


def _search(problem: Problem, instance: Instance, begun: Solution | None, options: PlanOptions,
            deadline: float | None, listener: Listener,
            given_cost: float = math.inf) -> Improved:
    config = SearchConfig(options.seed, options.threads, options.search_iterations,
                          cooled=options.cooled)
    until = None if deadline is None else deadline - usual_reserve(problem)
    begun = nobody_served(problem) if begun is None else begun
    return improve(problem, instance, begun, config, until,
                   listener.should_stop, listener.on_progress, more_by_plan(problem), given_cost)


def complete_plan(problem: Problem, begun: Solution, seed: int,
                  should_stop: Callable[[], bool]) -> Completed:
    """Return a plan with those whom it lacks where they cost least, as a search begins.

    If it is told to stop, it is the plan as it was.
    """
    try:
        instance = pack([problem], False, pausing(should_stop, patience=GRACE))
    except EndedError:
        return Completed(begun, False)
    found = improve(problem, instance, begun, SearchConfig(seed, turns=0), patience(problem),
                    should_stop)
    return Completed(found.solution, found.whole)


def patience(problem: Problem) -> float:
    """Return when an insertion of all has to end that begins now, on `time.perf_counter`."""
    return (time.perf_counter() + LEAST_UNHURRIED
            + UNHURRIED_PER_CUSTOMER * problem.num_customers)


def _completing(seed: int) -> Callable[[Solution, Problem], Completed]:
    """Return what completes plans of which something was refused, within some time."""
    def complete(begun: Solution, problem: Problem) -> Completed:
        late = time.perf_counter() + COMPLETING
        return complete_plan(problem, begun, seed, lambda: time.perf_counter() > late)

    return complete


def _result(last: Accepted, start: Start, first_cost: float, options: PlanOptions,
            improved: Improved | None, whole: bool, judge: Judge,
            elapsed: Elapsed) -> PlanResult:
    return PlanResult(
        last.solution, last.evaluation, start, decoded_cost=first_cost, final_cost=last.cost,
        search_iterations=0 if improved is None else improved.turns, threads=options.threads,
        deterministic=whole and judge.whole and (
            improved is None or (improved.whole and _made_all_turns(options, improved))),
        elapsed=elapsed, refused=judge.refused)


def _made_all_turns(options: PlanOptions, improved: Improved) -> bool:
    """Tell whether a search made the iterations asked for, each thread as many as the others."""
    if options.search_iterations is None:
        return False
    return improved.turns == options.search_iterations // options.threads * options.threads


def load_planner(weights: Path, names: Sequence[str],
                 on_refused: Callable[[], None] = lambda: None) -> Planner:
    """Load policies from their folders under `weights`; `on_refused` is `Planner`'s.

    Raises
    ------
    ValueError
        If a policy is missing or can't be read.
    """
    return Planner({name: load_policy(weights / name) for name in names}, on_refused)
