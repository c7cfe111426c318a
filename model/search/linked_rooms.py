"""Room for the linked routes of a search's threads."""

from model.search.linked.engine import measure_near
from model.search.linked.layout import Linked, make_linked
from model.search.problem_data import are_timed, can_be_linked
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher


def linked_rooms(data: ProblemData, whole: Searcher, threads: int) -> list[Linked | None]:
    """Return room for linked routes for each thread; None where routes can't be linked."""
    if not can_be_linked(data):
        return [None] * threads
    first, *others = (make_linked(data, whole, are_timed(data)) for _ in range(threads))
    measure_near(data, first)
    return [first, *(other._replace(near=first.near) for other in others)]
