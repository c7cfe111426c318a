"""What the service does under load, asked from another process over loopback.

Plans per second; requests at three times that rate; wrong keys; whether the time that a refusal
takes tells how much of a key was right. `--quick` takes half a minute instead of three.
"""

import asyncio
import json
import os
import random
import secrets
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Awaitable, Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import httpx
import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from app.schemas.limits import DEFAULT_POLICY

EXAMPLE = Path(__file__).parents[2] / "examples" / "table1.json"

OVERLOAD = 3
"""Requests in the overload, as a multiple of the capacity measured."""

PATIENCE = 10.0
"""Seconds after which a request counts as hung."""

WRONG_KEYS = 1000
"""Wrong keys a second."""

RIGHT_DIGITS = (0, 1, 16, 32, 48, 63)
"""How many of the 64 digits of a secret are right."""


@dataclass(frozen=True)
class Service:
    """A service that runs."""

    port: int
    pid: int
    key: str

    def memory(self) -> float:
        """Return the resident memory of all its processes in MB."""
        pages = (Path(f"/proc/{pid}/statm").read_text().split()[1] for pid in self._processes())
        return sum(map(int, pages)) * os.sysconf("SC_PAGE_SIZE") / 1e6

    def processor_seconds(self) -> float:
        """Return the processor time that all its processes have used."""
        ticks = 0
        for pid in self._processes():
            values = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
            ticks += int(values[11]) + int(values[12])
        return ticks / os.sysconf("SC_CLK_TCK")

    def _processes(self) -> list[int]:
        children = Path(f"/proc/{self.pid}/task/{self.pid}/children").read_text().split()
        return [self.pid, *map(int, children)]


@dataclass
class Tally:
    """Replies by status, and how long they took."""

    seconds: dict[int, list[float]] = field(default_factory=dict)

    def note(self, status: int, seconds: float) -> None:
        """Note a reply; status 0 stands for none. In place."""
        self.seconds.setdefault(status, []).append(seconds)

    def count(self, status: int) -> int:
        """Return how many replies had a status."""
        return len(self.seconds.get(status, ()))

    def quantile(self, status: int, share: float) -> float:
        """Return a quantile of the times of a status in milliseconds."""
        return 1000 * float(np.quantile(self.seconds.get(status, [float("nan")]), share))


class Client:
    """Sends the same request again and again, over connections that it keeps."""

    def __init__(self, port: int) -> None:
        self._port = port
        self._idle: list[tuple[asyncio.StreamReader, asyncio.StreamWriter]] = []

    async def ask(self, request: bytes) -> int:
        """Return the status of the reply."""
        reader, writer = await self._connection()
        try:
            writer.write(request)
            head = (await reader.readuntil(b"\r\n\r\n")).lower()
            length = next(int(line[15:]) for line in head.split(b"\r\n")
                          if line.startswith(b"content-length:"))
            await reader.readexactly(length)
        except BaseException:
            writer.close()
            raise
        if b"connection: close" in head:
            writer.close()
        else:
            self._idle.append((reader, writer))
        return int(head[9:12])

    async def time(self, request: bytes, tally: Tally) -> None:
        """Ask, and note how that went. In place."""
        began = time.perf_counter()
        status = 0
        try:
            async with asyncio.timeout(PATIENCE):
                status = await self.ask(request)
        except (TimeoutError, OSError, asyncio.IncompleteReadError):
            pass
        tally.note(status, time.perf_counter() - began)

    async def _connection(self) -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
        while self._idle:
            reader, writer = self._idle.pop()
            if not reader.at_eof():
                return reader, writer
            writer.close()
        return await asyncio.open_connection("127.0.0.1", self._port)

    def close(self) -> None:
        """Close all connections. In place."""
        for _, writer in self._idle:
            writer.close()


def encoded(body: bytes, key: str) -> bytes:
    """Return a request of POST /plan as it goes over the wire."""
    return (f"POST /plan HTTP/1.1\r\nHost: 127.0.0.1\r\nX-API-Key: {key}\r\n"
            f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
            ).encode() + body


