"""The search for the dearest requests finds what was hidden, and asks for nothing nonsensical.

The search itself is `python -m benchmarks.speed.dearest`.
"""

import json
import os
import random
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import nullcontext
from itertools import count
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import httpx
import pytest
import typer

from app.formats.vroom.schemas import VroomRequest
from app.requests.reading import read_request
from app.schemas.request import PlanRequest
from app.serving.load.courtesy import NICENESS
from benchmarks.speed.dear_requests import (
    KINDS, LARGEST, PLAN, Genes, changed_genes, gene, mixed_genes, random_genes, request_of,
)
from benchmarks.speed.dearest import Asker, Companion, Search, main, processor_time

pytestmark = pytest.mark.slow

Data = dict[str, Any]

ROOT = Path(__file__).resolve().parents[3]


@pytest.mark.parametrize(("path", "schema"), [("/plan", PlanRequest), ("/vroom", VroomRequest)])
def test_any_genes_make_a_request_of_the_schema_and_size(path: str, schema: Any) -> None:
    lengths = []
    for seed in range(30):
        request = request_of(path, random_genes(random.Random(seed), path), 1.0)
        body = json.dumps(request, separators=(",", ":"))
        schema.model_validate_json(body)
        lengths.append(len(body))
    assert max(lengths) <= LARGEST < 3 * max(lengths)


def test_most_requests_are_valid() -> None:
    valid = 0
    for seed in range(20):
        genes = random_genes(random.Random(seed), "/plan") | {"areas": 0, "customers": 2}
        read_request(json.dumps(request_of("/plan", genes, 1.0)).encode(), None)
        valid += 1
    assert valid == 20


def test_children_differ_in_few_genes_from_their_parents() -> None:
    rng = random.Random(0)
    first, second = random_genes(rng, "/plan"), random_genes(rng, "/plan")
    for _ in range(50):
        child = changed_genes(rng, "/plan", first)
        assert sum(child[name] != first[name] for name in PLAN) <= 3
        assert all(0 <= child[name] < len(PLAN[name]) for name in PLAN)
        mixed = mixed_genes(rng, first, second)
        assert all(mixed[name] in (first[name], second[name]) for name in PLAN)


def hidden(path: str, genes: Genes) -> float:
    """Return a ratio that is large for two values of genes together alone."""
    return (1.0 + genes["customers"] / 10
            + 3.0 * (genes["windows"] == 3 and genes["service"] == len(KINDS[path]["service"]) - 1))


@pytest.mark.parametrize("path", KINDS)
def test_search_finds_what_is_dear(path: str) -> None:
    search = Search(path, random.Random(1), lambda path, genes: (hidden(path, genes), 200, 1000))
    for _ in range(400):
        search.step()
    assert search.best[0].ratio > 4.5
    assert [find.ratio for find in search.best] == sorted(
        (find.ratio for find in search.best), reverse=True)


def test_a_busy_moment_is_no_find() -> None:
    ratios = iter([1.0, 1.0, 1.0, 9.0, 1.01, 9.0])
    search = Search("/plan", random.Random(0), lambda *_: (next(ratios), 200, 1000))
    search.step()
    assert search.step().ratio == 1.01


def asker(answer: Callable[[httpx.Request], httpx.Response]) -> Asker:
    """Return who asks a service that answers so."""
    return Asker(httpx.Client(transport=httpx.MockTransport(answer), base_url="http://service"),
                 0.5)


def test_plans_that_go_on_are_planned_first() -> None:
    asked: list[Data] = []

    def answer(request: httpx.Request) -> httpx.Response:
        asked.append(json.loads(request.content))
        return httpx.Response(200, json={"unassigned": [], "routes": [
            {"trips": [{"stops": [{"departure": 0.0}, {"departure": 1000.0}]}]}]})

    genes = random_genes(random.Random(0), "/plan")
    genes |= {"customers": 1, "replan": PLAN["replan"].index("under way")}
    ratio, status, length = asker(answer).measure("/plan", genes)
    first, second = asked
    assert second == first | {"replan": second["replan"]}
    assert second["replan"]["freeze_before"] == 400.0
    assert (status, length) == (200, len(json.dumps(second, separators=(",", ":"))))
    assert ratio > 0
    assert gene("/plan", genes, "replan") == "under way"


