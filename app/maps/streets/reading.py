"""An OpenStreetMap extract -> what of it is drawn."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import shapely

from app.maps.streets.kinds import KEYS, KINDS, SEA, kind_of_area, kind_of_way, name_of_way
from app.maps.streets.mercator import on_map
from app.maps.streets.sea import Box, Shapes, sea_of

COAST = "coastline"


class NamedLines(NamedTuple):
    """Lines with a name, one or more for each name."""

    names: Sequence[str]
    lines: Shapes


class StreetsError(Exception):
    """An extract can't be drawn."""


@dataclass(frozen=True)
class Drawing:
    """What an extract shows."""

    bounds: Box
    shapes: Mapping[str, Shapes]  # by kind, in the map's own coordinates (see `mercator`)
    named: Mapping[str, NamedLines]  # by kind, those of them that have a name


@dataclass(frozen=True)
class DrawnShapes:
    """What of an extract is drawn, by kind: shapes in degrees as WKB, and what each is called."""

    shapes: dict[str, list[bytes]]
    names: dict[str, list[str]]

    def add(self, kind: str, shapes: Iterable[bytes], name: str) -> None:
        """Note shapes. In place."""
        for shape in shapes:
            self.shapes[kind].append(shape)
            self.names[kind].append(name)


def read_drawing(extract: Path) -> Drawing:
    """Return what is drawn of an extract.

    Raises
    ------
    StreetsError
        If it can't be read, or what reads it isn't installed.
    """
    try:
        import osmium
    except ImportError as error:
        raise StreetsError("extracts are read by the package osmium, which the extra `roads` "
                           "brings: pip install 'tandem-planner[roads]'") from error
    try:
        bounds, found = _bounds(osmium, extract), _found(osmium, extract)
    except RuntimeError as error:
        raise StreetsError(f"{extract} can't be read: {error}") from error
    shapes = {name: shapely.from_wkb(wkb) for name, wkb in found.shapes.items()}
    shapes[SEA.name] = sea_of(shapes.pop(COAST, np.empty(0, object)), bounds)
    drawn = {kind.name: shapely.transform(shapes[kind.name], on_map)
             for kind in KINDS if len(shapes.get(kind.name, ()))}
    return Drawing(bounds, drawn, {
        kind.name: _joined(drawn[kind.name], found.names[kind.name])
        for kind in KINDS if kind.names_from is not None and any(found.names.get(kind.name, ()))})


def _joined(lines: Shapes, names: Sequence[str]) -> NamedLines:
    """Return the lines that have a name, joined where the same goes on: ways end at junctions."""
    ways = defaultdict(list)
    for line, name in zip(lines, names, strict=True):
        if name:
            ways[name].append(line)
    whole = shapely.line_merge([shapely.MultiLineString(parts) for parts in ways.values()])
    parts, of = shapely.get_parts(whole, return_index=True)
    known = list(ways)
    return NamedLines([known[name] for name in of], parts)


def _bounds(osmium: Any, extract: Path) -> Box:
    """Return the box that an extract says it holds, or that of its places."""
    with osmium.io.Reader(str(extract), osmium.osm.NODE) as reader:
        box = reader.header().box()
    if not box.valid():
        for node in osmium.FileProcessor(str(extract), osmium.osm.NODE):
            box.extend(node.location)
    if not box.valid():
        raise StreetsError(f"{extract} holds no places.")
    return (box.bottom_left.lon, box.bottom_left.lat, box.top_right.lon, box.top_right.lat)


def _found(osmium: Any, extract: Path) -> DrawnShapes:
    """Return the shapes of each kind, and of coastlines."""
    wkb = osmium.geom.WKBFactory()
    found = DrawnShapes(defaultdict(list), defaultdict(list))
    drawn = osmium.osm.WAY | osmium.osm.AREA
    for thing in (osmium.FileProcessor(str(extract)).with_locations().with_areas()
                  .with_filter(osmium.filter.EntityFilter(drawn))
                  .with_filter(osmium.filter.KeyFilter(*KEYS))):
        tags = {tag.k: tag.v for tag in thing.tags}
        if thing.is_area():
            kind, shape_of = kind_of_area(tags), wkb.create_multipolygon
        elif tags.get("natural") == COAST:
            kind, shape_of = COAST, wkb.create_linestring
        else:
            kind, shape_of = kind_of_way(tags), wkb.create_linestring
        if kind is None:
            continue
        try:
            found.add(kind, [bytes.fromhex(shape_of(thing))], name_of_way(tags))
        except osmium.InvalidLocationError:
            if not thing.is_area():
                found.add(kind, _within(thing), name_of_way(tags))
        except RuntimeError:
            continue  # It is a single point.
    return found


def _within(way: Any) -> Iterator[bytes]:
    """Yield the parts of a way that an extract holds, where it cuts off the rest."""
    for is_there, nodes in groupby(way.nodes, lambda node: node.location.valid()):
        places = [(node.lon, node.lat) for node in nodes] if is_there else []
        if len(places) > 1:
            yield shapely.to_wkb(shapely.LineString(places))
