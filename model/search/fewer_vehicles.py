"""Plans by fewer vehicles, where each costs more than all that they do.

A route is given up, and those whom it served are inserted among the others, by turns that prefer to
leave out whom they seldom did (`engine/search/turn.h`); once all are served, the next. Shipments
are inserted by ejecting others instead, where that can be (`model/search/ejection.py`).

References
----------
Christiaens and Vanden Berghe (2020), slack induction by string removals for vehicle routing
problems, Transportation Science 54:417-433.
"""

from collections.abc import Callable

import numpy as np

from model.engine.library import call
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.sharing import go_on_from_best

FEWER_SHARE = 0.4
"""Share of the search in which plans by fewer vehicles are looked for, where these cost most."""


def vehicles_first(data: ProblemData, searcher: Searcher) -> bool:
    """Tell whether all are served, and a truck costs more than all that those there are do."""
    fixed = float(data.rate["fixed"][0])
    return bool(data.num_types == 1 and data.type["drones"][0] == 0 and not data.type["flies"][0]
                and searcher.count.missing == 0 and not data.all_optional
                and fixed > float(searcher.value.cost) - fixed_costs(data, searcher))


def fixed_costs(data: ProblemData, searcher: Searcher) -> float:
    """Return what vehicles of the first type cost as they are, whatever they do."""
    return float(data.rate["fixed"][0]) * int(searcher.count.active)


def search_fewer(data: ProblemData, whole: Searcher, search: Callable[[], None],
                 is_over: Callable[[], bool], eject: Callable[[], bool] | None) -> None:
    """Search in rounds until it is over for plans by fewer vehicles. In place: go on from the best.

    Meanwhile there are no more vehicles than are to be used. `eject` inserts all who are left out,
    and tells whether that came about; None: only rounds do.
    """
    count = data.type["count"]
    most = int(count[0])
    try:
        while not is_over():
            go_on_from_best(data, whole)
            used = int(whole.count.active)
            if used <= _fewest(data):
                return
            count[0] = used - 1
            call("tandem_give_up_route", data, whole)
            if eject is not None and not eject():
                break
            while whole.best_used.sum() >= used and not is_over():
                search()
        go_on_from_best(data, whole)
    finally:
        count[0] = most


def _fewest(data: ProblemData) -> int:
    """Return how many routes there are at least, where what each customer is brought tells."""
    least = data.fairness.min_vehicles - int(data.fairness.used)
    if len(data.pair) or data.type["max_trips"][0] > 1:
        return max(1, least)
    demand = data.node["demand"][0, data.num_depots:, 0].sum(axis=0)
    capacity = data.type["capacity"][0][:len(demand)]
    some = capacity > 0
    return max(1, least, int(np.ceil(demand[some] / capacity[some]).max(initial=1)))
