"""Puts access control around an application."""

from collections.abc import Iterator
from contextlib import contextmanager
from urllib.parse import urlsplit

from fastapi import FastAPI
from starlette.middleware.cors import CORSMiddleware

from app.database.connections import close_for_good, make_engine
from app.serving.access.gate import Gate
from app.serving.access.guard import Guard
from app.serving.access.headers import SecurityHeaders
from app.serving.access.hosts import ANY, TrustedHosts, is_loopback
from app.serving.access.keys import KeyStore
from app.serving.access.limits import RateLimits, RequestCounter
from app.serving.settings import Settings

METHODS = ("GET", "POST", "PUT", "PATCH", "DELETE")
REQUEST_HEADERS = ("Authorization", "Content-Type", "Idempotency-Key", "If-Match", "If-None-Match",
                   "Last-Event-ID", "X-API-Key", "X-Request-ID", "X-Share-Token")
PUBLIC_TILES = "https://tile.openstreetmap.org/{z}/{x}/{y}.png"
"""Where the console gets streets from if who uses it asks for that; by itself it never does."""

REPLY_HEADERS = ("ETag", "Location", "RateLimit-Limit", "RateLimit-Remaining",
                 "RateLimit-Reset", "Retry-After", "X-Request-ID")


class ExposedError(ValueError):
    """The service would answer the network, and nobody said that it should do so without keys."""


def check_exposure(settings: Settings, host: str) -> None:
    """Make sure that access is open to other machines on purpose only.

    Raises
    ------
    ExposedError
        If `host` is no loopback address, and the settings don't say how access is controlled.
    """
    if settings.access is None and not is_loopback(host):
        raise ExposedError(
            f"Listening on {host} lets other machines in. Set TANDEM_ACCESS=keys to let in those "
            "with a key from 'tandem keys create', or TANDEM_ACCESS=open to let in everybody.")


@contextmanager
def guarding(settings: Settings) -> Iterator[Guard]:
    """Yield the guard that the settings ask for; its database is open until the block ends."""
    limits = RequestCounter(RateLimits(settings.plans_per_minute, settings.jobs_per_minute,
                                       settings.wrong_keys_per_minute,
                                       settings.driver_requests_per_minute))
    if settings.access != "keys":
        yield Guard(None, limits)
        return
    engine = make_engine(settings.database)
    try:
        yield Guard(KeyStore(engine), limits)
    finally:
        close_for_good(engine)


def control_access(app: FastAPI, settings: Settings) -> None:
    """Put what is refused, allowed and told around the endpoints. In place."""
    # Where keys are needed, a page under a name that was turned this way has none.
    needs_no_key = settings.access != "keys"
    trusted = TrustedHosts(settings.trusted_hosts or (() if needs_no_key else (ANY,)))
    app.add_middleware(Gate, hosts=trusted, origins=settings.cors_origins,
                       count_refusal=app.state.metrics.count_refusal)
    if settings.cors_origins:
        app.add_middleware(
            CORSMiddleware, allow_origins=settings.cors_origins,
            allow_methods=METHODS, allow_headers=REQUEST_HEADERS,
            expose_headers=REPLY_HEADERS)
    tiles = urlsplit(settings.tile_url or PUBLIC_TILES)
    app.add_middleware(SecurityHeaders, image_origin=f"{tiles.scheme}://{tiles.netloc}")
