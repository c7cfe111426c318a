"""The setting -> geocoders to ask."""

import time
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from app.maps.addresses.addresses import NO_ADDRESSES, Addresses
from app.maps.addresses.caching import AnswerCache
from app.maps.addresses.geocoder import (
    Geocoder, GeocoderStoppedError, GeocoderUnavailableError, Told,
)
from app.maps.addresses.index import find_index
from app.maps.addresses.searching import NAME, search
from app.maps.addresses.serving import ServerGeocoder
from app.maps.addresses.setting import AddressExtract, GeocoderSettingError, Source, read_setting
from app.maps.remote.asking import ShouldStop
from app.maps.streets.filing import folder_beside
from app.serving.settings import Settings


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


CACHE = Path("addresses", "answers.sqlite")
"""File, in the folder for data, of addresses looked up before."""


def opened_addresses(settings: Settings) -> Addresses:
    """Return the geocoders that the settings name; nothing is asked yet.

    Raises
    ------
    GeocoderSettingError
        If the setting can't be read, or names what isn't there or prepared.
    """
    sources = (() if settings.geocoder is None
               else read_setting(settings.geocoder.get_secret_value()))
    if not sources:
        return NO_ADDRESSES
    cache = AnswerCache(settings.data_dir / CACHE)
    try:
        return Addresses([_geocoder(source, cache) for source in sources], cache)
    except GeocoderSettingError:
        cache.close()
        raise


def _geocoder(source: Source, cache: AnswerCache) -> Geocoder:
    if isinstance(source, AddressExtract):
        return ExtractGeocoder(_index(source.path))
    gap = source.server.gap
    turn = partial(cache.take_turn, source.server.host, gap) if gap else None
    return ServerGeocoder(source.kind, source.server, turn)


def _index(extract: Path) -> Path:
    try:
        found = find_index(extract, [folder_beside(extract)])
    except OSError as error:
        raise GeocoderSettingError(f"{extract} can't be read: {error.strerror}") from error
    if found is None:
        raise GeocoderSettingError(f"the addresses of {extract} aren't prepared: run `tandem "
                                   f"addresses build {extract}` once")
    return found
