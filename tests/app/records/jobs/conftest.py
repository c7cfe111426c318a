"""A service that works on jobs."""

from collections.abc import Iterator
from contextlib import contextmanager

import httpx
import pytest

from app.records.jobs import order, planning, studies, webhook
from app.serving.settings import Settings
from tests.app.conftest import ready
from tests.app.conftest import serving as served
from tests.app.records.jobs.stepping import SteppingPlanner


@contextmanager
def serving(settings: Settings, planner: SteppingPlanner | None = None) -> Iterator[httpx.Client]:
    """Serve on loopback and work on jobs in this process."""
    with served(planner or SteppingPlanner(), settings) as client:
        yield ready(client)


@pytest.fixture(scope="module")
def jobs(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """Return a client of a service that works on jobs, with SQLite and webhooks.

    It writes down finds and calls webhooks again sooner than others do.
    """
    settings = Settings(data_dir=tmp_path_factory.mktemp("jobs"), role="all", job_slots=2,
                        max_scenarios=8, drain_seconds=0,
                        webhook_secret="whsec_MDEyMzQ1Njc4OTAxMjM0NTY3ODkwMTIzNDU2Nzg5MDE=")
    with pytest.MonkeyPatch.context() as patch, serving(settings) as client:
        for module in (order, planning, studies):
            patch.setattr(module, "SLICE", 0.25)
        patch.setattr(webhook, "FIRST_WAIT", 0.25)
        yield client
