"""The tiles of an extract in one file, made once and kept beside what else is made of the extract.
"""

import gzip
import json
import sqlite3
from collections import defaultdict
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from app.maps.streets.cutting import named_pieces, pieces
from app.maps.streets.filing import file_name, made, reading
from app.maps.streets.reading import read_drawing
from app.maps.streets.sea import Box

VERSION = 2
"""Of what a tile holds."""

SUFFIX = ".streets"

Tile = tuple[int, int, int]


@dataclass(frozen=True)
class Streets:
    """The tiles of an extract."""

    file: Path
    name: str  # tells one extract, and one version of its tiles, from all others
    bounds: Box

    @classmethod
    def opened(cls, file: Path) -> "Streets":
        """Return what a file holds, which `build_streets` made."""
        with closing(reading(file)) as database:
            (bounds,) = database.execute("SELECT bounds FROM about").fetchone()
        west, south, east, north = json.loads(bounds)
        return cls(file, file.name.removesuffix(SUFFIX).rpartition(".")[2],
                   (west, south, east, north))

    def tile(self, zoom: int, x: int, y: int) -> bytes | None:
        """Return a tile's JSON, compressed by gzip; None: it shows nothing."""
        with closing(reading(self.file)) as database:
            found = database.execute(
                "SELECT content FROM tile WHERE zoom = ? AND x = ? AND y = ?",
                (zoom, x, y)).fetchone()
        return None if found is None else bytes(found[0])


def build_streets(extract: Path, folders: Sequence[Path]) -> Streets:
    """Return the tiles of an extract, made in the first folder that takes them unless one has them.

    Raises
    ------
    StreetsError
        If the extract can't be drawn.
    OSError
        If it can't be read, or the tiles not be written.
    """
    name = file_name(extract, VERSION, SUFFIX)
    return Streets.opened(made(name, folders, partial(_fill, extract)))


def _fill(extract: Path, database: sqlite3.Connection) -> None:
    drawing = read_drawing(extract)
    database.execute("CREATE TABLE about (bounds TEXT NOT NULL)")
    database.execute("CREATE TABLE tile (zoom INTEGER, x INTEGER, y INTEGER, content BLOB "
                     "NOT NULL, PRIMARY KEY (zoom, x, y)) WITHOUT ROWID")
    database.execute("INSERT INTO about VALUES (?)", (json.dumps(drawing.bounds),))
    parts: dict[Tile, list[str]] = defaultdict(list)
    for kind, (zoom, x, y, lines) in pieces(drawing.shapes):
        parts[zoom, x, y].append(f'"{kind.name}":{_compact(lines)}')
    names: dict[Tile, list[list[object]]] = defaultdict(list)
    for kind, name, (zoom, x, y, lines) in named_pieces(drawing.named):
        names[zoom, x, y].append([kind.name, name, *lines])
    for tile, named in names.items():
        parts[tile].append(f'"names":{_compact(named)}')
    database.executemany("INSERT INTO tile VALUES (?, ?, ?, ?)", _rows(parts))


def _compact(value: object) -> str:
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False)


def _rows(parts: dict[Tile, list[str]]) -> Iterator[tuple[int, int, int, bytes]]:
    for (zoom, x, y), shown in parts.items():
        yield zoom, x, y, gzip.compress(f"{{{','.join(shown)}}}".encode(), mtime=0)
