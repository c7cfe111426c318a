"""How long do many clients wait who list jobs at once? `python -m benchmarks.load.listing`.

Each has a connection of its own and asks again as soon as it is answered. They are plain sockets:
of 200 tasks that share a client of httpx, some wait seconds for its pool, whatever is asked for.
Fails if one request of a hundred takes longer than `--bound`.
"""

import asyncio
import json
import re
import tempfile
import time
from pathlib import Path
from typing import Annotated
from urllib.parse import urlsplit

import numpy as np
import typer

from benchmarks.fuzz.api import Target, service
from benchmarks.fuzz.problems import client_of
from benchmarks.load.leavers import spent

SMALLEST = Path(__file__).parents[2] / "app" / "schemas" / "examples" / "smallest.json"

LENGTH = re.compile(rb"content-length: (\d+)", re.IGNORECASE)


def submit(target: Target, number: int) -> None:
    """Have so many jobs done."""
    request = json.loads(SMALLEST.read_text()) | {"options": {"time_limit": 0}}
    with client_of(target) as client:
        for _ in range(number):
            client.post("/jobs", json=request).raise_for_status()
        while client.get("/jobs", params={"state": "queued"}).json()["jobs"]:
            time.sleep(1.0)


async def listed(target: Target, end: float) -> list[float]:
    """Ask again and again until `end`, of the monotonic clock; return how long replies took."""
    address = urlsplit(target.url)
    asked = (f"GET /jobs HTTP/1.1\r\nHost: {address.netloc}\r\n"
             f"Authorization: Bearer {target.key}\r\n\r\n").encode()
    reader, writer = await asyncio.open_connection(address.hostname, address.port)
    taken = []
    while (began := time.monotonic()) < end:
        writer.write(asked)
        head = await reader.readuntil(b"\r\n\r\n")
        length = LENGTH.search(head)
        if not head.startswith(b"HTTP/1.1 200") or length is None:
            raise RuntimeError(head.decode())
        await reader.readexactly(int(length[1]))
        taken.append(time.monotonic() - began)
    writer.close()
    return taken


async def together(target: Target, clients: int, seconds: float) -> list[float]:
    """Have so many clients ask; return how long all replies took."""
    end = time.monotonic() + seconds
    found = await asyncio.gather(*(listed(target, end) for _ in range(clients)))
    return [each for taken in found for each in taken]


def main(
    clients: Annotated[int, typer.Option(help="Who ask at once.")] = 200,
    jobs: Annotated[int, typer.Option(help="There to be listed.")] = 60,
    seconds: Annotated[float, typer.Option(help="How long to ask.")] = 15.0,
    bound: Annotated[float, typer.Option(help="Seconds for 99 of 100 requests.")] = 5.0,
) -> None:
    """Tell how long clients wait who list jobs."""
    with tempfile.TemporaryDirectory() as folder, service(Path(folder)) as target:
        submit(target, jobs)
        before = spent(target.process.pid)
        taken = asyncio.run(together(target, clients, seconds))
        each = (spent(target.process.pid) - before) / len(taken)
    half, most = np.percentile(taken, (50, 99))
    typer.echo(f"{len(taken)} replies, median {half:.2f} s, 99 % {most:.2f} s, longest "
               f"{max(taken):.2f} s, {1000 * each:.2f} ms of processor time each")
    raise typer.Exit(1 if most > bound else 0)


if __name__ == "__main__":
    typer.run(main)
