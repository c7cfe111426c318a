"""The same import over HTTP and by the command, whatever bytes come."""

import json
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import httpx
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from typer.testing import CliRunner

from app.cli.commands import cli
from app.formats.sheets.importing import import_file
from app.formats.sheets.schemas import ImportReply, ImportSettings
from app.serving.settings import Settings
from tests.app.formats.sheets import makes
from tests.app.serving.load.waiting import WaitingPlanner
from tests.conftest import eventually

pytestmark = pytest.mark.slow

SETTINGS = makes.GERMAN_SETTINGS
GERMAN = makes.GERMAN.encode("cp1252")
EXPECTED = import_file(GERMAN, ImportSettings.model_validate(SETTINGS))


def posted(client: httpx.Client, content: bytes, stated: dict[str, Any] | None = None) -> Any:
    """Send a file as a form and return the reply."""
    return client.post("/import", files={"file": ("sheet.csv", content)},
                       data={"settings": json.dumps(stated or {})})


def test_a_form_and_a_bare_body_give_the_same_request(client: httpx.Client) -> None:
    form = posted(client, GERMAN, SETTINGS)
    assert form.status_code == 200, form.text
    ImportReply.model_validate(form.json())
    assert form.json()["request"] == EXPECTED.request
    bare = client.post("/import", content=GERMAN, headers={"Content-Type": "text/csv"},
                       params={"settings": json.dumps(SETTINGS)})
    assert bare.json() == form.json()


def test_the_request_of_an_import_is_planned(client: httpx.Client) -> None:
    request = posted(client, GERMAN, SETTINGS).json()["request"]
    plan = client.post("/plan", json=request)
    assert plan.status_code == 200, plan.text
    stops = [stop for route in plan.json()["routes"] for trip in route["trips"]
             for stop in trip["stops"]]
    told = {stop["id"]: stop["info"] for stop in stops if stop["kind"] == "customer"}
    assert told["Apotheke Süd"]["notes"] == "2x klingeln"


def test_the_mapping_of_a_reply_can_be_sent_again(client: httpx.Client) -> None:
    first = posted(client, GERMAN, SETTINGS).json()
    again = posted(client, GERMAN, SETTINGS | {"mapping": first["mapping"]}).json()
    assert again["request"] == first["request"]
    assert again["mapping"] == first["mapping"]


def test_cells_that_are_wrong_come_with_status_200(client: httpx.Client) -> None:
    reply = posted(client, b"name,x,y,from\nA,1,1,noon\nB,2,2,8:00\nC,3,3,9:00").json()
    assert reply["request"] is None
    assert [error["cell"] for error in reply["errors"]] == ["D2"]


@pytest.mark.parametrize(("stated", "path"), [
    ({"depott": "1,1"}, "$.depott"), ({"vehicles": 0}, "$.vehicles"), ({"day": "today"}, "$.day"),
    ({"mapping": {"columns": [{"heading": "a", "meaning": "colour"}]}},
     "$.mapping.columns[0].meaning"),
])
def test_wrong_settings_are_named(client: httpx.Client, stated: dict[str, Any],
                                  path: str) -> None:
    reply = posted(client, GERMAN, stated)
    assert reply.status_code == 422
    assert [error["path"] for error in reply.json()["errors"]] == [path]


@pytest.mark.parametrize("stated", [{"day": "2026-02-30"}, {"mapping": {"encoding": "klingon"}},
                                    {"mapping": {"encoding": "rot13"}}])
def test_settings_that_name_nothing_are_refused(client: httpx.Client,
                                                stated: dict[str, Any]) -> None:
    reply = posted(client, GERMAN, stated)
    assert reply.status_code == 422
    assert reply.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize(("content", "kind", "status"), [
    (b"--x\r\n", "multipart/form-data; boundary=x", 400),
    (b"", "multipart/form-data", 400),
    (b"--x\r\nContent-Disposition: form-data; name=\"other\"\r\n\r\n1\r\n--x--\r\n",
     "multipart/form-data; boundary=x", 400),
    (b"garbage", "multipart/form-data; boundary=x", 400),
    (b"", "text/csv", 422), (b"%PDF-1.7", "text/csv", 422),
    (b"PK\x03\x04" + bytes(1000), "application/octet-stream", 422),
])
def test_what_is_no_sheet_is_a_problem_document(client: httpx.Client, content: bytes, kind: str,
                                                status: int) -> None:
    reply = client.post("/import", content=content, headers={"Content-Type": kind})
    assert reply.status_code == status, reply.text
    assert reply.headers["content-type"] == "application/problem+json"


def test_a_body_that_is_too_large_is_refused(client: httpx.Client) -> None:
    assert posted(client, b"a,b\n" * 2**19).status_code == 413


