"""Who belongs together as rows for the engine: shipments, what is aboard between and how long, and
places of one customer.
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from model.engine.library import dtype_of
from model.engine.records import Records
from model.problem import IntArray, Lag, Problem, VehicleType


def empty_pairs(problems: Sequence[Problem], nodes: int) -> Records:
    """Allocate rows of who belongs together, (problem, node); (problem, 0) where nobody does."""
    some = any(problem.shipments or problem.choices for problem in problems)
    rows = np.zeros((len(problems), nodes if some else 0), dtype_of("tandem_pair"))
    rows["partner"] = -1
    rows["unit"] = rows["next_place"] = np.arange(rows.shape[1])
    return rows


def empty_limits(problems: Sequence[Problem], types: int, nodes: int, far: int) -> IntArray:
    """Allocate limits, (problem, type, node), all `far`; (problem, 0, 0) where there are none."""
    some = any(problem.limits_time_between for problem in problems)
    return np.full((len(problems), types if some else 0, nodes if some else 0), far, np.int64)


def write_pairs(problem: Problem, rows: Records) -> IntArray:
    """Write the other end at each end, (node,). In place; return the ends, (end, 3).

    Each as its node, the number of its shipment, and whether that is delivered there.
    """
    for each in problem.shipments:
        rows[each.delivery] = (each.pickup, 1, each.pickup, each.delivery)
        for pickup, after in pairwise((*each.pickups, each.pickup)):
            rows[pickup] = (each.delivery, 0, each.pickup, after)
    return np.array([(node, number, node == each.delivery)
                     for number, each in enumerate(problem.shipments) for node in each.nodes])


def write_choices(problem: Problem, rows: Records) -> None:
    """Write which places are those of one customer, (node,). In place."""
    for places in problem.choices:
        rows["unit"][[*places]] = places[0]
        rows["next_place"][[*places]] = (*places[1:], places[0])


def write_aboard(problem: Problem, rows: IntArray, size: int) -> None:
    """Write what comes aboard, (node, tier, amount), in tiers of so many dimensions. In place.

    At a delivery that is less than nothing.
    """
    for each in problem.shipments:
        for node in each.nodes:
            amount = np.zeros(rows.shape[1] * size, np.int64)
            amount[:problem.num_dimensions] = each.change_at(node)
            rows[node, :, size:2 * size] = amount.reshape(-1, size)


def write_limits(problem: Problem, kinds: Sequence[VehicleType], rows: IntArray) -> None:
    """Write how long shipments may be under way, (type, node), where that is limited. In place."""
    for index, kind in enumerate(kinds):
        duration = problem.travel[kind.travel].duration
        for each in problem.shipments:
            for pickup in each.pickups if each.is_limited else ():
                limit = each.longest_between(duration.item(pickup, each.delivery))
                if limit is not None:
                    rows[index, pickup] = min(limit, rows.item(index, pickup))


def lag_rows(problems: Sequence[Problem], nodes: int) -> dict[str, Records]:
    """Return how long behind others customers are served, by one vehicle or any."""
    across = _rows_of([each.lags_across for each in problems], nodes)
    # Whoever waits for those served before waits as for others on the same route.
    least = 1 if across.shape[1] else 0
    return {"lag": _rows_of([each.lags for each in problems], nodes, least), "across": across}


def _rows_of(behind: Sequence[Mapping[int, Sequence[Lag]]], nodes: int, least: int = 0) -> Records:
    """Return (problem, node, rank) lags, ranks `least` or more; (problem, 0, 0) if that is none."""
    most = max([len(lags) for each in behind for lags in each.values()], default=least)
    rows = np.zeros((len(behind), nodes if most else 0, most), dtype_of("tandem_lag"))
    rows["node"] = -1
    for row, each in zip(rows, behind, strict=True):
        for node, lags in each.items():
            row[node, : len(lags)] = [tuple(lag) for lag in lags]
    return rows
