"""What legs the search sees, and who is near to whom: by far the largest of its arrays."""

from collections.abc import Sequence
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from model.engine.instance import Instance
from model.engine.leg import COMPUTED, GLOBE, AllLegs, ComputedLegs
from model.engine.library import call, dtype_of
from model.engine.nearest import least_columns, write_nearest_points
from model.engine.pausing import Pause, go_on, matrix_blocks, row_blocks
from model.engine.records import Records
from model.engine.variants import Variation, are_stated, ways_of
from model.problem import UNLIMITED, Int32Array, IntArray, Problem, StraightLegs, Travel
from model.problem.quantities import NO_LEG
from model.search.neighbourhood.numbering import Numbering, along_neighbours, as_stated

NEAR_RUIN = 128
"""How many customers a ruin may spread to."""

ROWS = 64
"""For how many customers neighbours are ranked together; pages for all at once would take longer to
get."""

RENUMBERED = 4096
"""Whose neighbours get the search's numbers together."""

NEAR_INSERTION = 40
"""Beside how many customers an insertion is tried where not everywhere is."""


Whole = TypeVar("Whole", np.int32, np.int64)


class Neighbourhood(NamedTuple):
    """What a problem's search sees, whatever it may do."""

    leg: AllLegs
    back: AllLegs
    near: Int32Array
    granular: Int32Array
    numbering: Numbering


def make_neighbourhood(problem: Problem, instance: Instance, pause: Pause = go_on,
               along: bool = False) -> Neighbourhood:
    """Lay out the legs of a problem, and rank each customer's neighbours; `pause` may end it.

    `along` numbers customers along their neighbours.
    """
    returns = [travel.straight is not None or _is_symmetric(travel, pause)
               for travel in problem.travel]
    same_back = returns[problem.vehicle_types[0].travel]
    near = _near(problem, same_back, pause)
    granular = _granular(problem, instance.node[0, 0, :, 0], near, same_back, pause)
    numbering = as_stated(problem.num_nodes)
    if along:
        numbering = along_neighbours(near, problem.num_depots)
        near, granular = (_numbers_of(ranked, numbering, pause) for ranked in (near, granular))
    leg, back = _legs(problem, returns, instance.setup[0], numbering, pause)
    return Neighbourhood(leg, back, near, granular, numbering)


def _numbers_of(ranked: Int32Array, numbering: Numbering, pause: Pause) -> Int32Array:
    """Return neighbours (node, rank), -1 for none, in the search's numbers."""
    number, numbers = numbering.number.astype(np.int32), np.empty_like(ranked)
    for rows in row_blocks(len(ranked), RENUMBERED, pause):
        others = ranked[numbering.node[rows]]
        numbers[rows] = np.where(others >= 0, number[others], others)
    return numbers


def _legs(problem: Problem, returns: Sequence[bool], setup: Records, numbering: Numbering,
          pause: Pause) -> tuple[AllLegs, AllLegs]:
    """Return all legs in the search's numbers, and those back; `setup` has the SETUP of nodes.

    `returns` says of which matrices legs are the same both ways.
    """
    ways = ways_of(problem)
    law = np.zeros(len(ways), dtype_of("tandem_leg_law"))
    point = np.zeros(problem.num_nodes, dtype_of("tandem_point"))
    stated: list[Variation] = []
    for index, way in enumerate(ways):
        straight = problem.travel[way.travel].straight
        if straight is None or way.launch or way.recovery:
            law[index].table = len(stated)
            stated.append(way)
        else:
            law[index] = _law(straight, way)
            for axis, at in zip("xyz", straight.points.at.T, strict=False):
                point[axis] = at
    if len(setup):
        point["site"], point["setup_duration"] = setup["site"], setup["setup_duration"]
    directions = 1 if all(returns[way.travel] and not way.sets_up and way.launch == way.recovery
                          for way in stated) else 2
    if are_stated(problem, ways):
        narrow = _tables(problem, stated, directions, setup, numbering.node, np.int32, pause)
        leg = narrow[0]
        return leg, leg if len(narrow) == 1 else narrow[1]
    tables = _tables(problem, stated, directions, setup, numbering.node, np.int64, pause)
    legs = ComputedLegs(tables, _in_order(point, numbering), law)
    return legs, legs


def _in_order(point: Records, numbering: Numbering) -> Records:
    """Return nodes in the search's order, each with its number."""
    point = point[numbering.node]
    point["node"] = np.arange(len(point))
    return point


def _law(straight: StraightLegs, way: Variation) -> tuple[int | float, ...]:
    points = straight.points
    return (COMPUTED, GLOBE if points.on_globe else points.rounding, straight.more,
            straight.nowhere, int(way.sets_up), points.metres, straight.pace)


