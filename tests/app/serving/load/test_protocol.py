"""Connections: sent at once, and not held for ever by clients that say nothing."""

import logging
import socket
import threading
from collections.abc import Iterator
from typing import Any, NamedTuple

import pytest
import uvicorn

from app.main import create_app
from app.serving.load import protocol
from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner
from tests.conftest import PATIENCE, end, soon

pytestmark = [pytest.mark.by_clock, pytest.mark.slow]

GET = b"GET /health/live HTTP/1.1\r\nHost: localhost\r\n\r\n"


class Listening(NamedTuple):
    """A server, and where it listens."""

    server: uvicorn.Server
    address: tuple[str, int]

    def connections(self) -> list[Any]:
        """Return the connections that it holds."""
        return list(self.server.server_state.connections)


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[Listening]:
    """Return a server with little patience, whose port asyncio doesn't know to be TCP."""
    monkeypatch.setattr(protocol, "HEAD_SECONDS", 0.2)
    app = create_app(Settings(), FirstFitPlanner())
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        listener.listen()
        server = uvicorn.Server(uvicorn.Config(
            app, http=protocol.HttpProtocol, log_level=logging.CRITICAL + 1,
            timeout_keep_alive=1))
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
        address = listener.getsockname()
        thread.start()
        try:
            soon(lambda: server.started)
            yield Listening(server, address)
        finally:
            server.should_exit = True
            end(thread)


def connect(server: Listening) -> socket.socket:
    """Open a connection."""
    return socket.create_connection(server.address, timeout=PATIENCE)


def read_to_end(connection: socket.socket) -> bytes:
    """Return what comes until the service closes the connection."""
    content = b""
    try:
        while chunk := connection.recv(1000):
            content += chunk
    except ConnectionResetError:
        pass
    return content


def test_replies_are_sent_at_once(server: Listening) -> None:
    with connect(server) as connection:
        connection.sendall(GET)
        assert connection.recv(1000).startswith(b"HTTP/1.1 200")
        (held,) = server.connections()
        there = held.transport.get_extra_info("socket")
        assert there.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY) != 0


@pytest.mark.parametrize("said", [b"", b"GET /health/live HTT", GET + b"GET /hea"])
def test_unfinished_heads_are_given_up(server: Listening, said: bytes) -> None:
    with connect(server) as connection:
        connection.sendall(said)
        reply = read_to_end(connection)
    assert reply.count(b"HTTP/1.1 200") == said.count(GET)
    soon(lambda: not server.connections())


def test_heads_that_drip_are_given_up(server: Listening) -> None:
    with connect(server) as connection:
        connection.settimeout(0.02)
        sent = 0
        while True:
            try:
                connection.sendall(b"G")
                sent += 1
                if connection.recv(1000) == b"":
                    break
            except TimeoutError:
                continue
            except OSError:
                break
    assert 1 <= sent < 100


def test_body_that_follows_a_refusal_is_not_read_for_ever(server: Listening) -> None:
    with connect(server) as connection:
        connection.sendall(b"POST /plan HTTP/1.1\r\nHost: localhost\r\n"
                           b"Content-Length: 999999999\r\n\r\n")
        assert connection.recv(1000).startswith(b"HTTP/1.1 413")
        connection.sendall(b" ")
        read_to_end(connection)


def test_requests_in_progress_are_waited_for(server: Listening) -> None:
    body = b"{}"
    head = b"POST /plan HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\n"
    with connect(server) as connection:
        connection.sendall(head + body[:1])
        connection.settimeout(0.5)
        with pytest.raises(TimeoutError):
            connection.recv(1000)
        connection.settimeout(PATIENCE)
        connection.sendall(body[1:])
        assert connection.recv(1000).startswith(b"HTTP/1.1 422")
