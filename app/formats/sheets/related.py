"""What rows say of one another and of vehicles -> relations, and prices of other vehicles."""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from typing import Any, NamedTuple

from app.formats.sheets.cells import Doubt
from app.formats.sheets.customers import Entry
from app.formats.sheets.headings import simple
from app.formats.sheets.questions import Question, Questionnaire
from app.formats.sheets.rows import Row
from app.formats.sheets.vans import Van

Data = dict[str, Any]

RELATED: dict[str, Data] = {
    "together": {"kind": "together"}, "apart": {"kind": "apart"},
    "together_on_trip": {"kind": "together", "scope": "trip"},
    "apart_on_trip": {"kind": "apart", "scope": "trip"}}
"""Columns of who goes with whom, and what of relations they state."""

NAMES = ("name", "order", "shipment")
"""Columns by which others name a customer or shipment."""

CUSTOMERS, GROUPS = "customers", "groups"
ONE, ANY = "one", "any"

SHARE_OF_HOUR = 0.25
"""What another vehicle costs where nobody says so, in hours of a driver."""

MOST_NUMBERED = 1000
"""Single vehicles of a type that are known by name."""

class StatedRelation(NamedTuple):
    """A relation of the request, and the first cell that states it."""

    stated: Data
    cell: str


class StatedOrder(NamedTuple):
    """The first cell that states who is before whom, and all rows that do."""

    cell: str
    rows: list[Row]


def relations_of(stops: Sequence[Entry],
                 asking: Questionnaire) -> tuple[list[StatedRelation], list[Doubt]]:
    """Return who is served together, apart or in order, and which names bind nobody. In place.

    A cell names another customer or shipment, or a group that other rows name too. A shipment
    comes before others once it is delivered, and behind them by its first pickup.
    """
    known = stops_called(stops)
    found, alone = _orders(stops, known, asking)
    for kind, stated in RELATED.items():
        groups, first = _groups(stops, kind)
        names_groups = _names_groups(kind, groups, first, known, asking)
        sets: dict[tuple[str, ...], str] = {}
        for name, members in groups.items():
            called = [] if names_groups else known.get(name, [])
            if len({*called, *members}) > 1:
                for group in _sets(kind, called, members):
                    sets.setdefault(tuple(dict.fromkeys(group)), first[name][0])
            else:
                alone.append(_alone(*first[name]))
        found += [StatedRelation({**stated, "customers": list(group)}, cell)
                  for group, cell in sets.items()]
    return found, alone


def _alone(cell: str, text: str) -> Doubt:
    return Doubt("RELATED_TO_NOBODY", f"{text!r} ({cell}) is neither another customer nor on "
                 "another row, and binds nobody.", cell=cell, values={"name": text})


def _orders(stops: Sequence[Entry], known: Mapping[str, Sequence[str]],
            asking: Questionnaire) -> tuple[list[StatedRelation], list[Doubt]]:
    """Return who is served before whom, and which names are nobody's. In place."""
    orders: dict[tuple[str, str], StatedOrder] = {}
    alone = []
    for stop in stops:
        for row, meaning in product(stop.rows, ("before", "after")):
            for text in _named(row, meaning):
                others = [other for other in known.get(simple(text), ())
                          if other != stop.last]
                alone += [] if others else [_alone(row.cell(meaning), text)]
                for other in others:
                    pair = stop.last, other
                    orders.setdefault(pair if meaning == "before" else pair[::-1],
                                      StatedOrder(row.cell(meaning), [])).rows.append(row)
    alone += _lags_alone(stops, orders.values())
    if not orders:
        return [], alone
    begins = {stop.last: stop.first for stop in stops}
    (first, second), (cell, _) = next(iter(orders.items()))
    answer = asking.ask(Question(
        "orders", "orders", f"Some are served before others, such as {first!r} before {second!r} "
        f"({cell}): by one vehicle?",
        {ONE: "By one vehicle", ANY: "By any, trucks alone"}, ONE,
        {"count": len(orders), "first": first[:80], "second": second[:80]}, cell=cell))
    across = {} if answer == ONE else {"same_vehicle": False}
    return [StatedRelation({"kind": "before", "customers": [before, begins[behind]], **across,
                            **_lags(order.rows)}, order.cell)
            for (before, behind), order in orders.items()], alone


def _lags(rows: Iterable[Row]) -> Data:
    """Return the least and the longest time between two, the tighter where rows differ."""
    found: Data = {}
    for meaning, tighter in (("min_lag", max), ("max_lag", min)):
        stated = [row.values[meaning] for row in rows if row.get(meaning) is not None]
        found |= {meaning: tighter(stated)} if stated else {}
    return found


def _lags_alone(stops: Sequence[Entry], orders: Iterable[StatedOrder]) -> list[Doubt]:
    """Return what is told of rows with a time between two, and nobody before or behind."""
    ordered = {row.number for order in orders for row in order.rows}
    cells = [row.cell("min_lag", "max_lag") for stop in stops for row in stop.rows
             if row.number not in ordered and _lags([row])]
    return [Doubt("LAG_WITHOUT_ORDER", f"{len(cells)} rows state a time between two, such as "
                  f"{cells[0]}, and nobody who is served before or after: it isn't used.",
                  cell=cells[0], values={"count": len(cells)})] if cells else []


def stops_called(stops: Sequence[Entry]) -> dict[str, list[str]]:
    """Return the stops by their names and order numbers, each as relations call its last end."""
    found: dict[str, list[str]] = defaultdict(list)
    for stop in stops:
        names = [row.get(meaning) for row in stop.rows for meaning in NAMES]
        for name in {simple(str(name)) for name in (stop.customer["id"], *names) if name}:
            found[name].append(stop.last)
    return found


