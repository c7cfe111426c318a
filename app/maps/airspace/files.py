"""Zones in files, in any of the formats in which they are published."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import TypeAdapter, ValidationError
from pydantic_core import from_json

from app.maps.airspace.faults import Fault, Reading
from app.maps.airspace.reading import read_zones
from app.maps.airspace.zone import Zone
from app.schemas.airspace import ZoneFormat, Zones
from app.schemas.errors import json_path, schema_errors

MAX_FILE_BYTES = 64 * 2**20
"""Largest file that is read."""

LISTED_FAULTS = 5
"""Faults that a setting tells."""

_STATED: TypeAdapter[Any] = TypeAdapter(Zones)
_MARKS = (b"\xff\xfe", b"\xfe\xff")


class ZoneFileError(ValueError):
    """A file has no zones that can be read."""


class ZoneFile(NamedTuple):
    """What a file holds."""

    format: ZoneFormat
    reading: Reading


def read_file(path: Path, size: int = MAX_FILE_BYTES) -> ZoneFile:
    """Return what a file of at most `size` bytes holds, zone by zone.

    Raises
    ------
    ZoneFileError
        If it is no such file.
    """
    try:
        if path.stat().st_size > size:
            raise ZoneFileError(f"it has {path.stat().st_size / 2**20:.0f} MiB, and at most "
                                f"{size / 2**20:g} MiB are read: split it")
        content = path.read_bytes()
        text = content.decode("utf-16" if content.startswith(_MARKS) else "utf-8-sig")
    except OSError as error:
        raise ZoneFileError(f"it can't be opened ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise ZoneFileError("it is no text in UTF-8: save it as UTF-8") from error
    if text.lstrip().startswith("<"):
        return ZoneFile("kml", read_zones(_STATED.validate_python({"format": "kml",
                                                                   "data": text})))
    try:
        data = from_json(text)
    except ValueError as error:
        raise ZoneFileError(f"it is neither JSON nor KML ({error})") from error
    return _read_json(data)


def _read_json(data: Any) -> ZoneFile:
    features = data.get("features") if isinstance(data, dict) else None
    file_format = format_of(data)
    if not isinstance(features, list):
        features = [data]
    whole = Reading()
    for index, feature in enumerate(features):
        collection = {"type": "FeatureCollection", "features": [feature]}
        if feature is data:
            collection = data
        try:
            part = read_zones(_STATED.validate_python({"format": file_format,
                                                       "data": collection}))
        except ValidationError as error:
            whole.faults += [Fault(_place(error.path, index), error.message)
                             for error in _errors(error)]
            continue
        whole.zones += part.zones
        whole.faults += _numbered(part.faults, index)
        whole.doubts += _numbered(part.doubts, index)
    return ZoneFile(file_format, whole)


class _Error(NamedTuple):
    path: tuple[str | int, ...]
    message: str


def _errors(error: ValidationError) -> list[_Error]:
    """Return what is wrong, each with its place below the data."""
    details = error.errors(include_url=False)
    found = schema_errors(details)
    places = [tuple(key for key in each["loc"] if not str(key).startswith("("))[1:]
              for each in details]
    return [_Error(place, each.message) for place, each in zip(places, found, strict=False)]


def _place(path: tuple[str | int, ...], index: int) -> tuple[str | int, ...]:
    """Return where something is in the whole file, of which a zone was read alone."""
    return ("features", index, *path[2:]) if path[:1] == ("features",) else path


def _numbered(faults: Sequence[Fault], index: int) -> list[Fault]:
    return [replace(fault, path=_place(fault.path, index)) for fault in faults]


def format_of(data: Any) -> ZoneFormat:
    """Tell in which format JSON is written, by its first zone."""
    features = data.get("features") if isinstance(data, dict) else None
    first = features[0] if isinstance(features, list) and features else None
    if not isinstance(first, dict):
        return "geojson"
    if isinstance(first.get("geometry"), list):
        return "ed269"
    properties = first.get("properties")
    known = properties if isinstance(properties, dict) else {}
    return "ed318" if {"variant", "zoneAuthority"} <= known.keys() and "type" in known else (
        "geojson")


def zones_in(paths: Sequence[Path]) -> tuple[Zone, ...]:
    """Return the zones of several files.

    Raises
    ------
    ZoneFileError
        If anything of them can't be read: what is left out would be flown through.
    """
    zones: list[Zone] = []
    for path in paths:
        try:
            faults = (reading := read_file(path).reading).faults
        except ZoneFileError as error:
            raise ZoneFileError(f"{path}: {error}") from error
        if faults:
            told = "; ".join(words_of(fault) for fault in faults[:LISTED_FAULTS])
            raise ZoneFileError(f"{path}: {len(faults)} of its zones can't be read: {told}")
        zones += reading.zones
    return tuple(zones)


def words_of(fault: Fault) -> str:
    """Return a fault as a line of text."""
    return f"{json_path(fault.path)}: {fault.message}"
