"""The plan that a search holds."""

from model.search.beginning.translate import left_out, read_routes
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.solution import Solution


def read_plan(data: ProblemData, searcher: Searcher) -> Solution:
    """Return the best plan found, each trip begun as late as costs nothing."""
    return Solution(tuple(read_routes(data, searcher)), left_out(searcher))
