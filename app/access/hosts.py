"""Whom a request is for: names that lead here on purpose, and origins that are this service."""

from collections.abc import Collection
from ipaddress import ip_address
from urllib.parse import urlsplit

ANY = "*"
"""Among trusted hosts: whatever name."""


class TrustedHosts:
    """Names by which the service may be called.

    A page may have its own name lead to an address that only its visitor can reach, and so read
    what is there as if it were its own. An address that is written out can't be turned that way,
    so all are trusted, and so are the names that every machine keeps for itself.

    Parameters
    ----------
    names
        Names besides, without port; `*.example.org` stands for all below it, `*` for whatever.
    """

    def __init__(self, names: Collection[str]) -> None:
        self._trusts_all = ANY in names
        self._names = frozenset(name.lower() for name in names)

    def trusts(self, host: str) -> bool:
        """Tell whether a request with this header `Host` is meant for this service."""
        if self._trusts_all:
            return True
        name = _name(host)
        if is_address(name) or is_loopback(name):
            return True
        parents = name.split(".")[1:]
        return name in self._names or any(
            f"*.{'.'.join(parents[begin:])}" in self._names for begin in range(len(parents)))


def is_loopback(host: str) -> bool:
    """Tell whether only this machine can reach a name or an address."""
    if is_address(host):
        return ip_address(host.strip("[]")).is_loopback
    return host == "localhost" or host.endswith(".localhost")


def is_address(host: str) -> bool:
    """Tell whether a host is an address, not a name."""
    try:
        ip_address(host.strip("[]"))
    except ValueError:
        return False
    return True


def is_same_host(origin: str, host: str) -> bool:
    """Tell whether a page of `origin` was served from where its request goes.

    Its scheme doesn't count: behind a proxy that ends TLS it can't be told.
    """
    try:
        parts = urlsplit(origin)
        asked = urlsplit(f"{parts.scheme}://{host}")
        default = {"http": 80, "https": 443}.get(parts.scheme)
        return (bool(parts.hostname) and parts.hostname == asked.hostname
                and (parts.port or default) == (asked.port or default))
    except ValueError:
        return False


def _name(host: str) -> str:
    """Return a host in small letters without its port and the dot of its root."""
    try:
        parts = urlsplit(f"//{host}")
    except ValueError:
        return ""
    is_plain = parts.netloc == host and parts.username is None
    return (parts.hostname or "").removesuffix(".") if is_plain else ""
