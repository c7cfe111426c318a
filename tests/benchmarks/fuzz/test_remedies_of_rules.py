"""Remedies of breaks, rests, shipments, orders and other places, done by their changes, and as the
console does them."""

import json
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import IO, Any

import httpx
import pytest

from benchmarks.fuzz.api import ROOT
from examples.remedy import applied
from tests.app.plans.asking import planned

pytestmark = pytest.mark.slow

Request = dict[str, Any]

NOON = {"id": "lunch", "duration": 1800, "start": {"earliest": 0, "latest": 60}}
PICKUP = {"location": [6, 0]}


APPLY = """
import { createInterface } from 'node:readline';
const { applied } = await import(process.argv[1]);
for await (const line of createInterface({ input: process.stdin })) {
  console.log(JSON.stringify(applied(...JSON.parse(line))));
}"""


@dataclass(frozen=True)
class Console:
    """The part of the console that applies remedies."""

    to: IO[str]
    out: IO[str]

    def applied(self, request: Request, changes: list[Request]) -> Request:
        """Return a request as a remedy changes it."""
        self.to.write(json.dumps([request, changes]) + "\n")
        self.to.flush()
        changed: Request = json.loads(self.out.readline())
        return changed


@contextmanager
def console() -> Iterator[Console]:
    """Run that part until the block ends."""
    module = ROOT / "app" / "console" / "static" / "js" / "core" / "remedies.js"
    command = ["node", "--input-type=module", "-e", APPLY, module.as_uri()]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          text=True) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            yield Console(process.stdin, process.stdout)
        finally:
            process.stdin.close()


@pytest.fixture(scope="module")
def understood() -> Iterator[Console]:
    with console() as there:
        yield there


def request_of(van: Request, **parts: Any) -> Request:
    """Return a day of one van that drives a kilometre a minute."""
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}], "customers": [],
            "fleet": [{"id": "van", "count": 1, "capacity": [5], "speed_kmh": 60, **van}],
            "options": {"time_limit": 60, "search_iterations": 200}, **parts}


def customer(**parts: Any) -> list[Request]:
    return [{"id": "A", "location": [6, 0], "demand": [1], **parts}]


def shipment(**parts: Any) -> list[Request]:
    return [{"id": "A", "amount": [1], "pickup": PICKUP, "delivery": {"location": [6, 8]}, **parts}]


@pytest.mark.parametrize(("van", "parts", "code", "remedy"), [
    ({}, {"shipments": shipment(amount=[9])}, "CAPACITY", "fits if capacity were at least 9"),
    ({}, {"shipments": shipment(skills=["lift"])}, "SKILLS", "fits if van had lift"),
    ({}, {"shipments": shipment(pickup=PICKUP | {"time_window": {"latest": 300}})}, "TIME_WINDOW",
     "fits if the window of its pickup closed 1 minute later"),
    ({}, {"shipments": shipment(delivery={"location": [6, 8], "time_windows": [
        {"latest": 60}, {"earliest": 120, "latest": 720}]})}, "TIME_WINDOW",
     "fits if the last window of its delivery closed 2 minutes later"),
    ({"shift": {"earliest": 600}}, {"shipments": shipment(
        pickup=PICKUP | {"time_window": {"latest": 900}},
        delivery={"location": [6, 8], "time_window": {"latest": 1200}})}, "TIME_WINDOW",
     "fits if the window of its pickup closed 1 minute later and the window of its delivery closed "
     "4 minutes later"),
    ({}, {"shipments": shipment(max_time_between=450)}, "TIME_BETWEEN",
     "fits if max_time_between were at least 8 minutes"),
    ({"speed_profile": [{"from": 0, "speed_kmh": 30}]},
     {"shipments": shipment(max_detour=1.5, max_time_between=900)}, "TIME_BETWEEN",
     "fits if max_time_between were at least 16 minutes and max_detour were at least 2"),
    ({"max_stops": 1}, {"shipments": shipment()}, "STOPS", "fits if van could make 2 stops"),
    ({"shift": {"latest": 1200}}, {"shipments": shipment()}, "SHIFT",
     "fits if van's shift ended 4 minutes later"),
    ({}, {"shipments": shipment(unassigned_cost=3)}, "COST",
     "served if its unassigned_cost were above 24.00"),
    ({"breaks": [NOON]}, {"shipments": shipment(pickup=PICKUP | {"time_window": {"latest": 900}})},
     "TIME_WINDOW", "fits if break lunch could begin 5 minutes later"),
    ({"breaks": [NOON]}, {"customers": customer(time_window={"latest": 900})}, "TIME_WINDOW",
     "fits if break lunch could begin 5 minutes later"),
    ({"breaks": [{"id": "tea", "duration": 60, "start": {"earliest": 600, "latest": 700},
                  "max_load": [0]}]},
     {"customers": customer(time_window={"earliest": 720, "latest": 800})}, "BREAK",
     "fits if break tea allowed 1 aboard"),
    ({"breaks": [NOON]}, {"customers": customer(service_duration=3600, time_window={
        "latest": 360})}, "TIME_WINDOW", "fits if break lunch could begin 65 minutes later"),
    ({"driving_rules": {"max_driving": 240, "break_duration": 600}},
     {"customers": customer(time_window={"latest": 600})}, "TIME_WINDOW",
     "fits if van's drivers could drive 12 minutes without a rest"),
    ({"driving_rules": {"max_work_before_break": 240, "break_duration": 600}},
     {"customers": customer(time_window={"latest": 600})}, "TIME_WINDOW",
     "fits if van's drivers could work 12 minutes without a rest"),
    ({"shift": {"latest": 600}}, {"customers": customer(time_window={"latest": 60}, alternatives=[
        {"id": "kiosk", "location": [2, 0], "time_window": {"latest": 60}}])}, "TIME_WINDOW",
     "fits if its window at A/kiosk closed 1 minute later"),
    ({"count": 2, "capacity": [1]}, {"relations": [{"kind": "together", "customers": ["A", "B"]}],
      "customers": [*customer(), {"id": "B", "location": [0, 1], "demand": [1]}]}, "RELATION",
     "fits without its relations"),
])
def test_what_is_offered_has_it_served(
        client: httpx.Client, understood: Console, van: Request, parts: Request, code: str,
        remedy: str) -> None:
    request = request_of(van, **parts)
    left, = planned(client, request)["unassigned"]
    reason, = left["reasons"]
    offered = {each["text"]: each["changes"] for each in reason["remedies"]}
    assert (reason["code"], remedy) == (code, remedy if remedy in offered else offered)
    for changes in offered.values():
        changed = applied(request, changes)
        assert understood.applied(request, changes) == changed
        assert planned(client, changed)["unassigned"] == [], changes
