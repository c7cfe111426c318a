"""Rules that a drone breaks which serves a customer alone: in words, and what would change that.
"""

from dataclasses import replace
from math import ceil

from model.counsel.diagnosis import (
    Diagnosis, drones_of, flyer_of, more_of, name_of, told_apart, up_to_tenth, with_flyer,
    with_type,
)
from model.counsel.remedy import Change, in_km, in_minutes
from model.counsel.trial import Attempt
from model.judge.clock import MS_PER_MINUTE
from model.judge.energy import sortie_energy
from model.judge.flown_trips import airborne, trip_energy
from model.judge.rules import airborne_duration, farthest, watt_hours
from model.problem import (
    MAX_BATTERY, MAX_POWER, MICROJOULES_PER_WH, MM_PER_KM, Energy,
    VehicleType,
)

CLOSED = "No flight there and back is over before a zone is closed, or begins behind."

NO_FLIGHT = "No flight leads there from the depot and back."


def unreachable_broken(attempt: Attempt) -> Diagnosis:
    """Say that there is no flight."""
    return Diagnosis("RANGE", NO_FLIGHT)


def endurance_broken(attempt: Attempt) -> Diagnosis:
    """Say by how much a flight lasts too long."""
    drones, trip = flyer_of(attempt), attempt.solution.routes[0].trips[0]
    lasted = (airborne(trip) if isinstance(drones, VehicleType)
              else airborne_duration(attempt.problem, drones, trip, trip.sorties[0]))
    excess = up_to_tenth(lasted - drones.endurance, MS_PER_MINUTE)
    remedy, changed = more_of("endurance", drones, excess, told_apart(drones))
    return Diagnosis(
        "RANGE",
        f"A flight from the depot and back lasts {in_minutes(excess)} more than the endurance"
        f"{name_of(drones)}.",
        remedy,
        with_flyer(attempt, changed),
    )


def max_range_broken(attempt: Attempt) -> Diagnosis:
    """Say by how much a customer lies too far away, or the farther end of a shipment."""
    kind, problem = attempt.vehicle_type, attempt.problem
    trip = attempt.solution.routes[0].trips[0]
    flyer = kind if kind.flies else drones_of(attempt)
    sortie = trip.sorties[0] if trip.sorties else None
    ends = (0, -1) if sortie is None else (sortie.launch_stop, sortie.recovery_stop)
    meetings = [trip.stops[end].node for end in ends]
    served = trip.served if sortie is None else sortie.nodes
    far = max([farthest(problem, flyer, meetings, node) for node in served])
    excess = up_to_tenth(far - (flyer.max_range or 0), MM_PER_KM)
    remedy, farther = more_of("range", flyer, excess, told_apart(flyer))
    changed = (farther if isinstance(farther, VehicleType)
               else replace(kind, drones=farther))
    return Diagnosis("RANGE", f"It lies {in_km(excess)} farther away than the max_range"
                     f"{name_of(flyer)}.",
                     remedy, with_type(attempt, changed))


def wind_broken(attempt: Attempt) -> Diagnosis:
    """Say that it is too windy."""
    flyer = flyer_of(attempt)
    return Diagnosis("WIND", "The wind is too strong for a flight there and back, by max_wind_kmh"
                     f"{name_of(flyer)}.", (Change("wind", told_apart(flyer)),),
                     with_flyer(attempt, replace(flyer, storms=())))


def hours_broken(attempt: Attempt) -> Diagnosis:
    """Say that zones are closed."""
    return Diagnosis("AIRSPACE", CLOSED)


def energy_broken(attempt: Attempt) -> Diagnosis:
    """Say what a battery lacks."""
    drones, trip = flyer_of(attempt), attempt.solution.routes[0].trips[0]
    energy = drones.energy
    if energy is None:
        raise ValueError("drone energy: None is not allowed")
    if isinstance(drones, VehicleType):
        taken, lasted = trip_energy(attempt.problem, drones, trip) or 0, airborne(trip)
    else:
        sortie = trip.sorties[0]
        taken = sortie_energy(attempt.problem, drones, energy, trip, sortie)
        lasted = sortie.recovery_start - sortie.launch_time
    heavier = energy.per_wh * lasted
    tenths = _missing_tenths(energy, taken, heavier)
    larger = None if tenths is None else _with_battery_more(energy, tenths / 10)
    largest = MAX_BATTERY * energy.usable_share * MICROJOULES_PER_WH
    changed = replace(drones, energy=larger or replace(energy, available=taken))
    return Diagnosis(
        "RANGE",
        f"A flight from the depot and back takes {watt_hours(taken)}, and "
        f"{watt_hours(energy.available)} may be taken.",
        (Change("battery", told_apart(drones), tenths),)
        if tenths is not None and larger is not None and larger.available <= largest else (),
        with_flyer(attempt, changed),
    )


def _missing_tenths(energy: Energy, taken: int, heavier: float) -> int | None:
    """Return how many tenths of a Wh a battery lacks for a flight that takes so much.

    It takes `heavier` more for each Wh, since that weighs; None if no battery is large enough.
    """
    if heavier == 0.0:
        return -(-ceil((taken - energy.available) / energy.usable_share) * 10 // MICROJOULES_PER_WH)
    gained = energy.usable_share * MICROJOULES_PER_WH - heavier
    # Powers are rounded to a mW.
    missing = taken - energy.available + heavier / energy.per_wh
    return ceil(missing / gained * 10) if gained > 0 else None


def _with_battery_more(energy: Energy, more: float) -> Energy:
    """Return a battery of so many Wh more, with what it weighs."""
    rise = ceil(more * energy.per_wh)

    def raised(powers: tuple[int, ...]) -> tuple[int, ...]:
        return tuple([min(MAX_POWER, power + rise) for power in powers])

    return replace(
        energy, available=energy.available + round(more * energy.usable_share * MICROJOULES_PER_WH),
        cruise=raised(energy.cruise), hover=raised(energy.hover), climb=raised(energy.climb),
        descent=raised(energy.descent))
