"""What Python sees of a search, which belongs to the engine."""

from typing import TYPE_CHECKING, Any

import numpy as np

from model.engine.handle import Handle
from model.engine.lent import lent_fields
from model.search.route.room import Room
from model.search.route.layout import ProblemData


class Searcher:
    """Routes as they are, and as they were at their best: what `tandem_seen` has, by name."""

    def __init__(self, data: ProblemData, room: Room, seed: np.random.SeedSequence) -> None:
        """Make room for a search."""
        self.room = room
        self._own = Handle("search", data, *room)
        vars(self).update(lent_fields("tandem_look_into", self._own))
        self.rng[:] = seed.generate_state(1, np.uint64)

    if TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any:
            """Return what is seen."""

    @property
    def pointer(self) -> Any:
        """Return what functions of the engine take."""
        return self._own.pointer
