"""Log lines: JSON for machines, coloured text on a terminal, both with the request's id."""

import sys
from typing import Any, Literal

import structlog
from asgi_correlation_id import correlation_id
from structlog.typing import EventDict, Processor, WrappedLogger

LogFormat = Literal["auto", "json", "console"]
LogLevel = Literal["debug", "info", "warning", "error"]


def log_config(log_format: LogFormat, level: LogLevel, traced: bool = False) -> dict[str, Any]:
    """Return the configuration of all loggers, as `logging.config.dictConfig` and uvicorn take it.

    Parameters
    ----------
    log_format
        `auto` is `console` where standard error is a terminal, else `json`.
    level
        Least urgent level to write.
    traced
        Whether lines also carry the ids of the trace and span that they belong to.
    """
    if log_format == "auto":
        log_format = "console" if sys.stderr.isatty() else "json"
    return {
        "version": 1,
        "disable_existing_loggers": False,
        "formatters": {
            "lines": {"()": f"{__name__}.make_formatter", "log_format": log_format,
                      "traced": traced},
        },
        "handlers": {
            "stderr": {"class": "logging.StreamHandler", "formatter": "lines",
                       "stream": "ext://sys.stderr"},
        },
        "root": {"handlers": ["stderr"], "level": level.upper()},
        "loggers": {
            # Request lines are ours, with more in them.
            "uvicorn.access": {"level": "CRITICAL", "propagate": False},
            # Would warn of each request id that a client makes up.
            "asgi_correlation_id": {"level": "ERROR"},
            "httpx": {"level": "WARNING"},
        },
    }


def make_formatter(log_format: Literal["json", "console"],
                   traced: bool) -> structlog.stdlib.ProcessorFormatter:
    """Return the formatter of all handlers."""
    shared: list[Processor] = [
        structlog.stdlib.add_logger_name,
        structlog.stdlib.add_log_level,
        structlog.stdlib.ExtraAdder(),
        structlog.contextvars.merge_contextvars,
        _add_request_id,
        _drop_copy,
    ]
    if traced:
        from app.serving.observe.tracing import add_trace_ids

        shared.append(add_trace_ids)
    return structlog.stdlib.ProcessorFormatter(
        foreign_pre_chain=shared,
        processors=[structlog.stdlib.ProcessorFormatter.remove_processors_meta,
                    *_rendering(log_format)],
    )


def _rendering(log_format: Literal["json", "console"]) -> list[Processor]:
    if log_format == "console":
        return [structlog.processors.TimeStamper(fmt="%H:%M:%S", utc=False),
                # Others show variables, and so what clients sent.
                structlog.dev.ConsoleRenderer(colors=sys.stderr.isatty(),
                                              exception_formatter=structlog.dev.plain_traceback)]
    return [structlog.processors.TimeStamper(fmt="iso"), structlog.processors.format_exc_info,
            structlog.processors.JSONRenderer(ensure_ascii=False)]


def _add_request_id(logger: WrappedLogger, name: str, line: EventDict) -> EventDict:
    request_id = correlation_id.get()
    if request_id is not None:
        line["request_id"] = request_id
    return line


def _drop_copy(logger: WrappedLogger, name: str, line: EventDict) -> EventDict:
    """Drop the copy of a line in colours that uvicorn adds."""
    line.pop("color_message", None)
    return line
