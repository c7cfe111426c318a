"""The day of an import: seconds since midnight as times of the day, where its zone is known."""

from datetime import date
from typing import Any

Data = dict[str, Any]

DAY, HOUR, MINUTE = 86_400, 3600, 60

WINDOW = ("earliest", "latest")


def on_day(request: Data, day: date, time_zone: str) -> Data:
    """Return a request whose times are those of a day, so that clocks that jump are followed."""
    return {"plan_start": f"{day.isoformat()}T00:00:00", "time_zone": time_zone,
            **request,
            "customers": [_customer(customer) for customer in request["customers"]],
            **({"shipments": [_shipment(shipment) for shipment in request["shipments"]]}
               if "shipments" in request else {}),
            "fleet": [_vehicles(kind) for kind in request["fleet"]]}


def clock(seconds: float) -> str:
    """Return seconds since midnight by the wall clock, `+1 06:00` on the day after."""
    days, rest = divmod(round(seconds, 3), DAY)
    hours, minutes, left = int(rest // HOUR), int(rest % HOUR // MINUTE), rest % MINUTE
    text = f"{hours:02}:{minutes:02}" + (f":{left:06.3f}".rstrip("0").rstrip(".") if left else "")
    return f"{int(days):+d} {text}" if days else text


def _customer(customer: Data) -> Data:
    told = _clocks(_place(customer), ("release_time",))
    if "alternatives" in told:
        told["alternatives"] = [_place(other) for other in told["alternatives"]]
    return told


def _shipment(shipment: Data) -> Data:
    told = shipment | {end: _place(shipment[end]) for end in ("pickup", "delivery")
                       if end in shipment}
    if "pickups" in told:
        told["pickups"] = [_place(part) for part in told["pickups"]]
    return told


def _place(place: Data) -> Data:
    told = _with_clocks(place, {"time_window": WINDOW})
    if "time_windows" in told:
        told["time_windows"] = [_clocks(window, WINDOW) for window in told["time_windows"]]
    return told


def _vehicles(kind: Data) -> Data:
    told = _with_clocks(kind, {"shift": WINDOW})
    if "breaks" in told:
        told["breaks"] = [pause if pause.get("after_departure")
                          else _with_clocks(pause, {"start": WINDOW}) for pause in told["breaks"]]
    return told


def _with_clocks(holder: Data, inner: dict[str, tuple[str, ...]]) -> Data:
    return {name: _clocks(value, inner[name]) if name in inner else value
            for name, value in holder.items()}


def _clocks(holder: Data, names: tuple[str, ...]) -> Data:
    return {name: clock(value) if name in names and value is not None else value
            for name, value in holder.items()}
