"""What Prometheus reads: requests, plans, jobs, from one process or several."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import pytest
from prometheus_client.parser import text_string_to_metric_families

from app.database.connections import make_engine
from app.serving.access.keys import KeyStore
from app.serving.observe.metrics import MULTIPROCESS_DIR, Metrics
from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner, ready

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[4]
Request = dict[str, Any]
Samples = dict[tuple[str, frozenset[tuple[str, str]]], float]
Serve = Callable[..., httpx.Client]


def read(text: str) -> Samples:
    """Return all samples by name and labels."""
    return {(sample.name, frozenset(sample.labels.items())): sample.value
            for family in text_string_to_metric_families(text) for sample in family.samples}


def value(samples: Samples, name: str, **labels: str) -> float:
    """Return one sample."""
    return samples[name, frozenset(labels.items())]


def rendered(metrics: Metrics) -> Samples:
    """Return all samples of an application."""
    return read(metrics.render("")[0].decode())


@pytest.fixture
def fresh(serve: Serve) -> httpx.Client:
    """Return a client of a service that nobody has asked anything."""
    client = serve(FirstFitPlanner())
    return ready(client)


def _reply(decoded_cost: float, final_cost: float, load_rates: list[float]) -> dict[str, Any]:
    return {
        "status": "complete",
        "routes": [{"trips": [{"load_rate": rate} for rate in load_rates]}],
        "unassigned": [{"id": "A", "reasons": []}],
        "solver": {"policy": "attention", "start": "policy", "decoded_cost": decoded_cost,
                   "final_cost": final_cost, "search_iterations": 500,
                   "elapsed": {"validate": 0.001, "decode": 0.002, "search": 0.9, "check": 0.001,
                               "total": 0.905}},
    }


def test_requests_and_plans_are_counted(fresh: httpx.Client, smallest: Request) -> None:
    assert fresh.post("/plan", json=smallest).status_code == 200
    assert fresh.post("/plan", json={}).status_code == 422
    reply = fresh.get("/metrics")
    assert reply.headers["content-type"].startswith("text/plain; version=")
    samples = read(reply.text)
    counted = "tandem_http_requests_total"
    assert value(samples, counted, method="POST", route="/plan", status="200") == 1
    assert value(samples, counted, method="POST", route="/plan", status="422") == 1
    assert value(samples, "tandem_http_request_duration_seconds_count",
                 method="POST", route="/plan") == 2
    assert value(samples, "tandem_plans_total", status="complete", policy="attention",
                 start="policy") == 1
    assert value(samples, "tandem_trip_load_rate_count") == 1
    for stage in ("validate", "decode", "search", "check"):
        assert value(samples, "tandem_stage_duration_seconds_count", stage=stage) == 1


def test_plans_for_vroom_are_counted_too(fresh: httpx.Client) -> None:
    example = ROOT / "app" / "schemas" / "examples" / "vroom_matrix.json"
    reply = fresh.post("/vroom", content=example.read_bytes())
    assert reply.status_code == 200, reply.text
    status = "partial" if reply.json()["unassigned"] else "complete"
    samples = read(fresh.get("/metrics").text)
    assert value(samples, "tandem_plans_total", status=status, policy="none", start="vroom") == 1
    assert value(samples, "tandem_stage_duration_seconds_count", stage="search") == 1


def test_strange_paths_and_methods_share_one_label(fresh: httpx.Client) -> None:
    for number in range(20):
        fresh.request(f"BREW{number}", f"/tea/{number}?note=secret")
    samples = read(fresh.get("/metrics").text)
    assert value(samples, "tandem_http_requests_total", method="other", route="other",
                 status="404") == 20
    assert not any("tea" in label for _, labels in samples for _, label in labels)


def test_memory_and_version_are_told(fresh: httpx.Client) -> None:
    samples = read(fresh.get("/metrics").text)
    assert value(samples, "process_resident_memory_bytes") > 0
    (build,) = (dict(labels) for name, labels in samples if name == "tandem_build_info")
    assert build["version"] == fresh.get("/openapi.json").json()["info"]["version"]


def test_metrics_need_a_key_for_admins_unless_they_are_open(serve: Serve, tmp_path: Path) -> None:
    settings = Settings(access="keys", data_dir=tmp_path)
    engine = make_engine(settings.database)
    store = KeyStore(engine)
    keys = {scope: {"Authorization": f"Bearer {store.create(scope, [scope])}"}
            for scope in ("plan", "admin")}
    engine.dispose()
    client = ready(serve(FirstFitPlanner(), settings))
    assert client.get("/metrics").status_code == 401
    assert client.get("/metrics", headers=keys["plan"]).status_code == 403
    samples = read(client.get("/metrics", headers=keys["admin"]).text)
    assert value(samples, "tandem_refused_requests_total", reason="access") == 2
    opened = ready(serve(FirstFitPlanner(), settings.model_copy(update={"metrics_open": True})))
    assert opened.get("/metrics").status_code == 200


def test_openmetrics_is_spoken_to_those_who_ask_for_it(fresh: httpx.Client) -> None:
    reply = fresh.get("/metrics", headers={"Accept": "application/openmetrics-text"})
    assert reply.headers["content-type"].startswith("application/openmetrics-text")
    assert reply.text.endswith("# EOF\n")


def test_gap_is_what_decoding_costs_above_the_final_plan() -> None:
    metrics = Metrics("1")
    metrics.count_plan(_reply(110, 100, [0.5, 0.97]))
    metrics.count_plan(_reply(0, 0, []))
    samples = rendered(metrics)
    assert value(samples, "tandem_plan_gap_ratio_count", policy="attention") == 1
    assert value(samples, "tandem_plan_gap_ratio_sum", policy="attention") == pytest.approx(0.1)
    assert value(samples, "tandem_trip_load_rate_bucket", le="0.5") == 1
    assert value(samples, "tandem_trip_load_rate_bucket", le="1.0") == 2
    assert value(samples, "tandem_search_iterations_total") == 1000
    assert value(samples, "tandem_unassigned_customers_total") == 2


def test_jobs_are_counted_as_they_come_and_go() -> None:
    metrics = Metrics("1")
    metrics.watch_jobs(lambda: {("plan", "queued"): 3, ("sweep", "running"): 1})
    metrics.count_submitted_job("plan")
    metrics.count_finished_job("plan", "done", 12.0)
    metrics.count_finished_job("plan", "cancelled")
    samples = rendered(metrics)
    assert value(samples, "tandem_jobs", kind="plan", state="queued") == 3
    assert value(samples, "tandem_jobs", kind="sweep", state="running") == 1
    assert value(samples, "tandem_jobs_submitted_total", kind="plan") == 1
    assert value(samples, "tandem_jobs_finished_total", kind="plan", state="done") == 1
    assert value(samples, "tandem_job_duration_seconds_sum", kind="plan") == 12


def test_who_waits_and_runs_is_counted_meanwhile() -> None:
    metrics = Metrics("1")
    with metrics.waiting(), metrics.running(), metrics.running():
        samples = rendered(metrics)
        assert value(samples, "tandem_planner_waiting") == 1
        assert value(samples, "tandem_planner_running") == 2
    assert value(rendered(metrics), "tandem_planner_running") == 0


WORKER = """
import os, signal
from app.serving.observe.metrics import Metrics
metrics = Metrics("1")
metrics.count_request("GET", "/plan", 200, 0.1)
metrics.count_refusal("overload")
with metrics.running():
    print("counted", flush=True)
    signal.pause()
