"""How long launches take: before each of a trip but the first, the drone's battery is swapped."""

from collections.abc import Sequence
from typing import Protocol

from model.problem import DroneType, VehicleType
from model.solution import Sortie


class Launch(Protocol):
    """A sortie, as far as it tells which of a trip's is the first."""

    @property
    def launch_stop(self) -> int:
        """Index of the stop where it takes off."""

    @property
    def launch_time(self) -> float:
        """When it does."""


def launch_duration(drones: DroneType, is_first: bool) -> int:
    """Return how long a launch takes, which is the first of its trip or not."""
    if is_first and not drones.has_launched:
        return drones.launch_duration
    return drones.launch_duration + drones.swap_duration


def first_launch(sorties: Sequence[Launch]) -> int:
    """Return which sortie of a trip takes off first."""
    return min(range(len(sorties)), default=0,
               key=lambda index: (sorties[index].launch_stop, sorties[index].launch_time))


def launch_begins(sorties: Sequence[Sortie], kind: VehicleType) -> list[int]:
    """Return when the launch of each sortie of a trip by a type of vehicle begins."""
    if kind.drones is None:
        return [sortie.launch_time for sortie in sorties]
    first = first_launch(sorties)
    return [sortie.launch_time - launch_duration(kind.drone_type(sortie.drone), index == first)
            for index, sortie in enumerate(sorties)]
