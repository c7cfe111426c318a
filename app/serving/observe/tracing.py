"""OpenTelemetry: a span for each request and each stage of planning, sent to a collector.

Needs the packages of the extra `trace`; nothing imports this file unless an endpoint is set.
"""

import time
from collections.abc import Mapping, MutableMapping
from contextlib import AbstractContextManager, nullcontext
from typing import Any

from fastapi.telemetry import TelemetryConfig
from opentelemetry import trace
from opentelemetry.context import Context
from opentelemetry.exporter.otlp.proto.http.trace_exporter import OTLPSpanExporter
from opentelemetry.sdk.resources import SERVICE_NAME, SERVICE_VERSION, Resource
from opentelemetry.sdk.trace import Span, SpanProcessor, TracerProvider
from opentelemetry.sdk.trace.export import BatchSpanProcessor
from structlog.typing import EventDict, WrappedLogger

from app.serving.access.tokens import PREFIX

REDACTED = "REDACTED"

QUIET_PATHS = ("/health/live", "/health/ready", "/metrics")
"""What monitoring itself asks for is not traced."""


class Tracing:
    """Sends spans of one application to a collector.

    Parameters
    ----------
    endpoint
        Base address of a collector that takes OTLP over HTTP, such as `http://collector:4318`.
    version
        Version of the service, told with every span.
    """

    def __init__(self, endpoint: str, version: str) -> None:
        resource = Resource.create({SERVICE_NAME: "tandem", SERVICE_VERSION: version})
        self._provider = TracerProvider(resource=resource)
        self._provider.add_span_processor(_Discretion())
        self._provider.add_span_processor(
            BatchSpanProcessor(OTLPSpanExporter(f"{endpoint.rstrip('/')}/v1/traces")))
        self._tracer = self._provider.get_tracer("tandem")

    @property
    def telemetry(self) -> TelemetryConfig:
        """How FastAPI is to trace requests."""
        return {"tracer_provider": self._provider, "metrics": False, "logs": False,
                "operation_spans": False, "auto_configure": False, "exclude": _is_quiet}

    def record_plan(self, reply: Mapping[str, Any]) -> None:
        """Send a span for each stage of a plan that was just made, told as its reply.

        Validation came first, the other stages end now; between them the request waited.
        """
        elapsed = reply["solver"]["elapsed"]
        end = time.time_ns()
        start = end - _nanoseconds(elapsed["total"])
        with self._around(start):
            self._record("validate", start, start + _nanoseconds(elapsed["validate"]))
            for stage in ("check", "search", "decode"):
                start = end - _nanoseconds(elapsed[stage])
                self._record(stage, start, end)
                end = start

    def stop(self) -> None:
        """Send what is left. In place."""
        self._provider.shutdown()

    def _around(self, start: int) -> AbstractContextManager[object]:
        """Return the request's span, or one for the plan of a job."""
        if trace.get_current_span().get_span_context().is_valid:
            return nullcontext()
        return self._tracer.start_as_current_span("job", start_time=start)

    def _record(self, stage: str, start: int, end: int) -> None:
        self._tracer.start_span(stage, start_time=start).end(end)


class _Discretion(SpanProcessor):
    """Keeps queries, such as a webhook's address, and keys out of traces."""

    def on_start(self, span: Span, parent_context: Context | None = None) -> None:
        attributes = span.attributes or {}
        if "url.query" in attributes:
            span.set_attribute("url.query", REDACTED)
        if PREFIX in str(attributes.get("url.path", "")):
            span.set_attribute("url.path", REDACTED)


def add_trace_ids(logger: WrappedLogger, name: str, line: EventDict) -> EventDict:
    """Add the ids of the current trace and span to a log line."""
    context = trace.get_current_span().get_span_context()
    if context.is_valid:
        line["trace_id"] = trace.format_trace_id(context.trace_id)
        line["span_id"] = trace.format_span_id(context.span_id)
    return line


def _is_quiet(scope: MutableMapping[str, Any]) -> bool:
    return scope["path"] in QUIET_PATHS


def _nanoseconds(seconds: float) -> int:
    return round(seconds * 1e9)
