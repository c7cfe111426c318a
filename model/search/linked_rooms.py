"""Room for the linked routes of a search's threads."""

from model.search.linked.layout import Linked
from model.search.problem_data import are_timed, can_be_linked
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher


def linked_rooms(data: ProblemData, whole: Searcher, threads: int) -> list[Linked | None]:
    """Return room for linked routes for each thread; None where routes can't be linked."""
    if not can_be_linked(data):
        return [None] * threads
    timed = are_timed(data)
    first = Linked(data, whole, timed)
    return [first, *(Linked(data, whole, timed, first) for _ in range(threads - 1))]
