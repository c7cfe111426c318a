"""What flights take, and what presets say of it, as a reply states them."""

from collections.abc import Iterable
from typing import Any

from model.problem import MICROJOULES_PER_WH, Energy, Problem

Data = dict[str, Any]


def energy_wh(energies: Iterable[int | None]) -> float | None:
    """Return the sum of what flights take in Wh; None if it is known of none."""
    known = [energy for energy in energies if energy is not None]
    return sum(known) / MICROJOULES_PER_WH if known else None


def energy_models(problem: Problem) -> list[Data]:
    """Return the numbers of the presets that a problem's drones fly by, once for each type."""
    drones = dict.fromkeys((kind.type_id, drones.id, drones.energy)
                           for kind in problem.vehicle_types for drones in kind.drone_types)
    drones |= dict.fromkeys((kind.type_id, None, kind.energy) for kind in problem.vehicle_types)
    return [_model(problem, name, drone_type, energy) for name, drone_type, energy in drones
            if energy is not None and energy.preset is not None]


def _model(problem: Problem, name: str, drone_type: str | None, energy: Energy) -> Data:
    unit = 10 ** problem.amount_decimals[energy.dimension]
    points = zip(energy.weights, energy.cruise, energy.hover, energy.climb, energy.descent,
                 strict=True)
    return {
        "vehicle_type": name,
        **({"drone_type": drone_type} if drone_type is not None else {}),
        "preset": energy.preset,
        "available_wh": energy.available / MICROJOULES_PER_WH,
        "up_seconds": energy.climb_duration / 1000,
        "down_seconds": energy.descent_duration / 1000,
        "power": [{"weight": weight / unit, "cruise_w": cruise / 1000, "hover_w": hover / 1000,
                   "up_w": climb / 1000, "down_w": descent / 1000}
                  for weight, cruise, hover, climb, descent in points],
    }
