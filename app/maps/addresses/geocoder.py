"""What every source of addresses hands out, and how one fails."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol, get_args

from app.maps.remote.asking import ShouldStop
from app.maps.remote.errors import (
    SourceAnswerError, SourceError, SourceKind, SourceStoppedError, SourceUnavailableError,
)

Quality = Literal["house", "interpolated", "street", "town"]
"""What was found: the house itself or a named place, a point between houses whose numbers are next
to it, the street alone, or something larger. Best first."""

QUALITIES: tuple[Quality, ...] = get_args(Quality)

MOST_CANDIDATES = 5


class GeocoderError(SourceError):
    """No addresses were looked up this time."""


class GeocoderUnavailableError(GeocoderError, SourceUnavailableError):
    """The geocoder is down, too slow or too busy, or its setting is wrong."""


class GeocoderAnswerError(GeocoderError, SourceAnswerError):
    """The geocoder answered what can't be right, or that it can't answer this."""


class GeocoderStoppedError(GeocoderError, SourceStoppedError):
    """The caller said stop before there was an answer."""


GEOCODER = SourceKind("geocoder", GeocoderUnavailableError, GeocoderAnswerError,
                      GeocoderStoppedError)


@dataclass(frozen=True)
class Candidate:
    """A place that an address may mean."""

    lon: float
    lat: float
    label: str
    quality: Quality
    by: str  # the geocoder
    unmatched: tuple[str, ...] = ()  # words of the address that the label lacks

    def __post_init__(self) -> None:
        if not (-180 <= self.lon <= 180 and -90 <= self.lat <= 90):
            raise ValueError(f"{self.lon}, {self.lat} is not on the globe")


Candidates = tuple[Candidate, ...]
Told = Callable[[int, Candidates], None]
"""Is told what an address may mean, by its place among those asked for."""


class Geocoder(Protocol):
    """A source of addresses. May be asked by several threads at once."""

    @property
    def name(self) -> str:
        """What replies call it, such as `nominatim`."""
        ...

    @property
    def scope(self) -> str:
        """What tells its answers from those of others; empty: they needn't be kept."""
        ...

    def find(self, addresses: Sequence[str], until: float, should_stop: ShouldStop,
             told: Told) -> None:
        """Look addresses up; each answer is told as it comes, likeliest candidates first.

        Parameters
        ----------
        until
            When to have ended at the latest, on `time.perf_counter`.

        Raises
        ------
        GeocoderError
            If one isn't answered by then.
        """
        ...

    def close(self) -> None:
        """Let go of connections."""
        ...
