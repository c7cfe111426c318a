"""`TANDEM_GEOCODER`: where addresses are looked up."""

import re
from dataclasses import dataclass
from pathlib import Path

from app.maps.addresses.server import SERVER_KINDS, GeocodingServer, ServerKind
from app.maps.addresses.serving import read_server

EXTRACT = "extract"

_NEXT = re.compile(rf",(?=\s*(?:{'|'.join((*SERVER_KINDS, EXTRACT))}):)")
"""Between two geocoders; addresses and names of files may hold commas."""

HOW_TO_WRITE = ("write kind:address, several with commas between them, such as "
                "extract:berlin.osm.pbf,nominatim:https://nominatim.example.org")


class GeocoderSettingError(ValueError):
    """The setting can't be read, or names what isn't there."""

    def __init__(self, message: str) -> None:
        super().__init__(f"TANDEM_GEOCODER: {message}.")


@dataclass(frozen=True)
class AddressExtract:
    """A file of OpenStreetMap data."""

    path: Path


@dataclass(frozen=True)
class AddressServer:
    """A geocoding server."""

    kind: ServerKind
    server: GeocodingServer


Source = AddressExtract | AddressServer


def read_setting(text: str) -> list[Source]:
    """Return where addresses are looked up, in order.

    Raises
    ------
    GeocoderSettingError
        If the text isn't written as it has to be.
    """
    return [_source(entry.strip()) for entry in _NEXT.split(text.strip())] if text.strip() else []


def _source(stated: str) -> Source:
    word, _, rest = stated.partition(":")
    if word == EXTRACT and rest:
        return AddressExtract(Path(rest))
    kind = next((kind for kind in SERVER_KINDS if kind == word), None)
    # What can't be read may hold a key, so it isn't repeated.
    if kind is None:
        raise GeocoderSettingError(f"it can't be read: {HOW_TO_WRITE}")
    try:
        return AddressServer(kind, read_server(rest))
    except ValueError as error:
        raise GeocoderSettingError(f"{kind}: {error}") from error
