"""The vehicles of an import: as stated or listed in the file, else assumed and told."""

import math
from collections.abc import Sequence
from typing import Any

from app.formats.sheets.amounts import dimensions
from app.formats.sheets.breaks import break_doubts, breaks_of, driving_rules_of, is_ticked
from app.formats.sheets.cells import CellError, Doubt, MisreadError, Values, clock_text, next_day
from app.formats.sheets.clocks import DAY, LONGEST_NIGHT, Style, windows
from app.formats.sheets.columns import Column
from app.formats.sheets.customers import Entry
from app.formats.sheets.schemas import ImportSettings
from app.formats.sheets.vans import Van, factor_between

CUSTOMERS_PER_VEHICLE = 25
"""From which a number of vehicles is assumed."""

TYPE_ID = "vehicle"

MOST_NAMED = 100
"""Vehicles that orders may name for these to be the fleet."""

TRIPS = 5
"""Most trips of a vehicle where none are stated: whoever is back may take what came later."""

USUAL_HOUR = 30.0
COST_OF_HOUR = {
    "AUD": 45.0, "BRL": 60.0, "CAD": 40.0, "CHF": 45.0, "CNY": 90.0, "CZK": 400.0, "DKK": 240.0,
    "EUR": 30.0, "GBP": 25.0, "HUF": 6000.0, "INR": 300.0, "JPY": 2500.0, "MXN": 200.0,
    "NOK": 320.0, "NZD": 45.0, "PLN": 75.0, "RON": 75.0, "SEK": 300.0, "TRY": 600.0, "USD": 30.0}
"""About what an hour of a van's driver costs, by currency; in others, and in none, `USUAL_HOUR`."""

Data = dict[str, Any]


class Incomplete(ValueError):
    """What lacks for a request, as an error."""

    def __init__(self, code: str, message: str, values: Values | None = None) -> None:
        super().__init__(message)
        self.error = CellError(code, message, values=values or {})


def fleet_of(stops: Sequence[Entry], columns: Sequence[Column], settings: ImportSettings,
             vans: Sequence[Van], least: int) -> tuple[list[Data], list[Doubt]]:
    """Return the fleet and what was assumed for it; where no number is stated, `least` or more.

    Raises
    ------
    Incomplete
        If a setting doesn't fit.
    """
    doubts: list[Doubt] = []
    kinds = (_listed(vans, stops, columns, settings) if vans
             else _named(stops, columns, settings, doubts)
             or [_assumed(stops, columns, settings, least, doubts)])
    if settings.shift is None and any("shift" not in kind for kind in kinds):
        doubts.append(Doubt("SHIFT_ASSUMED", "No shift is stated: vehicles work at any time."))
    common: Data = {}
    if settings.shift is not None:
        common["shift"] = _shift(settings.shift)
        doubts += _overnight(f"The shift {settings.shift}", common["shift"])
    if settings.speed_kmh is not None:
        common["speed_kmh"] = settings.speed_kmh
    if settings.drones:
        common["drones"] = {"count": settings.drones,
                            "capacity": list(settings.drone_capacity or ())}
    usual, told = _usual_work(settings, kinds)
    doubts += told
    abilities, assumed = _abilities(stops, settings, kinds)
    return ([_completed(kind, usual | common) | abilities for kind in kinds],
            doubts + assumed + break_doubts(vans))


def _completed(kind: Data, common: Data) -> Data:
    """Return a type with what holds for all vehicles, where it states nothing else."""
    costs = common["costs"] | kind.get("costs", {})
    return {name: kind[name] for name in ("id", "count", "capacity")} | common | kind | {
        "costs": costs}


def _named(stops: Sequence[Entry], columns: Sequence[Column], settings: ImportSettings,
           doubts: list[Doubt]) -> list[Data]:
    """Return a type for each vehicle or crew that orders name; none unless each names one.

    In place.
    """
    told = [entry.customer.get("vehicles", {}).get("allowed", ()) for entry in stops]
    names = list(dict.fromkeys(name for allowed in told for name in allowed))
    if settings.vehicles is not None or not all(told) or not 1 < len(names) <= MOST_NAMED:
        return []
    doubts.append(Doubt("FLEET_NAMED", f"The vehicles are those that orders name: "
                        f"{', '.join(names[:10])}.", values={"names": names[:10]}))
    if settings.capacity is None:
        doubts.append(_all_fits())
    capacity = _capacity(stops, columns, settings)
    return [{"id": name, "count": 1, "capacity": capacity} for name in names]


def _all_fits() -> Doubt:
    return Doubt("CAPACITY_ASSUMED", "No capacity is stated: each vehicle holds everything that is "
                 "to be delivered.")


