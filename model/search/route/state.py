"""What one thread of the search holds."""

from typing import NamedTuple

from model.engine.records import Record, Records
from model.problem import BoolArray, FloatArray, IntArray, UIntArray
from model.search.route.layout import Fleet

ALL = -1
"""Stands for all slots where those are counted that changed since the best."""


class Searcher(NamedTuple):
    """Routes as they are, as they were before this turn, and as they were at their best."""

    now: Fleet
    before: Fleet  # those touched this turn, as they are listed there; who is where is not noted
    best: Fleet  # likewise not
    count: Record
    value: Record
    rng: UIntArray  # (1,)
    active: IntArray  # slots in use, and behind them those that are free
    rank: IntArray  # (slot,) where it stands in `active`
    changed: IntArray  # slots changed since the best
    is_changed: BoolArray  # (slot,) it is among those
    missing: IntArray  # customers left out
    best_missing: IntArray
    absent: IntArray  # to be inserted this turn, behind those left alone
    touched: IntArray  # slots changed this turn
    marked: BoolArray  # (node,) removed this turn
    absences: IntArray  # (node,) turns after which a customer was left out
    hit: IntArray  # (slot, trip) turn of the last string
    alone: FloatArray  # (type, 2, node) cost of a route that serves one customer
    kept_stamp: IntArray  # (node, slot) of the route whose best insertion is kept
    kept_move: Records  # (node, slot) that insertion
    kept_cost: FloatArray  # (node, slot) what it costs