@contextmanager
def running(workers: int) -> Iterator[Service]:
    """Run the service, with keys, until the block ends."""
    with socket.socket() as probe, tempfile.TemporaryDirectory() as folder:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
        probe.close()
        environment = {**os.environ, "TANDEM_ACCESS": "keys", "TANDEM_DATA_DIR": folder,
                       "TANDEM_ROLE": "api", "TANDEM_WRONG_KEYS_PER_MINUTE": "0",
                       "TANDEM_LOG_LEVEL": "warning"}
        command = [sys.executable, "-m", "app.cli"]
        key = subprocess.run([*command, "keys", "create", "load", "--scope", "plan"], text=True,
                             env=environment, check=True, stdout=subprocess.PIPE).stdout.strip()
        process = subprocess.Popen(
            [*command, "serve", "--port", str(port), "--workers", str(workers)], env=environment)
        try:
            _await_ready(process, port, workers)
            yield Service(port, process.pid, key)
        finally:
            process.terminate()
            process.wait()


def _await_ready(process: subprocess.Popen[bytes], port: int, workers: int) -> None:
    """Wait until each of the processes that share the port is ready."""
    in_a_row = 0
    while in_a_row < 20 * workers:
        if process.poll() is not None:
            raise RuntimeError("the service did not start")
        try:
            # Without a connection that is kept, any of the processes may answer.
            ready = httpx.get(f"http://127.0.0.1:{port}/health/ready").status_code == 200
        except httpx.TransportError:
            ready = False
        in_a_row = in_a_row + 1 if ready else 0
        if not ready:
            time.sleep(0.1)


def latency(service: Service, request: bytes, count: int = 40) -> Tally:
    """Ask one after another."""
    async def ask() -> Tally:
        tally, client = Tally(), Client(service.port)
        for _ in range(count):
            await client.time(request, tally)
        client.close()
        return tally

    return asyncio.run(ask())


def capacity(service: Service, request: bytes, seconds: float, clients: int) -> float:
    """Return how many plans a second come back to clients that ask as fast as they are answered."""
    tally = Tally()
    deadline = time.perf_counter() + seconds

    async def ask() -> None:
        client = Client(service.port)
        while time.perf_counter() < deadline:
            await client.time(request, tally)
        client.close()

    async def ask_all() -> None:
        await asyncio.gather(*(ask() for _ in range(clients)))

    asyncio.run(ask_all())
    if set(tally.seconds) - {200, 503}:
        raise RuntimeError(f"replies with status {sorted(tally.seconds)}")
    return tally.count(200) / seconds


def open_loop(service: Service, requests: Callable[[], bytes], rate: float,
              seconds: float) -> Tally:
    """Send requests at a rate, whether or not replies come."""
    tally = Tally()

    async def send() -> None:
        client = Client(service.port)
        began = time.perf_counter()
        tasks: list[Awaitable[None]] = []
        for number in range(int(rate * seconds)):
            wait = began + number / rate - time.perf_counter()
            if wait > 0:
                await asyncio.sleep(wait)
            tasks.append(asyncio.create_task(client.time(requests(), tally)))
        await asyncio.gather(*tasks)
        client.close()

    asyncio.run(send())
    return tally


def wrong_keys(key: str) -> dict[str, str]:
    """Return keys that are wrong in different ways, by what is right of them."""
    prefix, key_id, secret = key.split("_")
    wrong = {f"{right} of 64 digits": f"{prefix}_{key_id}_{secret[:right]}" + "".join(
        "1" if digit == "0" else "0" for digit in secret[right:]) for right in RIGHT_DIGITS}
    unknown = f"{prefix}_{secrets.token_hex(6)}_{secret}"
    return {**wrong, "another id": unknown, "no key at all": "x" * len(key)}


def refusal_times(service: Service, count: int) -> dict[str, float]:
    """Return the median time in µs that refusals take, by what is right of a key."""
    requests = {name: encoded(b"{}", key) for name, key in wrong_keys(service.key).items()}
    order = [name for name in requests for _ in range(count)]
    random.Random(0).shuffle(order)
    tallies = {name: Tally() for name in requests}

    async def ask() -> None:
        client = Client(service.port)
        for name in order:
            await client.time(requests[name], tallies[name])
        client.close()

    asyncio.run(ask())
    return {name: 1000 * tally.quantile(401, 0.5) for name, tally in tallies.items()}


