"""What mends an order that may be late: another place in the plan, at the least cost.

It is asked of `POST /quote`, in the plan without the order: once in its window, once in one that
ends sooner by as much as it may be later than planned. What the second costs more is the remedy's.
Its events move nobody else, so others don't make room in the quotes either.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from pydantic_core import from_json, to_json

from app.records.days.fold import Data
from app.schemas.errors import RequestError

MOST = 3
"""Orders for which a remedy is looked for after a plan: each takes some ms of the time to it."""

TIMES = ("arrival", "service_start", "departure")

Quote = Callable[[bytes], bytes]
"""Answers a request of `POST /quote`."""


def remedy_of(order: str, wanted: Mapping[str, Any], reply: Mapping[str, Any], now: float,
              quote: Quote) -> Data | None:
    """Return who serves an order so that it is hardly late, what that costs more, and its events.

    None: nobody does, or the order is on its way already.

    Parameters
    ----------
    wanted
        The request of the plan in which it may be late.
    reply
        That plan.
    now
        In seconds since plan start.
    quote
        Prices slots.
    """
    stated = next((each for each in wanted["customers"] if each["id"] == order), None)
    found = _without(order, reply, now)
    if stated is None or found is None:
        return None
    stop, routes = found
    window = (stated.get("time_windows") or [stated.get("time_window") or {}])[-1]
    latest = window.get("latest")
    if not isinstance(latest, int | float):
        return None
    earliest = window.get("earliest", 0)
    sooner = max(earliest, latest - (stop["lateness"]["latest"] - stop["arrival"]))
    problem = {**wanted, "customers": [each for each in wanted["customers"]
                                       if each["id"] != order]}
    try:
        quoted = from_json(quote(to_json({
            "problem": problem, "plan": {"routes": routes}, "order": stated, "search": False,
            "slots": [{"earliest": earliest, "latest": end} for end in (sooner, latest)]})))
    except RequestError:
        return None
    slot, now_kept = quoted["slots"]
    if not slot["feasible"] or not now_kept["feasible"]:
        return None
    return {"code": "serve_sooner", "vehicle": slot["vehicle"], "arrival": slot["arrival"],
            "cost": slot["cost"] - now_kept["cost"],
            "events": list(_events(order, slot["vehicle"], slot["after"], routes))}


def _events(order: str, vehicle: str, after: str, routes: Iterable[Data]) -> Iterator[Data]:
    """Yield what makes it so: the vehicle serves the order, and whoever is next there behind it."""
    yield {"kind": "order.pinned", "order": order, "vehicle": vehicle}
    for route in routes:
        for trip in route["trips"] if route["vehicle"] == vehicle else ():
            names = [stop["id"] for stop in trip["stops"]]
            if after in names[:-1]:
                following = trip["stops"][names.index(after) + 1]
                if following["kind"] == "customer":
                    yield {"kind": "order.pinned", "order": following["id"], "vehicle": vehicle,
                           "after": order}
                return


def _without(order: str, reply: Mapping[str, Any],
             now: float) -> tuple[Data, list[Data]] | None:
    """Return an order's stop, and a plan's routes without it; None: nobody can take it out."""
    for number, route in enumerate(reply["routes"]):
        for index, trip in enumerate(route["trips"]):
            for stop in trip["stops"]:
                if stop["kind"] == "customer" and stop["id"] == order:
                    if trip["sorties"] or trip["stops"][0]["departure"] <= now:
                        return None
                    rest = _untimed([each for each in trip["stops"] if each is not stop])
                    trips = [*route["trips"][:index], *([{**trip, "stops": rest}] if len(rest) > 2
                                                        else []), *route["trips"][index + 1:]]
                    left = [{**route, "trips": trips}] if trips else []
                    routes = reply["routes"]
                    return stop, [*routes[:number], *left, *routes[number + 1:]]
    return None


def _untimed(stops: list[Data]) -> list[Data]:
    """Return stops whose times, but for the first arrival, are to be made."""
    first, *others = [{name: each for name, each in stop.items() if name not in TIMES[1:]}
                      for stop in stops]
    return [first, *({name: each for name, each in stop.items() if name != TIMES[0]}
                     for stop in others)]
