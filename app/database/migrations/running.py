"""Brings the database's tables to this version, or back to an earlier one."""

import logging
import threading
from pathlib import Path

from sqlalchemy import Connection, Engine, Inspector, Table, inspect, select
from sqlalchemy.exc import DBAPIError

from app.database.connections import Purpose, alone, is_outage
from app.database.migrations.version import STATED, Direction
from app.database.tables import TABLES

logger = logging.getLogger(__name__)

VERSIONS = Path(__file__).parent / "versions"

_ONE_AT_A_TIME = threading.Lock()
"""Alembic hands connections to migrations in variables of its modules."""


class SchemaError(Exception):
    """The tables aren't those that this version needs, in words for whoever runs the service."""


def upgrade(engine: Engine) -> None:
    """Make the tables, or bring them to this version, one process at a time. In place.

    Tables of before there were versions are taken over as they are.

    Raises
    ------
    SchemaError
        If they are those of a later version, or don't fit; then they stay as they were.
    SQLAlchemyError
        If the database can't be reached.
    """
    with _ONE_AT_A_TIME, alone(engine, Purpose.CHANGING_TABLES) as connection:
        before = _checked_version(connection)
        if _is_empty(connection):
            _make_tables(connection)
        elif before != newest():
            _run(connection, "upgrade", newest())
        misfit = _misfit(connection)
        if misfit is not None:
            raise SchemaError(misfit)
        after = _version(connection)
    if before != after:
        logger.info("the database's tables came from version %s to %s", before or "none", after)


def downgrade(engine: Engine, version: str) -> None:
    """Bring the tables back to an earlier version; what only later ones keep is lost. In place.

    Raises
    ------
    SchemaError
        If there is no such earlier version, or the tables don't fit theirs.
    SQLAlchemyError
        If the database can't be reached.
    """
    with _ONE_AT_A_TIME, alone(engine, Purpose.CHANGING_TABLES) as connection:
        before = _checked_version(connection)
        if before is None or version not in _versions() or version > before:
            raise SchemaError(f"The database has the version {before or 'none'}, from which none "
                              f"leads back to {version!r}: there are {', '.join(_versions())}.")
        _run(connection, "downgrade", version)


def find_misfit(engine: Engine) -> str | None:
    """Return how the tables differ from what this version needs; None: they fit."""
    with engine.connect() as connection:
        try:
            _checked_version(connection)
        except SchemaError as error:
            return str(error)
        return _misfit(connection)


def version_of(engine: Engine) -> str | None:
    """Return the version of the tables; None: they were never brought to any."""
    with engine.connect() as connection:
        return _version(connection)


def newest() -> str:
    """Return the version of this code."""
    return _versions()[-1]


def _versions() -> list[str]:
    """Return all versions that this code knows, which are numbered, in order."""
    return sorted(path.name[1:5] for path in VERSIONS.glob("v*.py"))


def _run(connection: Connection, direction: Direction, version: str) -> None:
    # Not before it is needed: mostly the tables are as they should be, and Alembic takes 10 MB.
    from app.database.migrations.steps import run

    try:
        run(connection, direction, version)
    except DBAPIError as error:
        if is_outage(error):
            raise
        raise SchemaError(f"The database's tables can't be brought to the version {version}: "
                          f"{error.orig}.") from error


def _make_tables(connection: Connection) -> None:
    """Make those of this version in a database that has none of them. In place."""
    TABLES.create_all(connection)
    STATED.create(connection)
    connection.execute(STATED.insert().values(version_num=newest()))


def _is_empty(connection: Connection) -> bool:
    return not {STATED.name, *TABLES.tables} & {*inspect(connection).get_table_names()}


def _version(connection: Connection) -> str | None:
    if not inspect(connection).has_table(STATED.name):
        return None
    return connection.execute(select(STATED.c.version_num)).scalar()


def _checked_version(connection: Connection) -> str | None:
    """Return the version of the tables.

    Raises
    ------
    SchemaError
        If this code doesn't know it.
    """
    version = _version(connection)
    if version is not None and version not in _versions():
        raise SchemaError(f"The database has the version {version}, and this one of Tandem knows "
                          f"those up to {newest()}: run the later one, or have it lead back with "
                          f"'tandem database downgrade {newest()}'.")
    return version


def _misfit(connection: Connection) -> str | None:
    """Return the first difference that would have statements fail."""
    inspector = inspect(connection)
    found = (_difference(inspector, table) for table in TABLES.sorted_tables)
    return next(filter(None, found), None)


def _difference(inspector: Inspector, table: Table) -> str | None:
    if not inspector.has_table(table.name):
        return f"The database lacks the table {table.name}: restore it from a backup."
    there = {column["name"]: column for column in inspector.get_columns(table.name)}
    if missing := [column.name for column in table.columns if column.name not in there]:
        return (f"The database's table {table.name} lacks the column {' and '.join(missing)}: "
                "restore it from a backup, or add what is missing.")
    unknown = [name for name, column in there.items() if name not in table.columns
               and not column["nullable"] and column["default"] is None]
    if unknown:
        return (f"The database's table {table.name} needs the column {' and '.join(unknown)}, "
                "which this version doesn't know: drop it, or give it a default.")
    return None
