"""How good a plan is that goes on from another: `python -m benchmarks.quality.replanning`.

Each problem is planned without some of its customers. After 40 % of the day, from the first
departure to the last return, those come in and a tenth of the others who aren't settled by then are
cancelled. What is left is planned within a second from the plan given, and from nothing, by
insertion, with ten times the time. Costs are those of what is left.
"""

import csv
import statistics
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from model.judge.past import known_trips
from model.planner import ALONE, Listener, Planner, PlanOptions, PlanResult
from model.policy.decode import Policy, load_policy
from model.problem import Problem, Travel
from model.replanning.replan import Replanning, Terms
from model.solution import Solution, Trip
from training.instances import VARIANTS, generate

SHARE_OF_DAY = 0.4
NEW_SHARE, CANCELLED_SHARE = 0.05, 0.1
FIRST_SECONDS, SECONDS, TIMES = 3.0, 1.0, 10.0


@dataclass(frozen=True)
class Outcome:
    """Costs of what was left of one problem."""

    name: str
    settled: int  # customers
    left: int
    given: float  # by the plan given, those inserted whom it lacks
    replanned: float
    anew: float  # from nothing, with more time
    seconds: float  # that replanning took

    @property
    def ratio(self) -> float:
        """Cost of replanning by that of planning anew."""
        return self.replanned / self.anew


class Recorder(Planner):
    """A planner that keeps its last result, of what was left."""

    last: PlanResult | None = None

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        """Plan as any planner. In place."""
        self.last = super().plan(problem, options, received_at, listener, start)
        return self.last

    def result(self) -> PlanResult:
        """Return the last result."""
        if self.last is None:
            raise ValueError("last: None is not allowed")
        return self.last


class Forgetful(Recorder):
    """A planner that begins from nothing whatever it is given."""

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        """Plan by insertion. In place."""
        return super().plan(problem, options, received_at, listener, nothing(problem))


def nothing(problem: Problem) -> Solution:
    """Return the plan that serves nobody."""
    return Solution((), problem.left_out(()))


def part_of(problem: Problem, customers: Sequence[int]) -> Problem:
    """Return a problem with some of the customers, in the order of their nodes."""
    nodes = [*range(problem.num_depots), *customers]
    grid = np.ix_(nodes, nodes)
    travel = tuple(Travel(kind.duration[grid], kind.distance[grid]) for kind in problem.travel)
    return replace(problem, customers=tuple(map(problem.customer_at, customers)), travel=travel,
                   coordinates=problem.coordinates[nodes])


def renumbered(plan: Solution, nodes: Mapping[int, int]) -> Solution:
    """Return a plan with other nodes."""
    routes = tuple(replace(route, trips=tuple(
        Trip(tuple(replace(stop, node=nodes[stop.node]) for stop in trip.stops),
             tuple(replace(sortie, visits=tuple(replace(visit, node=nodes[visit.node])
                                                for visit in sortie.visits))
                   for sortie in trip.sorties))
        for trip in route.trips)) for route in plan.routes)
    return Solution(routes, tuple(nodes[node] for node in plan.unassigned if nodes[node] >= 0))


def day_of(plan: Solution) -> tuple[int, int]:
    """Return the first departure and the last return."""
    return (min(route.trips[0].stops[0].departure for route in plan.routes),
            max(route.trips[-1].stops[-1].departure for route in plan.routes))


def settled_customers(problem: Problem, plan: Solution, now: int) -> set[int]:
    """Return the customers who can't be cancelled any more."""
    known = [trip for trips in known_trips(problem, plan, now, frozenset()).values()
             for trip in trips]
    return {node for trip in known
            for node in (*(stop.node for stop in trip.stops),
                         *(sortie.recovery_node for sortie in trip.sorties),
                         *(visit.node for sortie in trip.sorties for visit in sortie.visits))}


