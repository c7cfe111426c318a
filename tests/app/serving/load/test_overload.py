"""More requests than the service can bear, clients that leave, bodies that are slow or many."""

import json
import socket
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any

import httpx
import pytest

from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner
from tests.app.serving.load.waiting import WaitingPlanner
from tests.conftest import PATIENCE, soon

pytestmark = pytest.mark.slow

Request = dict[str, Any]
Serve = Callable[..., httpx.Client]


def opened(client: httpx.Client) -> httpx.Client:
    """Return a client once its service is ready."""
    soon(lambda: client.get("/health/ready").status_code == 200)
    return client


def planner_gauge(client: httpx.Client, name: str) -> float:
    """Return how many requests wait, or run."""
    lines = client.get("/metrics").text.splitlines()
    (line,) = (line for line in lines if line.startswith(f"tandem_planner_{name} "))
    return float(line.split()[1])


def head(length: int) -> bytes:
    """Return the head of a request with a body of a length."""
    return (f"POST /plan HTTP/1.1\r\nHost: localhost\r\nContent-Length: {length}\r\n"
            "Content-Type: application/json\r\n\r\n").encode()


def connect(client: httpx.Client) -> socket.socket:
    """Open a plain connection to a client's service."""
    return socket.create_connection((client.base_url.host, client.base_url.port), timeout=PATIENCE)


def test_what_slots_and_queue_cannot_hold_is_refused_at_once_and_the_rest_is_planned(
        serve: Serve, smallest: Request) -> None:
    planner = WaitingPlanner()
    client = opened(serve(planner, Settings(max_concurrent_plans=2, max_queued_plans=3,
                                            max_queue_seconds=600)))
    with ThreadPoolExecutor(5) as pool:
        accepted = [pool.submit(client.post, "/plan", json=smallest) for _ in range(5)]
        soon(lambda: planner_gauge(client, "waiting") == 3)
        assert planner_gauge(client, "running") == planner.started == 2
        # None of them waits until there is room: there is none until the planner goes on.
        refused = [client.post("/plan", json=smallest) for _ in range(20)]
        assert client.get("/health/live").status_code == 200
        planner.go_on.set()
        assert [future.result().status_code for future in accepted] == [200] * 5
    assert {reply.status_code for reply in refused} == {503}
    assert refused[0].json()["type"] == "urn:tandem:error:overloaded"
    assert int(refused[0].headers["retry-after"]) > 0
    assert client.post("/plan", json=smallest).status_code == 200
    assert planner_gauge(client, "waiting") == planner_gauge(client, "running") == 0


def test_refusal_comes_before_the_body(serve: Serve, smallest: Request) -> None:
    planner = WaitingPlanner()
    client = opened(serve(planner, Settings(max_concurrent_plans=1, max_queued_plans=0)))
    with ThreadPoolExecutor(1) as pool, connect(client) as connection:
        running = pool.submit(client.post, "/plan", json=smallest)
        soon(lambda: planner.started == 1)
        connection.sendall(head(10**6))
        assert connection.recv(1000).startswith(b"HTTP/1.1 503")
        planner.go_on.set()
        assert running.result().status_code == 200


@pytest.mark.parametrize("shares_port", [False, True])
def test_refused_clients_connect_anew_where_another_process_may_be_free(
        serve: Serve, smallest: Request, monkeypatch: pytest.MonkeyPatch,
        shares_port: bool) -> None:
    monkeypatch.setattr("multiprocessing.parent_process", lambda: object() if shares_port else None)
    planner = WaitingPlanner()
    client = opened(serve(planner, Settings(max_concurrent_plans=1, max_queued_plans=0)))
    with ThreadPoolExecutor(1) as pool:
        running = pool.submit(client.post, "/plan", json=smallest)
        soon(lambda: planner.started == 1)
        small = client.post("/plan", json=smallest)
        large = client.post("/plan", content=b" " * 10**6)
        planner.go_on.set()
        assert running.result().status_code == 200
    assert small.status_code == large.status_code == 503
    assert (small.headers.get("connection") == "close") is shares_port
    assert "connection" not in large.headers


