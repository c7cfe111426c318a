"""`tandem plan`, `check` and `convert`: requests and plans in files."""

import time
from pathlib import Path
from typing import Annotated

import typer
from pydantic_core import to_json

from app.cli.file_errors import refuse
from app.cli.opening import roads_of
from app.formats.files.importers import FileFormat, convert_file
from app.plans.service import plan_options, preparing, reply_of
from app.plans.task import Task, task_of
from app.requests.bounds import UNBOUNDED
from app.requests.plan_reading import plan_to_solution
from app.requests.reading import read_request
from app.schemas.errors import RequestError
from app.schemas.fields import Rounding
from app.serving.settings import Settings
from model.judge.check import Evaluation
from model.planner import load_planner
from model.solution import COST_TERMS

LEAST_PREPARING = 60.0
"""Seconds that may pass before the search however short its time: nobody else waits for it."""

EXIT_INFEASIBLE = 1

ProblemFile = Annotated[Path, typer.Argument(help="Request of POST /plan as JSON.", exists=True,
                                             dir_okay=False)]
PlanFile = Annotated[Path, typer.Argument(help="Reply of POST /plan as JSON.", exists=True,
                                          dir_okay=False)]
Output = Annotated[Path | None, typer.Option("--output", "-o", help="File to write the plan to.")]
InstanceFormat = Annotated[FileFormat, typer.Option(
    "--format", help="auto knows Solomon's format by its headings; all else is VRPLIB.")]
RoundingOption = Annotated[Rounding, typer.Option(help=(
    "How distances are rounded. exact: as the crow flies; round: to whole units, as CVRPLIB does "
    "without time windows; trunc: to whole units, downwards; dimacs: to tenths, downwards, as is "
    "usual with time windows; thousandths: as is usual with mixed fleets."))]


def plan(problem_file: ProblemFile, output: Output = None) -> None:
    """Plan one problem."""
    settings = Settings()
    try:
        with roads_of(settings) as roads:
            started = time.perf_counter()
            request = read_request(problem_file.read_bytes(), settings.policies)
            hurried = preparing(request.options, UNBOUNDED, lambda: False).beside_search(
                LEAST_PREPARING, "the search")
            task = task_of(request, hurried, roads=roads)
            prepared = time.perf_counter() - started
            _print_warnings(task)
            planner = load_planner(settings.weights_dir, settings.policies)
            # What loading takes is no part of the time limit.
            options = plan_options(request.options, settings.search_threads)
            reply = to_json(reply_of(planner, task, options, time.perf_counter() - prepared,
                                     waited=hurried.waited))
    except RequestError as error:
        refuse(problem_file, error)
    if output is None:
        typer.echo(reply)
    else:
        output.write_bytes(reply)


def check_plan(problem_file: ProblemFile, plan_file: PlanFile) -> None:
    """Judge a plan: print the rules it breaks and its cost. Exits with 1 if it breaks any."""
    try:
        with roads_of(Settings()) as roads:
            task = task_of(read_request(problem_file.read_bytes(), policies=None), roads=roads)
    except RequestError as error:
        refuse(problem_file, error)
    try:
        solution = plan_to_solution(plan_file.read_bytes(), task.problem)
    except RequestError as error:
        refuse(plan_file, error)
    _print_warnings(task)
    evaluation = task.check(solution)
    _print_evaluation(evaluation)
    if not evaluation.is_feasible:
        raise typer.Exit(EXIT_INFEASIBLE)


def convert(
    instance_file: Annotated[Path, typer.Argument(
        metavar="INPUT", help="Instance in VRPLIB or Solomon format.", exists=True,
        dir_okay=False)],
    output: Annotated[Path | None, typer.Option(
        "--output", "-o", help="File to write the request to.")] = None,
    file_format: InstanceFormat = "auto",
    rounding: RoundingOption = "exact",
) -> None:
    """Turn a published instance into a request of POST /plan, a unit being 1 m, 1 s and 1 cost."""
    try:
        request = convert_file(instance_file, file_format, rounding)
    except RequestError as error:
        refuse(instance_file, error)
    if output is None:
        typer.echo(request)
    else:
        output.write_bytes(request)


def _print_warnings(task: Task) -> None:
    for warning in task.warnings:
        typer.echo(f"warning {warning.code} {warning.path}: {warning.message}", err=True)


def _print_evaluation(evaluation: Evaluation) -> None:
    for violation in evaluation.violations:
        typer.echo(f"{violation.code} {violation.path}: {violation.message}")
    cost = evaluation.cost
    for term in (*COST_TERMS, "total"):
        typer.echo(f"{term:16} {getattr(cost, term):.6f}")
    typer.echo("feasible" if evaluation.is_feasible else "infeasible")
