"""Plans by insertion alone, for the search to begin with."""

import math

from model.engine.alarm import has_rung
from model.engine.library import call
from model.search.route.engine import BY_FAR, BY_WIDTH, anneal, go_back, missing_cost
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher

CONSTRUCTED = (BY_FAR, BY_WIDTH)
"""Orders in which customers are inserted into no routes."""


def insert_missing(data: ProblemData, searcher: Searcher, order: int) -> None:
    """Insert all customers left out, one after another. In place.

    Once more those for whom the only place, such as a route of their own, was overlooked.
    """
    anneal(data, searcher, 1, order)
    if searcher.count.missing > 0:
        anneal(data, searcher, 1, order)


def begin_anew(data: ProblemData, searcher: Searcher, freely: bool,
               hurried: ProblemData | None = None) -> None:
    """Insert the customers left out; `freely`, plan all anew if that is better. In place.

    The latter in a `hurried` data, which is the same and may end sooner: a search then has more of
    the time, which finds room for those left out, too. But where nobody has to be served, a plan
    for few may be far cheaper than one that was begun for all.
    """
    if searcher.count.missing > 0:
        insert_missing(data, searcher, BY_FAR)
    if hurried is None or data.all_optional:
        hurried = data
    if freely and not has_rung(hurried.deadline):
        _construct(hurried, searcher)


def begin_again(data: ProblemData, searcher: Searcher) -> None:
    """Plan all anew by insertion, whatever there is. In place."""
    searcher.value.best = math.inf
    _construct(data, searcher)


def _construct(data: ProblemData, searcher: Searcher) -> None:
    """Plan anew by insertion in the best of several orders, if that is better. In place."""
    for order in CONSTRUCTED:
        call("tandem_disband", searcher)
        searcher.value.cost = missing_cost(data, searcher)
        insert_missing(data, searcher, order)
    go_back(searcher)
