"""Clients: one generated from the API's description, and the examples of docs/use/clients.md."""

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from typer.testing import CliRunner

from app.cli.commands import cli
from tests.app.serving.observe.server import Server, running

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[3]
GUIDE = (ROOT / "docs" / "use" / "clients.md").read_text("utf-8")
GUIDE_URL = "http://127.0.0.1:8000"

SCRIPT = """
import json
import sys

import httpx_sse
from tandem_client import Client
from tandem_client.api.jobs import read_job, submit_plan
from tandem_client.api.planning import plan
from tandem_client.models import PlanReply, PlanRequest, ProblemDocument

request = PlanRequest.from_dict(json.load(open("request.json")))
with Client(base_url=sys.argv[1], raise_on_unexpected_status=True) as client:
    reply = plan.sync(client=client, body=request)
    assert isinstance(reply, PlanReply), reply
    print(reply.routes[0].trips[0].stops[1].id, reply.cost.total)

    job = submit_plan.sync(client=client, body=request, idempotency_key="order-1")
    again = submit_plan.sync(client=client, body=request, idempotency_key="order-1")
    assert job.id == again.id
    http = client.get_httpx_client()
    with httpx_sse.connect_sse(http, "GET", f"/jobs/{job.id}/events") as source:
        for event in source.iter_sse():
            if event.event == "end":
                break
    job = read_job.sync(job.id, client=client)
    print(job.state, job.result.cost.total)
    print("<svg" in http.get(f"/jobs/{job.id}/plan.svg").text)

    request.customers[0].demand = [1.0, 2.0]
    refusal = plan.sync(client=client, body=request)
    assert isinstance(refusal, ProblemDocument)
    print(refusal.errors[0].code)
"""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """Return a server with jobs."""
    folder = tmp_path_factory.mktemp("data")
    with running(TANDEM_DATA_DIR=str(folder), TANDEM_ROLE="all") as server:
        yield server


def example(language: str) -> str:
    """Return the guide's first example in a language."""
    blocks = re.findall(rf"^```{language}\n(.*?)^```", GUIDE, re.DOTALL | re.MULTILINE)
    return str(blocks[0])


class Visitor(NamedTuple):
    """A server and what to say there."""

    server: Server
    key: str | None


@pytest.fixture(scope="module")
def guarded(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Visitor]:
    """Return a server with jobs that asks for keys, and one of them."""
    settings = {"TANDEM_DATA_DIR": str(tmp_path_factory.mktemp("data")), "TANDEM_ROLE": "all",
                "TANDEM_ACCESS": "keys"}
    made = CliRunner().invoke(cli, ["keys", "create", "a client"], env=settings)
    assert made.exit_code == 0, made.output
    with running(**settings) as server:
        yield Visitor(server, made.stdout.strip())


@pytest.fixture(params=["without a key", "with a key that is asked for"])
def visitor(request: pytest.FixtureRequest, server: Server) -> Visitor:
    """Return a server and the key with which its clients come."""
    if request.param == "without a key":
        return Visitor(server, None)
    guarded: Visitor = request.getfixturevalue("guarded")
    return guarded


def run(command: list[str], script: str, folder: Path, visitor: Visitor) -> str:
    """Run an example against a server and return what it prints."""
    url = str(visitor.server.client.base_url).rstrip("/")
    environment = {name: value for name, value in os.environ.items() if name != "TANDEM_KEY"}
    key = {} if visitor.key is None else {"TANDEM_KEY": visitor.key}
    done = subprocess.run(command, input=script.replace(GUIDE_URL, url), cwd=folder, text=True,
                          capture_output=True, timeout=300, check=False,
                          env={**environment, "NO_PROXY": "*", **key})
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_generated_client_plans_and_follows_a_job(
        server: Server, smallest: dict[str, Any], tmp_path: Path) -> None:
    (tmp_path / "openapi.json").write_bytes(server.client.get("/openapi.json").content)
    (tmp_path / "config.yml").write_text("post_hooks: []\n")
    generator = Path(sys.executable).parent / "openapi-python-client"
    made = subprocess.run(
        [generator, "generate", "--path", "openapi.json", "--meta", "none",
         "--output-path", "tandem_client", "--config", "config.yml"],
        cwd=tmp_path, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    assert made.returncode == 0, made.stdout
    # It has no type for pictures.
    warned = "".join(sorted(re.findall(r"^WARNING.*", made.stdout, re.MULTILINE)))
    assert re.findall("/picture|/plan.svg|/proofs", warned) == ["/proofs", "/plan.svg", "/picture"]
    assert warned.count("WARNING") == 3
    (tmp_path / "request.json").write_text(json.dumps(smallest))
    printed = run([sys.executable, "-", str(server.client.base_url)], SCRIPT, tmp_path,
                  Visitor(server, None))
    assert printed.splitlines() == ["A 16.0", "done 16.0", "True", "DIMENSION_MISMATCH"]


@pytest.mark.thorough_after(1)
def test_python_example_runs(visitor: Visitor, tmp_path: Path) -> None:
    printed = run([sys.executable, "-"], example("python"), tmp_path, visitor)
    for line in ("plan: ", "end done ", "job: done ", "fleet: one ", "fleet: two "):
        assert f"\n{line}" in f"\n{printed}"


def test_a_key_that_nobody_asks_for_is_no_harm(server: Server, tmp_path: Path) -> None:
    printed = run(["bash", "-eu"], example("sh"), tmp_path, Visitor(server, "unused"))
    assert '"state":"done"' in printed


@pytest.mark.thorough_after(1)
def test_javascript_example_runs(visitor: Visitor, tmp_path: Path) -> None:
    printed = run(["node", "--input-type=module"], example("js"), tmp_path, visitor)
    for line in ("plan: ", "end done ", "job: done ", "fleet: one ", "fleet: two "):
        assert f"\n{line}" in f"\n{printed}"


@pytest.mark.thorough_after(1)
def test_curl_example_runs(visitor: Visitor, tmp_path: Path) -> None:
    printed = run(["bash", "-eu"], example("sh"), tmp_path, visitor)
    assert '"status":"complete"' in printed
    assert "event: end" in printed
    assert '"state":"done"' in printed
    assert '"kind":"compare"' in printed
