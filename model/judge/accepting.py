"""Plans as the independent judge accepts them, and what stands for those that it refuses."""

import logging
import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from model.judge.chargers import with_charging
from model.judge.check import Evaluation
from model.judge.memory import Memory
from model.judge.rules import Violation
from model.problem import Problem
from model.solution import Route, Solution

logger = logging.getLogger(__name__)

_PLACE = re.compile(r"(routes|customers)\[(\d+)\]")


class PlanCheckError(Exception):
    """No plan passed the independent check, not even one that serves nobody: never an answer."""


@dataclass(frozen=True)
class Accepted:
    """A plan that keeps all rules."""

    solution: Solution
    evaluation: Evaluation

    @property
    def cost(self) -> float:
        """What it costs."""
        return self.evaluation.cost.total


class Completed(NamedTuple):
    """A plan with those whom it lacked, as far as there was room and time."""

    solution: Solution
    whole: bool  # no clock and no listener cut that short


class Judge:
    """Judges what a planner finds for one problem, and counts what is refused.

    Parameters
    ----------
    memory
        Of plans judged.
    complete
        Puts those into a plan whom it lacks, where that costs least.
    on_refused
        Called for each plan that is refused.
    """

    def __init__(self, memory: Memory, complete: Callable[[Solution, Problem], Completed],
                 on_refused: Callable[[], None]) -> None:
        self.problem, self.refused = memory.problem, 0
        self.whole = True
        """No clock had a say in what stands for plans that were refused."""
        self._memory, self._complete, self._on_refused = memory, complete, on_refused

    def accepted(self, solution: Solution) -> Accepted:
        """Return a plan, or the best that stands for it where it is refused. In place.

        That are its routes that break no rule, with whom they lack.

        Raises
        ------
        PlanCheckError
            If that is refused, too.
        """
        found = self._judged(solution)
        if not found.evaluation.violations:
            return found
        self.refused += 1
        self._on_refused()
        broken = "; ".join(f"{violation.path}: {violation.message}"
                           for violation in found.evaluation.violations)
        logger.error("plan refused: %s", broken)
        left = sound_routes(self._memory, solution)
        completed = self._complete(left, self.problem)
        self.whole = self.whole and completed.whole
        found = min(map(self._judged, (left, sound_routes(self._memory, completed.solution))),
                    key=lambda each: each.cost)
        if found.evaluation.violations:
            raise PlanCheckError(broken)
        return found

    def _judged(self, solution: Solution) -> Accepted:
        solution = with_charging(self.problem, solution)
        return Accepted(solution, self._memory.check(solution))


def sound_routes(judge: Memory, solution: Solution) -> Solution:
    """Return a plan without the routes that break rules, whose customers are left out.

    Those go of whom violations are told, until there are none, or no routes; of those that serve a
    customer more than once, the first stays.
    """
    routes = list(solution.routes)
    while True:
        served = Solution(tuple(routes)).served
        plan = with_charging(judge.problem, Solution(tuple(routes),
                                                     judge.problem.left_out(served)))
        violations = judge.check(plan).violations if routes else ()
        if not violations:
            return plan
        broken = {index for violation in violations
                  for index in _blamed(judge.problem, routes, violation)}
        routes = [route for index, route in enumerate(routes)
                  if broken and index not in broken]


def _blamed(problem: Problem, routes: Sequence[Route], violation: Violation) -> Collection[int]:
    """Return the routes by which a rule is broken; none if that isn't told."""
    place = _PLACE.match(violation.path)
    if place is None:
        return ()
    number = int(place[2])
    if place[1] == "routes":
        return (number,)
    node = problem.num_depots + number
    serving = [index for index, route in enumerate(routes)
               if node in map(problem.first_place, route.served)]
    return serving[1:] or serving
