"""How long launches take that a plan states."""

from app.conversion.units import thousandths
from app.schemas.drones import DronesInput, TurnaroundInput
from app.schemas.plan import TripInput
from model.judge.launches import first_launch, launch_duration
from model.problem import DroneType


def launch_durations(drones: DronesInput | None, trip: TripInput) -> list[int]:
    """Return how long the launch of each sortie of a trip takes, in ms."""
    if drones is None:
        return [0 for _ in trip.sorties]
    turnaround = drones.turnaround or TurnaroundInput()
    handled = DroneType(1, (), 0, launch_duration=thousandths(drones.launch_duration),
                        swap_duration=thousandths(turnaround.swap_duration))
    first = first_launch(trip.sorties)
    return [launch_duration(handled, index == first) for index in range(len(trip.sorties))]
