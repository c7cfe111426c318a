"""How often a key, or an address where access is open, may ask."""

import math
import time
from dataclasses import dataclass
from ipaddress import IPv6Address, ip_address, ip_network

from fastapi import Request
from limits import RateLimitItem, RateLimitItemPerMinute
from limits.storage import MemoryStorage
from limits.strategies import SlidingWindowCounterRateLimiter

from app.schemas.errors import RequestError
from app.serving.access.headers import RATE_LIMIT_HEADERS
from app.serving.access.keys import Scope

NETWORK_BITS = 64
"""An IPv6 customer usually gets a network of this many bits, so all of it counts as one address."""


class TooManyRequestsError(RequestError, status=429, name="too-many-requests",
                           refusal="rate_limit"):
    """A rate limit is used up."""

    title = "Too many requests"

    def __init__(self, detail: str, headers: dict[str, str]) -> None:
        super().__init__(detail)
        self.headers = headers


@dataclass(frozen=True)
class RateLimits:
    """Requests a minute; 0: no limit."""

    plans: int = 0
    jobs: int = 0
    failures: int = 0  # wrong keys from one address
    drivers: int = 0  # of one driver's link


class RequestCounter:
    """Counts requests, in this process alone.

    The counts slide from one minute to the next: two numbers a key, however many requests.
    """

    def __init__(self, rates: RateLimits) -> None:
        self._limiter = SlidingWindowCounterRateLimiter(MemoryStorage())
        stated: dict[Scope, int] = {"plan": rates.plans, "jobs": rates.jobs}
        self._by_scope: dict[Scope, RateLimitItem] = {
            scope: RateLimitItemPerMinute(rate, namespace=scope)
            for scope, rate in stated.items() if rate}
        self._failures = (RateLimitItemPerMinute(rates.failures, namespace="failures")
                          if rates.failures else None)
        self._drivers = (RateLimitItemPerMinute(rates.drivers, namespace="drivers")
                         if rates.drivers else None)

    def take(self, request: Request, client: str, scopes: frozenset[Scope]) -> None:
        """Count a request, and have its reply tell what is left.

        Parameters
        ----------
        client
            Whose request it is: a key, or an address.
        scopes
            Those that the endpoint needs, which tell the limit that holds.

        Raises
        ------
        TooManyRequestsError
            If the limit is used up.
        """
        for scope in scopes & self._by_scope.keys():
            self._take(request, self._by_scope[scope], client)

    def take_of_driver(self, request: Request, link: str) -> None:
        """Count a request that comes with a driver's link; raises as `take` does."""
        if self._drivers is not None:
            self._take(request, self._drivers, link)

    def count_failure(self, address: str) -> None:
        """Count a wrong key.

        Raises
        ------
        TooManyRequestsError
            If too many came from this address.
        """
        if self._failures is not None and not self._limiter.hit(self._failures, address):
            self._refuse("Too many wrong keys came from this address",
                         self._headers(self._failures, address))

    def _take(self, request: Request, item: RateLimitItem, client: str) -> None:
        taken = self._limiter.hit(item, client)
        headers = self._headers(item, client)
        if not taken:
            self._refuse(f"No more than {item.amount} requests a minute are allowed here", headers)
        setattr(request.state, RATE_LIMIT_HEADERS, headers)

    def _refuse(self, what: str, headers: dict[str, str]) -> None:
        # Where a minute's count has just slid into the next, it still weighs in full.
        wait = int(headers["RateLimit-Reset"]) + math.ceil(60 / int(headers["RateLimit-Limit"]))
        raise TooManyRequestsError(f"{what}: try again in {wait} s.",
                                   {**headers, "Retry-After": str(wait)})

    def _headers(self, item: RateLimitItem, who: str) -> dict[str, str]:
        stats = self._limiter.get_window_stats(item, who)
        return {"RateLimit-Limit": str(item.amount),
                "RateLimit-Remaining": str(max(0, stats.remaining)),
                "RateLimit-Reset": str(max(1, math.ceil(stats.reset_time - time.time())))}


def client_address(request: Request) -> str:
    """Return the address that a request came from, or its network."""
    host = request.client.host if request.client else ""
    try:
        address = ip_address(host)
    except ValueError:
        return host
    if isinstance(address, IPv6Address):
        network = ip_network((int(address), NETWORK_BITS), strict=False)
        return str(address.ipv4_mapped or network)
    return str(address)
