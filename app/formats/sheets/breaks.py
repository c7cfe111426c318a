"""Breaks and driving rules of a sheet that lists vehicles -> those of vehicle types."""

import re
from collections.abc import Sequence
from typing import Any

from app.formats.sheets.cells import Doubt, MisreadError, clock_text
from app.formats.sheets.headings import simple
from app.formats.sheets.readers import NO, YES
from app.formats.sheets.vans import Van
from app.schemas.driving import LAWS

MINUTE, HOUR = 60.0, 3600.0

LONGEST_ITSELF = HOUR
"""Windows up to this long are the break itself where no length is stated."""

USUAL = 30 * MINUTE
WITHIN = 6 * HOUR
"""Work before a break at the latest, where the sheet doesn't say when it is."""

USUAL_REST = 45 * MINUTE
"""A rest where a sheet limits driving or work before it and doesn't say how long it is."""

LIMITS = ("max_driving", "max_work_before_break", "max_driving_per_day")
BEFORE = ("driven_before", "worked_before")

_SPLIT = re.compile(r"(\d{1,3})\D{1,20}(\d{1,3})\D{0,20}")

Data = dict[str, Any]
Pause = tuple[float | None, float | None, float | None]
"""Begin, end and length, as far as they are stated."""


def breaks_of(van: Van, capacity: Sequence[float]) -> list[Data]:
    """Return the breaks of a listed vehicle's driver."""
    pauses = _pauses(van)
    common: Data = {} if is_ticked(van, "break_paid", default=True) else {"paid": False}
    if is_ticked(van, "break_anywhere"):
        common["at"] = "anywhere"
    if (load := van.values.get("break_max_load")) is not None:
        common["max_load"] = [load, *capacity[1:]]
    within = van.values.get("break_within", WITHIN)
    return [{"id": f"break-{number}" if len(pauses) > 1 else "break",
             **_break(pause, within), **common} for number, pause in enumerate(pauses, 1)]


def _pauses(van: Van) -> list[Pause]:
    """Return what columns say of each break: the first length is of the first window, or of all."""
    lengths, is_shared = van.break_durations, len(van.break_durations) == 1
    found: list[Pause] = []
    for place in range(max(len(van.breaks), len(lengths))):
        windows = van.breaks[place] if place < len(van.breaks) else None
        length = (lengths[0] if is_shared else lengths[place] if place < len(lengths) else None)
        found += [(earliest, latest, length) for earliest, latest in windows or ()]
        if not windows and length and not (is_shared and (place or any(van.breaks))):
            found.append((None, None, length))
    return found


def _break(pause: Pause, within: float) -> Data:
    """Return when a break is and how long; without a length a short window is the break."""
    earliest, latest, length = pause
    if earliest is None and latest is None:
        return {"duration": length, "start": {"latest": within}, "after_departure": True}
    begin = earliest or 0.0
    if length is None and latest is not None and latest - begin <= LONGEST_ITSELF:
        return {"duration": latest - begin, "start": {"earliest": begin, "latest": begin},
                "at": "anywhere"}
    duration = USUAL if length is None else length
    last = begin if latest is None else max(begin, latest - duration)
    return {"duration": duration, "start": {"earliest": begin, "latest": last}}


def is_ticked(van: Van, meaning: str, default: bool = False) -> bool:
    """Return whether a cell says yes.

    Raises
    ------
    MisreadError
        If it says neither yes nor no.
    """
    said = simple(van.texts.get(meaning, ""))
    if said and said not in YES | NO:
        text, cell = van.texts[meaning], van.cells[meaning]
        raise MisreadError(f"{text!r} ({cell}) is neither yes nor no", cell, text)
    return said in YES if said else default


def driving_rules_of(van: Van) -> Data | None:
    """Return the rule that a listed vehicle's driver keeps to: a published one, or its numbers.

    Raises
    ------
    MisreadError
        If there is none of that name, or its numbers can't be read.
    """
    rules: Data = {"preset": preset} if (preset := _preset(van)) else {}
    rules |= {name: van.values[name] for name in LIMITS if van.values.get(name)}
    if not rules:
        return None
    if rest := van.values.get("rest", 0.0 if preset else USUAL_REST):
        rules["break_duration"] = rest
    if split := van.texts.get("rest_split"):
        found = _SPLIT.fullmatch(split.strip())
        if found is None:
            raise MisreadError(f"{split!r} ({van.cells['rest_split']}) are no two parts of a "
                               "rest: write their minutes, such as 15 + 30",
                               van.cells["rest_split"], split)
        rules["split"] = [int(found[1]) * MINUTE, int(found[2]) * MINUTE]
    return rules | {name: van.values[name] for name in BEFORE if van.values.get(name)}


def _preset(van: Van) -> str | None:
    stated = van.texts.get("driving_rules", "")
    named = simple(stated)
    if not named or named in NO:
        return None
    if "2002" in named and "561" in named:
        return "eu-561+2002-15"
    if "561" in named:
        return "eu-561"
    if "hos" in named.split() or "hours of service" in named:
        return "us-hos"
    raise MisreadError(f"{stated!r} ({van.cells['driving_rules']}) is no driving rule known "
                       f"here: write one of {', '.join(LAWS)}", van.cells["driving_rules"], stated)


def break_doubts(vans: Sequence[Van]) -> list[Doubt]:
    """Return what was assumed of breaks and rests that the sheet doesn't tell wholly."""
    doubts = []
    pauses = [(van, pause) for van in vans for pause in _pauses(van)]
    if any(length is None for _, (_, _, length) in pauses):
        doubts.append(Doubt("BREAKS_ASSUMED", "Breaks have no length: a window of up to an hour is "
                            f"taken for the break, in longer ones it is {USUAL / MINUTE:.0f} min.",
                            values={"case": "length", "minutes": round(USUAL / MINUTE)}))
    if any(earliest is latest is None and "break_within" not in van.values
           for van, (earliest, latest, _) in pauses):
        doubts.append(Doubt("BREAKS_ASSUMED", "Breaks have no time: they are taken to begin within "
                            f"{clock_text(WITHIN)} h of the vehicle's departure.",
                            values={"case": "time", "hours": clock_text(WITHIN)}))
    if any("rest" not in van.values and not _preset(van)
           and any(van.values.get(name) for name in LIMITS) for van in vans):
        doubts.append(Doubt("RESTS_ASSUMED", "Rests have no length: they are taken to last "
                            f"{USUAL_REST / MINUTE:.0f} min.",
                            values={"minutes": round(USUAL_REST / MINUTE)}))
    if any(driving_rules_of(van) is None
           and ("rest_split" in van.texts or any(map(van.values.get, ("rest", *BEFORE))))
           for van in vans):
        doubts.append(Doubt("RESTS_UNUSED", "Rests, or what was driven or worked before, are "
                            "stated without driving rules or how long one may drive or work: "
                            "nothing is made of them."))
    return doubts