def _assumed(stops: Sequence[Entry], columns: Sequence[Column], settings: ImportSettings,
             least: int, doubts: list[Doubt]) -> Data:
    """Return a type as stated; note what isn't. In place."""
    count = settings.vehicles
    if count is None:
        count = max(1, least, math.ceil(len(stops) / CUSTOMERS_PER_VEHICLE))
        doubts.append(Doubt("FLEET_ASSUMED", f"No number of vehicles is stated: {count} "
                            f"{'is' if count == 1 else 'are'} assumed.", values={"count": count}))
    if settings.capacity is None:
        doubts.append(_all_fits())
    return {"id": TYPE_ID, "count": count, "capacity": _capacity(stops, columns, settings)}


def _usual_work(settings: ImportSettings,
                kinds: Sequence[Data]) -> tuple[Data, list[Doubt]]:
    """Return how often vehicles go out and what they cost, and what of it was assumed."""
    doubts = []
    if settings.max_trips is None and any("max_trips" not in kind for kind in kinds):
        doubts.append(Doubt("TRIPS_ASSUMED", f"Vehicles may go out again, up to {TRIPS} "
                            "times in all.", values={"count": TRIPS}))
    hour = settings.per_hour
    kilometre = settings.per_km
    usual = COST_OF_HOUR.get(settings.currency or "", USUAL_HOUR)
    money = f" {settings.currency}" if settings.currency else ""
    if hour is None:
        hour = usual
    if settings.per_hour is None and _lack_cost(kinds, "per_hour"):
        doubts.append(Doubt("HOURS_ASSUMED", "What drivers cost isn't stated: an hour is taken to "
                            f"cost {hour:g}{money}, and whoever is needed at all to be paid for an "
                            "hour more.", values={"amount": hour, "currency": money.strip()}))
    if kilometre is None:
        kilometre = float(f"{usual / USUAL_HOUR:.1g}")
    if settings.per_km is None and _lack_cost(kinds, "per_km"):
        doubts.append(Doubt("KILOMETRES_ASSUMED", "What a kilometre costs isn't stated: "
                            f"{kilometre:g}{money} is taken.",
                            values={"amount": kilometre, "currency": money.strip()}))
    costs = {"fixed": hour, "per_km": kilometre, "per_hour": hour}
    return {"max_trips": settings.max_trips or TRIPS, "costs": costs}, doubts


def _lack_cost(kinds: Sequence[Data], cost: str) -> bool:
    return any(cost not in kind.get("costs", {}) for kind in kinds)


def _listed(vans: Sequence[Van], stops: Sequence[Entry], columns: Sequence[Column],
            settings: ImportSettings) -> list[Data]:
    """Return a type for each vehicle that the file lists."""
    totals = _totals(stops)
    amounts = dimensions(columns)
    kinds: list[Data] = []
    names: set[str] = set()
    for number, van in enumerate(vans, 1):
        name = van.name[:200] or f"{TYPE_ID} {number}"
        name = name if name not in names else f"{name[:190]} ({number})"
        names.add(name)
        kind: Data = {"id": name, "count": max(1, round(van.values.get("count", 1))),
                      "capacity": _capacity_of(van, totals, amounts)}
        if van.shift is not None and any(end is not None for end in van.shift):
            kind["shift"] = _ends(van.shift, f"The shift of {name}")
        if van.skills:
            kind["skills"] = van.skills
        costs = {cost: van.values[cost] for cost in ("fixed", "per_km", "per_hour")
                 if cost in van.values}
        kind |= {"costs": costs} if costs else {}
        kind |= {"speed_kmh": van.values["speed"]} if van.values.get("speed") else {}
        kind |= {"max_trips": round(van.values["max_trips"])} if van.values.get(
            "max_trips") else {}
        kinds.append(kind | _work_of(van, kind["capacity"]))
    return kinds


def _work_of(van: Van, capacity: Sequence[float]) -> Data:
    """Return what holds for a listed vehicle's driver."""
    found: Data = {field: van.values[meaning] for meaning, field in
                   (("max_work", "max_working_duration"), ("max_travel", "max_travel_duration"))
                   if van.values.get(meaning)}
    try:
        stated = {"breaks": breaks_of(van, capacity), "driving_rules": driving_rules_of(van),
                  "lifo": is_ticked(van, "lifo")}
    except MisreadError as error:
        raise Incomplete("DRIVING_RULES", f"{error}.") from error
    return found | {name: value for name, value in stated.items() if value}


