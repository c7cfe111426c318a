"""`tandem plot`: draws a plan."""

from pathlib import Path
from typing import Annotated

import typer

from app.cli.file_errors import EXIT_BAD_INPUT, refuse
from app.cli.opening import roads_of
from app.plans.pictures.scene import DrawnPlan
from app.requests.plan_reading import parse_plan
from app.requests.reading import read_request
from app.schemas.errors import RequestError
from app.serving.settings import Settings

FORMATS = (".png", ".svg", ".html")


def plot(
    problem_file: Annotated[Path, typer.Argument(
        help="Request of POST /plan as JSON.", exists=True, dir_okay=False)],
    plan_file: Annotated[Path, typer.Argument(
        help="Reply of POST /plan as JSON.", exists=True, dir_okay=False)],
    output: Annotated[Path, typer.Option(
        "--output", "-o", help="Picture to write; its name ends in .png, .svg or .html.",
        dir_okay=False)],
) -> None:
    """Draw a plan: a map, a timeline under it, and in HTML the costs and all stops."""
    ending = output.suffix.lower()
    if ending not in FORMATS:
        typer.echo(f"{output}: the name must end in {', '.join(FORMATS)}: correct it.", err=True)
        raise typer.Exit(EXIT_BAD_INPUT)
    try:
        request = read_request(problem_file.read_bytes(), policies=None)
    except RequestError as error:
        refuse(problem_file, error)
    try:
        with roads_of(Settings()) as roads:
            scene = DrawnPlan.judged(request, parse_plan(plan_file.read_bytes()), roads)
    except RequestError as error:
        refuse(plan_file, error)
    output.write_bytes(_content(scene, ending))


def _content(scene: DrawnPlan, ending: str) -> bytes:
    # Imported here: other commands needn't wait for matplotlib.
    from app.plans.pictures.drawing import draw_png, draw_svg
    from app.plans.pictures.page import draw_page

    return {".png": draw_png, ".svg": draw_svg, ".html": draw_page}[ending](scene)
