"""What rows say of one another and of vehicles -> relations, and prices of other vehicles."""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from typing import Any, NamedTuple

from app.formats.sheets.cells import Doubt
from app.formats.sheets.customers import Entry
from app.formats.sheets.headings import simple
from app.formats.sheets.questions import Asking, Question
from app.formats.sheets.rows import Row
from app.formats.sheets.vans import Van

RELATED = ("together", "apart")
NAMES = ("name", "order", "shipment")
"""Columns by which others name a customer or shipment."""

CUSTOMERS, GROUPS = "customers", "groups"
ONE, ANY = "one", "any"

SHARE_OF_HOUR = 0.25
"""What another vehicle costs where nobody says so, in hours of a driver."""

MOST_NUMBERED = 1000
"""Single vehicles of a type that are known by name."""

Data = dict[str, Any]


class Relation(NamedTuple):
    """A relation of the request, and the first cell that states it."""

    stated: Data
    cell: str


def relations_of(stops: Sequence[Entry],
                 asking: Asking) -> tuple[list[Relation], list[Doubt]]:
    """Return who is served together, apart or in order, and which names bind nobody. In place.

    A cell names another customer or shipment, or a group that other rows name too. A shipment
    comes before others once it is delivered, and behind them by its first pickup.
    """
    known = stops_called(stops)
    found, alone = _orders(stops, known, asking)
    for kind in RELATED:
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
        found += [Relation({"kind": kind, "customers": list(group)}, cell)
                  for group, cell in sets.items()]
    return found, alone


def _alone(cell: str, text: str) -> Doubt:
    return Doubt("RELATED_TO_NOBODY", f"{text!r} ({cell}) is neither another customer nor on "
                 "another row, and binds nobody.", cell=cell)


def _orders(stops: Sequence[Entry], known: Mapping[str, Sequence[str]],
            asking: Asking) -> tuple[list[Relation], list[Doubt]]:
    """Return who is served before whom, and which names are nobody's. In place."""
    pairs: dict[tuple[str, str], str] = {}
    alone = []
    for stop in stops:
        for row, meaning in product(stop.rows, ("before", "after")):
            for text in _named(row, meaning):
                others = [other for other in known.get(simple(text), ())
                          if other != stop.last]
                alone += [] if others else [_alone(row.cell(meaning), text)]
                for other in others:
                    pair = stop.last, other
                    pairs.setdefault(pair if meaning == "before" else pair[::-1],
                                     row.cell(meaning))
    if not pairs:
        return [], alone
    begins = {stop.last: stop.first for stop in stops}
    (first, second), cell = next(iter(pairs.items()))
    answer = asking.ask(Question(
        "orders", "orders", f"Some are served before others, such as {first!r} before {second!r} "
        f"({cell}): by one vehicle?",
        {ONE: "By one vehicle", ANY: "By any, trucks alone"}, ONE,
        {"count": len(pairs), "first": first[:80], "second": second[:80]}, cell=cell))
    across = {} if answer == ONE else {"same_vehicle": False}
    return [Relation({"kind": "before", "customers": [before, begins[behind]], **across}, cell)
            for (before, behind), cell in pairs.items()], alone


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
                  asking: Asking) -> bool:
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
    if kind == "apart" and called:
        for stop in called:
            yield from (sorted((stop, member)) for member in members if stop != member)
    else:
        yield [*called, *members]


def _named(row: Row, meaning: str) -> list[str]:
    return [text for texts in row.get(meaning) or () for text in texts or ()]


def price_others(stops: Sequence[Entry], fleet: Sequence[Data],
                 vans: Sequence[Van]) -> list[Doubt]:
    """Have vehicles cost what they do where others are preferred; tell of doubts. In place."""
    known = _vehicles(fleet, vans)
    assumed = round(SHARE_OF_HOUR * fleet[0]["costs"]["per_hour"], 2)
    unknown: list[tuple[str, str]] = []
    without_price = []
    for stop in stops:
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
            stop.customer["vehicle_costs"] = costs
    return _preference_doubts(unknown, without_price, assumed)


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
        doubts.append(Doubt("PREFERENCE_UNKNOWN", f"{len(unknown)} preferred vehicles or drivers "
                            f"are none of the fleet's, such as {text!r} ({cell}): nobody is "
                            "preferred for that. List them on a sheet of vehicles.", cell=cell))
    if without_price:
        doubts.append(Doubt("PREFERENCE_ASSUMED", f"{len(without_price)} customers prefer a "
                            f"vehicle and don't say how much, such as {without_price[0]}: any "
                            f"other is taken to cost {assumed:g} more.", cell=without_price[0]))
    return doubts
