"""Nonsense for every route of the API's description, and what it takes to refuse it.

Run as a program, it sends all kinds to a service of its own, or every `n`-th if told so, and prints
as JSON what each took.
"""

import json
import os
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import httpx

from app.main import create_app
from app.serving.settings import Settings
from tests.app.records.dispatches.days import dispatched, holding, token_of
from tests.app.serving.observe.server import Server, running

SIZE = 32 * 2**20 - 2**16

HELD_UP, PROCESSOR, TRIES = 1.0, 1.0, 5
"""Seconds for which a process may keep its health from being told, and that it may work; and how
often it is tried whether that was by what was sent."""

EVERY = 0.02
"""Seconds between two looks, which count as the service's work too; it is held up for longer."""

Data = dict[str, Any]


@dataclass(frozen=True)
class Taken:
    """What a request took."""

    route: str
    kind: str
    status: int
    seconds: float
    processor: float  # seconds that the service worked, all that it did meanwhile
    grown: int  # bytes, while it was answered
    health: float  # seconds of the slowest look at its health, but for waiting for a processor


def repeated(begin: bytes, unit: bytes, end: bytes) -> Callable[[int], bytes]:
    """Return what makes a body of a size."""
    return lambda size: begin + unit * ((size - len(begin) - len(end)) // len(unit)) + end


def different_keys(size: int) -> bytes:
    """Return an object whose keys all differ."""
    return b"{" + b",".join(b'"k%08d":0' % number for number in range(size // 14)) + b"}"


def whole(schema: Data, fields: Data) -> Data:
    """Return a value that a schema would take for a body but for what a field holds."""
    known: Data = {name: [] if "array" in str(inner.get("type")) else {}
             for name, inner in schema.get("properties", {}).items()
             if name in schema.get("required", ())}
    return known | fields


KINDS: dict[str, Callable[[int], bytes]] = {
    "unknown keys": different_keys,
    "an unknown key again and again": repeated(b"{", b'"a":0,', b'"b":0}'),
    "unknown objects": repeated(b"{", b'"a":{"b":[{}]},', b'"b":0}'),
    "lists in lists": repeated(b"", b"[", b""),
    "objects in objects": repeated(b"", b'{"a":', b""),
    "closed lists in lists": lambda size: b"[" * (size // 2) + b"]" * (size // 2),
    "numbers": repeated(b"[", b"0,", b"0]"),
    "fractions": repeated(b"[", b"0.12345,", b"0]"),
    "objects": repeated(b"[", b"{},", b"0]"),
    "objects with a field": repeated(b"[", b'{"id":"a"},', b"0]"),
    "texts": repeated(b"[", b'"abc",', b"0]"),
    "a long text": repeated(b'"', b"a", b'"'),
    "a long escaped text": repeated(b'{"a":"', b"\\u00e4", b'"}'),
    "a long key": repeated(b'{"', b"a", b'":0}'),
    "a long number": repeated(b'{"a":', b"1", b"}"),
    "blanks": repeated(b"", b" ", b'{"a":0}'),
    "no text": repeated(b"", b"\xff\x00\x01", b""),
    "no JSON": repeated(b"", b"a;b;c\n", b""),
    "a form": repeated(b"", b"a=b&", b""),
    "parts": repeated(b"", b'--x\r\nContent-Disposition: form-data; name="a"\r\n\r\nb\r\n',
                      b"--x--\r\n"),
    "broken at its end": repeated(b'{"a":[', b'{"id":"a","n":[1,2.5]},', b"0]"),
    "broken numbers": repeated(b'{"a":[', b"1234,", b"0,]}"),
    "followed by more": repeated(b"{", b'"a":0,', b'"b":0} x'),
}

TYPES = {"a form": "application/x-www-form-urlencoded", "parts": "multipart/form-data; boundary=x",
         "no JSON": "text/csv", "no text": "application/octet-stream"}

UNITS: dict[str, tuple[bytes, bytes, bytes]] = {
    "numbers": (b"[", b"0,", b"0]"), "objects": (b"[", b"{},", b"{}]"),
    "lists": (b"[", b"[],", b"0]"), "texts": (b"[", b'"a",', b'"a"]'),
    "keys": (b"{", b'"a":0,', b'"b":0}'), "a text": (b'"', b"a", b'"'),
    "depth": (b"", b'[{"a":', b""), "numbers without end": (b"[", b"0.25,", b""),
}


def in_fields(schema: Data) -> Iterator[tuple[str, Callable[[int], bytes]]]:
    """Yield nonsense that stands in a field that a body may have, of other kinds in each."""
    for place, name in enumerate(schema.get("properties", {})):
        for kind, (begin, unit, end) in list(UNITS.items())[place % 4::4]:
            others = whole(schema, {})
            others.pop(name, None)
            head = json.dumps(others)[:-1].encode() + (b"," if others else b"")
            yield f"{kind} in {name}", repeated(
                head + b'"' + name.encode() + b'":' + begin, unit, end + b"}")


class Watch:
    """Looks at a process's health and memory while others ask it for something."""

    def __init__(self, server: Server) -> None:
        self._server = server
        self._process = Path(f"/proc/{server.process.pid}")
        self._slowest = 0.0
        self._done = threading.Event()
        self._thread = threading.Thread(target=self._look, daemon=True)
        self._thread.start()

    def _look(self) -> None:
        with httpx.Client(base_url=self._server.client.base_url, timeout=60,
                          trust_env=False) as client:
            while not self._done.is_set():
                began, waited = time.perf_counter(), self._waited()
                client.get("/health/live")
                took, others = time.perf_counter() - began, self._waited() - waited
                self._slowest = max(self._slowest, took - others)
                self._done.wait(EVERY)

    def _waited(self) -> float:
        """Return the seconds that both processes' threads waited while others had the processor."""
        waited = 0
        for process in (self._process, Path("/proc/self")):
            for thread in process.glob("task/*/schedstat"):
                with suppress(OSError, IndexError):  # that has ended
                    waited += int(thread.read_text().split()[1])
        return waited / 1e9

    def begin(self) -> tuple[int, float]:
        """Forget what was; return the bytes of memory in use and the seconds worked so far."""
        self._slowest = 0.0
        (self._process / "clear_refs").write_text("5")
        return self._memory("VmRSS"), self._worked()

    def end(self, before: tuple[int, float]) -> tuple[float, int, float]:
        """Return the seconds worked, the bytes grown, and how long the slowest look took."""
        return self._worked() - before[1], self._memory("VmHWM") - before[0], self._slowest

    def stop(self) -> None:
        """Look no more."""
        self._done.set()
        self._thread.join()

    def _memory(self, field: str) -> int:
        told = (self._process / "status").read_text()
        return 1024 * int(told.split(f"{field}:")[1].split()[0])

    def _worked(self) -> float:
        fields = (self._process / "stat").read_text().rpartition(")")[2].split()
        return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


@dataclass(frozen=True)
class Route:
    """A route of the description, with what its path names put in."""

    method: str
    path: str
    schema: Data  # of its body; empty: it takes none in JSON
    headers: dict[str, str]


def routes(server: Server, description: Data) -> Iterator[Route]:
    """Yield every route that takes a body, for things that are there."""
    sent = dispatched(server.client)
    link = sent["links"][0]
    job = server.client.post("/jobs", json=example()).json()["id"]
    day = server.client.post("/days", json={"problem": example()}).json()["id"]
    there = {"job_id": job, "dispatch_id": sent["id"], "plan_id": "mine", "link_id": link["id"],
             "day_id": day, "token": "none"}
    schemas = description["components"]["schemas"]
    for path, operations in description["paths"].items():
        for method, operation in operations.items():
            if "requestBody" not in operation:
                continue
            content = operation["requestBody"]["content"]
            named = content.get("application/json", {}).get("schema", {}).get("$ref", "")
            headers = holding(token_of(link)) if path.startswith("/drive/") else {}
            yield Route(method.upper(), path.format(**there),
                        schemas.get(named.rpartition("/")[2], {}), headers)


def example() -> Data:
    """Return a small request that is right."""
    return {"depots": [{"id": "d", "location": [0, 0]}],
            "customers": [{"id": "a", "location": [1, 1], "demand": [1]}],
            "fleet": [{"id": "t", "count": 1, "capacity": [1]}]}


def takings(server: Server, size: int = SIZE, each: int = 1) -> Iterator[Taken]:
    """Yield what nonsense takes at each route that takes a body.

    Of its kinds every `each`-th is sent, others at each route.
    """
    description = create_app(Settings()).openapi()
    watch = Watch(server)
    for number, route in enumerate(routes(server, description)):
        kinds = list((KINDS | dict(in_fields(route.schema))).items())
        for kind, body_of in kinds[number % len(kinds)::each]:
            yield _tried(server, watch, route, kind, body_of(size))
    watch.stop()


def _tried(server: Server, watch: Watch, route: Route, kind: str, body: bytes) -> Taken:
    for _ in range(TRIES):
        taken = _taken(server, watch, route, kind, body)
        if taken.health < HELD_UP and taken.processor < PROCESSOR:
            break
    return taken


def _taken(server: Server, watch: Watch, route: Route, kind: str, body: bytes) -> Taken:
    headers = {"Content-Type": TYPES.get(kind, "application/json"), **route.headers}
    before, began = watch.begin(), time.perf_counter()
    with httpx.Client(base_url=server.client.base_url, timeout=120, trust_env=False) as client:
        try:
            with client.stream(route.method, route.path, content=body, headers=headers) as reply:
                status = reply.status_code
        except httpx.TransportError:
            status = 0  # hung up before all was sent
    seconds = time.perf_counter() - began
    return Taken(f"{route.method} {route.path}", kind, status, seconds, *watch.end(before))


def main(each: int) -> None:
    """Print what every `each`-th kind takes at each route."""
    with tempfile.TemporaryDirectory() as folder, running(
            TANDEM_DATA_DIR=folder, TANDEM_DRIVER_REQUESTS_PER_MINUTE="0",
            TANDEM_LOG_LEVEL="error") as server:
        for taken in takings(server, each=each):
            print(json.dumps(asdict(taken)), flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1)
