"""`tandem flights`: writes a plan's flights for flight controllers."""

from pathlib import Path
from typing import Annotated

import typer

from app.cli.file_errors import refuse
from app.cli.opening import roads_of
from app.plans.flights.answering import judged_flights
from app.plans.flights.files import flight_file
from app.requests.plan_reading import parse_plan
from app.requests.reading import read_request
from app.schemas.errors import RequestError
from app.schemas.flights import ExitOnLost, FlightFormat, LostAction, Per, WpmlInput
from app.serving.settings import Settings


def flights(
    problem_file: Annotated[Path, typer.Argument(
        help="Request of POST /plan as JSON.", exists=True, dir_okay=False)],
    plan_file: Annotated[Path, typer.Argument(
        help="Reply of POST /plan as JSON.", exists=True, dir_okay=False)],
    file_format: Annotated[FlightFormat, typer.Option(
        "--format", help="What the flights are written as.")],
    per: Annotated[Per, typer.Option(
        help="A file for each flight, or for each drone; several come as a ZIP.")] = "sortie",
    exit_on_rc_lost: Annotated[ExitOnLost, typer.Option(
        help="Of dji-wpml: whether a flight goes on where the remote control is lost.")] = (
            "goContinue"),
    rc_lost_action: Annotated[LostAction, typer.Option(
        help="Of dji-wpml: what it does else.")] = "hover",
    aircraft: Annotated[int, typer.Option(
        help="Of dji-wpml: the aircraft's number with DJI.", min=0, max=100_000)] = 89,
    output: Annotated[Path | None, typer.Option(
        "--output", "-o", help="File to write. Left out: under the file's own name here.",
        dir_okay=False)] = None,
) -> None:
    """Write a plan's flights as flight controllers read them; that is no permission to fly."""
    try:
        request = read_request(problem_file.read_bytes(), policies=None)
    except RequestError as error:
        refuse(problem_file, error)
    try:
        with roads_of(Settings()) as roads:
            found = judged_flights(request, parse_plan(plan_file.read_bytes()), roads=roads)
            written = flight_file(found, file_format, per, "--format", WpmlInput(
                exit_on_rc_lost=exit_on_rc_lost, rc_lost_action=rc_lost_action, aircraft=aircraft))
    except RequestError as error:
        refuse(plan_file, error)
    path = output or Path(written.name)
    path.write_bytes(written.content)
    typer.echo(path)
