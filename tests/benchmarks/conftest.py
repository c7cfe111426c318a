"""One service for all that is thrown at one."""

from collections.abc import Iterator

import httpx
import pytest

from benchmarks.fuzz.api import service
from benchmarks.fuzz.problems import client_of


@pytest.fixture(scope="session")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """Return a client of a service that runs in a process of its own."""
    with service(tmp_path_factory.mktemp("fuzzed")) as target, client_of(target) as asking:
        yield asking