def test_whoever_waits_too_long_is_refused(serve: Serve, smallest: Request) -> None:
    planner = WaitingPlanner()
    client = opened(serve(planner, Settings(max_concurrent_plans=1, max_queued_plans=1,
                                            max_queue_seconds=0.05)))
    with ThreadPoolExecutor(1) as pool:
        running = pool.submit(client.post, "/plan", json=smallest)
        soon(lambda: planner.started == 1)
        late = client.post("/plan", json=smallest)
        planner.go_on.set()
        assert running.result().status_code == 200
    assert late.status_code == 503
    assert "0.05 s" in late.json()["detail"]


@pytest.mark.by_clock
def test_abandoned_plan_stops_and_frees_its_slot(serve: Serve, smallest: Request) -> None:
    planner = WaitingPlanner()
    client = opened(serve(planner, Settings(max_concurrent_plans=1, max_queued_plans=0)))
    body = json.dumps(smallest).encode()
    with connect(client) as connection:
        connection.sendall(head(len(body)) + body)
        soon(lambda: planner.started == 1)
    looks = planner.looks
    soon(lambda: planner.has_stopped)
    # Each after two milliseconds; the clock would count how long a busy machine sleeps.
    assert planner.looks - looks < 50
    planner.go_on.set()
    soon(lambda: client.post("/plan", json=smallest).status_code == 200)


def test_whoever_leaves_the_queue_makes_room(serve: Serve, smallest: Request) -> None:
    planner = WaitingPlanner()
    client = opened(serve(planner, Settings(max_concurrent_plans=1, max_queued_plans=1,
                                            max_queue_seconds=60)))
    body = json.dumps(smallest).encode()
    with ThreadPoolExecutor(2) as pool:
        accepted: list[Future[httpx.Response]] = [pool.submit(client.post, "/plan", json=smallest)]
        soon(lambda: planner.started == 1)
        with connect(client) as connection:
            connection.sendall(head(len(body)) + body)
            soon(lambda: planner_gauge(client, "waiting") == 1)
            assert client.post("/plan", json=smallest).status_code == 503
        soon(lambda: planner_gauge(client, "waiting") == 0)
        accepted.append(pool.submit(client.post, "/plan", json=smallest))
        soon(lambda: planner_gauge(client, "waiting") == 1)
        planner.go_on.set()
        assert [future.result().status_code for future in accepted] == [200, 200]
    assert planner.started == 2


def test_slow_body_is_given_up(serve: Serve) -> None:
    client = serve(FirstFitPlanner(), Settings(max_body_seconds=0.1))
    with connect(client) as connection:
        connection.sendall(head(100) + b"{")
        reply = b""
        while chunk := connection.recv(1000):
            reply += chunk
    assert reply.startswith(b"HTTP/1.1 408")
    assert b"connection: close" in reply.lower()


def test_slow_bodies_take_no_slot(serve: Serve, smallest: Request) -> None:
    client = opened(serve(FirstFitPlanner(), Settings(max_concurrent_plans=1, max_queued_plans=0)))
    with connect(client) as one, connect(client) as other:
        for connection in (one, other):
            connection.sendall(head(100) + b"{")
        assert client.post("/plan", json=smallest).status_code == 200


def test_bodies_together_are_bounded(serve: Serve, smallest: Request) -> None:
    client = opened(serve(FirstFitPlanner(), Settings(max_buffered_bytes=1000)))
    body = json.dumps(smallest).encode()
    assert 200 < len(body) < 600

    def second_is_refused() -> bool:
        with connect(client) as first:
            first.sendall(head(900) + b" " * 800)
            refused = client.post("/plan", content=body).status_code == 503
            first.sendall(b" " * 100)
            # Whichever comes second is refused.
            return refused and first.recv(1000).startswith(b"HTTP/1.1 400")

    soon(second_is_refused)
    assert client.post("/plan", content=body).status_code == 200


def test_clients_that_leave_while_sending_are_forgotten(serve: Serve, smallest: Request) -> None:
    client = opened(serve(FirstFitPlanner(), Settings(max_buffered_bytes=1000)))
    body = json.dumps(smallest).encode()
    for _ in range(5):
        with connect(client) as connection:
            connection.sendall(head(900) + b" " * 800)
    soon(lambda: client.post("/plan", content=body).status_code == 200)


