"""When launches begin."""

from collections.abc import Sequence

from model.problem import DroneType
from model.solution import Sortie


def launch_begins(sorties: Sequence[Sortie], drones: DroneType | None) -> list[int]:
    """Return when the launch of each sortie of a trip begins."""
    duration = 0 if drones is None else drones.launch_duration
    return [sortie.launch_time - duration for sortie in sorties]
