"""An OpenStreetMap extract -> what of it is drawn."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from app.streets.kinds import KEYS, KINDS, SEA, kind_of_area, kind_of_way
from app.streets.mercator import on_map
from app.streets.sea import Box, Shapes, sea_of

COAST = "coastline"


class StreetsError(Exception):
    """An extract can't be drawn."""


@dataclass(frozen=True)
class Drawing:
    """What an extract shows."""

    bounds: Box
    shapes: Mapping[str, Shapes]  # by kind, in the map's own coordinates (see `mercator`)


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
    shapes = {name: shapely.from_wkb(wkb) for name, wkb in found.items()}
    shapes[SEA.name] = sea_of(shapes.pop(COAST, np.empty(0, object)), bounds)
    return Drawing(bounds, {kind.name: shapely.transform(shapes[kind.name], on_map)
                            for kind in KINDS if len(shapes.get(kind.name, ()))})


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


def _found(osmium: Any, extract: Path) -> dict[str, list[bytes]]:
    """Return the shapes of each kind, and of coastlines, in degrees as WKB."""
    wkb = osmium.geom.WKBFactory()
    found: dict[str, list[bytes]] = defaultdict(list)
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
            found[kind].append(bytes.fromhex(shape_of(thing)))
        except osmium.InvalidLocationError:
            if not thing.is_area():
                found[kind] += _within(thing)
        except RuntimeError:
            continue  # It is a single point.
    return found


def _within(way: Any) -> Iterator[bytes]:
    """Yield the parts of a way that an extract holds, where it cuts off the rest."""
    for is_there, nodes in groupby(way.nodes, lambda node: node.location.valid()):
        places = [(node.lon, node.lat) for node in nodes] if is_there else []
        if len(places) > 1:
            yield shapely.to_wkb(shapely.LineString(places))
