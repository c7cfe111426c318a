"""Warnings about what is stated beside the rule that drones name, and is looser."""

from app.requests.warnings.survey import Survey
from app.requests.warnings.warning import Warnings, amount_text, warning_at
from app.schemas.driving import LAWS
from app.schemas.drones import Flyer
from app.schemas.rulebook import RULES, Rule
from app.schemas.vehicle import VehicleTypeInput


def rule_warnings(survey: Survey) -> Warnings:
    """Yield a warning for each number that is looser than that of a rule named beside it."""
    for index, kind in enumerate(survey.request.fleet):
        for inner, flyer in kind.flyers_by_path:
            if flyer.preset is None:
                continue
            looser = _looser(flyer, RULES[flyer.preset])
            if not kind.flies:
                looser += _looser_aboard(kind, RULES[flyer.preset])
            for path, stated, asked in looser:
                where = inner if path in ("max_range", "altitude") else ()
                yield warning_at(
                    "LOOSER_THAN_PRESET", ("fleet", index, *where, path),
                    f"{flyer.preset!r} asks for {asked}, and {stated} is stated here, which "
                    f"counts: leave {path} out to keep the rule's.")


def law_warnings(survey: Survey) -> Warnings:
    """Yield a warning for each number that is looser than that of driving rules named beside it."""
    for index, kind in enumerate(survey.request.fleet):
        rules = kind.driving_rules
        if rules is None or rules.preset is None:
            continue
        law, looser = LAWS[rules.preset], []
        if rules.other_work_interrupts and not law.other_work_interrupts:
            yield warning_at(
                "LOOSER_THAN_PRESET", ("fleet", index, "driving_rules", "other_work_interrupts"),
                f"By {rules.preset!r} breaks alone interrupt driving, and here other work does, "
                "too, which counts: leave other_work_interrupts out to keep the rule's.")
        for name in ("max_driving", "max_driving_per_day", "max_work_before_break"):
            looser += [(f"driving_rules.{name}", getattr(rules, name), getattr(law, name), False)]
        looser += [("driving_rules.break_duration", rules.break_duration, law.break_duration, True),
                   ("max_working_duration", kind.max_working_duration, law.max_working_duration,
                    False)]
        looser += [(f"driving_rules.split.{part}", length, asked, True)
                   for part, length in enumerate(rules.split or ())
                   for asked in [law.split[part] if law.split else law.break_duration]]
        for name, stated, asked, is_least in looser:
            if asked is None or (stated is not None
                                 and (stated >= asked if is_least else stated <= asked)):
                continue
            path = tuple(int(key) if key.isdigit() else key for key in name.split("."))
            yield warning_at(
                "LOOSER_THAN_PRESET", ("fleet", index, *path),
                f"{rules.preset!r} asks for {asked:g} s, and {_told(stated)} is stated here, which "
                f"counts: leave {path[-1 if isinstance(path[-1], str) else -2]} out to keep the "
                "rule's.")


_Looser = list[tuple[str, str, str]]
"""Fields that are looser, what they state, and what the rule has instead."""


def _looser_aboard(kind: VehicleTypeInput, rule: Rule) -> _Looser:
    """Return what of a truck is looser."""
    found = []
    if kind.max_airborne is None or kind.max_airborne > rule.max_airborne:
        found.append(("max_airborne", _told(kind.max_airborne), f"{rule.max_airborne}"))
    if rule.truck_waits and not kind.truck_waits:
        found.append(("truck_waits", "false", "true"))
    return found


def _looser(flyer: Flyer, rule: Rule) -> _Looser:
    """Return what of drones is looser."""
    found = []
    if rule.max_range is not None and (
            flyer.max_range is None or flyer.max_range > rule.max_range):
        found.append(("max_range", _told(flyer.max_range), f"{amount_text(rule.max_range)} m"))
    if rule.altitude is not None and flyer.altitude > rule.altitude:
        found.append(("altitude", _told(flyer.altitude), f"{rule.altitude:g} m"))
    return found


def _told(stated: float | None) -> str:
    return "no limit" if stated is None else f"{stated:g}"
