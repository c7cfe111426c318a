"""What surrounds the search over the number of customers: `python -m benchmarks.speed.scaling`.

Reads, converts, judges and replies a request of so many customers and a plan for it that was made
without any search; then makes a first plan and improves it. Each size in a process of its own,
which tells the processor time of each step and its peak of memory. Prints a table as Markdown.
"""

import json
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Annotated, Any, TypeVar

import typer
from pydantic_core import to_json

MOST_CUSTOMERS = 200_000

STEPS = ("read", "warn", "convert", "judge", "reply", "check", "begin", "improve")

TURNS = 100_000
"""Of the search, for every size."""

Data = dict[str, Any]
Result = TypeVar("Result")


def measured(number: int, is_planned: bool, turns: int = TURNS) -> Data:
    """Return seconds of each step and MB for so many customers, the service's bounds set aside.

    Beside them what its first plan costs, and by which share less after so many turns.
    """
    from app.schemas import limits

    # Constants of the schema are made from it when they are imported.
    limits.MAX_CUSTOMERS = MOST_CUSTOMERS
    limits.MAX_LEGS = MOST_CUSTOMERS**2
    from app.serving.load.memory import collect_seldom
    from examples.many import many_customers

    collect_seldom()
    body = to_json(many_customers(number))
    _steps(to_json(many_customers(2)), {}, is_planned, 0)  # what is imported and made once
    before = _peak_mb()
    found: Data = {"customers": number, "body": len(body) / 1e6}
    _steps(body, found, is_planned, turns)
    return found | {"memory": _peak_mb() - before}


def _steps(body: bytes, found: Data, is_planned: bool, turns: int) -> None:
    """Take all steps, or those before the legs, and note how long each takes. In place."""
    from app.requests.conversion.problem import to_problem
    from app.plans.checking import read_check
    from app.plans.replies import plan_reply
    from app.plans.service import plan_options
    from app.requests.bounds import UNBOUNDED
    from app.requests.plan_reading import read_plan
    from app.requests.reading import read_request
    from app.requests.warnings.finding import warnings_of
    from examples.many import swept
    from model.judge.check import check
    from model.judge.timing import RouteDecision, TripDecision, schedule
    from model.planner import Elapsed, PlanResult
    from model.solution import Solution

    step = _Stopwatch(found)
    request = step("read", lambda: read_request(body, None))
    step("warn", lambda: warnings_of(request))
    if not is_planned:
        return
    problem = step("convert", lambda: to_problem(request))
    solution = Solution(tuple(
        schedule(problem, RouteDecision(0, vehicle, (
            TripDecision((0, *(index + 1 for index in some), 0), (), None),)))
        for vehicle, some in enumerate(swept(json.loads(body)))))
    evaluation = step("judge", lambda: check(problem, solution))
    cost = evaluation.cost.total
    options = plan_options(request.options)
    result = PlanResult(solution, evaluation, "policy", cost, cost, 0, 1, True,
                        Elapsed(decode=0.0, search=0.0, check=0.0))
    reply = step("reply", lambda: to_json(plan_reply(problem, options, result)))
    both = b'{"problem":' + body + b',"plan":' + reply + b"}"
    step("check", lambda: read_plan(read_check(both, UNBOUNDED).plan, problem))
    _search(problem, step, turns)


def _search(problem: Any, step: "_Stopwatch", turns: int) -> None:
    """Plan a problem, and note as `_steps` does. In place."""
    from model.engine.instance import pack
    from model.search.improve import SearchConfig, improve
    from model.solution import Solution

    instance = pack([problem], legs=False)
    begun = step("begin", lambda: improve(problem, instance, Solution((), ()),
                                          SearchConfig(), time.perf_counter()))
    better = step("improve", lambda: improve(problem, instance, begun.solution,
                                             SearchConfig(turns=turns)))
    step.found |= {"cost": begun.cost, "saved": 1 - better.cost / begun.cost}


class _Stopwatch:
    """Notes how long steps take."""

    def __init__(self, found: Data) -> None:
        self.found = found

    def __call__(self, name: str, work: Callable[[], Result]) -> Result:
        """Return what a step comes to. In place."""
        began = time.process_time()
        result = work()
        self.found[name] = time.process_time() - began
        return result


def _peak_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def _in_process(number: int, most_planned: int) -> Data:
    """Return what is measured in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.speed.scaling", "--one", str(number),
               "--most-planned", str(most_planned)]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    return dict(json.loads(run.stdout))


def main(sizes: Annotated[str, typer.Option(help="Numbers of customers.")]
         = "100,300,1000,3000,10000,30000,100000",
         most_planned: Annotated[int, typer.Option(
             help="With more customers only what comes before the legs is measured.")] = 100_000,
         one: Annotated[int | None, typer.Option(hidden=True)] = None) -> None:
    """Print a row for each size."""
    if one is not None:
        print(json.dumps(measured(one, one <= most_planned)))
        return
    print("| customers | body, MB |", " | ".join(STEPS), "| memory, MB | cost | saved |")
    print("| ---: " * (len(STEPS) + 5) + "|")
    for number in map(int, sizes.split(",")):
        row = _in_process(number, most_planned)
        times = [f"{row[name]:.3g}" if name in row else "" for name in STEPS]
        print(f"| {number:,} | {row['body']:.1f} |", " | ".join(times),
              f"| {row['memory']:.0f} | {row.get('cost', 0):,.0f} | {row.get('saved', 0):.1%} |",
              flush=True)


if __name__ == "__main__":
    typer.run(main)
