"""The vehicles of an import: as stated, else assumed and told."""

import math
from collections.abc import Sequence
from typing import Any

from app.sheets.cells import CellError, Doubt, MisreadError
from app.sheets.clocks import Style, windows
from app.sheets.columns import Column
from app.sheets.customers import Entry
from app.sheets.schemas import ImportSettings

CUSTOMERS_PER_VEHICLE = 25
"""From which a number of vehicles is assumed."""

TYPE_ID = "vehicle"

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

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.error = CellError(code, message)


def fleet_of(stops: Sequence[Entry], columns: Sequence[Column],
             settings: ImportSettings) -> tuple[list[Data], list[Doubt]]:
    """Return the fleet and what was assumed for it.

    Raises
    ------
    Incomplete
        If a setting doesn't fit.
    """
    doubts = []
    count = settings.vehicles
    if count is None:
        count = max(1, math.ceil(len(stops) / CUSTOMERS_PER_VEHICLE))
        doubts.append(Doubt("FLEET_ASSUMED", f"No number of vehicles is stated: {count} "
                            f"{'is' if count == 1 else 'are'} assumed."))
    if settings.capacity is None:
        doubts.append(Doubt("CAPACITY_ASSUMED", "No capacity is stated: each vehicle holds "
                            "everything that is to be delivered."))
    kind: Data = {"id": TYPE_ID, "count": count, "capacity": _capacity(stops, columns, settings)}
    if settings.shift is None:
        doubts.append(Doubt("SHIFT_ASSUMED", "No shift is stated: vehicles work at any time."))
    else:
        kind["shift"] = _shift(settings.shift)
    usual, told = _usual_work(settings)
    kind |= usual
    doubts += told
    if settings.speed_kmh is not None:
        kind["speed_kmh"] = settings.speed_kmh
    if settings.drones:
        kind["drones"] = {"count": settings.drones, "capacity": list(settings.drone_capacity or ())}
    abilities, assumed = _abilities(stops, settings)
    return [kind | abilities], doubts + assumed


def _usual_work(settings: ImportSettings) -> tuple[Data, list[Doubt]]:
    """Return how often vehicles go out and what they cost, and what of it was assumed."""
    doubts = []
    if settings.max_trips is None:
        doubts.append(Doubt("TRIPS_ASSUMED", f"Vehicles may go out again, up to {TRIPS} "
                            "times in all."))
    hour = settings.per_hour
    kilometre = settings.per_km
    usual = COST_OF_HOUR.get(settings.currency or "", USUAL_HOUR)
    money = f" {settings.currency}" if settings.currency else ""
    if hour is None:
        hour = usual
        doubts.append(Doubt("HOURS_ASSUMED", "What drivers cost isn't stated: an hour is taken to "
                            f"cost {hour:g}{money}, and whoever is needed at all to be paid for an "
                            "hour more."))
    if kilometre is None:
        kilometre = float(f"{usual / USUAL_HOUR:.1g}")
        doubts.append(Doubt("KILOMETRES_ASSUMED", "What a kilometre costs isn't stated: "
                            f"{kilometre:g}{money} is taken."))
    costs = {"fixed": hour, "per_km": kilometre, "per_hour": hour}
    return {"max_trips": settings.max_trips or TRIPS, "costs": costs}, doubts


def _capacity(stops: Sequence[Entry], columns: Sequence[Column],
              settings: ImportSettings) -> list[float]:
    """Return what a vehicle holds; all there is unless stated."""
    totals = [math.fsum(amounts) for amounts in
              zip(*(stop.customer["demand"] for stop in stops), strict=True)] or [1.0]
    names = [column.name for column in columns if column.meaning == "demand"]
    capacity = settings.capacity or [max(total, 1.0) for total in totals]
    if settings.drones and settings.drone_capacity is None:
        raise Incomplete("DRONE_CAPACITY", "There are drones, and it isn't stated what one "
                         "carries: state drone_capacity.")
    for what, amounts in (("capacity", capacity), ("drone_capacity", settings.drone_capacity)):
        if amounts is not None and len(amounts) != len(totals):
            told = f" ({', '.join(names)})" if names else ""
            raise Incomplete("CAPACITY", f"{what} has {len(amounts)} numbers, and there are "
                             f"{len(totals)} amounts to deliver{told}: state one for each.")
    return list(capacity)


def _abilities(stops: Sequence[Entry], settings: ImportSettings) -> tuple[Data, list[Doubt]]:
    """Return the skills that vehicles are taken to have, and what customers ask in vain."""
    found: Data = {}
    doubts = []
    skills = sorted({skill for stop in stops for skill in stop.customer.get("skills", ())})
    if skills:
        found["skills"] = skills
        doubts.append(Doubt("SKILLS_ASSUMED", "All vehicles are taken to have the skills that "
                            f"customers need: {', '.join(skills[:10])}."))
    for_drones = sum(stop.customer.get("served_by") == "drone" for stop in stops)
    if for_drones and not settings.drones:
        doubts.append(Doubt("NO_DRONES", f"{for_drones} customers are for drones alone, and there "
                            "are none."))
    return found, doubts


def _shift(text: str) -> Data:
    try:
        [(earliest, latest)] = windows(text, "clock", Style())
    except (MisreadError, ValueError) as error:
        raise Incomplete("SHIFT", f"The shift {text!r} can't be read: write one such as "
                         "8:00-17:00.") from error
    return {"earliest": earliest or 0} | ({} if latest is None else {"latest": latest})
