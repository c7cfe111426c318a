"""`EnergyInput` -> `Energy`; powers are rounded here, once, at some weights."""

from collections.abc import Collection, Sequence
from math import ceil

from app.conversion.amounts import counted
from app.conversion.powers import Curve, climb_of, powers_of
from app.conversion.units import thousandths
from app.schemas.drones import DEFAULT_DRONE_SPEED_KMH, DronesInput
from app.schemas.energy import EnergyInput
from model.problem import MAX_POINTS, MICROJOULES_PER_WH, Energy

MILLIWATTS = 1000.0


def climb_duration(drones: DronesInput) -> int:
    """Return how long climb and descent of a leg take together in ms."""
    if drones.energy is None:
        return 0
    climb = climb_of(drones.energy, drones.speed_kmh or DEFAULT_DRONE_SPEED_KMH)
    return thousandths(climb.up_seconds) + thousandths(climb.down_seconds)


def to_energy(drones: DronesInput, stated: EnergyInput, decimals: Sequence[int],
              amounts: Collection[Sequence[int]]) -> Energy:
    """Convert what is stated of a drone's energy; `amounts` are delivered and picked up."""
    dimension, speed = stated.weight_dimension, drones.speed_kmh or DEFAULT_DRONE_SPEED_KMH
    powers, climb = powers_of(stated, speed), climb_of(stated, speed)
    most = counted(drones.capacity, decimals)[dimension]
    most = max(1, min(most, sum([amount[dimension] for amount in amounts])))
    weights: tuple[int, ...] = (0, most)
    if not powers.are_linear:
        weights = _points(most, {amount[dimension] for amount in amounts})
    kg = [weight / 10 ** decimals[dimension] * stated.kg_per_unit for weight in weights]

    def rounded(curve: Curve) -> tuple[int, ...]:
        return tuple([round(max(0.0, curve(weight)) * MILLIWATTS) for weight in kg])

    charge_w = drones.turnaround.charge_w if drones.turnaround else 0.0
    return Energy(
        available=round(stated.battery_wh * (1.0 - stated.reserve) * MICROJOULES_PER_WH),
        usable_share=1.0 - stated.reserve, weights=weights, cruise=rounded(powers.cruise),
        hover=rounded(powers.hover), climb=rounded(powers.climb),
        descent=rounded(powers.descent), climb_duration=thousandths(climb.up_seconds),
        descent_duration=thousandths(climb.down_seconds), dimension=dimension,
        lands=stated.lands, preset=stated.preset, charge=ceil(charge_w * MILLIWATTS))


def _points(most: int, weights: set[int]) -> tuple[int, ...]:
    """Return weights up to `most` at which a curve is stated: those that occur, if they are few.

    Between two the curve is a straight line, which lies above a curve that bends upwards.
    """
    few = {weight for weight in weights if weight < most}
    points = {0, most}
    if len(few | points) <= MAX_POINTS:
        points |= few
    room = MAX_POINTS - len(points)
    points |= {most * step // (room + 1) for step in range(1, room + 1)}
    return tuple(sorted(points))


def is_countable(drones: DronesInput, stated: EnergyInput, decimals: Sequence[int],
                 amounts: Collection[Sequence[int]]) -> bool:
    """Tell whether what flying takes with the most aboard can be counted."""
    try:
        to_energy(drones, stated, decimals, amounts)
    except (OverflowError, ValueError):
        return False
    return True
