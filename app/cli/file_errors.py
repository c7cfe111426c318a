"""Input files of the command line that are wrong."""

from pathlib import Path
from typing import NoReturn

import typer

from app.schemas.errors import RequestError

EXIT_BAD_INPUT = 2


def refuse(file: Path, error: RequestError) -> NoReturn:
    """Print what is wrong with an input file, and exit."""
    typer.echo(f"{file}: {error}", err=True)
    for item in error.errors:
        typer.echo(f"{item.code} {item.path}: {item.message}", err=True)
    raise typer.Exit(EXIT_BAD_INPUT)
