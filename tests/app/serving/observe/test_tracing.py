"""Traces as a collector receives them."""

import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import pytest
from opentelemetry.proto.collector.trace.v1.trace_service_pb2 import ExportTraceServiceRequest
from opentelemetry.proto.trace.v1.trace_pb2 import Span

from app.serving.observe.tracing import Tracing
from tests.app.serving.observe.server import running

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

SECOND = 10**9


class Collector(ThreadingHTTPServer):
    """Takes spans by OTLP over HTTP."""

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), _Handler)
        self.received: list[tuple[str, ExportTraceServiceRequest]] = []

    @property
    def spans(self) -> list[Span]:
        """All spans received."""
        return [span for _, request in self.received for resource in request.resource_spans
                for scope in resource.scope_spans for span in scope.spans]


class _Handler(BaseHTTPRequestHandler):
    server: Collector

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers["Content-Length"]))
        if self.headers.get("Content-Encoding") == "gzip":
            raise AssertionError("compressed")
        self.server.received.append((self.path, ExportTraceServiceRequest.FromString(body)))
        self.send_response(200)
        self.send_header("Content-Length", "0")
        self.end_headers()

    def log_message(self, *_: Any) -> None:
        pass


@pytest.fixture
def collector() -> Iterator[Collector]:
    """Return a running collector."""
    with Collector() as collector:
        thread = threading.Thread(target=collector.serve_forever)
        thread.start()
        yield collector
        collector.shutdown()
        thread.join()


def test_requests_and_stages_become_one_trace(
        collector: Collector, smallest: dict[str, Any]) -> None:
    endpoint = f"http://127.0.0.1:{collector.server_address[1]}"
    trace_id = "4bf92f3577b34da6a3ce929d0e0e4736"
    with running(TANDEM_OTLP_ENDPOINT=endpoint, TANDEM_LOG_FORMAT="json") as server:
        reply = server.client.post("/plan?note=secret", json=smallest, headers={
            "traceparent": f"00-{trace_id}-00f067aa0ba902b7-01"})
        assert reply.status_code == 200
        assert server.client.get("/tdm_secret").status_code == 400
        lines = server.stop()
    assert [path for path, _ in collector.received] == ["/v1/traces"]
    spans = {span.name: span for span in collector.spans if span.name != "GET"}
    assert set(spans) == {"POST /plan", "validate", "decode", "search", "check"}
    request = spans.pop("POST /plan")
    assert request.trace_id.hex() == trace_id
    for stage in spans.values():
        assert stage.trace_id == request.trace_id
        assert stage.parent_span_id == request.span_id
        assert stage.start_time_unix_nano >= request.start_time_unix_nano - SECOND // 100
        assert stage.end_time_unix_nano <= request.end_time_unix_nano
    assert "secret" not in str(collector.received)
    assert sum(f'"trace_id": "{trace_id}"' in line for line in lines) == 1


def test_plans_of_jobs_are_traces_of_their_own(collector: Collector) -> None:
    tracing = Tracing(f"http://127.0.0.1:{collector.server_address[1]}", "1")
    tracing.record_plan({"solver": {"elapsed": {
        "validate": 0.1, "decode": 0.2, "search": 3.0, "check": 0.1, "total": 5.0}}})
    tracing.stop()
    spans = {span.name: span for span in collector.spans}
    job = spans.pop("job")
    assert {span.parent_span_id for span in spans.values()} == {job.span_id}
    lengths = {name: (span.end_time_unix_nano - span.start_time_unix_nano) / SECOND
               for name, span in spans.items()}
    assert lengths == {"validate": 0.1, "decode": 0.2, "search": 3.0, "check": 0.1}
    assert job.start_time_unix_nano == spans["validate"].start_time_unix_nano
    assert spans["search"].end_time_unix_nano == spans["check"].start_time_unix_nano
