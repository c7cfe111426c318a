"""Flights -> the file that is sent: one, or a ZIP of several."""

import re
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass
from typing import NamedTuple

from app.plans.flights.flight import BeyondFormatError, Flight, note_of
from app.plans.flights.geojson import geojson_files
from app.plans.flights.packing import packed
from app.plans.flights.qgc import plan_files, way_point_files
from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.flights import FlightFormat, Per, WpmlInput

ZIP = "application/zip"

README = "README.txt"

FORMAT_ASKED = "query.format"
"""Where the format is stated that is asked for in an address."""


class Writer(NamedTuple):
    """How a format is written: flights of one drone -> files by the ends of their names."""

    write: Callable[[Sequence[Flight], WpmlInput], Mapping[str, bytes]]
    media_type: str


def _kml_files(flights: Sequence[Flight], wpml: WpmlInput) -> Mapping[str, bytes]:
    # Not before somebody asks: what writes XML takes 5 MB.
    from app.plans.flights.kml import kml_files
    return kml_files(flights)


def _wpml_files(flights: Sequence[Flight], wpml: WpmlInput) -> Mapping[str, bytes]:
    from app.plans.flights.wpml import wpml_files
    return wpml_files(flights, wpml)


WRITERS: Mapping[FlightFormat, Writer] = {
    "qgc-plan": Writer(lambda flights, _: plan_files(flights), "application/json"),
    "qgc-wpl": Writer(lambda flights, _: way_point_files(flights), "text/plain"),
    "kml": Writer(_kml_files, "application/vnd.google-earth.kml+xml"),
    "dji-wpml": Writer(_wpml_files, "application/vnd.google-earth.kmz"),
    "geojson": Writer(lambda flights, _: geojson_files(flights), "application/geo+json"),
}


@dataclass(frozen=True)
class FlightFile:
    """A file to be sent."""

    name: str
    media_type: str
    content: bytes


def flight_file(flights: Sequence[Flight], file_format: FlightFormat, per: Per,
                asked: str, wpml: WpmlInput) -> FlightFile:
    """Return all of some flights: at least one. `asked` is where the format was stated.

    Raises
    ------
    InvalidRequestError
        If the format can't tell one of them.
    """
    try:
        return _written(flights, file_format, per, wpml)
    except BeyondFormatError as error:
        raise InvalidRequestError([
            InputError(code="BEYOND_FORMAT", path=asked, message=str(error))]) from error


def _written(flights: Sequence[Flight], file_format: FlightFormat, per: Per,
             wpml: WpmlInput) -> FlightFile:
    writer = WRITERS[file_format]
    files: dict[str, bytes] = {}
    stems: set[str] = set()
    for name, group in _grouped(flights, per).items():
        stem = _free(name, stems)
        stems.add(stem.casefold())
        files |= {stem + ending: content for ending, content in writer.write(group, wpml).items()}
    if len(files) == 1:
        (name, content), = files.items()
        return FlightFile(name, writer.media_type, content)
    return FlightFile(f"flights-{file_format}.zip", ZIP,
                      packed({README: f"{note_of(flights)}\n".encode(), **files}))


def _grouped(flights: Sequence[Flight], per: Per) -> dict[str, list[Flight]]:
    """Return the flights that each file holds, by its name's beginning."""
    if per == "sortie":
        return {f"{flight.drone} flight {flight.number}": [flight] for flight in flights}
    groups: dict[str, list[Flight]] = {}
    for flight in flights:
        groups.setdefault(flight.drone, []).append(flight)
    return groups


def _free(name: str, taken: Set[str]) -> str:
    """Return a name that any file system takes and that is not taken yet."""
    plain = re.sub(r"[^A-Za-z0-9._-]+", "-", name).strip("-.") or "flight"
    candidate, number = plain, 2
    while candidate.casefold() in taken:
        candidate, number = f"{plain}-{number}", number + 1
    return candidate
