"""Routes of a search where each stop knows those beside it; they belong to the engine.

Where vehicles make one trip each and distance alone costs, all that an insertion asks of a route is
what is beside one stop, what the vehicle carries, and, where windows are stated, when it leaves
there and has to come at the latest. So nothing is moved, copied or added up along a route: a turn
takes as long on routes of ninety customers as on those of nine. What a turn changes is noted, and
taken back backwards.
"""

from model.engine.handle import Handle
from model.engine.header import interface
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher

MOMENTS = 4096
"""How many changes of times are noted at least in a turn."""


class Linked(Handle):
    """Routes as they are, those of the best plan, and what to take back."""

    def __init__(self, data: ProblemData, searcher: Searcher, timed: bool,
                 like: "Linked | None" = None, moments: int | None = None) -> None:
        """Make room for the routes of a search; `timed` if something limits when anybody is served.

        Neighbours are as near as in those of another thread, if they are given. `moments`: how many
        changes of times are noted in a turn; None: as many as are usual.
        """
        if moments is None:
            moments = MOMENTS + 2 * data.num_nodes
        super().__init__("linked", data, searcher, moments if timed else 0,
                         interface().NULL if like is None else like)
