"""All Prometheus metrics of the service, and the small functions that feed them.

Every application has a `Metrics` of its own, found at `app.state.metrics`. With several processes
(`PROMETHEUS_MULTIPROC_DIR`) each answers for all: `prometheus_client` keeps their counts in files.
"""

import os
import platform
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final, Literal

from prometheus_client import (
    CollectorRegistry, Counter, GCCollector, Gauge, Histogram, ProcessCollector,
)
from prometheus_client.exposition import choose_encoder
from prometheus_client.metrics_core import GaugeMetricFamily, Metric
from prometheus_client.multiprocess import MultiProcessCollector, mark_process_dead
from prometheus_client.registry import Collector

from app.schemas.errors import Refusal

Stage = Literal["queue", "validate", "decode", "search", "check"]
JobCounts = Mapping[tuple[str, str], int]
"""Number of jobs by kind and state."""

MULTIPROCESS_DIR: Final = "PROMETHEUS_MULTIPROC_DIR"
"""Environment variable with the folder that processes share; prometheus_client names it."""

REQUEST_SECONDS = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 30, 60)
STAGE_SECONDS = (0.0001, 0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5,
                 5, 10, 30, 60, 300)
JOB_SECONDS = (1, 2.5, 5, 10, 30, 60, 120, 300, 600, 1800, 3600, 10_800)
GAP_RATIOS = (0, 0.005, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.75, 1)
LOAD_RATES = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1)


class Metrics:
    """The metrics of one application; its methods change counts in place.

    Parameters
    ----------
    version
        Version of the service, told as a label of `tandem_build_info`.
    """

    def __init__(self, version: str) -> None:
        self.registry = CollectorRegistry()
        self._jobs: _JobCollector | None = None
        self._add_requests()
        self._add_plans()
        self._add_jobs()
        build = Gauge("tandem_build_info", "Version that runs, always 1.", ("version", "python"),
                      registry=self.registry, multiprocess_mode="max")
        build.labels(version, platform.python_version()).set(1)
        if MULTIPROCESS_DIR not in os.environ:
            ProcessCollector(registry=self.registry)
            GCCollector(registry=self.registry)

    def _add_requests(self) -> None:
        self._requests = Counter(
            "tandem_http_requests", "Requests answered.", ("method", "route", "status"),
            registry=self.registry)
        self._request_seconds = Histogram(
            "tandem_http_request_duration_seconds", "From a request's head to its reply's end.",
            ("method", "route"), buckets=REQUEST_SECONDS, registry=self.registry)
        self._refused = Counter(
            "tandem_refused_requests", "Requests refused without a look at their content.",
            ("reason",), registry=self.registry)
        for reason in ("overload", "rate_limit", "access"):
            self._refused.labels(reason)
        self._waiting = Gauge(
            "tandem_planner_waiting", "Requests that wait for a planner.",
            registry=self.registry, multiprocess_mode="livesum")
        self._running = Gauge(
            "tandem_planner_running", "Plans being computed.", registry=self.registry,
            multiprocess_mode="livesum")

    def _add_plans(self) -> None:
        self._plans = Counter(
            "tandem_plans", "Plans made.", ("status", "policy", "start"), registry=self.registry)
        self._stage_seconds = Histogram(
            "tandem_stage_duration_seconds", "Stages of planning.", ("stage",),
            buckets=STAGE_SECONDS, registry=self.registry)
        self._gap = Histogram(
            "tandem_plan_gap_ratio", "Cost of the decoded plan above the final cost, over it.",
            ("policy",), buckets=GAP_RATIOS, registry=self.registry)
        self._load_rate = Histogram(
            "tandem_trip_load_rate", "Load of trips over capacity.", buckets=LOAD_RATES,
            registry=self.registry)
        self._iterations = Counter(
            "tandem_search_iterations", "Iterations of all searches.", registry=self.registry)
        self._unassigned = Counter(
            "tandem_unassigned_customers", "Customers that plans left out.",
            registry=self.registry)

        self._plans_refused = Counter(
            "tandem_plans_refused", "Plans found that broke a rule; others stood for them.",
            registry=self.registry)
        self._deaths = Counter(
            "tandem_process_deaths", "Processes that planned and ended unexpectedly, by what they "
            "were doing.", ("during",), registry=self.registry)
        for during in ("request", "job", "nothing"):
            self._deaths.labels(during)

    def _add_jobs(self) -> None:
        self._submitted = Counter(
            "tandem_jobs_submitted", "Jobs accepted.", ("kind",), registry=self.registry)
        self._finished = Counter(
            "tandem_jobs_finished", "Jobs ended, by the state they ended in.", ("kind", "state"),
            registry=self.registry)
        self._job_seconds = Histogram(
            "tandem_job_duration_seconds", "Jobs from their start to their end.", ("kind",),
            buckets=JOB_SECONDS, registry=self.registry)

    def count_request(self, method: str, route: str, status: int, seconds: float) -> None:
        """Count a request that was answered. `route` is a template such as `/jobs/{id}`."""
        self._requests.labels(method, route, status).inc()
        self._request_seconds.labels(method, route).observe(seconds)

    def count_refusal(self, reason: Refusal) -> None:
        """Count a request that was turned away."""
        self._refused.labels(reason).inc()

    def count_plan(self, reply: Mapping[str, Any]) -> None:
        """Count a plan, told as the reply of `POST /plan` before it is written down."""
        solver = reply["solver"]
        self._plans.labels(reply["status"], solver["policy"], solver["start"]).inc()
        for stage in ("validate", "decode", "search", "check"):
            self.observe_stage(stage, solver["elapsed"][stage])
        if solver["start"] == "policy" and solver["final_cost"] > 0:
            gap = solver["decoded_cost"] / solver["final_cost"] - 1
            self._gap.labels(solver["policy"]).observe(max(gap, 0.0))
        for route in reply["routes"]:
            for trip in route["trips"]:
                self._load_rate.observe(trip["load_rate"])
        self._iterations.inc(solver["search_iterations"])
        self._unassigned.inc(len(reply["unassigned"]))

    def count_refused_plan(self) -> None:
        """Count a plan that broke a rule, so that another stood for it."""
        self._plans_refused.inc()

    def count_vroom_plan(self, reply: Mapping[str, Any]) -> None:
        """Count a plan of `POST /vroom`, told as its reply, which has times in milliseconds."""
        status = "partial" if reply["unassigned"] else "complete"
        self._plans.labels(status, "none", "vroom").inc()
        times = reply["summary"]["computing_times"]
        self.observe_stage("validate", times["loading"] / 1000)
        self.observe_stage("search", times["solving"] / 1000)
        self._unassigned.inc(len(reply["unassigned"]))

    def count_death(self, during: str) -> None:
        """Count a process that planned and died, by what it was doing."""
        self._deaths.labels(during).inc()

    def observe_stage(self, stage: Stage, seconds: float) -> None:
        """Note how long a stage of planning took."""
        self._stage_seconds.labels(stage).observe(seconds)

    @contextmanager
    def waiting(self) -> Iterator[None]:
        """Count one more request that waits for a planner, meanwhile."""
        with self._waiting.track_inprogress():
            yield

    @contextmanager
    def running(self) -> Iterator[None]:
        """Count one more plan being computed, meanwhile."""
        with self._running.track_inprogress():
            yield

    def count_submitted_job(self, kind: str) -> None:
        """Count a job that was accepted."""
        self._submitted.labels(kind).inc()

    def count_finished_job(self, kind: str, state: str, seconds: float | None = None) -> None:
        """Count a job that ended in `state`, `seconds` after it started, if it did."""
        self._finished.labels(kind, state).inc()
        if seconds is not None:
            self._job_seconds.labels(kind).observe(seconds)

    def watch_jobs(self, count: Callable[[], JobCounts]) -> None:
        """Ask `count` for the number of jobs whenever metrics are read. In place."""
        self._jobs = _JobCollector(count)
        self.registry.register(self._jobs)

    def render(self, accept: str) -> tuple[bytes, str]:
        """Return all metrics, of all processes that share them, and their media type.

        Parameters
        ----------
        accept
            The request's `Accept` header, which tells the format.
        """
        encode, media_type = choose_encoder(accept)
        content: bytes = encode(self._readable())
        return content, media_type

    def _readable(self) -> CollectorRegistry:
        folder = os.environ.get(MULTIPROCESS_DIR)
        if folder is None:
            return self.registry
        _forget_dead_processes(Path(folder))
        readable = CollectorRegistry()
        MultiProcessCollector(readable)
        if self._jobs is not None:
            readable.register(self._jobs)
        return readable


