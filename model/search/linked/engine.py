"""What the engine does with the linked routes of a search. As `route.engine`."""

from model.engine.library import call
from model.engine.packing import Packed
from model.search.linked.layout import Linked
from model.search.route.engine import ANY
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher


def tie(data: ProblemData | Packed, searcher: Searcher, linked: Linked) -> None:
    """Link the routes of a search as they are, and of its best plan. In place."""
    call("tandem_tie", data, searcher, linked)


def anneal_linked(data: ProblemData | Packed, searcher: Searcher, linked: Linked,
                  turns: int) -> None:
    """Ruin and recreate `turns` times among linked stops. In place. As `anneal`."""
    call("tandem_anneal_linked", data, searcher, linked, turns, ANY)


def insert_linked(data: ProblemData | Packed, searcher: Searcher, linked: Linked,
                  order: int) -> None:
    """Link the routes of a search, insert all who are left out in an order and write them back.

    In place. Once the search must end, whoever is not inserted yet is left out.
    """
    call("tandem_anneal_linked", data, searcher, linked, 0, order)


def write_back(data: ProblemData | Packed, searcher: Searcher,
               linked: Linked) -> None:
    """Let the routes of a search, and of its best plan, be those that are linked. In place."""
    call("tandem_write_back", data, searcher, linked)
