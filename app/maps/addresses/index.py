"""The addresses of an extract in one file, made once and kept beside what else is made of it."""

import sqlite3
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing
from functools import partial
from itertools import islice
from pathlib import Path

import numpy as np
import shapely

from app.maps.addresses.reading import House, Street, Town, read_addresses, read_towns
from app.maps.addresses.spelling import house_numbers, key_of, split_number
from app.maps.streets.filing import file_name, made, reading

VERSION = 1
"""Of what the file holds."""

SUFFIX = ".addresses"

BATCH = 10_000

TABLES = """
CREATE TABLE street (id INTEGER PRIMARY KEY, name TEXT NOT NULL, town TEXT NOT NULL,
                     lon REAL, lat REAL);
CREATE TABLE called (key TEXT NOT NULL, street INTEGER NOT NULL, PRIMARY KEY (key, street))
    WITHOUT ROWID;
CREATE TABLE house (street INTEGER NOT NULL, number INTEGER NOT NULL, letter TEXT NOT NULL,
                    stated TEXT NOT NULL, suburb TEXT NOT NULL, postcode TEXT NOT NULL,
                    lon REAL NOT NULL, lat REAL NOT NULL);
CREATE TABLE town (key TEXT NOT NULL, name TEXT NOT NULL, lon REAL NOT NULL, lat REAL NOT NULL);
CREATE VIRTUAL TABLE spelt USING fts5(key, tokenize = 'trigram', detail = 'none');
"""

INDEXES = """
CREATE INDEX house_by_number ON house (street, number);
CREATE INDEX town_by_key ON town (key);
INSERT INTO spelt (key) SELECT DISTINCT key FROM called;
INSERT INTO spelt (spelt) VALUES ('optimize');
"""


def build_index(extract: Path, folders: Sequence[Path]) -> Path:
    """Return the file with an extract's addresses, made unless it is in one of the folders.

    Raises
    ------
    AddressesError
        If the extract's addresses can't be read.
    OSError
        If it can't be read, or the file not be written.
    """
    return made(file_name(extract, VERSION, SUFFIX), folders, partial(_fill, extract))


def find_index(extract: Path, folders: Sequence[Path]) -> Path | None:
    """Return the file with an extract's addresses, if it was made."""
    name = file_name(extract, VERSION, SUFFIX)
    return next((folder / name for folder in folders if (folder / name).exists()), None)


def num_houses(file: Path) -> int:
    """Return how many house numbers a file has."""
    with closing(reading(file)) as database:
        (count,) = database.execute("SELECT count(*) FROM house").fetchone()
    return int(count)


def _fill(extract: Path, database: sqlite3.Connection) -> None:
    database.executescript(TABLES)
    towns = read_towns(extract)
    database.executemany("INSERT INTO town VALUES (?, ?, ?, ?)", (
        (key_of(name), town.names[0], town.lon, town.lat) for town in towns for name in town.names))
    filling = _Filling(database, towns)
    entries = read_addresses(extract)
    while batch := list(islice(entries, BATCH)):
        filling.add(batch)
    filling.finish()


class _Filling:
    """Streets by name and town, while they are read."""

    def __init__(self, database: sqlite3.Connection, towns: Sequence[Town]) -> None:
        self._database = database
        self._towns = towns
        self._tree = shapely.STRtree(shapely.points([(town.lon, town.lat) for town in towns])
                                     if towns else [])
        self._streets: dict[tuple[str, str], int] = {}

    def add(self, batch: Sequence[House | Street]) -> None:
        """Write some down. In place."""
        towns = self._nearest_towns(batch)
        houses: list[tuple[object, ...]] = []
        for entry, nearest in zip(batch, towns, strict=True):
            if isinstance(entry, House):
                street = self._street((entry.street,), _town(entry) or nearest)
                houses += _rows(street, entry)
            else:
                street = self._street(entry.names, nearest)
                self._database.execute("UPDATE street SET lon = ?, lat = ? WHERE id = ? AND lon "
                                       "IS NULL", (entry.lon, entry.lat, street))
        self._database.executemany("INSERT INTO house VALUES (?, ?, ?, ?, ?, ?, ?, ?)", houses)

    def finish(self) -> None:
        """Put streets without a way where their houses are, and make indexes. In place."""
        self._database.executescript(INDEXES)
        self._database.execute(
            "UPDATE street SET (lon, lat) = (SELECT avg(lon), avg(lat) FROM house "
            "WHERE house.street = street.id) WHERE lon IS NULL")

    def _nearest_towns(self, batch: Iterable[House | Street]) -> list[str]:
        places = [(entry.lon, entry.lat) for entry in batch]
        if not self._towns:
            return [""] * len(places)
        nearest = np.asarray(self._tree.nearest(shapely.points(places)))
        return [self._towns[town].names[0] for town in nearest.tolist()]

    def _street(self, names: Sequence[str], town: str) -> int:
        """Return a street's number, written down under all its names. In place."""
        place = key_of(names[0]), key_of(town)
        street = self._streets.get(place)
        is_new = street is None
        if street is None:
            street = self._streets[place] = len(self._streets) + 1
            self._database.execute("INSERT INTO street (id, name, town) VALUES (?, ?, ?)",
                                   (street, names[0], town))
        if is_new or len(names) > 1:
            self._database.executemany("INSERT OR IGNORE INTO called VALUES (?, ?)", (
                (key, street) for name in names if (key := key_of(name))))
        return street


def _town(house: House) -> str:
    """Return the town that a house states, unless what stands there is no name."""
    return house.town if any(map(str.isalpha, house.town)) else ""


def _rows(street: int, house: House) -> Iterator[tuple[object, ...]]:
    for number in house_numbers(house.number):
        value, letter = split_number(number)
        yield (street, value, letter, house.number, house.suburb, house.postcode, house.lon,
               house.lat)
