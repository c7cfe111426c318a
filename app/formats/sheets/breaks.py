"""Breaks and driving rules of a sheet that lists vehicles -> those of vehicle types."""

from collections.abc import Sequence
from typing import Any

from app.formats.sheets.cells import Doubt, MisreadError, clock_text
from app.formats.sheets.headings import simple
from app.formats.sheets.readers import NO
from app.formats.sheets.vans import Van
from app.schemas.driving import LAWS

MINUTE, HOUR = 60.0, 3600.0

LONGEST_ITSELF = HOUR
"""Windows up to this long are the break itself where no length is stated."""

USUAL = 30 * MINUTE
WITHIN = 6 * HOUR
"""Work before a break at the latest, where the sheet doesn't say when it is."""

Data = dict[str, Any]


def breaks_of(van: Van) -> list[Data]:
    """Return the breaks of a listed vehicle's driver."""
    length = van.values.get("break_duration")
    if van.breaks is None:
        return [{"id": "break", "duration": length, "start": {"latest": WITHIN},
                 "after_departure": True}] if length else []
    many = len(van.breaks) > 1
    return [{"id": f"break-{number}" if many else "break",
             **_break(earliest or 0.0, latest, length)}
            for number, (earliest, latest) in enumerate(van.breaks, 1)]


def _break(earliest: float, latest: float | None, length: float | None) -> Data:
    """Return when a break is and how long; without a length a short window is the break."""
    if length is None and latest is not None and latest - earliest <= LONGEST_ITSELF:
        return {"duration": latest - earliest, "start": {"earliest": earliest, "latest": earliest},
                "at": "anywhere"}
    duration = USUAL if length is None else length
    last = earliest if latest is None else max(earliest, latest - duration)
    return {"duration": duration, "start": {"earliest": earliest, "latest": last}}


def driving_rules_of(van: Van) -> Data | None:
    """Return the published rule that a listed vehicle's driver keeps to.

    Raises
    ------
    MisreadError
        If there is none of that name.
    """
    named = simple(van.driving_rules)
    if not named or named in NO:
        return None
    if "2002" in named and "561" in named:
        return {"preset": "eu-561+2002-15"}
    if "561" in named:
        return {"preset": "eu-561"}
    if "hos" in named.split() or "hours of service" in named:
        return {"preset": "us-hos"}
    raise MisreadError(f"{van.driving_rules!r} ({van.cell}) is no driving rule known here: write "
                       f"one of {', '.join(LAWS)}")


def break_doubts(vans: Sequence[Van]) -> list[Doubt]:
    """Return what was assumed of breaks that the sheet doesn't tell wholly."""
    doubts = []
    if any(van.breaks and "break_duration" not in van.values for van in vans):
        doubts.append(Doubt("BREAKS_ASSUMED", "Breaks have no length: a window of up to an hour is "
                            f"taken for the break, in longer ones it is {USUAL / MINUTE:.0f} min."))
    if any(van.breaks is None and van.values.get("break_duration") for van in vans):
        doubts.append(Doubt("BREAKS_ASSUMED", "Breaks have no time: they are taken to begin within "
                            f"{clock_text(WITHIN)} h of the vehicle's departure."))
    return doubts
