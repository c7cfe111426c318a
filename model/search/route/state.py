"""What Python sees of a search; the engine owns all but what inserting a customer alone costs."""

from typing import NamedTuple

import numpy as np

from model.engine.handle import Handle
from model.engine.header import interface
from model.engine.lent import lent_row, lent_rows
from model.engine.library import call
from model.engine.records import Record
from model.problem import FloatArray, IntArray, UIntArray
from model.search.route.layout import Fleet, ProblemData

ALL = -1
"""Stands for all slots where those are counted that changed since the best."""


class Searcher(NamedTuple):
    """Routes as they are, and as they were at their best."""

    now: Fleet
    best: Fleet  # who is where is not noted
    count: Record
    value: Record
    rng: UIntArray  # (1,)
    active: IntArray  # slots in use, and behind them those that are free
    missing: IntArray  # customers left out
    best_missing: IntArray
    absences: IntArray  # (node,) turns after which a customer was left out
    alone: FloatArray  # (type, 2, node) cost of a route that serves one customer
    own: Handle  # its memory, and what it works with

    @classmethod
    def opened(cls, data: ProblemData, room: tuple[int, int, int, int], alone: FloatArray,
               seed: np.random.SeedSequence) -> "Searcher":
        """Make room for a search: so many routes, and of each so many stops, trips and sorties."""
        own, seen = Handle("search", data, *room), interface().new("tandem_searcher *")
        call("tandem_look_into", own, seen)
        now, best = (Fleet(*(lent_rows(getattr(fleet, name), own) for name in Fleet._fields))
                     for fleet in (seen.now, seen.best))
        rows = {name: lent_rows(getattr(seen, name), own)
                for name in ("rng", "active", "missing", "best_missing", "absences")}
        rows["rng"][:] = seed.generate_state(1, np.uint64)
        return cls(now=now, best=best, count=lent_row(seen.count, own),
                   value=lent_row(seen.value, own), alone=alone, own=own, **rows)
