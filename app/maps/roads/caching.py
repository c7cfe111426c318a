"""Tables of roads that were answered before, in memory and in files that processes share.

Tables are filed under their places, to six decimals of a degree, and a scope: whatever else decides
the answers. What is filed was answered whole; files are written under another name first.
"""

import hashlib
import os
import tempfile
import threading
from collections import OrderedDict
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

import numpy as np

from app.maps.roads.engine import RoadTable
from model.problem import BoolArray, FloatArray, IntArray

DECIMALS = 6

MEMORY_BYTES = 256 * 2**20

TABLES_SEARCHED = 16
"""Latest tables that are looked through for one with more places than those asked for."""

_OF_ONE_SIDE = 2**61
"""More than any place's number."""

_SIDE_COLUMNS = 3  # where a place is on the road, and how far from there


class _Filed(NamedTuple):
    scope: str
    places: IntArray  # sorted
    rows: IntArray  # of these places
    table: RoadTable


class TableCache:
    """Tables by scope and places.

    Parameters
    ----------
    folder
        Where files are; None: nowhere.
    disk_bytes, memory_bytes
        Most bytes of tables there and here; those not used for longest are let go.
    """

    def __init__(self, folder: Path | None = None, disk_bytes: int = 2**30,
                 memory_bytes: int = MEMORY_BYTES) -> None:
        self._folder = folder if disk_bytes else None
        self._disk_bytes = disk_bytes
        self._memory_bytes = memory_bytes
        self._lock = threading.Lock()
        self._filed: OrderedDict[str, _Filed] = OrderedDict()

    def get(self, scope: str, lon_lat: FloatArray,
            curb: BoolArray | None = None) -> RoadTable | None:
        """Return the table between places, if it or a larger one is known.

        Parameters
        ----------
        curb
            (place,) whether it is that to one side of the street. None: of none.
        """
        places = _numbers(lon_lat, curb)
        key = _key(scope, places)
        with self._lock:
            if key in self._filed:
                self._filed.move_to_end(key)
                return self._filed[key].table
            latest = list(reversed(self._filed.values()))[:TABLES_SEARCHED]
        for filed in latest:
            rows = _rows_in(filed, places) if filed.scope == scope else None
            if rows is not None:
                return part_of(filed.table, rows)
        table = self._read(key, len(lon_lat))
        if table is not None:
            self._keep(key, scope, places, table)
        return table

    def overlap(self, scope: str, lon_lat: FloatArray,
                curb: BoolArray | None = None) -> tuple[RoadTable, IntArray] | None:
        """Return a table with at least half of the places, and the row of each, -1 for none."""
        places = _numbers(lon_lat, curb)
        with self._lock:
            latest = list(reversed(self._filed.values()))[:TABLES_SEARCHED]
        best, fewest = None, len(places) // 2
        for filed in latest:
            if filed.scope != scope or not len(filed.places):
                continue
            found = np.minimum(np.searchsorted(filed.places, places), len(filed.places) - 1)
            rows = np.where(filed.places[found] == places, filed.rows[found], -1)
            missing = int((rows < 0).sum())
            if missing <= fewest:
                best, fewest = (filed.table, rows), missing
        return best

    def put(self, scope: str, lon_lat: FloatArray, table: RoadTable,
            curb: BoolArray | None = None) -> None:
        """File a table. In place."""
        places = _numbers(lon_lat, curb)
        key = _key(scope, places)
        self._keep(key, scope, places, table)
        if self._folder is not None and _size(table) <= self._disk_bytes:
            # What can't be written is asked for again, some time.
            with suppress(OSError):
                self._write(self._folder, key, table)

    def _keep(self, key: str, scope: str, places: IntArray, table: RoadTable) -> None:
        if _size(table) > self._memory_bytes:
            return
        rows = np.argsort(places, kind="stable")
        for part in (table.durations_s, table.distances_m, table.snapped, table.snap_m):
            part.flags.writeable = False
        with self._lock:
            self._filed[key] = _Filed(scope, places[rows], rows, table)
            self._filed.move_to_end(key)
            total = sum(_size(filed.table) for filed in self._filed.values())
            while total > self._memory_bytes:
                total -= _size(self._filed.popitem(last=False)[1].table)

    def _read(self, key: str, size: int) -> RoadTable | None:
        if self._folder is None:
            return None
        path = self._folder / f"{key}.npy"
        try:
            whole = np.load(path, allow_pickle=False)
            os.utime(path)
        except (OSError, ValueError, EOFError):
            return None
        if whole.shape != (size, 2 * size + _SIDE_COLUMNS) or whole.dtype != np.float64:
            return None
        return RoadTable(whole[:, :size], whole[:, size:2 * size], whole[:, -3:-1], whole[:, -1])

    def _write(self, folder: Path, key: str, table: RoadTable) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        whole = np.column_stack((table.durations_s, table.distances_m, table.snapped,
                                 table.snap_m))
        descriptor, name = tempfile.mkstemp(dir=folder, prefix=".")
        try:
            with os.fdopen(descriptor, "wb") as file:
                np.save(file, whole, allow_pickle=False)
            os.replace(name, folder / f"{key}.npy")
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
        self._shrink(folder)

    def _shrink(self, folder: Path) -> None:
        """Delete files not used for longest until the others are few enough. In place."""
        files = sorted(_states(folder))
        total = sum(size for _, size, _ in files)
        for _, size, path in files:
            if total <= self._disk_bytes:
                break
            path.unlink(missing_ok=True)
            total -= size


def part_of(table: RoadTable, rows: IntArray) -> RoadTable:
    """Return the part of a table between some of its places."""
    both = np.ix_(rows, rows)
    return RoadTable(table.durations_s[both], table.distances_m[both], table.snapped[rows],
                     table.snap_m[rows])


def _states(folder: Path) -> Iterator[tuple[float, int, Path]]:
    """Yield when each file was used last, and its size."""
    for path in folder.glob("*.npy"):
        with suppress(FileNotFoundError):
            state = path.stat()
            yield state.st_mtime, state.st_size, path


def _numbers(lon_lat: FloatArray, curb: BoolArray | None) -> IntArray:
    """Return a number for each place, another one for its side of the street."""
    lon, lat = np.rint(lon_lat * 10**DECIMALS).astype(np.int64).T
    numbers: IntArray = lon * 10**9 + lat
    return numbers if curb is None else numbers + curb * _OF_ONE_SIDE


def _key(scope: str, places: IntArray) -> str:
    return hashlib.sha256(scope.encode() + b"\0" + places.tobytes()).hexdigest()


def _rows_in(filed: _Filed, places: IntArray) -> IntArray | None:
    """Return the rows of places in a table, if it has all of them."""
    if len(filed.places) < len(places):
        return None
    found = np.minimum(np.searchsorted(filed.places, places), len(filed.places) - 1)
    return filed.rows[found] if np.array_equal(filed.places[found], places) else None


def _size(table: RoadTable) -> int:
    return table.durations_s.nbytes + table.distances_m.nbytes
