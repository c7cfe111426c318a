"""What an operator states of a geocoding server."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, get_args
from urllib.parse import urlencode

from app.maps.remote.servers import Server

ServerKind = Literal["nominatim", "photon", "pelias"]

SERVER_KINDS: tuple[ServerKind, ...] = get_args(ServerKind)

PUBLIC: dict[str, float] = {"nominatim.openstreetmap.org": 1.0, "photon.komoot.io": 1.0}
"""Hosts that all may use, and how often a second at most."""

NEEDS_CONTACT = frozenset(("nominatim.openstreetmap.org",))
"""Hosts whose policy asks who one is."""

AGENT = "tandem-planner"


@dataclass(frozen=True)
class GeocodingServer(Server):
    """A geocoding server and its limits.

    Parameters
    ----------
    key
        Sent with every question, if there is one.
    email
        Whom its operator can write to.
    country
        Code of two letters; addresses elsewhere aren't looked for.
    language
        Code of the language of its labels.
    per_second
        Questions a second at most, of all processes that share a cache; 0: as many as it answers.
    """

    key: str = field(default="", repr=False)
    email: str = ""
    country: str = ""
    language: str = ""
    per_second: float = 0.0

    def __post_init__(self) -> None:
        self.require("a geocoder")
        if self.host in NEEDS_CONTACT and "@" not in self.email:
            raise ValueError(f"{self.host} asks who uses it: add ?email=you@example.org")
        if self.per_second < 0:
            raise ValueError("per_second of a geocoder must not be negative")

    @property
    def host(self) -> str:
        """Who answers."""
        import httpx  # not before it is needed, as `require_address` has it

        return httpx.URL(self.url).host

    @property
    def sent(self) -> Mapping[str, str]:
        """Who asks."""
        return {"User-Agent": f"{AGENT} ({self.email})" if self.email else AGENT}

    @property
    def gap(self) -> float:
        """Least seconds between two questions."""
        allowed = PUBLIC.get(self.host, 0.0)
        rates = [rate for rate in (self.per_second, allowed) if rate]
        return 1 / min(rates) if rates else 0.0


def path_with(path: str, query: Mapping[str, object]) -> str:
    """Return a path with a query of what is stated."""
    return f"{path}?" + urlencode({name: value for name, value in query.items() if value})
