"""`EnergyInput` -> `Energy`; powers are rounded here, once, at some weights."""

from collections.abc import Collection, Sequence
from math import ceil

from app.requests.conversion.amounts import counted
from app.requests.conversion.powers import Curve, climb_of, powers_of
from app.requests.conversion.units import thousandths
from app.schemas.drones import DEFAULT_DRONE_SPEED_KMH, Flyer
from app.schemas.energy import EnergyInput
from model.problem import MAX_POINTS, MAX_POWER, MICROJOULES_PER_WH, Energy
from model.problem.energy import MAX_RISE

MILLIWATTS = 1000.0


def climb_duration(drones: Flyer) -> int:
    """Return how long climb and descent of a leg take together in ms."""
    if drones.energy is None:
        return 0
    climb = climb_of(drones.energy, drones.speed_kmh or DEFAULT_DRONE_SPEED_KMH)
    return thousandths(climb.up_seconds) + thousandths(climb.down_seconds)


def to_energy(drones: Flyer, stated: EnergyInput, decimals: Sequence[int],
              amounts: Collection[Sequence[int]]) -> Energy:
    """Convert what is stated of a drone's energy; `amounts` are delivered and picked up."""
    dimension, speed = stated.weight_dimension, drones.speed_kmh or DEFAULT_DRONE_SPEED_KMH
    powers, climb = powers_of(stated, speed), climb_of(stated, speed)
    capacity = max(1, counted(drones.capacity, decimals)[dimension])
    most = max(1, min(capacity, sum([amount[dimension] for amount in amounts])))
    kg_per_part = stated.kg_per_unit / 10 ** decimals[dimension]

    def milliwatts(curve: Curve, weight: int) -> int:
        return round(max(0.0, curve(weight * kg_per_part)) * MILLIWATTS)

    weights: tuple[int, ...] = (0, most)
    if not powers.are_linear:
        weights = _points(most, capacity, {amount[dimension] for amount in amounts})
    elif all(_can_be_stated(milliwatts(curve, 0), milliwatts(curve, capacity), capacity)
             for curve in powers[:4]):
        weights = (0, capacity)

    def rounded(curve: Curve) -> tuple[int, ...]:
        return tuple([milliwatts(curve, weight) for weight in weights])

    charge_w = drones.turnaround.charge_w if drones.turnaround else 0.0
    return Energy(
        available=round(stated.battery_wh * (1.0 - stated.reserve) * MICROJOULES_PER_WH),
        usable_share=1.0 - stated.reserve, weights=weights, cruise=rounded(powers.cruise),
        hover=rounded(powers.hover), climb=rounded(powers.climb),
        descent=rounded(powers.descent), climb_duration=thousandths(climb.up_seconds),
        descent_duration=thousandths(climb.down_seconds), dimension=dimension,
        lands=stated.lands, preset=stated.preset, charge=ceil(charge_w * MILLIWATTS),
        per_wh=powers.per_wh * MILLIWATTS)


def _can_be_stated(empty: int, full: int, capacity: int) -> bool:
    """Tell whether powers in mW with nothing and the most aboard are no larger than may be."""
    return max(empty, full) <= MAX_POWER and abs(full - empty) * capacity < MAX_RISE


def _points(most: int, capacity: int, weights: set[int]) -> tuple[int, ...]:
    """Return weights up to `most` at which a curve is stated: those that occur, if they are few.

    Between two the curve is a straight line, which lies above a curve that bends upwards. What
    room is left is filled with halves, quarters and so on of a weight that changes with the most
    only where that doubles: so one more customer leaves what others take as it is, mostly.
    """
    few = {weight for weight in weights if weight < most}
    points = {0, most}
    if len(few | points) <= MAX_POINTS:
        points |= few
    parts = ((odd, 2**depth) for depth in range(1, MAX_POINTS) for odd in range(1, 2**depth, 2))
    whole = min(capacity, 1 << (most - 1).bit_length())
    for odd, part in parts:
        if len(points) == MAX_POINTS or part > whole:
            break
        if whole * odd // part < most:
            points.add(whole * odd // part)
    return tuple(sorted(points))


def is_countable(drones: Flyer, stated: EnergyInput, decimals: Sequence[int],
                 amounts: Collection[Sequence[int]]) -> bool:
    """Tell whether what flying takes with the most aboard can be counted."""
    try:
        to_energy(drones, stated, decimals, amounts)
    except (OverflowError, ValueError):
        return False
    return True
