"""Shipments left out, inserted by ejecting others.

References
----------
Nagata and Kobayashi (2010), guided ejection search for the pickup and delivery problem with time
windows, EvoCOP.
Curtois, Landa-Silva, Qu and Laesanklang (2018), large neighbourhood search with adaptive guided
ejection search for the pickup and delivery problem with time windows, EURO Journal on
Transportation and Logistics 7:151-192.
"""

from collections.abc import Callable

from model.engine.alarm import Alarm
from model.engine.library import call
from model.problem import UNLIMITED
from model.search.limits import Cooling
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.worker import SearchThread

MOST_ROUNDS = 10**9
"""More than there is time for."""

LIMITS = "max_trip_distance", "max_distance", "max_working_duration", "max_travel_duration"
"""Of vehicles, which aren't looked at."""


def can_eject(data: ProblemData) -> bool:
    """Tell whether all are ends of shipments, and windows and loads alone limit vehicles."""
    if not len(data.pair) or data.num_types > 1:
        return False
    kind, how, first = data.type[0], data.evaluation[0], data.num_depots
    once = (kind["max_trips"] == 1 and not how["priced"] and not kind["must_rest"]
            and all(kind[most] >= UNLIMITED for most in LIMITS))
    anyhow = not (kind["lifo"] or kind["pickup_order"] or kind["changes_ends"]
                  or kind["keeps_hours"] or len(data.goods) or len(data.setup) or len(data.hub))
    pair, nodes = data.pair[first:], range(first, data.num_nodes)
    paired = (pair["partner"] >= 0).all() and (pair["next_place"] == list(nodes)).all()
    own = data.node["release"].any() or data.amount[first:, :, :3].any()
    return bool(once and anyhow and paired and data.node.shape[2] == 1 and not own)


def by_ejection(data: ProblemData, searcher: Searcher, workers: list[SearchThread], span: Cooling,
                gently: bool = False) -> Callable[[], bool] | None:
    """Return what inserts all shipments left out among the routes; None where that can't be.

    It changes the search in place until the span of it ends, and tells whether all are inserted; if
    not, routes are as they were, or the best ones. Rounds count as turns of each worker. `gently`:
    shipments that are served are moved only where ways become hardly longer.
    """
    limits = workers[0].limits

    def eject() -> bool:
        most, end = limits.span_end(span)
        with Alarm(min(end, limits.deadline), limits.should_stop) as alarm:
            made, done = call("tandem_eject", data._replace(deadline=alarm.setting), searcher,
                              int(min(most - workers[0].turns, MOST_ROUNDS)), gently)
        for worker in workers:
            worker.turns += made
        return bool(done)

    return eject if can_eject(data) else None
