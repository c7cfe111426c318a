"""A service with keys of two owners, on both databases."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.database.connections import make_engine
from app.serving.access.keys import KeyStore
from app.serving.settings import Settings
from tests.app.postgres import settings_of
from tests.app.records.jobs.conftest import serving

REQUEST = {"depots": [{"id": "hub", "location": [0, 0]}],
           "customers": [{"id": "A", "location": [3000, 4000], "demand": [10], "half done": True}],
           "fleet": [{"id": "truck", "count": 2, "capacity": [20]}]}
PLAN = {"cost": {"total": 12.5}, "routes": [], "new": ["field", 0.1]}


def content(name: str = "Monday", **parts: Any) -> dict[str, Any]:
    """Return a body that keeps a plan."""
    return {"name": name, "request": REQUEST, "plan": PLAN} | parts


@dataclass(frozen=True)
class Owner:
    """Asks with a key."""

    client: httpx.Client
    key: str

    def ask(self, method: str, path: str, **options: Any) -> httpx.Response:
        """Send a request with the key."""
        headers = {"Authorization": f"Bearer {self.key}"} | options.pop("headers", {})
        return self.client.request(method, path, headers=headers, **options)

    def keep(self, plan_id: str, body: dict[str, Any] | None = None,
             **headers: str) -> httpx.Response:
        """Keep a plan; headers' names are those of arguments."""
        named = {name.replace("_", "-"): value for name, value in headers.items()}
        return self.ask("PUT", f"/plans/{plan_id}", json=body or content(), headers=named)

    def share(self, plan_id: str) -> dict[str, str]:
        """Make a link and return it."""
        link: dict[str, str] = self.ask("POST", f"/plans/{plan_id}/links").json()
        return link


@dataclass(frozen=True)
class Service:
    """A running service, and keys of several owners."""

    settings: Settings
    client: httpx.Client
    keys: dict[str, str]

    def owner(self, name: str) -> Owner:
        """Return somebody who has a key."""
        return Owner(self.client, self.keys[name])


@pytest.fixture(scope="session", params=["sqlite", "postgresql"])
def service(request: pytest.FixtureRequest,
            tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """Return a service that demands keys, of which Ann's and Ben's may plan."""
    settings = settings_of(request, tmp_path_factory.mktemp("kept")).model_copy(
        update={"role": "api", "access": "keys", "drain_seconds": 0})
    engine = make_engine(settings.database)
    store = KeyStore(engine)
    keys = {"ann": store.create("ann", ["plan"]), "ben": store.create("ben", ["plan"]),
            "jobs": store.create("jobs", ["jobs"])}
    engine.dispose()
    with serving(settings) as client:
        yield Service(settings, client, keys)


@pytest.fixture
def ann(service: Service) -> Iterator[Owner]:
    """Return an owner without plans."""
    yield from _without_plans(service.owner("ann"))


@pytest.fixture
def ben(service: Service) -> Iterator[Owner]:
    """Return another."""
    yield from _without_plans(service.owner("ben"))


def _without_plans(owner: Owner) -> Iterator[Owner]:
    yield owner
    for plan in owner.ask("GET", "/plans").json()["plans"]:
        owner.ask("DELETE", f"/plans/{plan['id']}")


@pytest.fixture
def keeping(tmp_path: Path) -> Iterator[Callable[..., httpx.Client]]:
    """Return a function that serves with settings of its own, where access is open."""
    with ExitStack() as stack:
        yield lambda **stated: stack.enter_context(serving(Settings(
            data_dir=tmp_path, role="api", drain_seconds=0, **stated)))
