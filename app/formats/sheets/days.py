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
            "fleet": [_with_clocks(kind, {"shift": WINDOW}) for kind in request["fleet"]]}


def clock(seconds: float) -> str:
    """Return seconds since midnight by the wall clock, `+1 06:00` on the day after."""
    days, rest = divmod(round(seconds, 3), DAY)
    hours, minutes, left = int(rest // HOUR), int(rest % HOUR // MINUTE), rest % MINUTE
    text = f"{hours:02}:{minutes:02}" + (f":{left:06.3f}".rstrip("0").rstrip(".") if left else "")
    return f"{int(days):+d} {text}" if days else text


def _customer(customer: Data) -> Data:
    told = _with_clocks(customer, {"time_window": WINDOW})
    if "time_windows" in told:
        told["time_windows"] = [_clocks(window, WINDOW) for window in told["time_windows"]]
    return _clocks(told, ("release_time",))


def _with_clocks(holder: Data, inner: dict[str, tuple[str, ...]]) -> Data:
    return {name: _clocks(value, inner[name]) if name in inner else value
            for name, value in holder.items()}


def _clocks(holder: Data, names: tuple[str, ...]) -> Data:
    return {name: clock(value) if name in names and value is not None else value
            for name, value in holder.items()}
