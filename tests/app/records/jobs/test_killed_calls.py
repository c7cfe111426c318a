"""A webhook whose call is under way as the service is killed."""

from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Event, Thread

import pytest

from tests.app.records.jobs.served import Served
from tests.app.records.jobs.stepping import request_of
from tests.conftest import PATIENCE, eventually

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

SECRET = "whsec_MDEyMzQ1Njc4OTAxMjM0NTY3ODkwMTIzNDU2Nzg5MDE="

Call = tuple[str | None, bytes]


@contextmanager
def receiver(answers: Event) -> Iterator[tuple[int, list[Call]]]:
    """Yield the port of who takes calls, and those taken; answers come when they are to."""
    taken: list[Call] = []

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["content-length"]))
            taken.append((self.headers["webhook-id"], body))
            answers.wait(PATIENCE)
            self.send_response(204)
            self.end_headers()

        def log_message(self, *_: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    thread = Thread(target=server.serve_forever)
    thread.start()
    yield server.server_port, taken
    answers.set()
    server.shutdown()
    thread.join()
    server.server_close()


def test_call_cut_off_by_a_kill_comes_again_with_the_same_id_and_body(tmp_path: Path) -> None:
    answers = Event()
    process = Served(tmp_path / "log", data_dir=tmp_path, drain_seconds=0, webhook_secret=SECRET)
    with receiver(answers) as (port, taken):
        try:
            process.start()
            reply = process.client.post(f"/jobs?webhook=http://127.0.0.1:{port}/",
                                        json=request_of(0))
            assert reply.status_code == 202, reply.text
            eventually(lambda: taken)
            process.kill()
            answers.set()
            process.start()
            eventually(lambda: len(taken) > 1)
        finally:
            process.kill()
            process.client.close()
        assert len(set(taken)) == 1
        assert taken[0][0] == f"msg_{reply.json()['id']}"
