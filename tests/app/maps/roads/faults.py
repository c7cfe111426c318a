"""A proxy on loopback that stands before a server of roads and does to its answers what it is told.
"""

import asyncio
import http.client
import json
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any
from urllib.parse import urlsplit

import numpy as np
from anyio.from_thread import start_blocking_portal

Fault = Callable[["Reply"], None]
Answer = dict[str, Any]
Fetch = Callable[[str, str, bytes], tuple[int, bytes]]
"""From a method, a path and a body to a status and a body."""


class Reply:
    """What the proxy is about to send, to be spoilt."""

    def __init__(self, status: int, body: bytes) -> None:
        self.status = status
        self.body = body
        self.headers = {"Content-Type": "application/json"}
        self.stated_length: int | None = len(body)
        self.cut_at: int | None = None
        self.delay = 0.0
        self.drip: float | None = None

    def replace(self, body: bytes) -> None:
        """Send another body, as if it were right. In place."""
        self.body, self.stated_length = body, len(body)

    def change(self, change: Callable[[Answer], object]) -> None:
        """Send JSON changed in place, if it is an answer of the kind that can be so changed."""
        try:
            answer = json.loads(self.body)
        except ValueError:
            return
        with suppress(KeyError):
            change(answer)
        self.replace(json.dumps(answer).encode())

    @property
    def head(self) -> bytes:
        """The status and the headers."""
        lines = [f"HTTP/1.1 {self.status} Whatever", *map(": ".join, self.headers.items())]
        if self.stated_length is None:
            lines.append("Connection: close")
        else:
            lines.append(f"Content-Length: {self.stated_length}")
        return "\r\n".join([*lines, "", ""]).encode()


class Proxy:
    """Counts what it is asked, and asks the server behind it once for each different thing."""

    def __init__(self, fetch: Fetch, choose: Callable[[], Fault]) -> None:
        self._fetch = fetch
        self._choose = choose
        self._known: dict[tuple[str, str, bytes], tuple[int, bytes]] = {}
        self.url = ""
        self.questions = 0
        self.fields: dict[str, str] = {}

    async def answer(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Serve one connection."""
        try:
            while await self._exchange(reader, writer):
                pass
        except (ConnectionError, asyncio.IncompleteReadError, asyncio.CancelledError):
            pass
        finally:
            writer.close()
            with suppress(ConnectionError):
                await writer.wait_closed()

    async def _exchange(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> bool:
        head = (await reader.readuntil(b"\r\n\r\n")).decode("latin-1")
        method, path, _ = head.split(" ", 2)
        lines = [line.split(": ", 1) for line in head.split("\r\n")[1:] if line]
        fields = {name.lower(): value for name, value in lines}
        body = await reader.readexactly(int(fields.get("content-length", 0)))
        self.questions += 1
        self.fields = fields
        reply = Reply(*await self._true(method, path, body))
        self._choose()(reply)
        await asyncio.sleep(reply.delay)
        sent = reply.head + reply.body
        if reply.cut_at is not None:
            sent = sent[:reply.cut_at]
        if reply.drip is None:
            writer.write(sent)
            await writer.drain()
        else:
            for byte in sent:
                writer.write(bytes([byte]))
                await writer.drain()
                await asyncio.sleep(reply.drip)
        return reply.cut_at is None and reply.stated_length is not None

    async def _true(self, method: str, path: str, body: bytes) -> tuple[int, bytes]:
        known = self._known.get((method, path, body))
        if known is None:
            known = await asyncio.to_thread(self._fetch, method, path, body)
            self._known[method, path, body] = known
        return known


def fetched(upstream: str, method: str, path: str, body: bytes) -> tuple[int, bytes]:
    """Ask a server."""
    connection = http.client.HTTPConnection(urlsplit(upstream).netloc, timeout=60)
    try:
        connection.request(method, path, body or None, {"Content-Type": "application/json"})
        answer = connection.getresponse()
        return answer.status, answer.read()
    finally:
        connection.close()


@contextmanager
def proxied(upstream: str, choose: Callable[[], Fault]) -> Iterator[Proxy]:
    """Have a proxy before a server meanwhile."""
    with standing_in(partial(fetched, upstream), choose) as proxy:
        yield proxy


@contextmanager
def standing_in(fetch: Fetch, choose: Callable[[], Fault]) -> Iterator[Proxy]:
    """Have something that answers as it is told meanwhile."""
    proxy = Proxy(fetch, choose)
    with start_blocking_portal() as portal:
        server = portal.call(asyncio.start_server, proxy.answer, "127.0.0.1", 0)
        proxy.url = f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}"
        try:
            yield proxy
        finally:
            portal.call(server.close)
            portal.call(_end_connections)


async def _end_connections() -> None:
    own = asyncio.current_task()
    tasks = [task for task in asyncio.all_tasks()
             if task is not own and getattr(task.get_coro(), "__name__", "") == "answer"]
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    # Sockets are closed by what the loop does next.
    await asyncio.sleep(0)


def nothing(reply: Reply) -> None:
    """Let the answer be."""


def status(code: int, **headers: str) -> Fault:
    """Answer with a status."""
    def fault(reply: Reply) -> None:
        reply.status = code
        reply.headers.update({name.replace("_", "-"): value for name, value in headers.items()})
    return fault


def body(text: bytes, **headers: str) -> Fault:
    """Answer with a text."""
    def fault(reply: Reply) -> None:
        reply.replace(text)
        reply.headers.update({name.replace("_", "-"): value for name, value in headers.items()})
    return fault


def cut(share: float) -> Fault:
    """Close the connection after a share of the answer, its head included."""
    def fault(reply: Reply) -> None:
        reply.cut_at = int(share * len(reply.head + reply.body))
    return fault


def cut_unseen(share: float) -> Fault:
    """Send a share of the body as if it were all."""
    def fault(reply: Reply) -> None:
        reply.body, reply.stated_length = reply.body[:int(share * len(reply.body))], None
    return fault


def longer(reply: Reply) -> None:
    """State a longer body than comes, and close."""
    reply.stated_length = len(reply.body) + 10
    reply.cut_at = len(reply.head + reply.body)


def delay(seconds: float) -> Fault:
    """Answer late."""
    def fault(reply: Reply) -> None:
        reply.delay = seconds
    return fault


def drip(seconds: float) -> Fault:
    """Answer byte by byte."""
    def fault(reply: Reply) -> None:
        reply.drip = seconds
    return fault


def changed(change: Callable[[Answer], object]) -> Fault:
    """Change the JSON of the answer in place."""
    return lambda reply: reply.change(change)


def number(text: bytes) -> Fault:
    """Write something else for the first number of the last row."""
    def fault(reply: Reply) -> None:
        head, bracket, tail = reply.body.rpartition(b",[")
        rest = tail[min(tail.find(b","), tail.find(b"]")) if b"," in tail else tail.find(b"]"):]
        reply.replace(head + bracket + text + rest)
    return fault


def compressed(share: float) -> Fault:
    """Compress the body and send a share of that as if it were all."""
    def fault(reply: Reply) -> None:
        packed = zlib.compress(reply.body, wbits=31)
        reply.replace(packed[:int(share * len(packed))])
        reply.headers["Content-Encoding"] = "gzip"
    return fault


def uncompressed(reply: Reply) -> None:
    """State a compression that isn't."""
    reply.headers["Content-Encoding"] = "gzip"


def chosen(faults: list[Fault], rng: np.random.Generator) -> Callable[[], Fault]:
    """Choose among faults at random, each time."""
    return lambda: faults[rng.integers(len(faults))]
