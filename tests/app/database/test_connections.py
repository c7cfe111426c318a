"""Connections to the service's own database end when it ends."""

from contextlib import closing
from typing import Any

import pytest
from sqlalchemy import text

from app.database.connections import close_for_good, make_engine
from app.serving.settings import Settings


def ask(connection: Any) -> None:
    """Ask the database by the driver's connection."""
    with closing(connection.cursor()) as cursor:
        cursor.execute("SELECT 1")


@pytest.mark.parametrize("begun", ["before", "after"])
def test_connection_given_back_too_late_is_closed(settings: Settings, begun: str) -> None:
    engine = make_engine(settings.database)
    if begun == "after":
        close_for_good(engine)
    late = engine.connect()
    late.execute(text("SELECT 1"))
    driver = late.connection.driver_connection
    if begun == "before":
        close_for_good(engine)
    ask(driver)
    late.close()
    with pytest.raises(Exception, match="closed"):
        ask(driver)
