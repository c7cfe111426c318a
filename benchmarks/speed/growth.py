"""How the time that a plan of some quality takes grows with the customers.

`python -m benchmarks.speed.growth --customers 1000 --customers 5000` plans customers with windows
for vehicles of two sizes and two trips, in a time that grows like n ** 1.2, and in four times as
long. Where the shorter search ends no further above the longer as customers grow, no more than that
time is needed for a plan as good. One thread, processor time, legs and neighbours included.
"""

import json
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from app.requests.conversion.problem import to_problem
from app.schemas.request import PlanRequest
from benchmarks.clock import count_processor_time
from examples.many import mixed_customers
from benchmarks.peers.answers import cost_of_all
from benchmarks.results import gap_percent
from benchmarks.rows import append_rows
from model.engine.instance import pack
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.solution import Solution

EXPONENT = 1.2

LONGER = 4.0
"""How many times as long the search takes that the other is measured by."""

WARM = 2500
"""Customers of what is planned first, so that all is loaded."""


@dataclass(frozen=True)
class Row:
    """Two searches for one problem."""

    customers: int
    drones: bool
    seed: int
    seconds: float
    first: float
    cost: float
    longer: float  # the cost of the longer one
    gap_percent: float  # of the shorter one to it
    turns: int


def mixed_problem(customers: int, has_drones: bool) -> Problem:
    """Return the problem of a request."""
    text = json.dumps(mixed_customers(customers, has_drones))
    return to_problem(PlanRequest.model_validate_json(text))


def searched(problem: Problem, seconds: float, seed: int) -> tuple[float, float, int]:
    """Return the cost of the first plan, that of the best, and the turns of a search.

    Raises
    ------
    ValueError
        If the plan breaks a rule or leaves somebody out.
    """
    began = time.perf_counter()
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    found = improve(problem, pack([problem], legs=False), nobody, SearchConfig(seed),
                    began + seconds)
    cost = cost_of_all(f"{problem.num_customers} customers", problem, found.solution)
    return found.first_cost, cost, found.turns


def rows(customers: list[int], has_drones: bool, base: float, seeds: int) -> Iterator[Row]:
    """Plan all, `base` seconds for 1,000 customers."""
    for number in customers:
        problem = mixed_problem(number, has_drones)
        seconds = base * (number / 1000) ** EXPONENT
        for seed in range(1, seeds + 1):
            first, cost, turns = searched(problem, seconds, seed)
            _, longer, _ = searched(problem, LONGER * seconds, seed)
            yield Row(number, has_drones, seed, round(seconds, 1), round(first), round(cost),
                      round(longer), round(gap_percent(cost, longer), 2), turns)


def main(customers: Annotated[list[int], typer.Option(help="several")],
         drones: Annotated[bool, typer.Option("--drones", help="one for each vehicle")] = False,
         seconds: Annotated[float, typer.Option(help="for 1,000 customers")] = 6.0,
         seeds: Annotated[int, typer.Option()] = 1,
         output: Annotated[Path, typer.Option()] = Path("runs/bench/growth.csv")) -> None:
    """Write a row for each problem and seed, and print it."""
    count_processor_time()
    searched(mixed_problem(WARM, drones), 1.0, 0)

    def told() -> Iterator[Row]:
        for row in rows(customers, drones, seconds, seeds):
            print(row, flush=True)
            yield row

    append_rows(output, Row, told())


if __name__ == "__main__":
    typer.run(main)