def _tables(problem: Problem, ways: Sequence[Variation], directions: int, setup: Records,
            node: IntArray, kind: type[Whole], pause: Pause) -> NDArray[Whole]:
    """Return the legs that were stated, (direction, table, node, node, 2), in 32 or 64 bits."""
    num_depots = problem.num_depots
    if not ways:
        return np.empty((1, 1, len(node), 0, 2), kind)
    legs = np.empty((directions, len(ways), len(node), len(node), 2), kind)
    write = "tandem_write_narrow_legs" if kind is np.int32 else "tandem_write_legs"
    for index, way in enumerate(ways):
        travel = problem.travel[way.travel]
        held = travel.narrow() if kind is np.int32 else None
        duration, distance = map(np.ascontiguousarray, held or travel.arrays())
        for rows in matrix_blocks(len(node), pause):
            call(write, duration, distance, node, rows.start, legs[0, index, rows])
            if way.sets_up:
                _add_setups(legs[0, index, rows, :, 0], setup, node[rows], node)
        if way.launch or way.recovery:
            _add_handling(legs[0, index, ..., 0], way, num_depots)
    for index in range(len(ways) if directions > 1 else 0):
        for rows in matrix_blocks(len(node), pause):
            legs[1, index, rows] = legs[0, index, :, rows].transpose(1, 0, 2)
    return legs


def _add_setups(durations: NDArray[Whole], setup: Records, origin: IntArray, to: IntArray) -> None:
    """Let legs last longer by the setup at their end, if there are any. In place."""
    elsewhere = setup["site"][origin, None] != setup["site"][to]
    if durations.dtype == np.int32:
        elsewhere &= durations != NO_LEG
    durations += elsewhere * setup["setup_duration"][to]


def _add_handling(durations: NDArray[Whole], way: Variation, num_depots: int) -> None:
    """Let legs last longer from depots by the launch, and to them by the recovery. In place."""
    for part, more in ((durations[:num_depots], way.launch),
                       (durations[:, :num_depots], way.recovery)):
        part += (part != NO_LEG) * more if durations.dtype == np.int32 else more


def _is_symmetric(travel: Travel, pause: Pause) -> bool:
    """Tell whether legs that were stated are the same both ways."""
    return all(bool((matrix[rows] == matrix[:, rows].T).all())
               for matrix in travel.narrow() or travel.arrays()
               for rows in row_blocks(len(matrix), ROWS, pause))


def _near(problem: Problem, same_back: bool, pause: Pause) -> Int32Array:
    """Return each customer's closest others by the first type's drive, there or back.

    (node, rank), nearest first; -1 for depots and behind the last. `same_back`: either is as long.
    """
    first, number = problem.num_depots, problem.num_customers
    ranks = max(1, min(NEAR_RUIN, number - 1))
    near = np.full((problem.num_nodes, ranks), -1, np.int32)
    if number > 1:
        travel = problem.travel[problem.vehicle_types[0].travel]
        if travel.straight is not None:
            write_nearest_points(travel.straight.points.at[first:], near[first:], pause)
            near[first:] += first
            return near
        for rows in row_blocks(number, ROWS, pause):
            some = slice(first + rows.start, first + rows.stop)
            drive = travel.duration[some, first:].astype(np.float32)
            if not same_back:
                np.minimum(drive, travel.duration[first:, some].T, out=drive)
            drive[np.arange(len(drive)), np.arange(rows.start, rows.stop)] = np.inf
            near[first:][rows] = least_columns(drive, ranks) + first
    return near


def _granular(problem: Problem, place: Records, near: Int32Array, same_back: bool, pause: Pause
              ) -> Int32Array:
    """Return the granular neighbourhood: whom a truck would best visit before or after each.

    `same_back`: drives take as long there as back.

    References
    ----------
    Vidal, Crainic, Gendreau and Prins (2013), a hybrid genetic algorithm with adaptive diversity
    management for a large class of vehicle routing problems with time windows, Computers and
    Operations Research 40:475-489.
    """
    ranks = min(NEAR_INSERTION, near.shape[1])
    granular = near[:, :ranks].copy()
    first, number = problem.num_depots, problem.num_customers
    earliest, service, latest = (place[field].astype(np.float64) for field in (
        "window_earliest", "service_duration", "window_latest"))
    if number < 3 or (earliest.max() == 0.0 and latest[first:].min() >= UNLIMITED):
        return granular
    travel = problem.travel[problem.vehicle_types[0].travel]
    for rows in row_blocks(number, ROWS, pause):
        one = np.arange(first + rows.start, first + rows.stop)[:, None]
        other = near[first:][rows].astype(np.int64)
        there = back = np.ascontiguousarray(travel.duration[one, other])
        if not same_back:
            back = np.ascontiguousarray(travel.duration[other, one])
        weight = np.empty(other.shape)
        call("tandem_write_misfit", there, back, other, first + rows.start, earliest, service,
             latest, weight)
        granular[first:][rows] = np.take_along_axis(other, least_columns(weight, ranks), axis=1)
    return granular