def _names_groups(kind: str, groups: Mapping[str, Sequence[str]],
                  first: Mapping[str, tuple[str, str]], known: Mapping[str, Sequence[str]],
                  asking: Questionnaire) -> bool:
    """Return whether cells name groups alone; ask where names are customers' too. In place."""
    either = [name for name, members in groups.items() if name in known and len(members) > 1]
    if not either:
        return False
    cell, text = first[either[0]]
    # Who counts rows and groups counts both from 1.
    default = GROUPS if all(name.isdecimal() for name in either) else CUSTOMERS
    return asking.ask(Question(
        f"related:{kind}", "related", f"Several rows name {text!r} ({cell}), and so is a customer "
        "called: do they name the customer, or a group of rows?",
        {CUSTOMERS: "Customers", GROUPS: "Groups: rows with the same name"}, default,
        {"name": text[:80], "count": len(either)}, cell=cell)) == GROUPS


def _groups(stops: Sequence[Entry], kind: str) -> tuple[
        dict[str, list[str]], dict[str, tuple[str, str]]]:
    """Return who names each name, and the first cell that does with its words."""
    groups: dict[str, list[str]] = defaultdict(list)
    first: dict[str, tuple[str, str]] = {}
    for stop in stops:
        for row in stop.rows:
            for text in _named(row, kind):
                name = simple(text)
                first.setdefault(name, (row.cell(kind), text))
                if stop.last not in groups[name]:
                    groups[name].append(stop.last)
    return groups, first


def _sets(kind: str, called: Sequence[str], members: Sequence[str]) -> Iterable[list[str]]:
    """Yield who is bound: those who name a group, or each of them to the one that they name."""
    if RELATED[kind]["kind"] == "apart" and called:
        for stop in called:
            yield from (sorted((stop, member)) for member in members if stop != member)
    else:
        yield [*called, *members]


def _named(row: Row, meaning: str) -> list[str]:
    return [text for texts in row.get(meaning) or () for text in texts or ()]


def price_others(stops: Sequence[Entry], fleet: Sequence[Data],
                 vans: Sequence[Van]) -> list[Doubt]:
    """Have vehicles cost what rows say, or what they do where others are preferred. In place."""
    known = _vehicles(fleet, vans)
    assumed = round(SHARE_OF_HOUR * fleet[0]["costs"]["per_hour"], 2)
    unknown: list[tuple[str, str]] = []
    without_price = []
    for stop in stops:
        unknown += _price_each(stop, known)
        row = next((row for row in stop.rows if row.get("preferred_vehicles")), stop.rows[0])
        texts = row.get("preferred_vehicles") or ()
        unknown += [(row.cell("preferred_vehicles"), text) for text in texts
                    if simple(text) not in known]
        preferred = {known[simple(text)] for text in texts if simple(text) in known}
        if not preferred:
            continue
        price = row.get("preference_cost")
        if price is None:
            price = assumed
            without_price.append(row.cell("preferred_vehicles"))
        costs = {kind["id"]: price for kind in fleet if kind["id"] not in preferred}
        costs |= dict.fromkeys(sorted(preferred - {kind["id"] for kind in fleet}), 0)
        if any(costs.values()):
            stop.customer["vehicle_costs"] = costs | stop.customer.get("vehicle_costs", {})
    return _preference_doubts(unknown, without_price, assumed)


def _price_each(stop: Entry, known: Mapping[str, str]) -> list[tuple[str, str]]:
    """Have vehicles cost what a stop's rows say of each; return who is unknown. In place."""
    unknown = []
    for row in stop.rows:
        for text, price in row.get("vehicle_costs") or ():
            if simple(text) in known:
                stop.customer.setdefault("vehicle_costs", {})[known[simple(text)]] = price
            else:
                unknown.append((row.cell("vehicle_costs"), text))
    return unknown


def _vehicles(fleet: Sequence[Data], vans: Sequence[Van]) -> dict[str, str]:
    """Return types and single vehicles by what they are called, or their drivers are."""
    found: dict[str, str] = {}
    for kind in fleet:
        found.setdefault(simple(kind["id"]), kind["id"])
    for kind, van in zip(fleet, vans, strict=False):
        if van.driver:
            found.setdefault(simple(van.driver), kind["id"])
    for kind in fleet:
        for number in range(1, min(kind["count"], MOST_NUMBERED) + 1):
            found.setdefault(simple(f"{kind['id']}-{number}"), f"{kind['id']}-{number}")
    return found


def _preference_doubts(unknown: Sequence[tuple[str, str]], without_price: Sequence[str],
                       assumed: float) -> list[Doubt]:
    doubts = []
    if unknown:
        cell, text = unknown[0]
        doubts.append(Doubt("PREFERENCE_UNKNOWN", f"{len(unknown)} vehicles or drivers that rows "
                            f"prefer or price are none of the fleet's, such as {text!r} ({cell}): "
                            "nothing is made of that. List them on a sheet of vehicles.",
                            cell=cell, values={"count": len(unknown), "name": text}))
    if without_price:
        doubts.append(Doubt("PREFERENCE_ASSUMED", f"{len(without_price)} customers prefer a "
                            f"vehicle and don't say how much, such as {without_price[0]}: any "
                            f"other is taken to cost {assumed:g} more.", cell=without_price[0],
                            values={"count": len(without_price), "amount": assumed}))
    return doubts
