"""What the engine does with the routes of a search.

Worlds and searches are given as they are, or packed where they are given often: to pack a
search takes as long as some of its turns.
"""

from model.engine.library import call
from model.engine.packing import Packed
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher

ANY = -1
"""No order of insertion in particular: one is drawn each turn."""
BY_FAR, BY_WIDTH = 2, 4
"""Orders in which customers are inserted: who is farthest from the depot first, or who has the
least time."""

LONGEST_STRING = 10
"""How many stops a string has at most, but where `Searcher.value` allows more on long routes."""


def anneal(data: ProblemData | Packed, searcher: Searcher, turns: int, order: int) -> None:
    """Ruin and recreate `turns` times. In place.

    Given an `order`, nobody is removed, all who are left out are inserted in it, and that is kept
    whatever it costs.
    Once the search must end, a turn is given up as if it had not begun, and an insertion of all
    leaves out whoever is not inserted yet.
    """
    call("tandem_anneal", data, searcher, turns, order)


def go_back(searcher: Searcher) -> None:
    """Go on from the best routes. In place."""
    call("tandem_go_back", searcher)


def take_better_parts(data: ProblemData | Packed, searcher: Searcher) -> None:
    """Let the best plan take over the parts of the routes as they are that cost less. In place."""
    call("tandem_take_better_parts", data, searcher)


def leg_cost(data: ProblemData | Packed, searcher: Searcher) -> tuple[float, float]:
    """Return what the truck's legs between customers cost on average, and those left out in all.

    Where there are no legs, a share of the whole cost; always above zero.
    """
    leg, missing = call("tandem_leg_cost", data, searcher)
    return leg, missing
