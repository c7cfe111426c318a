"""What Python sees of a search, which belongs to the engine."""

from typing import TYPE_CHECKING, Any

import numpy as np

from model.engine.handle import Handle
from model.engine.header import interface
from model.engine.lent import lent_row, lent_rows
from model.engine.library import call
from model.search.route.room import Room
from model.search.route.layout import ProblemData


class Searcher:
    """Routes as they are, and as they were at their best: what `tandem_seen` has, by name."""

    def __init__(self, data: ProblemData, room: Room, seed: np.random.SeedSequence) -> None:
        """Make room for a search."""
        self.room = room
        self._own = Handle("search", data, *room)
        seen = interface().new("tandem_seen *")
        call("tandem_look_into", self._own, seen)
        for name, field in interface().typeof(seen).item.fields:
            lent = lent_row if field.type.kind == "pointer" else lent_rows
            setattr(self, name, lent(getattr(seen, name), self._own))
        self.rng[:] = seed.generate_state(1, np.uint64)

    if TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any:
            """Return what is seen."""

    @property
    def pointer(self) -> Any:
        """Return what functions of the engine take."""
        return self._own.pointer
