"""A service with a planner of its own: small, slow, and legal."""

import json
import logging
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import httpx
import pytest
import uvicorn
from sqlalchemy import Connection, Engine, event

from app.cli.serving import IDLE_SECONDS
from app.database.connections import make_engine
from app.main import create_app
from app.plans import explaining, task
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.planner import (
    ALONE, Elapsed, Listener, Planner, PlanOptions, PlanResult, load_planner,
)
from model.problem import Problem, VehicleType
from model.solution import Route, Solution
from tests.app.postgres import fragile_postgres, postgres, settings
from tests.conftest import PATIENCE, end, eventually

__all__ = ["fragile_postgres", "postgres", "settings"]

APP_DIR = Path(__file__).parents[2] / "app"


@contextmanager
def opened(settings: Settings) -> Iterator[Engine]:
    """Yield the service's database, which nobody else closes: else a later test is told of it."""
    engine = make_engine(settings.database)
    try:
        yield engine
    finally:
        engine.dispose()


class FirstFitPlanner:
    """Serves each customer, in order, in the first place where no rule breaks."""

    policies: tuple[str, ...] = (DEFAULT_POLICY,)

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        routes: list[RouteDecision] = []
        unassigned = []
        for node in range(problem.num_depots, problem.num_nodes):
            for candidate in _candidates(problem, routes, node):
                if _is_legal(problem, candidate):
                    routes = candidate
                    break
            else:
                unassigned.append(node)
        solution = Solution(_timed(problem, routes), tuple(unassigned))
        evaluation = check(problem, solution)
        assert evaluation.is_feasible, evaluation.violations
        cost = evaluation.cost.total
        return PlanResult(solution=solution, evaluation=evaluation, start="policy",
                          decoded_cost=cost, final_cost=cost, search_iterations=0,
                          threads=options.threads, deterministic=True,
                          elapsed=Elapsed(decode=0.0, search=0.0, check=0.0))


def _candidates(problem: Problem, routes: list[RouteDecision],
                node: int) -> Iterator[list[RouteDecision]]:
    for index, route in enumerate(routes):
        kind = problem.vehicle_types[route.vehicle_type]
        for trip in _with_customer(kind, route.trips[-1], node):
            longer = RouteDecision(route.vehicle_type, route.vehicle, (*route.trips[:-1], trip))
            yield [*routes[:index], longer, *routes[index + 1:]]
    for index, kind in enumerate(problem.vehicle_types):
        used = sum(route.vehicle_type == index for route in routes)
        for trip in _with_customer(kind, TripDecision((kind.begins_at, kind.ends_at)), node):
            yield [*routes, RouteDecision(index, used, (trip,))]


def _with_customer(kind: VehicleType, trip: TripDecision, node: int) -> Iterator[TripDecision]:
    """Yield the trip with one more customer: by truck at the end, by drone from the depot."""
    shifted = tuple(
        SortieDecision(sortie.nodes, sortie.launch_stop, sortie.recovery_stop, sortie.drone)
        for sortie in trip.sorties
    )
    yield TripDecision((*trip.nodes[:-1], node, trip.nodes[-1]), shifted)
    for drone in range(kind.num_drones):
        yield TripDecision(trip.nodes, (*trip.sorties, SortieDecision((node,), 0, 0, drone)))


def _is_legal(problem: Problem, routes: list[RouteDecision]) -> bool:
    kinds = [problem.vehicle_types[route.vehicle_type] for route in routes]
    if any(trip.sorties and kind.drones is None
           for kind, route in zip(kinds, routes, strict=True) for trip in route.trips):
        return False
    violations = check(problem, Solution(_timed(problem, routes))).violations
    return all(violation.code == "MISSING" for violation in violations)


def _timed(problem: Problem, routes: list[RouteDecision]) -> tuple[Route, ...]:
    return tuple(schedule(problem, route) for route in routes)


@pytest.fixture(scope="session", autouse=True)
def no_workers() -> Iterator[None]:
    """Let services within this process take jobs without working on them: only one could."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TANDEM_ROLE", "api")
        yield


@pytest.fixture(scope="session", autouse=True)
def time_for_reasons() -> Iterator[None]:
    """Have replies say why somebody is left out however busy the machine: usual are 50 ms."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(task, "EXPLAINING", PATIENCE)
        patch.setattr(explaining, "REASONS_SECONDS", PATIENCE)
        yield


