"""Tables of OSRM: in JSON, as any of its servers answers, or in numbers as they are in memory.

In memory (FlatBuffers) a large table is a third of the work: to write its numbers as text and to
read them takes longer than to find the ways. Two things are missing there, and asked for in JSON
beside it: where places lie on the road to a decimetre, and the difference between no way and a way
of no length. For that OSRM looks for half of the ways once more, so small tables are asked for in
JSON alone.
"""

import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from flatbuffers import encode, number_types, packer
from flatbuffers.table import Table

from app.maps.remote.asking import RemoteCall, RemoteServer, ShouldStop
from app.maps.roads.answers import (
    BlockAnswer, Numbers, Schema, Snap, TableAnswer, metres_between, numbers, read, snapped_at,
)
from app.maps.roads.engine import Block, RoadsAnswerError
from model.problem import BoolArray, FloatArray, IntArray

BYTES_PER_LEG, BYTES_PER_PLACE, BYTES_BESIDES = 64, 1_024, 65_536
"""More than an answer holds for a leg of a table (both numbers), for a place, and besides."""

EXACT_UP_TO = 400_000.0
"""Seconds and metres up to which a number of 32 bits tells one decimal."""

LEGS_PER_PLACE = 400
"""From so many on numbers as they are in memory save more time than they cost."""

SAME_SPOT_M = 2.0
"""Farther apart on the road no two places have a way of no length."""

TABLE, DURATIONS, ROWS, COLUMNS, DISTANCES = 14, 4, 6, 8, 10
"""Where OSRM's schema has these fields: the first of an answer, the others of its table."""

_BOTH = "duration,distance"


@dataclass(frozen=True, eq=False)
class AskedBlock:
    """A block of a table, and how it is asked for."""

    block: Block
    path: str  # with the places, without a format
    query: str  # whatever is asked of them
    places: FloatArray  # (place, 2) all that are named
    origins: IntArray  # of these
    destinations: IntArray  # of these

    def address(self, origins: IntArray, destinations: IntArray, annotations: str = _BOTH,
                form: str = "") -> str:
        """Return what to ask for legs between some of the places."""
        return (f"{self.path}{form}?annotations={annotations}{self.query}"
                f"&sources={_listed(origins)}&destinations={_listed(destinations)}")

    @property
    def whole(self) -> str:
        """The longest of what is asked for."""
        return self.address(self.origins, self.destinations)


TableForm = Callable[[RemoteServer, Sequence[AskedBlock], float, ShouldStop], list[BlockAnswer]]
"""Asks for blocks of tables; raises `RoadsError` if one isn't answered whole and in time."""


class _Table(TableAnswer):
    code: Literal["Ok"]


class _Legs(Schema):
    code: Literal["Ok"]
    durations: Numbers
    distances: Numbers


class _Spots(Schema):
    code: Literal["Ok"]
    destinations: list[Snap | None]


def quickest(asking: RemoteServer, asked: Sequence[AskedBlock], until: float,
             should_stop: ShouldStop) -> list[BlockAnswer]:
    """Ask for large blocks as numbers of 32 bits, and for others as text."""
    is_large = {one: len(one.origins) * len(one.destinations) >= LEGS_PER_PLACE * len(one.places)
                for one in asked}
    parts: dict[AskedBlock, BlockAnswer] = {}
    for form, chosen in ((in_json, False), (in_floats, True)):
        some = [one for one in asked if is_large[one] == chosen]
        if some:
            parts |= zip(some, form(asking, some, until, should_stop), strict=True)
    return [parts[one] for one in asked]


def in_json(asking: RemoteServer, asked: Sequence[AskedBlock], until: float,
            should_stop: ShouldStop) -> list[BlockAnswer]:
    """Ask for blocks as text."""
    return asking.ask([RemoteCall(one.whole, partial(_part, one), _most_bytes(one))
                       for one in asked], until, should_stop)


def in_floats(asking: RemoteServer, asked: Sequence[AskedBlock], until: float,
              should_stop: ShouldStop) -> list[BlockAnswer]:
    """Ask for blocks as numbers of 32 bits, and in JSON for what these leave open."""
    questions: list[RemoteCall[Any]] = [*map(_floats, asked), *map(_spots, asked)]
    answers = asking.ask(questions, until, should_stop)
    tables, spots = answers[:len(asked)], answers[len(asked):]
    parts = [_joined(one, at, table)
             for one, at, table in zip(asked, spots, tables, strict=True)]
    _settle(asking, list(zip(asked, parts, strict=True)), until, should_stop)
    return parts


def _part(asked: AskedBlock, body: bytes) -> BlockAnswer:
    places = asked.places[[*asked.origins, *asked.destinations]]
    return read(_Table, body).part(asked.block, places)


def _most_bytes(asked: AskedBlock) -> int:
    rows, columns = len(asked.origins), len(asked.destinations)
    return rows * columns * BYTES_PER_LEG + (rows + columns) * BYTES_PER_PLACE + BYTES_BESIDES


