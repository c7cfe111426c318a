"""The addresses of an extract as a geocoder."""

import time
from collections.abc import Sequence
from pathlib import Path

from app.maps.addresses.geocoder import GeocoderStoppedError, GeocoderUnavailableError, Told
from app.maps.addresses.searching import NAME, search
from app.maps.remote.asking import ShouldStop


class ExtractGeocoder:
    """A file that `build_index` made."""

    name = NAME
    scope = ""
    """Looking up is as quick as finding what was kept."""

    def __init__(self, file: Path) -> None:
        self._file = file

    def find(self, addresses: Sequence[str], until: float, should_stop: ShouldStop,
             told: Told) -> None:
        """Look addresses up; each answer is told as it comes. Raises `GeocoderError`."""
        for place, address in enumerate(addresses):
            if time.perf_counter() > until:
                raise GeocoderUnavailableError("There was no time to look all addresses up.")
            if should_stop():
                raise GeocoderStoppedError("The work was stopped before there was an answer.")
            told(place, search(self._file, address))

    def close(self) -> None:
        """Let go of nothing: the file is opened for each search."""