@pytest.fixture(scope="session")
def connected_engines() -> Iterator[set[Engine]]:
    """Return what tests opened, noted all along: a service may connect while listeners change."""
    engines: set[Engine] = set()

    def note(connection: Connection) -> None:
        if threading.current_thread() is threading.main_thread():
            engines.add(connection.engine)

    event.listen(Engine, "engine_connect", note)
    yield engines
    event.remove(Engine, "engine_connect", note)


@pytest.fixture(autouse=True)
def no_open_database(connected_engines: set[Engine]) -> Iterator[None]:
    """Close what a test opened, services apart: from Python 3.13 on, SQLite warns of it."""
    connected_engines.clear()
    yield
    for engine in connected_engines:
        engine.dispose()


@pytest.fixture
def planner() -> FirstFitPlanner:
    """Return a planner that needs no weights."""
    return FirstFitPlanner()


def ready(client: httpx.Client) -> httpx.Client:
    """Return a client once its service plans."""
    eventually(lambda: client.get("/health/ready").status_code == 200)
    return client


@contextmanager
def serving(planner: Planner | None,
            settings: Settings | None = None) -> Iterator[httpx.Client]:
    """Serve on loopback; without a planner by that of the settings."""
    app = create_app(settings or Settings(max_body_bytes=2**20), planner)
    # With its protocol stated, asyncio sends small packets at once.
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.bind(("127.0.0.1", 0))
    listener.listen()
    # Nor does it close a connection just when a client that was busy for 5 s asks on it again.
    server = uvicorn.Server(uvicorn.Config(app, log_level=logging.CRITICAL + 1,
                                           timeout_keep_alive=IDLE_SECONDS))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
    thread.start()
    address = f"http://127.0.0.1:{listener.getsockname()[1]}"
    try:
        # To read the certificates takes longer than most requests.
        with httpx.Client(base_url=address, timeout=PATIENCE, trust_env=False,
                          verify=False) as client:
            yield client
    finally:
        server.should_exit = True
        end(thread)
        listener.close()


@pytest.fixture
def serve() -> Iterator[Callable[..., httpx.Client]]:
    """Return a function that serves a planner, until the test ends, and returns a client."""
    with ExitStack() as stack:
        yield lambda planner, settings=None: stack.enter_context(serving(planner, settings))


@pytest.fixture
def same_minute(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stop the clock of the rate limits, whose counts slide wherever a minute begins."""
    stopped = time.time()
    clock = SimpleNamespace(time=lambda: stopped)
    for module in ("limits.storage.memory", "limits.strategies", "app.serving.access.limits"):
        monkeypatch.setattr(f"{module}.time", clock)


@pytest.fixture(scope="session")
def client() -> Iterator[httpx.Client]:
    """Return a client of a service."""
    with serving(FirstFitPlanner()) as client:
        yield ready(client)


class SearchingPlanner(Planner):
    """The true planner without policies, for requests that never ask one."""

    def __init__(self) -> None:
        super().__init__({DEFAULT_POLICY: None})  # type: ignore[dict-item]


@pytest.fixture(scope="session")
def searching() -> Iterator[httpx.Client]:
    """Return a client of a service that searches."""
    with serving(SearchingPlanner(), Settings(vroom_seconds=0.3)) as client:
        client.timeout = 300
        yield ready(client)


@pytest.fixture(scope="session")
def service() -> Iterator[httpx.Client]:
    """Return a client of a service that plans by the policies trained, and searches."""
    settings = Settings()
    with serving(load_planner(settings.weights_dir, settings.policies), settings) as client:
        yield ready(client)


@pytest.fixture
def smallest() -> dict[str, Any]:
    """Return the smallest example request."""
    return json.loads((APP_DIR / "schemas" / "examples" / "smallest.json").read_text("utf-8"))


@pytest.fixture
def with_drones() -> dict[str, Any]:
    """Return the example request with drones."""
    return json.loads((APP_DIR / "schemas" / "examples" / "drones.json").read_text("utf-8"))