def countable(reply: Mapping[str, Any]) -> dict[str, Any]:
    """Return of a plan, told as its reply, what `count_plan` looks at."""
    return {"status": reply["status"], "solver": reply["solver"],
            "unassigned": [None] * len(reply["unassigned"]),
            "routes": [{"trips": [{"load_rate": trip["load_rate"]} for trip in route["trips"]]}
                       for route in reply["routes"]]}


def countable_vroom(reply: Mapping[str, Any]) -> dict[str, Any]:
    """Return of a plan of `POST /vroom`, told as its reply, what `count_vroom_plan` looks at."""
    return {"summary": {"computing_times": reply["summary"]["computing_times"]},
            "unassigned": [None] * len(reply["unassigned"])}


class _JobCollector(Collector):
    """Counts jobs where they are kept, as no process knows them all."""

    def __init__(self, count: Callable[[], JobCounts]) -> None:
        self._count = count

    def collect(self) -> Iterator[Metric]:
        family = GaugeMetricFamily("tandem_jobs", "Jobs kept, by state.", labels=("kind", "state"))
        for labels, number in self._count().items():
            family.add_metric(labels, number)
        yield family

    def describe(self) -> Iterator[Metric]:
        yield from ()


def _forget_dead_processes(folder: Path) -> None:
    """Drop what killed processes said of themselves, such as how many plans they compute."""
    for file in folder.glob("gauge_live*_*.db"):
        process = int(file.stem.rpartition("_")[2])
        if not Path(f"/proc/{process}").exists() and Path("/proc").exists():
            mark_process_dead(process, str(folder))