"""

READER = """
from app.serving.observe.metrics import Metrics
metrics = Metrics("1")
metrics.watch_jobs(lambda: {("plan", "done"): 2})
print(metrics.render("")[0].decode())
"""


def test_each_process_tells_the_counts_of_all_and_forgets_the_killed(tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": str(ROOT), MULTIPROCESS_DIR: str(tmp_path)}
    workers = [subprocess.Popen([sys.executable, "-c", WORKER], env=environment, text=True,
                                stdout=subprocess.PIPE) for _ in range(2)]

    def read_all() -> Samples:
        done = subprocess.run([sys.executable, "-c", READER], env=environment, text=True,
                              check=True, stdout=subprocess.PIPE)
        return read(done.stdout)

    try:
        for worker in workers:
            assert worker.stdout is not None
            assert worker.stdout.readline() == "counted\n"
        before = read_all()
        workers[0].kill()
        workers[0].wait()
        after = read_all()
    finally:
        for worker in workers:
            worker.kill()
            worker.communicate()
    for samples in (before, after):
        assert value(samples, "tandem_http_requests_total", method="GET", route="/plan",
                     status="200") == 2
        assert value(samples, "tandem_refused_requests_total", reason="overload") == 2
        assert value(samples, "tandem_jobs", kind="plan", state="done") == 2
    assert value(before, "tandem_planner_running") == 2
    assert value(after, "tandem_planner_running") == 1
