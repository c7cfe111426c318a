"""The `tandem` command."""

import time
from pathlib import Path
from typing import Annotated, NoReturn

import typer
import uvicorn

from app.convert import to_problem
from app.errors import RequestError
from app.importers import FileFormat, convert_file
from app.instance_files import Rounding
from app.main import create_app
from app.plan_reading import plan_to_solution
from app.reading import read_request
from app.service import ReceivedBody, answer
from app.settings import Settings
from model.check import Evaluation, check
from model.planner import Planner, load_planner

EXIT_INFEASIBLE = 1
EXIT_BAD_INPUT = 2

cli = typer.Typer(help="Plan deliveries for trucks that carry drones.", no_args_is_help=True,
                  add_completion=False)

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
    "usual with time windows; thousandths: as is usual with mixed fleets. All but exact write "
    "matrices, large ones for many customers."))]


@cli.command()
def serve(
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="Port to listen on.", min=0, max=65535)] = 8000,
) -> None:
    """Answer planning requests over HTTP."""
    uvicorn.run(create_app(Settings()), host=host, port=port)


@cli.command()
def warm() -> None:
    """Compile everything that planning needs, so that later starts are quick."""
    _warm_planner(Settings())
    typer.echo("ready")


@cli.command()
def plan(problem_file: ProblemFile, output: Output = None) -> None:
    """Plan one problem."""
    settings = Settings()
    planner = _warm_planner(settings)
    body = ReceivedBody(problem_file.read_bytes(), time.perf_counter())
    try:
        reply = answer(planner, body, settings.search_threads)
    except RequestError as error:
        _refuse(problem_file, error)
    if output is None:
        typer.echo(reply)
    else:
        output.write_bytes(reply)


@cli.command("check")
def check_plan(problem_file: ProblemFile, plan_file: PlanFile) -> None:
    """Judge a plan: print the rules it breaks and its cost. Exits with 1 if it breaks any."""
    try:
        problem = to_problem(read_request(problem_file.read_bytes(), policies=None))
    except RequestError as error:
        _refuse(problem_file, error)
    try:
        solution = plan_to_solution(plan_file.read_bytes(), problem)
    except RequestError as error:
        _refuse(plan_file, error)
    evaluation = check(problem, solution)
    _print_evaluation(evaluation)
    if not evaluation.is_feasible:
        raise typer.Exit(EXIT_INFEASIBLE)


@cli.command()
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
        _refuse(instance_file, error)
    if output is None:
        typer.echo(request)
    else:
        output.write_bytes(request)


def main() -> None:
    """Run the command line."""
    cli()


def _warm_planner(settings: Settings) -> Planner:
    planner = load_planner(settings.weights_dir, settings.policies)
    planner.warm(lambda progress: typer.echo(progress, err=True))
    return planner


def _print_evaluation(evaluation: Evaluation) -> None:
    for violation in evaluation.violations:
        typer.echo(f"{violation.code} {violation.path}: {violation.message}")
    cost = evaluation.cost
    for term in ("fixed", "distance", "time", "lateness", "earliness", "unassigned", "total"):
        typer.echo(f"{term:10} {getattr(cost, term):.6f}")
    typer.echo("feasible" if evaluation.is_feasible else "infeasible")


def _refuse(file: Path, error: RequestError) -> NoReturn:
    """Print what is wrong with an input file, and exit."""
    typer.echo(f"{file}: {error}", err=True)
    for item in error.errors:
        typer.echo(f"{item.code} {item.path}: {item.message}", err=True)
    raise typer.Exit(EXIT_BAD_INPUT)
