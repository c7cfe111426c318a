"""`tandem airspace`: looks into files of zones."""

from collections import Counter
from pathlib import Path
from typing import Annotated

import typer

from app.cli.file_errors import EXIT_BAD_INPUT
from app.maps.airspace.faults import Fault
from app.maps.airspace.files import ZoneFileError, read_file, words_of

FORMATS = {"ed269": "ED-269", "ed318": "ED-318", "geojson": "GeoJSON", "kml": "KML"}

MOST_TOLD = 50
"""Faults told one by one."""

airspace_cli = typer.Typer(help="Look into files of airspace zones.", no_args_is_help=True,
                           add_completion=False)


@airspace_cli.callback()
def _airspace() -> None:
    """Look into files of airspace zones."""


@airspace_cli.command()
def check(file: Annotated[Path, typer.Argument(
        help="File of zones: ED-269, ED-318, GeoJSON or KML.")]) -> None:
    """Tell which zones a file holds, and what of it can't be read."""
    try:
        file_format, reading = read_file(file)
    except ZoneFileError as error:
        typer.echo(f"{file}: {error}.", err=True)
        raise typer.Exit(EXIT_BAD_INPUT) from error
    zones = reading.zones
    volumes = [volume for zone in zones for volume in zone.volumes]
    unlimited = sum(volume.upper is None for volume in volumes)
    above_sea = sum(limit is not None and limit.reference != "AGL"
                    for volume in volumes for limit in (volume.lower, volume.upper))
    typer.echo(f"{file}: {FORMATS[file_format]}, {_count(len(zones), 'zone')} with "
               f"{_count(len(volumes), 'volume')}")
    for restriction, count in Counter(zone.restriction for zone in zones).most_common():
        typer.echo(f"  {restriction}: {count}")
    typer.echo(f"  at certain times: {sum(bool(zone.is_timed) for zone in zones)}")
    typer.echo(f"  volumes without an upper limit: {unlimited}")
    typer.echo(f"  limits above the sea: {above_sea}")
    _tell("Read with care", reading.doubts)
    _tell("Can't be read", reading.faults)
    if reading.faults:
        raise typer.Exit(EXIT_BAD_INPUT)


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def _tell(heading: str, faults: list[Fault]) -> None:
    if faults:
        typer.echo(f"{heading}:", err=True)
    for fault in faults[:MOST_TOLD]:
        typer.echo(f"  {words_of(fault)}", err=True)
    if len(faults) > MOST_TOLD:
        typer.echo(f"  and {len(faults) - MOST_TOLD} more", err=True)
