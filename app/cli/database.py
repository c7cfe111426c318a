"""`tandem database`: tells of the database's tables and brings them to a version."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, NoReturn

import typer
from sqlalchemy import Engine
from sqlalchemy.exc import SQLAlchemyError

from app.database.connections import make_engine
from app.database.migrations import running
from app.serving.settings import Settings

EXIT_FAILED = 1

database_cli = typer.Typer(help="See and change the version of the database's tables.",
                           no_args_is_help=True, add_completion=False)


@database_cli.command()
def show() -> None:
    """Print the version of the tables. Exits with 1 if this Tandem can't work with them."""
    with database() as engine:
        version, misfit = running.version_of(engine), running.find_misfit(engine)
    typer.echo(version or "none")
    if misfit is not None:
        fail(misfit)


@database_cli.command()
def upgrade() -> None:
    """Make the tables, or bring them to this version, as every start does."""
    with database() as engine:
        running.upgrade(engine)
    typer.echo(running.newest())


@database_cli.command()
def downgrade(
    version: Annotated[str, typer.Argument(help="An earlier version, such as 0001.")],
) -> None:
    """Lead the tables back, before an earlier Tandem runs; what only later ones keep is lost."""
    with database() as engine:
        running.downgrade(engine, version)
    typer.echo(version)


@contextmanager
def database() -> Iterator[Engine]:
    """Yield the database that the settings name; say in words why it can't be used."""
    try:
        engine = make_engine(Settings().database)
        try:
            yield engine
        finally:
            engine.dispose()
    except running.SchemaError as error:
        fail(str(error))
    except (SQLAlchemyError, OSError, ValueError) as error:
        # The class alone: messages may repeat the URL, and so its password.
        fail(f"The database can't be used ({type(error).__name__}): see TANDEM_DATABASE_URL and "
             "TANDEM_DATA_DIR.")


def fail(message: str) -> NoReturn:
    """Say what went wrong, and exit."""
    typer.echo(message, err=True)
    raise typer.Exit(EXIT_FAILED)