def show(title: str, rows: Sequence[tuple[str, str]]) -> None:
    """Print a table of two columns."""
    table = Table(title=title, show_header=False)
    for row in rows:
        table.add_row(*row)
    Console().print(table)


def study_overload(service: Service, request: bytes, seconds: float, clients: int) -> None:
    """Measure the capacity, then ask for more."""
    used = service.processor_seconds()
    plans = capacity(service, request, max(3.0, seconds / 6), clients)
    used = (service.processor_seconds() - used) / (plans * max(3.0, seconds / 6))
    before, memory = latency(service, request), service.memory()
    tally = open_loop(service, lambda: request, OVERLOAD * plans, seconds)
    time.sleep(1)
    after, memory_after = latency(service, request), service.memory()
    sent = sum(map(len, tally.seconds.values()))
    show("100 customers, greedy, time_limit 0", [
        ("plans a second", f"{plans:.1f}"),
        ("processor time of a plan", f"{1000 * used:.1f} ms"),
        ("one after another before, median / 95 %",
         f"{before.quantile(200, 0.5):.1f} / {before.quantile(200, 0.95):.1f} ms"),
        (f"sent in {seconds:.0f} s", f"{sent} ({OVERLOAD * plans:.0f}/s)"),
        ("planned", f"{tally.count(200)} ({tally.count(200) / seconds:.1f}/s)"),
        ("planned, median / 99 %",
         f"{tally.quantile(200, 0.5):.0f} / {tally.quantile(200, 0.99):.0f} ms"),
        ("refused with 503", str(tally.count(503))),
        ("refused, median / 99 %",
         f"{tally.quantile(503, 0.5):.1f} / {tally.quantile(503, 0.99):.1f} ms"),
        ("anything else, hung included", str(sent - tally.count(200) - tally.count(503))),
        ("one after another after, median / 95 %",
         f"{after.quantile(200, 0.5):.1f} / {after.quantile(200, 0.95):.1f} ms"),
        ("memory before / after", f"{memory:.0f} / {memory_after:.0f} MB"),
    ])


def study_keys(service: Service, seconds: float, count: int) -> None:
    """Send wrong keys, many and of all kinds."""
    used = service.processor_seconds()
    tally = open_loop(service, lambda: encoded(b"{}", f"tdm_{secrets.token_hex(6)}_"
                                               f"{secrets.token_hex(32)}"), WRONG_KEYS, seconds)
    used = service.processor_seconds() - used
    show(f"{WRONG_KEYS} wrong keys a second for {seconds:.0f} s", [
        ("refused with 401", str(tally.count(401))),
        ("anything else", str(sum(map(len, tally.seconds.values())) - tally.count(401))),
        ("median / 99 %", f"{tally.quantile(401, 0.5):.1f} / {tally.quantile(401, 0.99):.1f} ms"),
        ("processor time of a refusal", f"{1000 * used / max(1, tally.count(401)):.2f} ms"),
    ])
    times = refusal_times(service, count)
    spread = max(times.values()) - min(times.values())
    show(f"Time of a refusal by what is right of the key, median of {count}", [
        *((name, f"{value:.1f} µs") for name, value in times.items()),
        ("largest less smallest", f"{spread:.1f} µs"),
        ("standard deviation", f"{statistics.pstdev(times.values()):.1f} µs"),
    ])


def main(workers: Annotated[int, typer.Option(help="processes of the service")] = 2,
         seconds: Annotated[float, typer.Option(help="how long to overload it")] = 60.0,
         quick: Annotated[bool, typer.Option("--quick", help="ten seconds of each")] = False,
         policy: str = DEFAULT_POLICY) -> None:
    """Print what the service does under load."""
    request = json.loads(EXAMPLE.read_text()) | {"options": {"policy": policy, "time_limit": 0}}
    seconds = 10.0 if quick else seconds
    with running(workers) as service:
        # Twice as many clients as processes keep all of them busy, and none in the queue for long.
        study_overload(service, encoded(json.dumps(request).encode(), service.key), seconds,
                       2 * workers)
        study_keys(service, seconds / 4, 300 if quick else 2000)


if __name__ == "__main__":
    typer.run(main)
