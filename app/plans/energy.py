"""What flights take, and what presets say of it, as a reply states them."""

from collections.abc import Iterable, Sequence
from itertools import accumulate
from typing import Any

from model.judge.chargers import levels
from model.judge.energy import charges, sortie_energies
from model.judge.flown_trips import trip_charges, trip_energies
from model.problem import MICROJOULES_PER_WH, Energy, Problem, shares_chargers
from model.solution import Route, Trip

Data = dict[str, Any]


def energy_wh(energies: Iterable[int | None]) -> float | None:
    """Return the sum of what flights take in Wh; None if it is known of none."""
    known = [energy for energy in energies if energy is not None]
    return sum(known) / MICROJOULES_PER_WH if known else None


def left_by_sorties(problem: Problem, kind: int, trip: Trip) -> list[list[Data]]:
    """Return the fields on what each sortie of a trip leaves in its drone's battery.

    For each of its customers, and last for itself; empty ones where it isn't known what flying
    takes.
    """
    vehicle_type = problem.vehicle_types[kind]
    told = []
    for sortie, there in zip(trip.sorties, charges(problem, vehicle_type, trip), strict=True):
        drones = vehicle_type.drone_type(sortie.drone)
        told.append([{}] * (len(sortie.visits) + 1) if drones.energy is None else _left(
            drones.energy, there,
            sortie_energies(problem, drones, drones.energy, trip, sortie)))
    return told


def left_by_trips(problem: Problem, route: Route) -> list[list[Data]]:
    """Return the fields on what is left in the battery of one that flies by itself, by trip and
    stop: at the first as it takes off, at the last as it has landed; empty ones as for sorties.
    """
    kind = problem.vehicle_types[route.vehicle_type]
    if kind.energy is None:
        return [[{}] * len(trip.stops) for trip in route.trips]
    if shares_chargers(problem, kind):
        there = levels(problem, kind, route.trips)
    else:
        there = trip_charges(problem, kind, route.trips)
    return [_left(kind.energy, before, [0, *trip_energies(problem, kind, kind.energy, trip)])
            for before, trip in zip(there, route.trips, strict=True)]


def _left(energy: Energy, before: int, taken: Sequence[int]) -> list[Data]:
    """Return the fields on what is left after each part of a flight, the reserve included."""
    reserve = energy.available / energy.usable_share - energy.available
    return [{"energy_left_wh": (before + reserve - gone) / MICROJOULES_PER_WH}
            for gone in accumulate(taken)]


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
