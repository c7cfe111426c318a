"""`TANDEM_ROADS`: where each profile's roads come from."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, get_args

from app.maps.roads.servers import ServerKind

Vehicle = Literal["car", "van", "truck", "bicycle"]
"""What an extract can be prepared for."""

VEHICLES: tuple[Vehicle, ...] = get_args(Vehicle)
SERVER_KINDS: tuple[ServerKind, ...] = get_args(ServerKind)

_NEXT = re.compile(r",(?=[^,=:/]+=)")
"""Between two profiles; addresses and names of files may hold commas."""

HOW_TO_WRITE = ("write profile=extract or profile=server, several with commas between them, such "
                "as truck=berlin.osm.pbf,car=osrm:http://localhost:5000")


class SettingError(ValueError):
    """The setting can't be read, or names what isn't there."""

    def __init__(self, message: str, setting: str = "TANDEM_ROADS") -> None:
        super().__init__(f"{setting}: {message.rstrip('.')}.")


@dataclass(frozen=True)
class Extract:
    """A file of OpenStreetMap data, and for which vehicle it has been prepared."""

    path: Path
    vehicle: Vehicle


@dataclass(frozen=True)
class RoadsServer:
    """A server of roads and its address."""

    kind: ServerKind
    url: str


Source = Extract | RoadsServer


def read_setting(text: str) -> dict[str, Source]:
    """Return where roads come from by profile.

    Raises
    ------
    SettingError
        If the text isn't written as it has to be.
    """
    sources: dict[str, Source] = {}
    for entry in _NEXT.split(text.strip()) if text.strip() else ():
        profile, equals, stated = (part.strip() for part in entry.partition("="))
        if not (profile and equals and stated):
            raise SettingError(f"{entry.strip()!r} can't be read: {HOW_TO_WRITE}")
        if profile in sources:
            raise SettingError(f"{profile!r} is named twice: name each profile once")
        sources[profile] = _source(profile, stated)
    return sources


def _source(profile: str, stated: str) -> Source:
    word, colon, rest = stated.partition(":")
    kind = next((kind for kind in SERVER_KINDS if kind == word), None)
    if colon and kind is not None:
        if not re.match(r"https?://[^/]", rest):
            raise SettingError(f"{profile} has no address behind {kind}: write one such as "
                               f"{kind}:http://localhost:5000")
        return RoadsServer(kind, rest)
    if re.match(r"https?$", word):
        raise SettingError(f"{profile} has an address and no word that says what answers there: "
                           f"write {' or '.join(f'{kind}:' for kind in SERVER_KINDS)} before it")
    vehicle = next((vehicle for vehicle in VEHICLES if vehicle == (word if colon else profile)),
                   None)
    if vehicle is None:
        raise SettingError(
            f"{profile}={stated} doesn't say for which vehicle the extract is: write "
            f"{profile}=car:{rest if colon else stated}, or another of {', '.join(VEHICLES)}")
    return Extract(Path(rest if colon else stated), vehicle)
