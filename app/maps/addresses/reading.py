"""An OpenStreetMap extract -> its houses, streets and towns."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import shapely

from app.maps.addresses.spelling import key_of

HOUSE, STREET, PLACE = "addr:housenumber", "highway", "place"

TOWNS = ("city", "town", "village", "hamlet")
"""Values of `place` by which people address their post."""

NAMES = ("name", "alt_name", "old_name", "short_name", "official_name")
"""Keys of names that a street has; behind most there may be a colon and a language."""


class AddressesError(Exception):
    """An extract's addresses can't be read."""


@dataclass(frozen=True)
class House:
    """A house number of a street, or of a place without streets."""

    street: str
    number: str
    town: str  # empty: not stated
    suburb: str
    postcode: str
    lon: float
    lat: float


@dataclass(frozen=True)
class Street:
    """A piece of a street, under all its names, the usual one first."""

    names: tuple[str, ...]
    lon: float
    lat: float


@dataclass(frozen=True)
class Town:
    """A town or village, under all its names, the usual one first."""

    names: tuple[str, ...]
    lon: float
    lat: float


def read_towns(extract: Path) -> list[Town]:
    """Return the towns of an extract; raises as `read_addresses` does."""
    osmium = _osmium()
    try:
        return [Town(names, node.location.lon, node.location.lat)
                for node in osmium.FileProcessor(str(extract), osmium.osm.NODE)
                .with_filter(osmium.filter.KeyFilter(PLACE))
                if (tags := _tags(node)).get(PLACE) in TOWNS and (names := _names(tags))]
    except RuntimeError as error:
        raise AddressesError(f"{extract} can't be read: {error}") from error


def read_addresses(extract: Path) -> Iterator[House | Street]:
    """Yield the houses and pieces of streets of an extract.

    Raises
    ------
    AddressesError
        If it can't be read, or what reads it isn't installed.
    """
    osmium = _osmium()
    wkb = osmium.geom.WKBFactory()
    try:
        for thing in (osmium.FileProcessor(str(extract)).with_locations().with_areas()
                      .with_filter(osmium.filter.KeyFilter(HOUSE, STREET))):
            tags = _tags(thing)
            place = _place(osmium, wkb, thing, HOUSE in tags)
            if place is None:
                continue
            if HOUSE in tags:
                yield from _houses(tags, *place)
            elif names := _names(tags):
                yield Street(names, *place)
    except RuntimeError as error:
        raise AddressesError(f"{extract} can't be read: {error}") from error


def _osmium() -> Any:
    try:
        import osmium
    except ImportError as error:
        raise AddressesError("extracts are read by the package osmium, which the extra `roads` "
                             "brings: pip install 'tandem-planner[roads]'") from error
    return osmium


def _tags(thing: Any) -> dict[str, str]:
    return {tag.k: tag.v for tag in thing.tags}


def _place(osmium: Any, wkb: Any, thing: Any, is_house: bool) -> tuple[float, float] | None:
    """Return the longitude and latitude of a house or a street; None: there is none to take."""
    if thing.is_node():
        return (thing.location.lon, thing.location.lat) if is_house else None
    if thing.is_area():
        if not is_house:
            return None
        middle = shapely.centroid(shapely.from_wkb(bytes.fromhex(wkb.create_multipolygon(thing))))
        return middle.x, middle.y
    if not thing.is_way() or is_house:
        return None  # Outlines of houses come again as areas.
    nodes = [node.location for node in thing.nodes if node.location.valid()]
    return (nodes[len(nodes) // 2].lon, nodes[len(nodes) // 2].lat) if nodes else None


def _names(tags: Mapping[str, str]) -> tuple[str, ...]:
    """Return all names, the usual one first."""
    found = dict.fromkeys(name.strip() for key in NAMES for tag, value in tags.items()
                          if tag == key or tag.startswith(f"{key}:")
                          for name in value.split(";"))
    usual = tags.get("name")
    rest = (name for name in found if name != usual and key_of(name))
    return (usual, *rest) if usual else ()


def _houses(tags: Mapping[str, str], lon: float, lat: float) -> Iterator[House]:
    street = tags.get("addr:street") or tags.get("addr:place")
    if street:
        yield House(street.strip(), tags[HOUSE].strip(), tags.get("addr:city", "").strip(),
                    tags.get("addr:suburb", "").strip(), tags.get("addr:postcode", "").strip(),
                    lon, lat)
