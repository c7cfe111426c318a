"""Plans by insertion alone, for the search to begin with."""

import math
from collections.abc import Callable

import numpy as np

from model.engine.alarm import has_rung
from model.engine.library import call
from model.search.linked.engine import insert_linked
from model.search.linked.layout import Linked
from model.search.route.engine import BY_FAR, BY_WIDTH, anneal, go_back
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher

CONSTRUCTED = (BY_FAR, BY_WIDTH)
"""Orders in which customers are inserted into no routes."""


def insert_missing(data: ProblemData, searcher: Searcher, order: int,
                   linked: Linked | None = None) -> None:
    """Insert all customers left out, one after another, by linked stops if there are. In place.

    Once more those for whom the only place, such as a route of their own, was overlooked.
    """
    for _ in range(2):
        if linked is None:
            anneal(data, searcher, 1, order)
        else:
            insert_linked(data, searcher, linked, order)
        if searcher.count.missing == 0:
            return


def begin_anew(data: ProblemData, searcher: Searcher, freely: bool,
               hurried: ProblemData | None = None, linked: Linked | None = None) -> None:
    """Insert the customers left out; `freely`, plan all anew if that is better. In place.

    The latter in a `hurried` data, which is the same and may end sooner: a search then has more of
    the time, which finds room for those left out, too. But where nobody has to be served, a plan
    for few may be far cheaper than one that was begun for all.
    """
    if searcher.count.missing > 0:
        insert_missing(data, searcher, BY_FAR, linked)
    if hurried is None or data.all_optional:
        hurried = data
    if freely and not has_rung(hurried.deadline):
        _construct(hurried, searcher, linked)


def begin_again(data: ProblemData, searcher: Searcher, linked: Linked | None = None) -> None:
    """Plan all anew by insertion, whatever there is. In place."""
    searcher.value.best = math.inf
    _construct(data, searcher, linked)


def begin_by_types(data: ProblemData, whole: Searcher, is_over: Callable[[], bool]) -> None:
    """Plan anew by vehicles of one type after another as far as they go. In place: the best plan.

    What a route costs its first customer says nothing of how many more a larger vehicle serves.
    """
    alone = whole.alone.copy()
    dearest = float(alone[np.isfinite(alone)].max(initial=0.0))
    for k in range(data.num_types):
        if is_over():
            return
        whole.alone[:] = alone + dearest
        whole.alone[k] = alone[k]
        begin_anew(data, whole, True)
        whole.alone[:] = alone


def _construct(data: ProblemData, searcher: Searcher, linked: Linked | None) -> None:
    """Plan anew by insertion in the best of several orders, if that is better. In place."""
    for order in CONSTRUCTED:
        call("tandem_disband", data, searcher)
        insert_missing(data, searcher, order, linked)
    go_back(searcher)
