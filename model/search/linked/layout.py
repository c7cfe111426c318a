"""Arrays of the search where each stop of a route knows those beside it.

Where vehicles make one trip each and distance alone costs, all that an insertion asks of a route is
what is beside one stop, what the vehicle carries, and, where windows are stated, when it leaves
there and has to come at the latest. So nothing is moved, copied or added up along a route: a turn
takes as long on routes of ninety customers as on those of nine. What a turn changes is noted, and
taken back backwards.
"""

from typing import NamedTuple

import numpy as np

from model.kernel.instance import TIER
from model.kernel.records import Record, Records, one, record
from model.problem import Int32Array, IntArray
from model.search.route.layout import NOWHERE, World
from model.search.route.state import Searcher

LINK = record("slot", "before", "behind", "inward", "onward", "gap", "leave", "latest")
"""A customer: the slot of the route; who comes before and behind, or the depot there; how far it is
from there and to there, and how long it takes from there; when the vehicle leaves, and when it has
to come at the latest. Times are kept only where something limits them. A cache line."""

RUN = record("type", "first", "last", "count", "distance", load=TIER)
"""A route: its first and last customer, how many there are, and how far it is driven. Where there
is nobody, its end comes first and its beginning last."""

PIECE = record("slot", "type", "count", "gap", "saved")
"""Customers in a row that were taken out this turn: of which route, driven by which type then; how
many; how long the leg to who came behind took; and how much shorter the route is without them."""

ENTRY = record("node", "onward", "gap")
"""A customer inserted this turn, and how far and how long it was where it went between."""

MOMENT = record("node", "leave", "latest")
"""Times of a customer before they changed this turn."""

NOTED = record("pieces", "removed", "entries", "moments", "retyped", "over")
"""How many of each were noted this turn, and whether there were more moments than there is room."""

LEAST = record(distance=float, stop=float)
"""What the vehicle costs at least that a mm more is driven by, and that serves a customer more."""

MOST_REMOVED = 512
"""How many customers a turn removes at most, to the last string."""

MOMENTS = 4096
"""How many times are noted at least in a turn."""


class Linked(NamedTuple):
    """Routes as they are, those of the best plan, and what to take back."""

    link: Records  # (node,) LINK
    run: Records  # (slot,) RUN
    piece: Records  # (piece,) PIECE
    removed: Records  # (customer,) LINK, of the pieces one after another
    removed_node: IntArray  # (customer,) who that is
    entry: Records  # (customer,) ENTRY
    moment: Records  # (moment,) MOMENT
    retyped: IntArray  # (slot,) routes that another type drives since this turn
    former: IntArray  # (slot,) the type that did before, else NOWHERE
    noted: Record  # NOTED
    hit: IntArray  # (slot,) turn of the last string
    near: Int32Array  # (node, rank) mm to or from those that `World.fit` lists, or what fits
    best_first: IntArray  # (slot,) first customer of the best plan's route, else NOWHERE
    best_type: IntArray  # (slot,)
    best_behind: IntArray  # (node,)
    cheapest: Record  # LEAST, of all types
    timed: bool  # something limits when customers are served


def make_linked(world: World, searcher: Searcher, timed: bool) -> Linked:
    """Make room for the routes of a search; `timed` if something limits when customers are served.
    """
    nodes, slots = world.num_nodes, len(searcher.active)
    removed = min(nodes, 2 * MOST_REMOVED)
    cheapest = one(LEAST)
    cheapest.distance, cheapest.stop = (world.rate[:world.num_types][field].min()
                                        for field in ("distance", "stop"))
    return Linked(
        link=np.zeros(nodes, LINK), run=np.zeros(slots, RUN), piece=np.zeros(removed, PIECE),
        removed=np.zeros(removed, LINK), removed_node=np.zeros(removed, np.int64),
        entry=np.zeros(nodes, ENTRY),
        moment=np.zeros(MOMENTS + 2 * nodes if timed else 0, MOMENT),
        retyped=np.zeros(slots, np.int64), former=np.full(slots, NOWHERE), noted=one(NOTED),
        hit=np.zeros(slots, np.int64), near=np.zeros(world.fit.shape, np.int32),
        best_first=np.full(slots, NOWHERE), best_type=np.zeros(slots, np.int64),
        best_behind=np.zeros(nodes, np.int64), cheapest=cheapest, timed=timed)