def _spots(asked: AskedBlock) -> RemoteCall[FloatArray]:
    """Return how to ask where all places lie on the road: with as few legs as can be."""
    everywhere = np.arange(len(asked.places))
    return RemoteCall(asked.address(everywhere[:1], everywhere, "duration"),
                      lambda body: snapped_at(read(_Spots, body).destinations, asked.places),
                      len(everywhere) * (BYTES_PER_LEG + BYTES_PER_PLACE) + BYTES_BESIDES)


def _floats(asked: AskedBlock) -> RemoteCall[tuple[FloatArray, FloatArray]]:
    rows, columns = len(asked.origins), len(asked.destinations)
    address = asked.address(asked.origins, asked.destinations, form=".flatbuffers")
    return RemoteCall(f"{address}&skip_waypoints=true", partial(floats, rows, columns),
                      2 * rows * columns * np.float32().itemsize + BYTES_BESIDES)


def floats(rows: int, columns: int, body: bytes) -> tuple[FloatArray, FloatArray]:
    """Return durations and distances of an answer in FlatBuffers, (origin, destination).

    Raises
    ------
    RoadsAnswerError
        If it is none, or of another size.
    """
    try:
        root = Table(body, encode.Get(packer.uoffset, body, 0))
        table = Table(body, root.Indirect(root.Pos + root.Offset(TABLE)))
        size = tuple(table.GetSlot(field, 0, number_types.Uint16Flags)
                     for field in (ROWS, COLUMNS))
        durations, distances = (table.GetVectorAsNumpy(number_types.Float32Flags,
                                                       table.Offset(field))
                                for field in (DURATIONS, DISTANCES))
    except (struct.error, TypeError, ValueError) as error:
        raise RoadsAnswerError("The server of roads answered nonsense.") from error
    if size != (rows, columns) or not len(durations) == len(distances) == rows * columns:
        raise RoadsAnswerError("The server of roads answered a table of another size.")
    if not (np.isfinite(durations).all() and np.isfinite(distances).all()):
        raise RoadsAnswerError("The server of roads answered numbers that are none.")
    return _tenths(durations, rows, columns), _tenths(distances, rows, columns)


def _tenths(single: npt.NDArray[np.float32], rows: int, columns: int) -> FloatArray:
    """Return what OSRM writes in JSON for numbers of 32 bits."""
    tenths = single.astype(np.float64).reshape(rows, columns)
    return np.round(tenths, 1, out=tenths)


def _joined(asked: AskedBlock, spots: FloatArray,
            table: tuple[FloatArray, FloatArray]) -> BlockAnswer:
    """Return a part in which there is no way of no length between spots that are apart."""
    part = BlockAnswer(*table, spots[asked.origins], spots[asked.destinations])
    rows, columns = np.nonzero((part.durations_s == 0) & (part.distances_m == 0))
    metres = metres_between(part.origins[rows], part.destinations[columns])
    # Not finite where a place is on no road.
    apart = ~(metres <= SAME_SPOT_M)
    for legs in table:
        legs[rows[apart], columns[apart]] = np.nan
    return part


def _settle(asking: RemoteServer, parts: Sequence[tuple[AskedBlock, BlockAnswer]], until: float,
            should_stop: ShouldStop) -> None:
    """Ask in JSON for legs that numbers of 32 bits don't tell. In place."""
    doubts = [(asked, part, doubtful) for asked, part in parts
              if (doubtful := _doubtful(asked, part)).any()]
    if not doubts:
        return
    questions = [_some_legs(asked, Block(*map(_any_of, (doubtful, doubtful.T))))
                 for asked, _, doubtful in doubts]
    answers = asking.ask(questions, until, should_stop)
    for (_, part, doubtful), (durations, distances) in zip(doubts, answers, strict=True):
        some = np.ix_(_any_of(doubtful), _any_of(doubtful.T))
        here = doubtful[some]
        for legs, told in ((part.durations_s, durations), (part.distances_m, distances)):
            legs[some] = np.where(here, told, legs[some])


def _doubtful(asked: AskedBlock, part: BlockAnswer) -> BoolArray:
    """Tell which legs are told by JSON alone, (origin, destination)."""
    own = asked.origins[:, None] == asked.destinations
    nothing = (part.durations_s == 0) & (part.distances_m == 0) & ~own
    far: BoolArray = (part.durations_s > EXACT_UP_TO) | (part.distances_m > EXACT_UP_TO)
    return nothing | far


def _any_of(doubtful: BoolArray) -> IntArray:
    return np.flatnonzero(doubtful.any(axis=1))


def _some_legs(asked: AskedBlock, some: Block) -> RemoteCall[tuple[FloatArray, FloatArray]]:
    def told(body: bytes) -> tuple[FloatArray, FloatArray]:
        answer = read(_Legs, body)
        return numbers(answer.durations, some), numbers(answer.distances, some)

    address = asked.address(asked.origins[some.origins], asked.destinations[some.destinations])
    return RemoteCall(f"{address}&skip_waypoints=true", told,
                      len(some.origins) * len(some.destinations) * BYTES_PER_LEG + BYTES_BESIDES)


def _listed(places: IntArray) -> str:
    return ";".join(map(str, places.tolist()))