@pytest.mark.parametrize(("only", "asked"), [("/vroom", {"/vroom"}), (None, set(KINDS))])
def test_one_endpoint_may_be_asked_alone(monkeypatch: pytest.MonkeyPatch, tmp_path: Path,
                                         only: Any, asked: set[str]) -> None:
    paths: list[str] = []

    def measure(self: Asker, path: str, genes: Genes) -> tuple[float, int, int]:
        paths.append(path)
        return 1.0 if len(paths) == 1 else 0.5, 200, 1000

    running = SimpleNamespace(url="http://service", key="", process=SimpleNamespace(
        poll=lambda: None))
    monkeypatch.setattr("benchmarks.speed.dearest.service", lambda folder: nullcontext(running))
    monkeypatch.setattr("benchmarks.speed.dearest.pinned", lambda target, core: None)
    monkeypatch.setattr(Asker, "measure", measure)
    # Looks at the clock are all that takes time.
    ticks = count()
    monkeypatch.setattr("benchmarks.speed.dearest.time", SimpleNamespace(
        monotonic=lambda: 0.01 * next(ticks), perf_counter=time.perf_counter))
    with pytest.raises(typer.Exit):
        main(minutes=0.005, only=only, folder=tmp_path)
    assert set(paths) == asked


def test_a_job_runs_beside_what_is_asked_for() -> None:
    states, asked = iter(["queued", "running", "running", "done", "running"]), []

    def answer(request: httpx.Request) -> httpx.Response:
        asked.append((request.method, request.url.path))
        if request.method == "GET":
            return httpx.Response(200, json={"state": next(states)})
        return httpx.Response(202, json={"id": "a", "routes": [], "unassigned": []})

    client = asker(answer).client
    beside = Asker(client, 0.5, Companion(client))
    for _ in range(3):
        beside.measure("/vroom", random_genes(random.Random(0), "/vroom"))
    told = [path for method, path in asked if method == "POST"]
    assert told == ["/jobs", "/vroom", "/vroom", "/jobs", "/vroom"]


WORKING = """import sys, threading, time
from app.serving.load.courtesy import stand_back

def spend():
    if sys.argv[1] == "stand back":
        stand_back()
    end = time.thread_time() + 0.5
    while time.thread_time() < end:
        pass
    print("done", flush=True)
    sys.stdin.readline()

print("ready", flush=True)
sys.stdin.readline()
threading.Thread(target=spend).start()
"""
"""Takes half a second of the processor in a thread, once it is told to, and ends as it is told."""


def counted(how: str) -> float:
    """Return what is counted of half a second of a thread's work.

    It is done in a process of its own: this one has threads and children of other tests.
    """
    with subprocess.Popen([sys.executable, "-c", WORKING, how], cwd=ROOT, text=True, bufsize=1,
                          stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        before = processor_time(process.pid)
        process.stdin.write("\n")
        assert process.stdout.readline() == "done\n"
        taken = processor_time(process.pid) - before
        process.stdin.write("\n")
    return taken


@pytest.mark.skipif(sys.platform != "linux" or os.nice(0) >= NICENESS,
                    reason="no thread stands back of this process's others")
def test_processor_time_leaves_out_what_stands_back() -> None:
    assert counted("work") > 0.4
    assert counted("stand back") < 0.3


def test_the_job_beside_is_a_valid_request() -> None:
    request = Companion(httpx.Client())._request
    read_request(json.dumps(request).encode(), None)
    assert len(request["fleet"]) == 100
    assert len(request["fleet"][0]["drones"]) == 8
