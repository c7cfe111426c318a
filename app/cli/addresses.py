"""`tandem addresses`: prepares addresses of an extract, and looks some up."""

import time
from contextlib import closing
from pathlib import Path
from typing import Annotated

import typer

from app.cli.file_errors import EXIT_BAD_INPUT
from app.maps.addresses.index import build_index, num_houses
from app.maps.addresses.opening import opened_addresses
from app.maps.addresses.reading import AddressesError
from app.maps.addresses.setting import GeocoderSettingError
from app.maps.streets.filing import folder_beside
from app.serving.settings import Settings

PATIENCE = 60.0
"""Seconds in which addresses are looked up."""

addresses_cli = typer.Typer(help="Look addresses up, and prepare extracts for that.",
                            no_args_is_help=True, add_completion=False)


@addresses_cli.callback()
def _addresses() -> None:
    """Look addresses up, and prepare extracts for that."""


@addresses_cli.command()
def build(extract: Annotated[Path, typer.Argument(
        help="Extract of OpenStreetMap, such as berlin.osm.pbf.")]) -> None:
    """Prepare the addresses of an extract, once, in a file of the folder beside it."""
    try:
        made = build_index(extract, [folder_beside(extract)])
    except (AddressesError, OSError) as error:
        typer.echo(f"{error}.", err=True)
        raise typer.Exit(EXIT_BAD_INPUT) from error
    typer.echo(f"{made}, {num_houses(made)} house numbers\n"
               f"They are looked up with TANDEM_GEOCODER=extract:{extract}")


@addresses_cli.command()
def find(
    addresses: Annotated[list[str], typer.Argument(help="Addresses, each in quotes.")],
) -> None:
    """Look addresses up as the service does, by TANDEM_GEOCODER."""
    try:
        geocoders = opened_addresses(Settings())
    except GeocoderSettingError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(EXIT_BAD_INPUT) from error
    if not geocoders.names:
        typer.echo("TANDEM_GEOCODER states no geocoder.", err=True)
        raise typer.Exit(EXIT_BAD_INPUT)
    with closing(geocoders):
        looked_up = geocoders.look_up(addresses, time.perf_counter() + PATIENCE)
    for address in addresses:
        candidates = looked_up.candidates.get(address)
        typer.echo(f"{address}: " + ("no answer" if candidates is None else
                                     "" if candidates else "not found"))
        for place in candidates or ():
            typer.echo(f"  {place.lat:.6f}, {place.lon:.6f} {place.quality}: {place.label} "
                       f"({place.by})")
    if looked_up.error is not None:
        typer.echo(str(looked_up.error), err=True)
        raise typer.Exit(EXIT_BAD_INPUT)
