"""How long launches take that a plan states."""

from app.requests.conversion.names import drone_number
from app.requests.conversion.units import thousandths
from app.schemas.drones import DronesInput, TurnaroundInput
from app.schemas.plan import SortieInput, TripInput
from app.schemas.vehicle import VehicleTypeInput
from model.judge.launches import first_launch, launch_duration
from model.problem import DroneType


def launch_durations(kind: VehicleTypeInput | None, trip: TripInput) -> list[int]:
    """Return how long the launch of each sortie of a vehicle's trip takes, in ms."""
    first, durations = first_launch(trip.sorties), []
    for index, sortie in enumerate(trip.sorties):
        drones = drones_of_sortie(kind, sortie)
        durations.append(0 if drones is None else _launch_duration(drones, index == first))
    return durations


def _launch_duration(drones: DronesInput, is_first: bool) -> int:
    turnaround = drones.turnaround or TurnaroundInput()
    handled = DroneType(1, (), 0, launch_duration=thousandths(drones.launch_duration),
                        swap_duration=thousandths(turnaround.swap_duration))
    return launch_duration(handled, is_first)


def drones_of_sortie(kind: VehicleTypeInput | None, sortie: SortieInput) -> DronesInput | None:
    """Return the drones one of which flies a sortie; the last ones for one that there isn't."""
    return drones_named(kind, sortie.drone)


def drones_named(kind: VehicleTypeInput | None, name: str) -> DronesInput | None:
    """Return the drones one of which has a name; the last ones for one that there isn't."""
    stated = [] if kind is None else kind.drone_types
    carried = [drones for drones in stated if drones.count > 0] or stated
    number = drone_number(name) or 0
    for drones in carried[:-1]:
        number -= drones.count
        if number < 0:
            return drones
    return carried[-1] if carried else None
