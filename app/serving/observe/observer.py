"""What watches over one application: metrics, request lines, and traces where they are wanted."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from asgi_correlation_id import CorrelationIdMiddleware
from fastapi import FastAPI
from fastapi.telemetry import TelemetryConfig

from app.serving.observe.failures import FailureReply
from app.serving.observe.metrics import Metrics
from app.serving.observe.requests import REQUEST_ID_HEADER, RequestObserver, is_request_id
from app.serving.settings import Settings

if TYPE_CHECKING:
    from app.serving.observe.tracing import Tracing

UNTRACED: TelemetryConfig = {"tracing": False, "metrics": False, "logs": False,
                             "auto_configure": False}


class Observer:
    """Watches one application.

    Parameters
    ----------
    settings
        Whether to trace, and where to send traces.
    version
        Version of the application.

    Raises
    ------
    ModuleNotFoundError
        If traces are wanted and the packages of the extra `trace` are missing.
    """

    def __init__(self, settings: Settings, version: str) -> None:
        self.metrics = Metrics(version)
        self._tracing = None
        if settings.otlp_endpoint is not None:
            self._tracing = _tracing(settings.otlp_endpoint, version)

    @property
    def telemetry(self) -> TelemetryConfig:
        """How FastAPI is to trace requests."""
        return UNTRACED if self._tracing is None else self._tracing.telemetry

    def enter(self, app: FastAPI) -> None:
        """Put metrics into `app.state` and innermost what turns failures into replies. In place."""
        app.state.metrics = self.metrics
        app.add_middleware(FailureReply)

    def surround(self, app: FastAPI) -> None:
        """Put what sees every request and reply around all other middleware. In place."""
        app.add_middleware(RequestObserver, metrics=self.metrics)
        app.add_middleware(CorrelationIdMiddleware, header_name=REQUEST_ID_HEADER,
                           validator=is_request_id)

    def record_plan(self, reply: Mapping[str, Any]) -> None:
        """Count a plan that was just made, told as the reply of `POST /plan`."""
        self.metrics.count_plan(reply)
        if self._tracing is not None:
            self._tracing.record_plan(reply)

    def stop(self) -> None:
        """Send what is left to send. In place."""
        if self._tracing is not None:
            self._tracing.stop()


def _tracing(endpoint: str, version: str) -> "Tracing":
    # Imported only here: its packages are optional, and large.
    from app.serving.observe.tracing import Tracing

    return Tracing(endpoint, version)
