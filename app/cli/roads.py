"""`tandem roads`: prepares roads for plans."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from tqdm import tqdm

from app.cli.file_errors import EXIT_BAD_INPUT
from app.maps.addresses.index import build_index
from app.maps.addresses.reading import AddressesError
from app.maps.roads.building import BuildError, Show, build_roads
from app.maps.roads.setting import Extract, Vehicle
from app.maps.roads.tools import ToolsMissingError, find_tools
from app.maps.streets.filing import folder_beside
from app.maps.streets.reading import StreetsError
from app.maps.streets.store import build_streets

BAR = "{desc} |{bar}| {percentage:3.0f} % [{elapsed}]"

roads_cli = typer.Typer(help="Prepare roads for plans.", no_args_is_help=True,
                        add_completion=False)


@roads_cli.callback()
def _roads() -> None:
    """Prepare roads for plans."""


@roads_cli.command()
def build(
    extract: Annotated[Path, typer.Argument(
        help="Extract of OpenStreetMap, such as berlin.osm.pbf.")],
    profile: Annotated[Vehicle, typer.Option(help="For which vehicle.")] = "truck",
) -> None:
    """Prepare an extract for a vehicle, once; what it makes lies in a folder beside it.

    The streets that the console draws and the index of its addresses are made, too.
    """
    try:
        with _showing() as show:
            made = build_roads(Extract(extract, profile), find_tools(), show)
            show("drawing streets", 1.0)
            _draw(extract)
            show("gathering addresses", 1.0)
            _gather(extract)
    except (BuildError, ToolsMissingError) as error:
        typer.echo(f"{error}.", err=True)
        raise typer.Exit(EXIT_BAD_INPUT) from error
    typer.echo(f"{made.folder}\nPlans use it with TANDEM_ROADS={profile}={extract}")


def _draw(extract: Path) -> None:
    """Make the streets of an extract; plans need none."""
    try:
        build_streets(extract, [folder_beside(extract)])
    except (StreetsError, OSError) as error:
        typer.echo(f"No streets are drawn: {error}.", err=True)


def _gather(extract: Path) -> None:
    """Make the index of an extract's addresses; plans on roads need none."""
    try:
        build_index(extract, [folder_beside(extract)])
    except (AddressesError, OSError) as error:
        typer.echo(f"No addresses are looked up in it: {error}.", err=True)


@contextmanager
def _showing() -> Iterator[Show]:
    """Yield what shows how far a build is: a bar on a terminal, elsewhere a line for each stage."""
    if not sys.stderr.isatty():
        told: set[str] = set()

        def tell(doing: str, share: float) -> None:
            if doing not in told:
                told.add(doing)
                typer.echo(f"{doing}, about {share:.0%} done", err=True)

        yield tell
        return
    with tqdm(total=1.0, bar_format=BAR, leave=False, file=sys.stderr, dynamic_ncols=True) as bar:
        def advance(doing: str, share: float) -> None:
            bar.set_description_str(doing, refresh=False)
            bar.n = max(bar.n, share)
            bar.refresh()

        yield advance
