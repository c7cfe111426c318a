"""A service whose days are searched."""

from collections.abc import Iterator

import httpx
import pytest

from app.serving.settings import Settings
from tests.app.conftest import SearchingPlanner, ready, serving


@pytest.fixture(scope="session")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """Return a client of a service with a database of its own."""
    settings = Settings(data_dir=tmp_path_factory.mktemp("days"), drain_seconds=0, role="api")
    with serving(SearchingPlanner(), settings) as client:
        yield ready(client)
