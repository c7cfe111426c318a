"""Connections to the service's own database end when it ends."""

from contextlib import closing
from typing import Any

import pytest
from sqlalchemy import event, text

from app.database.connections import KEPT_OPEN, close_for_good, make_engine
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


def test_connections_of_all_threads_stay_open(settings: Settings) -> None:
    engine, opened = make_engine(settings.database), list[Any]()
    event.listen(engine, "connect", lambda connection, _: opened.append(connection))
    for _ in range(3):
        connections = [engine.connect() for _ in range(KEPT_OPEN)]
        for connection in connections:
            connection.close()
    assert len(opened) == KEPT_OPEN
    engine.dispose()