@pytest.mark.thorough
def test_others_are_answered_while_many_rows_are_read(client: httpx.Client) -> None:
    done = threading.Event()

    def import_many() -> None:
        reply = posted(client, makes.large(12_000))
        assert reply.json()["rows"] == 12_000
        done.set()

    thread = threading.Thread(target=import_many)
    thread.start()
    answered = 0
    while not done.is_set() and thread.is_alive():
        assert client.get("/health/live").status_code == 200
        answered += 1
        time.sleep(0.01)
    thread.join()
    assert done.is_set()
    assert answered > 3


def test_an_import_waits_for_no_plan(serve: Callable[..., httpx.Client],
                                     smallest: dict[str, Any]) -> None:
    planner = WaitingPlanner()
    client = serve(planner, Settings(max_concurrent_plans=1, max_queued_plans=0))
    eventually(lambda: client.get("/health/ready").status_code == 200)
    with ThreadPoolExecutor(1) as pool:
        planned = pool.submit(client.post, "/plan", json=smallest)
        eventually(lambda: planner.started == 1)
        assert posted(client, GERMAN, SETTINGS).json()["request"] == EXPECTED.request
        planner.go_on.set()
        assert planned.result().status_code == 200


def test_a_workbook_that_unpacks_to_too_much_is_refused(client: httpx.Client) -> None:
    def fill(book: Any) -> None:
        sheet = book.add_worksheet()
        sheet.write(0, 0, "name")
        sheet.write(1_048_575, 16_383, 1)
    reply = posted(client, makes.workbook(fill))
    assert reply.status_code == 422
    assert "workbook" in reply.json()["detail"]


@pytest.mark.thorough
@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
@given(content=st.binary(max_size=400) | st.text(max_size=400).map(lambda text: text.encode())
       | st.lists(st.lists(st.sampled_from(
           ["name", "lat", "lon", "x", "y", "from", "to", "window", "date", "kg", "8:30", "8-10",
            "0800", "8.30", "1e9", "-1", "48.1", "11.5", "999999999999", "1/2/2026 8:00", "NaN",
            "9" * 400, "\u00bd", "12 kg", "24.12.2026", "31.02.2026 8:00", "'", '"', ""]),
           max_size=8), max_size=8).map(lambda rows: "\n".join(map(",".join, rows)).encode()))
def test_no_bytes_are_an_internal_error(client: httpx.Client, content: bytes) -> None:
    reply = posted(client, content, {"leave_out_errors": True})
    assert reply.status_code in (200, 422), reply.text
    if reply.status_code == 200 and reply.json()["request"] is not None:
        plan = reply.json()["request"]
        assert len({customer["id"] for customer in plan["customers"]}) == len(plan["customers"])


@pytest.mark.thorough
@settings(max_examples=10, deadline=None, suppress_health_check=list(HealthCheck))
@given(cut=st.integers(4, 3000), flipped=st.lists(st.integers(4, 3000), max_size=5))
def test_no_damaged_workbook_is_an_internal_error(client: httpx.Client, cut: int,
                                                  flipped: list[int]) -> None:
    content = bytearray(makes.dates())
    for place in flipped:
        content[place % len(content)] ^= 0x55
    damaged = bytes(content[:max(4, len(content) - cut % 200)])
    assert posted(client, damaged).status_code in (200, 422)


def test_the_command_writes_the_same_request(tmp_path: Path) -> None:
    sheet, output = tmp_path / "customers.csv", tmp_path / "request.json"
    mapping = tmp_path / "mapping.json"
    sheet.write_bytes(GERMAN)
    options = ["--depot", "48.14, 11.56", "--vehicles", "3", "--capacity", "1500",
               "--shift", "7-17"]
    done = CliRunner().invoke(cli, ["import", str(sheet), "-o", str(output), *options,
                                    "--save-mapping", str(mapping)])
    assert done.exit_code == 0, done.stderr
    assert json.loads(output.read_bytes()) == EXPECTED.request
    assert "8.30 \u2192 8:30" in done.stderr
    again = CliRunner().invoke(cli, ["import", str(sheet), *options, "--mapping", str(mapping)])
    assert json.loads(again.stdout) == EXPECTED.request


@pytest.mark.parametrize(("rows", "options", "told"), [
    ("A,1,1,noon\nB,2,2,8:00", [], "D2: 'noon' is no time of day"),
    ("A,1,1,8:00", ["--vehicles", "0"], "--vehicles: "),
    ("A,1,1,8:00", ["--depot", "here"], "The depot can't be read"),
    ("A,1,1,8:00", ["--capacity", "many"], "are no numbers"),
    ("", [], "no rows"),
])
def test_the_command_says_what_is_wrong(tmp_path: Path, rows: str, options: list[str],
                                        told: str) -> None:
    sheet = tmp_path / "customers.csv"
    sheet.write_text(f"name,x,y,from\n{rows}\n")
    done = CliRunner().invoke(cli, ["import", str(sheet), *options])
    assert done.exit_code == 2
    assert told in done.stderr
    assert done.stdout == ""
