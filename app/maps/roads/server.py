"""What an operator states of a server of roads."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from app.maps.remote.servers import Server


@dataclass(frozen=True)
class RoadServer(Server):
    """A server of roads and its limits.

    Parameters
    ----------
    max_places
        Most origins, and most destinations, in one question.
    max_url
        Longest address that it takes; larger tables are cut further.
    max_points
        Most points of one route.
    headers
        Sent with every question, such as a key.
    """

    max_places: int = 100
    max_url: int = 8_000
    max_points: int = 100
    headers: Mapping[str, str] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        if self.max_points < 2:
            raise ValueError("max_points of a server of roads must be at least 2")
        self.require("a server of roads", "max_places", "max_url")

    @property
    def sent(self) -> Mapping[str, str]:
        """Headers of every question, such as a key."""
        return self.headers