def what_happens(whole: Problem, planner: Planner, rng: np.random.Generator,
                 seconds: float) -> tuple[Problem, Terms]:
    """Plan a problem and let orders come in and be cancelled; return what is to be replanned."""
    customers = np.arange(whole.num_depots, whole.num_nodes)
    new = set(rng.choice(customers, max(1, round(NEW_SHARE * len(customers))), replace=False))
    first = [int(node) for node in customers if node not in new]
    before = part_of(whole, first)
    plan = planner.plan(before, PlanOptions(DEFAULT_POLICY, time_limit=seconds),
                        start=nothing(before)).solution
    begin, end = day_of(plan)
    now = int(begin + SHARE_OF_DAY * (end - begin))
    fixed = settled_customers(before, plan, now)
    cancelled = {node for index, node in enumerate(first, before.num_depots)
                 if index not in fixed and rng.random() < CANCELLED_SHARE}
    kept = [int(node) for node in customers if node not in cancelled]
    here = {node: index for index, node in enumerate(kept, whole.num_depots)}
    nodes = {index: here.get(node, -1) for index, node in enumerate(first, before.num_depots)}
    nodes |= {depot: depot for depot in range(whole.num_depots)}
    return part_of(whole, kept), Terms(renumbered(plan, nodes), now)


def measure(name: str, whole: Problem, rng: np.random.Generator,
            policies: Mapping[str, Policy], seconds: float) -> Outcome | None:
    """Replan a problem both ways; None if nothing is left by then."""
    recorder, forgetful = Recorder(policies), Forgetful(policies)
    problem, terms = what_happens(whole, recorder, rng, FIRST_SECONDS * seconds)
    began = time.perf_counter()
    replanning = Replanning(problem, terms)
    recorder.last = None
    replanning.plan(recorder, PlanOptions(DEFAULT_POLICY, time_limit=seconds), began)
    elapsed = time.perf_counter() - began
    if recorder.last is None:
        return None
    replanning.plan(forgetful, PlanOptions(DEFAULT_POLICY, time_limit=TIMES * seconds))
    quick, slow = recorder.result(), forgetful.result()
    settled = sum(len(kept.served) for kept in replanning.kept)
    return Outcome(name, settled, problem.num_customers - settled, quick.decoded_cost,
                   quick.final_cost, slow.final_cost, elapsed)


def problems(sizes: Sequence[int], each: int) -> Iterator[tuple[str, Problem]]:
    """Yield random problems of every class."""
    for size in sizes:
        for index in range(each):
            for variant in VARIANTS:
                rng = np.random.default_rng((20_251_120, size, index, len(variant)))
                yield f"{variant}-{size}-{index}", generate(rng, size, variant)


def main(
    sizes: Annotated[list[int], typer.Option(help="Customers.")] = [50, 100],  # noqa: B006
    each: Annotated[int, typer.Option(help="Problems of each class and size.")] = 2,
    seconds: Annotated[float, typer.Option(help="Time to replan.")] = SECONDS,
    output: Annotated[Path, typer.Option(help="CSV.")] = Path("runs/bench/replanning.csv"),
) -> None:
    """Compare plans of what is left: from the plan given, and from nothing with more time."""
    policies = {DEFAULT_POLICY: load_policy(Settings().weights_dir / DEFAULT_POLICY)}
    outcomes: list[Outcome] = []
    for name, problem in problems(sizes, each):
        rng = np.random.default_rng((len(outcomes), problem.num_customers))
        outcome = measure(name, problem, rng, policies, seconds)
        if outcome is not None:
            outcomes.append(outcome)
            typer.echo(f"{name:16} {outcome.settled:4} settled {outcome.left:4} left  given "
                       f"{outcome.given:10.2f}  {seconds:g} s {outcome.replanned:10.2f}  "
                       f"{TIMES * seconds:g} s anew {outcome.anew:10.2f}  {outcome.ratio:.4f}")
    output.parent.mkdir(parents=True, exist_ok=True)
    with output.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow([*Outcome.__dataclass_fields__, "ratio"])
        writer.writerows([*vars(outcome).values(), outcome.ratio] for outcome in outcomes)
    Console().print(table(outcomes))


def table(outcomes: Sequence[Outcome]) -> Table:
    """Return ratios by class."""
    shown = Table("class", "problems", "geometric mean", "median", "largest")
    for variant in (*VARIANTS, ""):
        ratios = [outcome.ratio for outcome in outcomes if outcome.name.startswith(variant)]
        if ratios:
            shown.add_row(variant or "all", str(len(ratios)),
                          f"{statistics.geometric_mean(ratios):.4f}",
                          f"{statistics.median(ratios):.4f}", f"{max(ratios):.4f}")
    return shown


if __name__ == "__main__":
    typer.run(main)
