"""Arrays of the search where each stop of a route knows those beside it.

Where vehicles make one trip each and distance alone costs, all that an insertion asks of a route is
what is beside one stop, what the vehicle carries, and, where windows are stated, when it leaves
there and has to come at the latest. So nothing is moved, copied or added up along a route: a turn
takes as long on routes of ninety customers as on those of nine. What a turn changes is noted, and
taken back backwards.
"""

from typing import NamedTuple

import numpy as np

from model.engine.library import dtype_of
from model.engine.records import Record, Records, one
from model.problem import BoolArray, Int32Array, IntArray
from model.search.route.layout import NOWHERE, ProblemData
from model.search.route.state import Searcher

MOST_REMOVED = 512
"""How many customers a turn removes at most, to the last string."""

MOMENTS = 4096
"""How many times are noted at least in a turn."""


CACHE_LINE = 64
"""Bytes that come from memory at once."""


class Linked(NamedTuple):
    """Routes as they are, those of the best plan, and what to take back."""

    link: Records  # (node,)
    run: Records  # (slot,)
    piece: Records  # (piece,)
    removed: Records  # (customer,), of the pieces one after another
    removed_node: IntArray  # (customer,) who that is
    entry: Records  # (customer,)
    moment: Records  # (moment,)
    retyped: IntArray  # (slot,) routes that another type drives since this turn
    former: IntArray  # (slot,) the type that did before, else NOWHERE
    noted: Record
    hit: IntArray  # (slot,) turn of the last string
    near: Int32Array  # (node, rank) mm to or from `ProblemData.granular`, or what fits
    best_first: IntArray  # (slot,) first customer of the best plan's route, else NOWHERE
    best_type: IntArray  # (slot,)
    best_behind: IntArray  # (node,)
    cheapest: Record  # costs, of all types
    timed: bool  # something limits when customers are served
    reach: IntArray  # (node,) mm of the longer of a customer's legs; `layout.h` says more
    aboard: Records  # (tier, row) around customers, and where routes begin and end; likewise
    stale: BoolArray  # (slot,) what is aboard isn't written anew yet
    one_travel: bool  # all vehicles drive by the same legs


def make_linked(data: ProblemData, searcher: Searcher, timed: bool) -> Linked:
    """Make room for the routes of a search; `timed` if something limits when customers are served.
    """
    nodes, slots = data.num_nodes, len(searcher.active)
    removed = min(nodes, 2 * MOST_REMOVED)
    cheapest = one(dtype_of("tandem_least"))
    cheapest.distance, cheapest.stop = (data.rate[:data.num_types][field].min()
                                        for field in ("distance", "stop"))
    return Linked(
        link=_in_lines(nodes, dtype_of("tandem_link")),
        run=_in_lines(slots, dtype_of("tandem_run")),
        piece=np.zeros(removed, dtype_of("tandem_piece")),
        removed=np.zeros(removed, dtype_of("tandem_link")),
        removed_node=np.zeros(removed, np.int64),
        entry=np.zeros(nodes, dtype_of("tandem_entry")),
        moment=np.zeros(MOMENTS + 2 * nodes if timed else 0, dtype_of("tandem_moment")),
        retyped=np.zeros(slots, np.int64), former=np.full(slots, NOWHERE),
        noted=one(dtype_of("tandem_noted")),
        hit=np.zeros(slots, np.int64), near=np.zeros(data.granular.shape, np.int32),
        best_first=np.full(slots, NOWHERE), best_type=np.zeros(slots, np.int64),
        best_behind=np.zeros(nodes, np.int64), cheapest=cheapest, timed=timed,
        reach=np.zeros(nodes, np.int64),
        aboard=np.zeros((data.amount.shape[1], nodes + 2 * slots), dtype_of("tandem_stop_load")),
        stale=np.ones(slots, np.bool_),
        one_travel=bool((data.type["travel"][:data.num_types] == data.type["travel"][0]).all()))


def _in_lines(size: int, kind: np.dtype[np.record]) -> Records:
    """Return rows of zeros that begin where a cache line does."""
    room = np.zeros(size * kind.itemsize + CACHE_LINE, np.int8)
    begin = -room.ctypes.data % CACHE_LINE
    return room[begin:begin + size * kind.itemsize].view(kind)
