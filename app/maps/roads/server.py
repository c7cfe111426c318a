"""What an operator states of a server of roads."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from app.maps.remote.servers import require_address, require_positive


@dataclass(frozen=True)
class RoadServer:
    """A server and its limits.

    Parameters
    ----------
    url
        Where its paths begin, such as `http://localhost:5000`.
    max_places
        Most origins, and most destinations, in one question.
    at_once
        Most questions at the same time for one table.
    patience
        Most seconds for one answer, before the question is asked again.
    first_wait
        Seconds until it is asked again, at random up to this, then up to twice as many, and so on.
    max_url
        Longest address that it takes; larger tables are cut further.
    failures, rest
        After so many tables or routes in a row that it failed to answer, it isn't asked for so many
        seconds.
    max_points
        Most points of one route.
    headers
        Sent with every question, such as a key.
    """

    url: str
    max_places: int = 100
    at_once: int = 4
    patience: float = 10.0
    first_wait: float = 0.2
    max_url: int = 8_000
    failures: int = 3
    rest: float = 10.0
    max_points: int = 100
    headers: Mapping[str, str] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        require_address(self.url, "a server of roads")
        if self.max_points < 2:
            raise ValueError("max_points of a server of roads must be at least 2")
        require_positive(self, ("max_places", "at_once", "patience", "first_wait", "max_url",
                                "failures", "rest"), "a server of roads")
