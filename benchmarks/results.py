"""One row for each run of a solver on a published instance, in a CSV that grows."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Result:
    """A judged run; what a run without a plan doesn't have is nan or empty."""

    set: str
    instance: str
    n: int  # customers
    solver: str
    threads: int
    budget_s: float
    seed: int
    wall_s: float  # of the solver's call
    cost: float  # in the unit of the published cost, without customers left out
    best_known: float
    gap_percent: float  # to `best_known`; nan unless the plan counts
    feasible: bool
    complete: bool  # everybody is served
    version: str
    date: str
    machine: str

    @property
    def counts(self) -> bool:
        """The plan serves everybody and breaks no rule."""
        return self.feasible and self.complete

    @property
    def key(self) -> tuple[str, str, str, float, int]:
        """What was run: set, instance, solver, budget, seed."""
        return self.set, self.instance, self.solver, self.budget_s, self.seed


def gap_percent(cost: float, best_known: float) -> float:
    """Return how much more than the best known a cost is; nan without one."""
    return 100 * (cost / best_known - 1) if best_known else math.nan
