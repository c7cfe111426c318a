"""Windows of a night: in a shift from 21:00 to 6:00, 3:00 is on the day after."""

from collections.abc import Iterable, Iterator, Sequence
from operator import itemgetter
from typing import Any

from app.formats.sheets.cells import Doubt, clock_text, next_day
from app.formats.sheets.clocks import DAY, EVENING, LAST
from app.formats.sheets.customers import Entry, disjoint

SMALL_HOURS = 9 * 3600.0
"""Until here a night's work lasts."""

Data = dict[str, Any]


def into_the_night(fleet: Sequence[Data], served: Iterable[Entry]) -> list[Doubt]:
    """Move windows, and breaks, that end before any shift begins to the day after. In place.

    Only where somebody works then: other windows stay, and are warned of.
    """
    shifts = [_ends(kind) for kind in fleet]
    for kind, shift in zip(fleet, shifts, strict=True):
        for pause in kind.get("breaks", ()):
            if not pause.get("after_departure") and _is_after(pause.get("start", {}), *shift):
                pause["start"] = _a_day_later(pause["start"])
    served = list(served)
    opens, closes = min(opens for opens, _ in shifts), max(closes for _, closes in shifts)
    if not any("shift" in kind for kind in fleet):
        opens, closes = _night_of(served)
    moved = [(row, place) for entry in served for row, whole in entry.places()
             for place in _places(whole) if _move(place, opens, closes)]
    if not moved:
        return []
    row, place = moved[0]
    begins = next(window["earliest"] for window in _windows(place) if window["latest"] > DAY)
    cell = row.cell("window", "earliest", "latest")
    return [Doubt("NEXT_NIGHT", f"{len(moved)} windows are taken for the day after, since nobody "
                  f"works before {clock_text(opens)}: such as {cell} from {next_day(begins)}.",
                  cell=cell, values={"count": len(moved)})]


def _ends(kind: Data) -> tuple[float, float]:
    """Return when a shift begins, and ends; one without end says nothing of a night."""
    shift = kind.get("shift", {})
    return shift.get("earliest", 0.0), shift.get("latest") or 0.0


def _night_of(served: Iterable[Entry]) -> tuple[float, float]:
    """Return when work of a night begins and ends, by its windows; 0, 0: there is none.

    All begin in the evening or end in the small hours, and some do each.
    """
    ends = [(window.get("earliest") or 0.0, window.get("latest") or LAST) for entry in served
            for _, whole in entry.places() for place in _places(whole)
            for window in _windows(place)]
    evening = [earliest for earliest, _ in ends if earliest >= EVENING]
    small = [latest for earliest, latest in ends if earliest < EVENING]
    if not evening or not small or max(small) > SMALL_HOURS:
        return 0.0, 0.0
    return min(evening), LAST


def _places(whole: Data) -> Iterator[Data]:
    yield whole
    yield from whole.get("alternatives", ())


def _windows(place: Data) -> Sequence[Data]:
    single = [place["time_window"]] if "time_window" in place else []
    return place.get("time_windows", single)


def _is_after(window: Data, opens: float, closes: float) -> bool:
    """Tell whether a window is on the day after: it ends before work begins, and there is work."""
    latest = window.get("latest")
    return latest is not None and latest < opens and latest + DAY <= closes


def _a_day_later(window: Data) -> Data:
    return window | {end: (window.get(end) or 0.0) + DAY for end in ("earliest", "latest")}


def _move(place: Data, opens: float, closes: float) -> bool:
    """Move windows of a place that are on the day after. In place; tell whether any is."""
    windows = _windows(place)
    if not any(_is_after(window, opens, closes) for window in windows):
        return False
    costs = {name: cost for window in windows for name, cost in window.items()
             if name.endswith("_per_hour")}
    later = [_a_day_later(window) if _is_after(window, opens, closes) else window
             for window in windows]
    later.sort(key=itemgetter("earliest"))
    ends = disjoint((window["earliest"], window.get("latest")) for window in later)
    told = [{"earliest": earliest} | ({} if latest is None else {"latest": latest})
            | {name: cost for name, cost in costs.items()
               if name.startswith("early") or number == len(ends)}
            for number, (earliest, latest) in enumerate(ends, 1)]
    place.pop("time_windows", None)
    place.pop("time_window", None)
    place |= {"time_windows": told} if len(told) > 1 else {"time_window": told[0]}
    return True
