"""What goes to whoever plans a region of a job, and what comes back: ids and routes alone."""

from dataclasses import dataclass

from pydantic import TypeAdapter

from app.plans.replies import Data
from model.judge.check import Evaluation, check
from model.planner import ALONE, Listener, Planner, PlanOptions, PlanResult
from model.problem import Problem
from model.search.regions.part import RegionProblem, part_of
from model.search.regions.region import Region
from model.solution import Solution


@dataclass(frozen=True)
class Errand:
    """A region to plan."""

    region: Region
    seconds: float
    seed: int
    cooled: float = 0.0  # share of the job's time that was over


ERRANDS = TypeAdapter(Errand)
PLANS = TypeAdapter(Solution)


@dataclass(frozen=True)
class RegionTask:
    """A region as a search takes it; its plans are told in the numbers of the whole problem."""

    part: RegionProblem
    begun: Solution
    far: None = None
    replanning: None = None

    @classmethod
    def of(cls, problem: Problem, region: Region) -> "RegionTask":
        """Cut a region out of a problem."""
        part = part_of(problem, region)
        return cls(part, part.inward(region.plan))

    def plan(self, planner: Planner, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        """Plan, beginning with what the region had, or with what was found since."""
        return planner.plan(self.part.problem, options, received_at, listener,
                            self.begun if start is None else start)

    def check(self, solution: Solution) -> Evaluation:
        """Judge a plan."""
        return check(self.part.problem, solution)

    def reply(self, options: PlanOptions, result: PlanResult) -> Data:
        """Return what is written down of a plan."""
        plan = PLANS.dump_python(self.part.outward(result.solution), mode="json")
        return {
            "cost": {"total": result.evaluation.cost.total},
            "plan": plan,
            "solver": {"start": result.start, "decoded_cost": result.decoded_cost,
                       "final_cost": result.final_cost,
                       "search_iterations": result.search_iterations,
                       "plans_refused": result.refused,
                       "elapsed": {"search": result.elapsed.search}},
        }

    def read(self, reply: Data) -> Solution:
        """Return the plan that was written down."""
        return self.part.inward(found_by(reply))


def found_by(reply: Data) -> Solution:
    """Return the plan of a region that was written down, in the numbers of the whole problem."""
    return PLANS.validate_python(reply["plan"])
