"""Runs Alembic, which leads from version to version."""

import logging
from pathlib import Path

from alembic import command
from alembic.config import Config
from sqlalchemy import Connection

from app.database.migrations.version import Direction


def run(connection: Connection, direction: Direction, version: str) -> None:
    """Bring the tables to a version within the caller's transaction. In place."""
    # Alembic tells each step at the level of information.
    logging.getLogger("alembic").setLevel(logging.WARNING)
    config = Config()
    config.set_main_option("script_location", str(Path(__file__).parent).replace("%", "%%"))
    config.set_main_option("path_separator", "os")
    config.attributes["connection"] = connection
    getattr(command, direction)(config, version)
