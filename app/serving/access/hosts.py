"""Whom a request is for: names that lead here on purpose, and origins that are this service."""

import re
from collections.abc import Collection
from ipaddress import ip_address

ANY = "*"
"""Among trusted hosts: whatever name."""

_HOST = re.compile(r"(\[[0-9A-Fa-f:.]+\]|[^][:@/\\?#\s]+)(?::([0-9]{0,5}))?")
"""A name, or an address with brackets if it has colons, and perhaps a port: nothing around them."""


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
        return ip_address(_bare(host)).is_loopback
    return host == "localhost" or host.endswith(".localhost")


def is_address(host: str) -> bool:
    """Tell whether a host is an address, not a name."""
    try:
        ip_address(_bare(host))
    except ValueError:
        return False
    return True


def is_same_host(origin: str, host: str) -> bool:
    """Tell whether a page of `origin` was served from where its request goes.

    Its scheme doesn't count: behind a proxy that ends TLS it can't be told.
    """
    scheme, _, page = origin.partition("://")
    default = {"http": 80, "https": 443}.get(scheme.lower())
    return _parts(page, default) == _parts(host, default) is not None


def _name(host: str) -> str:
    """Return a host in small letters without its port and the dot of its root; empty if it is none.
    """
    parts = _parts(host)
    return "" if parts is None else parts[0]


def _parts(host: str, default: int | None = None) -> tuple[str, int | None] | None:
    """Return the name of a host, in small letters and without brackets, and its port."""
    found = _HOST.fullmatch(host)
    if found is None:
        return None
    return _bare(found[1].lower().removesuffix(".")), int(found[2]) if found[2] else default


def _bare(host: str) -> str:
    """Return an address without the brackets around it."""
    return host[1:-1] if host.startswith("[") and host.endswith("]") else host
