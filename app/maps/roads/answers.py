"""Answers of road servers, taken whole or not at all."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Annotated, TypeVar

import numpy as np
from pydantic import AliasChoices, BaseModel, ConfigDict, Field, ValidationError
from pyproj import Geod

from app.maps.roads.engine import Block, RoadsAnswerError, RoadTable
from model.problem import BoolArray, FloatArray, IntArray
from model.problem.distances import EARTH_RADIUS_M

NOISE_M = 5.0
"""By how much a true distance may be less than its ends are apart: engines measure along segments,
and answer for two places close together a metre more or less, or even less than none."""

NOISE_S = 0.5
"""By how much a duration may be less than none between two places close together."""

SHARPNESS = 0.99
"""A road's part of the great circle between its ends that it has at least; engines differ in what
they hold for the size of the Earth."""

MAX_SPEED, MAX_DURATION, MAX_DISTANCE = 100.0, 1e8, 1e8
"""Metres per second, seconds and metres beyond which an answer must be wrong."""

SNAP_ERROR, SNAP_ERROR_M = 0.02, 5.0
"""How far a stated distance to the road may be from the true one: by a share, and in metres."""

BEYOND_M = 100_000.0
"""Farther from every road a place is off the roads by any measure, and that of OSRM, who takes
the globe for a plane, is not the true one."""

_SPHERE = Geod(a=EARTH_RADIUS_M, b=EARTH_RADIUS_M)

Numbers = list[list[float | None]]


class Schema(BaseModel):
    """Part of an answer: what is read of it must be there, and of the right type."""

    model_config = ConfigDict(strict=True, allow_inf_nan=False, frozen=True)


Model = TypeVar("Model", bound=BaseModel)


class Snap(Schema):
    """Where a place lies on the road."""

    location: tuple[Annotated[float, Field(ge=-180, le=180)],
                    Annotated[float, Field(ge=-90, le=90)]]
    distance: float | None = Field(
        None, validation_alias=AliasChoices("distance", "snapped_distance"))


def read(model: type[Model], body: bytes) -> Model:
    """Return what a body states.

    Raises
    ------
    RoadsAnswerError
        If it is no such answer.
    """
    try:
        return model.model_validate_json(body)
    except ValidationError as error:
        first = error.errors(include_input=False, include_url=False)[0]
        where = ".".join(map(str, first["loc"]))
        raise RoadsAnswerError(
            f"The server of roads answered nonsense: {where}: {first['msg']}.") from None


def stated_refusal(model: type[Model], body: bytes) -> Model | None:
    """Return why a server refuses, if it says so in its own way: something else may stand before
    it."""
    try:
        return read(model, body)
    except RoadsAnswerError:
        return None


@dataclass(frozen=True)
class BlockAnswer:
    """What was answered to a block."""

    durations_s: FloatArray  # (origin, destination)
    distances_m: FloatArray  # (origin, destination)
    origins: FloatArray  # (origin, 2) where they lie on the road
    destinations: FloatArray  # (destination, 2)


def blocks(wanted: Iterable[Block], most: int) -> list[Block]:
    """Cut blocks into such of at most so many origins and destinations."""
    return [Block(origins, destinations) for block in wanted
            for origins in _cut(block.origins, most)
            for destinations in _cut(block.destinations, most)]


def _cut(places: IntArray, most: int) -> list[IntArray]:
    """Cut places into parts of at most so many, as equal as can be."""
    return np.array_split(places, -(-len(places) // most)) if len(places) else []


def numbers(rows: Numbers, block: Block) -> FloatArray:
    """Return a block's numbers, null as nan.

    Raises
    ------
    RoadsAnswerError
        If these are not as many as were asked for.
    """
    if (len(rows) != len(block.origins)
            or any(len(row) != len(block.destinations) for row in rows)):
        raise RoadsAnswerError("The server of roads answered a table of another size.")
    return np.array(rows, np.float64).reshape(len(block.origins), len(block.destinations))


def snapped_at(snaps: Sequence[Snap | None], lon_lat: FloatArray) -> FloatArray:
    """Return where places lie on the road, (place, 2), nan without one.

    Raises
    ------
    RoadsAnswerError
        If these are others than the places asked for.
    """
    _require(len(snaps) == len(lon_lat), "other places than were asked for")
    nowhere = (np.nan, np.nan)
    found = np.array([nowhere if snap is None else snap.location for snap in snaps]).reshape(-1, 2)
    stated = np.array([np.nan if snap is None or snap.distance is None else snap.distance
                       for snap in snaps])
    true = metres_between(lon_lat, found)
    differs = np.abs(stated - true) > SNAP_ERROR * true + SNAP_ERROR_M
    _require(not (differs & (np.minimum(stated, true) <= BEYOND_M)).any(),
             "other places than were asked for")
    return found


def metres_between(these: FloatArray, those: FloatArray) -> FloatArray:
    """Return the great circles from each of some points to the other at its place, nan for nan."""
    known = np.isfinite(those).all(axis=1)
    metres = np.full(len(these), np.nan)
    metres[known] = _SPHERE.inv(*these[known].T, *those[known].T)[2]
    return metres


def moved(count: int, parts: Iterable[tuple[Block, BlockAnswer]]) -> BoolArray:
    """Tell which of so many places lie on other spots on the road in some blocks than in others."""
    first, differs = np.full((count, 2), np.inf), np.zeros(count, bool)
    for block, part in parts:
        for places, found in ((block.origins, part.origins),
                              (block.destinations, part.destinations)):
            before = first[places]
            before = np.where(np.isposinf(before), found, before)
            first[places] = before
            same = (before == found) | (np.isnan(before) & np.isnan(found))
            differs[places] |= ~same.all(axis=1)
    return differs


class TableAnswer(Schema):
    """What OSRM and openrouteservice answer to a block."""

    durations: Numbers
    distances: Numbers
    sources: list[Snap | None]
    destinations: list[Snap | None]

    def part(self, block: Block, places: FloatArray) -> BlockAnswer:
        """Return what was answered for places, a block's origins before its destinations.

        Raises
        ------
        RoadsAnswerError
            If that was asked of others.
        """
        rows = len(block.origins)
        return BlockAnswer(numbers(self.durations, block), numbers(self.distances, block),
                           snapped_at(self.sources, places[:rows]),
                           snapped_at(self.destinations, places[rows:]))


def joined(lon_lat: FloatArray, parts: Iterable[tuple[Block, BlockAnswer]],
           spread_m: FloatArray | float = 0.0) -> RoadTable:
    """Return the table of all blocks' answers, nan where none answers.

    Parameters
    ----------
    spread_m
        How far from where a place lies on the road its drives may begin or end, (place,) or for
        all.

    Raises
    ------
    RoadsAnswerError
        If it can't be right.
    """
    size = len(lon_lat)
    durations, distances = np.full((2, size, size), np.nan)
    snapped = np.full((size, 2), np.inf)
    ends = np.broadcast_to(np.asarray(spread_m, np.float64), size)
    for block, part in parts:
        here = np.ix_(block.origins, block.destinations)
        durations[here] = np.maximum(part.durations_s, 0.0)
        distances[here] = _plausible(block, part, ends)
        for places, found in ((block.origins, part.origins),
                              (block.destinations, part.destinations)):
            before = np.where(np.isposinf(snapped[places]), found, snapped[places])
            _require(np.array_equal(before, found, equal_nan=True),
                     "two spots on the road for one place")
            snapped[places] = before
    np.fill_diagonal(durations, np.where(np.isfinite(snapped[:, 0]), 0.0, np.nan))
    np.fill_diagonal(distances, np.diagonal(durations))
    return RoadTable(durations, distances, snapped, metres_between(lon_lat, snapped))


def among(near: IntArray, count: int, wanted: Iterable[Block]) -> list[Block]:
    """Return blocks of places that have a road near them, numbered among these."""
    number = np.full(count, -1)
    number[near] = np.arange(len(near))

    def kept(places: IntArray) -> IntArray:
        numbers: IntArray = number[places]
        return numbers[numbers >= 0]

    return [Block(kept(block.origins), kept(block.destinations)) for block in wanted]


def expanded(table: RoadTable, near: IntArray, count: int) -> RoadTable:
    """Return a table of so many places of which only some have a road near them."""
    if len(near) == count:
        return table
    durations, distances = np.full((2, count, count), np.nan)
    snapped, snap_m = np.full((count, 2), np.nan), np.full(count, np.nan)
    durations[np.ix_(near, near)], distances[np.ix_(near, near)] = (
        table.durations_s, table.distances_m)
    snapped[near], snap_m[near] = table.snapped, table.snap_m
    return RoadTable(durations, distances, snapped, snap_m)


def _plausible(block: Block, part: BlockAnswer, spread_m: FloatArray) -> FloatArray:
    """Return a block's distances without noise below zero, if all can be right."""
    near_origin: BoolArray = np.isfinite(part.origins[:, 0])
    near_destination: BoolArray = np.isfinite(part.destinations[:, 0])
    way: BoolArray = np.isfinite(part.durations_s)
    _require(np.array_equal(way, np.isfinite(part.distances_m)), "durations without distances")
    _require(not way[~near_origin].any() and not way[:, ~near_destination].any(),
             "a way for a place without a road")
    lasting, driven = part.durations_s[way], part.distances_m[way]
    _require(bool((lasting >= -NOISE_S).all()) and bool((lasting <= MAX_DURATION).all()),
             "a duration that can't be right")
    own = ((block.origins[:, None] == block.destinations)
           & near_origin[:, None] & near_destination)
    _require(bool((part.durations_s[own] == 0).all() and (part.distances_m[own] == 0).all()),
             "a way from a place to itself")
    straight = _straight_m(part.origins, part.destinations)[way]
    spread = (spread_m[block.origins, None] + spread_m[block.destinations])[way]
    _require(bool((driven >= SHARPNESS * straight - spread - NOISE_M).all())
             and bool((driven <= MAX_DISTANCE).all()), "a distance that can't be right")
    _require(bool((driven <= MAX_SPEED * lasting + MAX_SPEED).all()),
             "a drive that is too fast to be right")
    return np.maximum(part.distances_m, 0.0)


def _straight_m(these: FloatArray, those: FloatArray) -> FloatArray:
    """Return the great circles from each of some points to each of others, to a metre."""
    from_centre = []
    for lon_lat in (these, those):
        longitude, latitude = np.radians(np.nan_to_num(lon_lat)).T
        from_centre.append(np.column_stack((np.cos(latitude) * np.cos(longitude),
                                            np.cos(latitude) * np.sin(longitude),
                                            np.sin(latitude))))
    cosine = np.clip(from_centre[0] @ from_centre[1].T, -1.0, 1.0)
    around: FloatArray = EARTH_RADIUS_M * np.arccos(cosine)
    return around


def _require(holds: bool, otherwise: str) -> None:
    if not holds:
        raise RoadsAnswerError(f"The server of roads answered {otherwise}.")