@pytest.mark.parametrize(("change", "path", "code", "setting"), [
    ({"customers": 3}, "$.customers", "WRONG_LENGTH", "TANDEM_MAX_CUSTOMERS"),
    ({"num_samples": 11}, "$.options.num_samples", "OUT_OF_RANGE", "TANDEM_MAX_NUM_SAMPLES"),
    ({"time_limit": 5.1}, "$.options.time_limit", "OUT_OF_RANGE", "TANDEM_MAX_PLAN_SECONDS")])
def test_requests_beyond_the_settings_are_refused_by_name(
        serve: Serve, smallest: Request, change: dict[str, Any], path: str, code: str,
        setting: str) -> None:
    client = opened(serve(FirstFitPlanner(), Settings(
        max_customers=2, max_num_samples=10, max_plan_seconds=5)))
    smallest["options"] = {"num_samples": 10, "time_limit": 5.0}
    assert client.post("/plan", json=smallest).status_code == 200
    if "customers" in change:
        smallest["customers"] += [{**smallest["customers"][0], "id": "third"}]
    else:
        smallest["options"] |= change
    reply = client.post("/plan", json=smallest)
    assert reply.status_code == 422
    (error,) = reply.json()["errors"]
    assert (error["path"], error["code"]) == (path, code)
    assert setting in error["message"]


def test_bounds_join_the_other_errors_of_a_request(serve: Serve, smallest: Request) -> None:
    client = opened(serve(FirstFitPlanner(), Settings(max_customers=1)))
    smallest["options"] = {"time_limit": 61, "colour": "red"}
    del smallest["fleet"][0]["capacity"]
    codes = [error["code"] for error in client.post("/plan", json=smallest).json()["errors"]]
    assert sorted(codes) == ["MISSING_FIELD", "UNKNOWN_FIELD", "WRONG_LENGTH"]


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize(("options", "status"), [
    ({"time_limit": 0}, 200),
    ({"time_limit": 0, "decoding": "sample", "num_samples": 128}, 422),
    ({"search_iterations": 0, "decoding": "sample", "num_samples": 128}, 422),
    ({"time_limit": 1.5, "decoding": "sample", "num_samples": 128}, 200)])
def test_samples_that_nothing_cuts_short_are_bounded(
        serve: Serve, smallest: Request, options: dict[str, Any], status: int) -> None:
    client = opened(serve(FirstFitPlanner(), Settings(max_plan_seconds=1.5)))
    smallest["customers"] = [{**smallest["customers"][0], "id": str(number)}
                             for number in range(300)]
    smallest["options"] = options
    reply = client.post("/plan", json=smallest)
    assert reply.status_code == status, reply.text[:300]
    if status == 422:
        assert reply.json()["errors"][0]["path"] == "$.options"


def test_fleets_that_take_too_much_memory_are_refused(serve: Serve, smallest: Request) -> None:
    client = opened(serve(FirstFitPlanner(), Settings(max_legs=20)))
    truck = smallest["fleet"][0]
    drones = {"count": 1, "capacity": [1], "speed_kmh": 50}
    # Two customers and a depot: nine legs for each way to travel.
    for fleet, ways in (
            ([truck], 1), ([truck, {**truck, "id": "b"}], 1),
            ([truck, {**truck, "id": "b", "speed_kmh": 50}], 2),
            ([{**truck, "speed_kmh": 50, "drones": drones}], 1),
            ([truck, {**truck, "id": "b", "speed_profile": [{"from": 9, "speed_kmh": 30}]}], 1),
            ([truck, {**truck, "id": "b", "speed_kmh": 50, "drones": {**drones, "speed_kmh": 60}}],
             3)):
        reply = client.post("/plan", json={**smallest, "fleet": fleet})
        assert reply.status_code == (200 if ways <= 2 else 422), ways
    (error,) = reply.json()["errors"]
    assert (error["code"], error["path"]) == ("TOO_MANY_LEGS", "$.fleet")
    assert "27 legs" in error["message"]
    assert "TANDEM_MAX_LEGS" in error["message"]
