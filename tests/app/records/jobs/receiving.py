"""Receivers of webhooks that behave badly."""

import socket
import threading
from collections.abc import Callable
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, HTTPServer


class Receiver:
    """Takes a connection, says something, and goes on as it likes."""

    def __init__(self, say: Callable[[socket.socket, threading.Event], None]) -> None:
        self._say = say
        self._is_over = threading.Event()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        self.num_calls = 0
        self._thread = threading.Thread(target=self._serve)

    def __enter__(self) -> "Receiver":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._is_over.set()
        with suppress(OSError):
            socket.create_connection(("127.0.0.1", self.port)).close()
        self._thread.join()
        self._listener.close()

    def _serve(self) -> None:
        while not self._is_over.is_set():
            connection, _ = self._listener.accept()
            with connection, suppress(OSError):
                if not self._is_over.is_set():
                    connection.recv(65536)
                    self.num_calls += 1
                    self._say(connection, self._is_over)


def drip(connection: socket.socket, is_over: threading.Event) -> None:
    """Send a byte now and then, each of them in time."""
    connection.sendall(b"HTTP/1.1 200 OK\r\nX-Slow: ")
    while not is_over.wait(0.02):
        connection.sendall(b"x")


class FailingReceiver:
    """A webhook's receiver, which fails as often as told."""

    def __init__(self, failures: int) -> None:
        self.calls: list[tuple[dict[str, str], bytes]] = []
        receiver = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                body = self.rfile.read(int(self.headers["content-length"]))
                receiver.calls.append((dict(self.headers), body))
                self.send_response(500 if len(receiver.calls) <= failures else 204)
                self.end_headers()

            def log_message(self, *arguments: object) -> None:
                """Say nothing."""

        self._server = HTTPServer(("127.0.0.1", 0), Handler)
        self._thread = threading.Thread(target=self._server.serve_forever)
        self._thread.start()
        self.url = f"http://localhost:{self._server.server_port}/hook"

    def close(self) -> None:
        """Receive no more."""
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()
