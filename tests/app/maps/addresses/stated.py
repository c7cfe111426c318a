"""A geocoder that knows what a test states."""

from collections.abc import Mapping, Sequence

from app.maps.addresses.geocoder import Candidate, Candidates, GeocoderError, Quality, Told
from app.maps.remote.asking import ShouldStop


class StatedGeocoder:
    """Answers as stated, or fails at the first that it isn't told of; notes what it is asked."""

    def __init__(self, known: Mapping[str, Candidates], error: GeocoderError | None = None,
                 name: str = "stated", scope: str = "stated") -> None:
        self.known = known
        self.error = error
        self.name = name
        self.scope = scope
        self.asked: list[str] = []

    def find(self, addresses: Sequence[str], until: float, should_stop: ShouldStop,
             told: Told) -> None:
        for place, address in enumerate(addresses):
            if self.error is not None and address not in self.known:
                raise self.error
            self.asked.append(address)
            told(place, self.known.get(address, ()))

    def close(self) -> None:
        self.asked.clear()


def place(label: str, lon: float = 24.94, lat: float = 60.17, quality: Quality = "house",
          unmatched: tuple[str, ...] = ()) -> Candidate:
    """Return a place that an address may mean."""
    return Candidate(lon, lat, label, quality, "stated", unmatched)
