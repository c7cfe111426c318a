"""What the drone of a sortie meets. Compiled."""

from model.kernel.compiled import inlined, pasted
from model.kernel.drone_types import row_of_drone
from model.kernel.leg import AllLegs, TravelLegs, legs_of
from model.kernel.records import Record, Records
from model.kernel.stop import places_by_air
from model.search.route.layout import World

Skies = tuple[Records, int, Records, AllLegs]
"""What drones meet: all types, by which truck, nodes, legs. A call would copy a whole `World`."""


@inlined
def skies_of(world: World, k: int) -> Skies:
    """Return what the drones on a truck meet."""
    return world.type, k, world.place, world.leg


@pasted
def craft_of(skies: Skies, sortie: Record) -> tuple[Record, Records, TravelLegs, TravelLegs]:
    """Return the row and the nodes of a sortie's drones, its legs to customers and those home."""
    types, k, places, legs = skies
    kind = types[row_of_drone(types, k, sortie.drone)]
    return (kind, places_by_air(places, kind), legs_of(legs, kind.drone_travel),
            legs_of(legs, kind.home_travel))
