"""Warnings about what is stated beside the rule that drones name, and is looser."""

from app.requests.warnings.survey import Survey
from app.requests.warnings.warning import Warnings, amount_text, warning_at
from app.schemas.drones import DronesInput
from app.schemas.rulebook import RULES
from app.schemas.vehicle import VehicleTypeInput


def rule_warnings(survey: Survey) -> Warnings:
    """Yield a warning for each number that is looser than that of a rule named beside it."""
    for index, kind in enumerate(survey.request.fleet):
        for inner, drones in kind.drones_by_path:
            if drones.preset is None:
                continue
            for path, stated, asked in _looser(kind, drones):
                where = inner if path in ("max_range", "altitude") else ()
                yield warning_at(
                    "LOOSER_THAN_PRESET", ("fleet", index, *where, path),
                    f"{drones.preset!r} asks for {asked}, and {stated} is stated here, which "
                    f"counts: leave {path} out to keep the rule's.")


def _looser(kind: VehicleTypeInput, drones: DronesInput) -> list[tuple[str, str, str]]:
    """Return the fields that are looser, what they state, and what the rule has instead."""
    if drones.preset is None:
        return []
    rule, found = RULES[drones.preset], []
    if kind.max_airborne is None or kind.max_airborne > rule.max_airborne:
        found.append(("max_airborne", _told(kind.max_airborne), f"{rule.max_airborne}"))
    if rule.truck_waits and not kind.truck_waits:
        found.append(("truck_waits", "false", "true"))
    if rule.max_range is not None and (
            drones.max_range is None or drones.max_range > rule.max_range):
        found.append(("max_range", _told(drones.max_range), f"{amount_text(rule.max_range)} m"))
    if rule.altitude is not None and drones.altitude > rule.altitude:
        found.append(("altitude", _told(drones.altitude), f"{rule.altitude:g} m"))
    return found


def _told(stated: float | None) -> str:
    return "no limit" if stated is None else f"{stated:g}"
