"""Who belongs together as rows for the engine: shipments, what is aboard between and how long, and
places of one customer.
"""

from collections.abc import Mapping, Sequence

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
    """Write the other end at each end, (node,). In place; return the ends, (shipment, 2)."""
    for each in problem.shipments:
        rows[[each.pickup, each.delivery]] = [
            (each.delivery, 0, each.pickup, each.pickup),
            (each.pickup, 1, each.pickup, each.delivery)]
    return np.array([(each.pickup, each.delivery) for each in problem.shipments])


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
        amount = np.zeros(rows.shape[1] * size, np.int64)
        amount[:len(each.amount)] = each.amount
        rows[each.pickup, :, size:2 * size] = amount.reshape(-1, size)
        rows[each.delivery, :, size:2 * size] = -amount.reshape(-1, size)


def write_limits(problem: Problem, kinds: Sequence[VehicleType], rows: IntArray) -> None:
    """Write how long shipments may be under way, (type, node), where that is limited. In place."""
    for index, kind in enumerate(kinds):
        duration = problem.travel[kind.travel].duration
        for each in problem.shipments:
            limit = each.longest_between(duration.item(each.pickup, each.delivery))
            if limit is not None:
                rows[index, each.pickup] = min(limit, rows.item(index, each.pickup))


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
