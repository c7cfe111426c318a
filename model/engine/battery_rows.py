"""Drones' batteries as rows of numbers, all 0 where none limits them."""

from model.problem import MAX_POINTS, Energy

NO_ENERGY = (0,) * 6


def battery_row(energy: Energy | None) -> tuple[int, ...]:
    """Return what a type's row says of a battery, but for its powers."""
    if energy is None:
        return NO_ENERGY
    return (len(energy.weights), energy.available, int(energy.lands), energy.climb_duration,
            energy.descent_duration, energy.charge)


def powers_row(energy: Energy | None) -> tuple[tuple[int, ...], ...]:
    """Return weights, and the powers at each."""
    if energy is None:
        return ((0,) * MAX_POINTS,) * 5
    return tuple([(*row, *(0,) * (MAX_POINTS - len(row))) for row in (
        energy.weights, energy.cruise, energy.hover, energy.climb, energy.descent)])


def full_row(energy: Energy | None, drones: int) -> tuple[int, ...]:
    """Return what so many drones have whose batteries are full."""
    return (0 if energy is None else energy.available,) * drones
