"""Webhooks whose receivers are slow, beside others."""

import threading
from http.server import BaseHTTPRequestHandler, HTTPServer
from types import SimpleNamespace

import anyio
import httpx
import pytest

from app.records.jobs import webhook
from app.records.jobs.worker import CALLS_OF_A_HOST, WEBHOOKS_AT_ONCE
from tests.app.records.jobs.receiving import Receiver, drip
from tests.app.records.jobs.stepping import request_of, submit
from tests.conftest import SOON, eventually

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


def test_slow_receivers_of_one_host_hold_up_no_other(
        jobs: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    # No slow call is given up meanwhile, however busy the machine.
    monkeypatch.setattr(webhook, "anyio", SimpleNamespace(
        run=anyio.run, fail_after=lambda _: anyio.fail_after(2 * SOON)))
    called = threading.Event()

    class Quick(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            self.send_response(204)
            self.end_headers()
            called.set()

        def log_message(self, *_: object) -> None:
            """Say nothing."""

    with Receiver(drip) as slow, HTTPServer(("127.0.0.1", 0), Quick) as quick:
        thread = threading.Thread(target=quick.serve_forever, daemon=True)
        thread.start()
        for _ in range(WEBHOOKS_AT_ONCE + 1):
            submit(jobs, request_of(0), params={"webhook": f"http://127.0.0.1:{slow.port}/slow"})
        eventually(lambda: slow.num_calls > 0)
        submit(jobs, request_of(0),
               params={"webhook": f"http://localhost:{quick.server_port}/quick"})
        assert called.wait(SOON)
        # Of so many, no more than the share of the slow host were called meanwhile.
        assert slow.num_calls <= CALLS_OF_A_HOST
        quick.shutdown()
        thread.join()
