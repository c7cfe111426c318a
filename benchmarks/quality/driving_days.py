"""Solomon's instances as days, by driving rules: `python -m benchmarks.quality.driving_days data`.

An instance's depot is open for 14 hours then, and all of its times are longer in the same measure.
Each is planned without rules and by those of the EU, and all plans are judged twice.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from app.requests.conversion.vehicle import driving_rules
from app.schemas.driving import DrivingRulesInput, LawName
from benchmarks.peers.published import published_set, to_problem
from benchmarks.quality.driving_law import Law, offences
from benchmarks.rows import appended
from model.engine.instance import pack
from model.judge.check import check
from model.problem import Problem, Travel
from model.search.improve import SearchConfig, improve
from model.solution import Solution

INSTANCES = "C101,C202,R101,R202,RC102,RC201"

HOUR = 3600 * 1000
DAY = 14 * HOUR

EU = Law(round(4.5 * HOUR), round(0.75 * HOUR), (HOUR // 4, HOUR // 2), 9 * HOUR)

BY_LAW: dict[LawName, Law] = {"eu-561": EU, "eu-561+2002-15": replace(EU, labour=6 * HOUR)}


@dataclass(frozen=True)
class Run:
    """A plan of an instance, judged."""

    instance: str
    rules: str  # empty: none
    turns: int
    vehicles: int
    distance: float
    left_out: int
    rests: int
    resting_h: float
    against: int  # routes against the rules, or those of `eu-561` without any


def stretched(problem: Problem) -> Problem:
    """Return a problem whose times are as much longer as its day is."""
    factor = DAY // problem.vehicle_types[0].latest
    customers = tuple(replace(
        each, earliest=each.earliest * factor, latest=each.latest * factor,
        service_duration=each.service_duration * factor) for each in problem.customers)
    legs = tuple(Travel(np.asarray(each.duration) * factor, each.distance)
                 for each in problem.travel)
    fleet = tuple(replace(kind, latest=kind.latest * factor) for kind in problem.vehicle_types)
    return replace(problem, customers=customers, travel=legs, vehicle_types=fleet)


def planned(problem: Problem, name: str, rules: LawName | None, turns: int) -> Run:
    """Plan an instance, with rules or without, and judge the plan."""
    driving = None if rules is None else driving_rules(DrivingRulesInput(preset=rules))
    fleet = tuple(replace(kind, driving=driving) for kind in problem.vehicle_types)
    problem = replace(problem, vehicle_types=fleet)
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    plan = improve(problem, pack([problem]), nobody, SearchConfig(turns=turns)).solution
    judged = check(problem, plan)
    against = [any(offences(route, BY_LAW[rules or "eu-561"])) for route in plan.routes]
    if judged.violations or (rules is not None and any(against)):
        raise RuntimeError(f"{name}, {rules}: {judged.violations}")
    rests = [rest for route in plan.routes for trip in route.trips for rest in trip.breaks]
    return Run(name, rules or "", turns, len(plan.routes), round(judged.cost.distance, 1),
               len(plan.unassigned), len(rests),
               sum(rest.end - rest.start for rest in rests) / HOUR, sum(against))


def table(runs: Sequence[Run]) -> Iterator[str]:
    """Yield a table in Markdown."""
    yield ("| instance | rules | vehicles | distance | left out | rests, h | offending |\n"
           "| --- | --- | ---: | ---: | ---: | ---: | ---: |")
    for run in runs:
        yield (f"| {run.instance} | {run.rules} | {run.vehicles} | {run.distance:.1f} | "
               f"{run.left_out} | {run.resting_h:.2f} | {run.against} |")


def main(
    data: Path, names: str = INSTANCES, turns: int = 4000,
    output: Annotated[Path, typer.Option(help="CSV, made anew.")]
    = Path("runs/bench/driving_days.csv"),
) -> None:
    """Print the table in Markdown."""
    output.unlink(missing_ok=True)
    runs = (planned(stretched(to_problem(instance)), instance.name, rules, turns)
            for instance in published_set(data, "solomon", names.split(","))
            for rules in (None, *BY_LAW))
    print("\n".join(table(list(appended(output, Run, runs)))))


if __name__ == "__main__":
    typer.run(main)