def _capacity_of(van: Van, totals: Sequence[float], amounts: Sequence[Column]) -> list[float]:
    """Return what a listed vehicle holds of each amount; all there is where it isn't said."""
    left = list(van.capacities)
    found: list[float | None] = [None] * len(totals)
    for place in range(len(totals)):
        unit = amounts[place].unit if place < len(amounts) else None
        fitting = [(entry, factor) for entry in left if entry[1] and unit
                   and (factor := factor_between(entry[1], unit)) is not None]
        if fitting:
            entry, factor = fitting[0]
            found[place] = round(entry[2] * factor, 9)
            left.remove(entry)
    for place, total in enumerate(totals):
        if found[place] is None:
            # What has no unit is for what has none, in their order.
            unit = amounts[place].unit if place < len(amounts) else None
            other = next((entry for entry in left if not (entry[1] and unit)), None)
            found[place] = max(total, 1.0) if other is None else other[2]
            if other is not None:
                left.remove(other)
    return [amount for amount in found if amount is not None]


def _totals(stops: Sequence[Entry]) -> list[float]:
    """Return the most of each amount that is to be carried: all deliveries, or all pickups.

    Shipments are aboard with either.
    """
    sums = [[math.fsum(amounts) for amounts in zip(*(
        amounts for stop in stops for amounts in _carried(stop.customer, what)), strict=True)]
            for what in ("demand", "pickup")]
    return [max(pair) for pair in zip(*(found for found in sums if found), strict=True)] or [1.0]


def _carried(customer: Data, what: str) -> list[list[float]]:
    """Return what is brought to, or taken from, a customer, and all parts of a shipment."""
    if "delivery" in customer:
        return [part["amount"] for part in customer.get("pickups") or [customer]]
    return [customer[what]] if what in customer else []


def _capacity(stops: Sequence[Entry], columns: Sequence[Column],
              settings: ImportSettings) -> list[float]:
    """Return what a vehicle holds; all there is unless stated."""
    totals = _totals(stops)
    names = [column.name for column in dimensions(columns)]
    capacity = settings.capacity or [max(total, 1.0) for total in totals]
    if settings.drones and settings.drone_capacity is None:
        raise Incomplete("DRONE_CAPACITY", "There are drones: state what one of them carries.")
    for what, amounts in (("a vehicle holds", capacity),
                          ("a drone carries", settings.drone_capacity)):
        if amounts is not None and len(amounts) != len(totals):
            told = f" ({', '.join(names)})" if names else ""
            numbers = "1 number tells" if len(amounts) == 1 else f"{len(amounts)} numbers tell"
            raise Incomplete("CAPACITY", f"{numbers} what {what}, and there are "
                             f"{len(totals)} amounts to deliver{told}: state one for each.",
                             {"numbers": len(amounts), "amounts": len(totals)})
    return list(capacity)


def _abilities(stops: Sequence[Entry], settings: ImportSettings,
               kinds: Sequence[Data]) -> tuple[Data, list[Doubt]]:
    """Return the skills that vehicles are taken to have, and what customers ask in vain."""
    found: Data = {}
    doubts = []
    skills = sorted({skill for stop in stops for skill in stop.customer.get("skills", ())})
    if skills and not any(kind.get("skills") for kind in kinds):
        found["skills"] = skills
        doubts.append(Doubt("SKILLS_ASSUMED", "All vehicles are taken to have the skills that "
                            f"customers need: {', '.join(skills[:10])}.",
                            values={"names": skills[:10]}))
    for_drones = sum(stop.customer.get("served_by") == "drone" for stop in stops)
    if for_drones and not settings.drones:
        doubts.append(Doubt("NO_DRONES", f"{for_drones} customers are for drones alone, and there "
                            "are none.", values={"count": for_drones}))
    return found, doubts


def _shift(text: str) -> Data:
    try:
        [ends] = windows(text, "clock", Style())
    except (MisreadError, ValueError) as error:
        raise Incomplete("SHIFT", f"The shift {text!r} can't be read: write one such as "
                         "8:00-17:00, or 21:00-6:00.", {"value": text}) from error
    return _ends(ends, f"The shift {text}")


def _ends(ends: tuple[float | None, float | None], what: str) -> Data:
    """Return a shift; one of a night ends on the day after."""
    earliest, latest = ends[0] or 0, ends[1]
    if latest is None:
        return {"earliest": earliest}
    if latest < earliest:
        if latest + DAY - earliest > LONGEST_NIGHT:
            raise Incomplete("SHIFT_ENDS_BEFORE_START", f"{what} ends before it begins: write its "
                             f"end as {clock_text(latest + DAY)}, or {next_day(latest + DAY)}, if "
                             "the day after is meant.", {"end": clock_text(latest + DAY)})
        latest += DAY
    return {"earliest": earliest, "latest": latest}


def _overnight(what: str, shift: Data) -> list[Doubt]:
    latest = shift.get("latest", 0)
    if latest <= DAY:
        return []
    return [Doubt("SHIFT_OVERNIGHT", f"{what} ends on the day after, at {next_day(latest)} "
                  f"({clock_text(latest)}).", values={"end": next_day(latest)})]
