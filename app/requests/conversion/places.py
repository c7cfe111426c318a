"""Where a request's vehicles begin and end, beside its depots: further nodes of the problem."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from app.schemas.customer import CustomerInput
from app.schemas.request import DepotInput, PlanRequest
from app.schemas.vehicle import PlaceInput, VehicleTypeInput
from model.problem import Depot

Place = DepotInput | PlaceInput | CustomerInput
Path = tuple[str | int, ...]

NOWHERE = Depot("nowhere", "nowhere")


class Stand(NamedTuple):
    """Where the vehicles of a type start, or end."""

    depot: Depot
    place: PlaceInput
    location: Path  # in the type
    location_index: Path


def stands_of(kind: VehicleTypeInput) -> Iterator[Stand]:
    """Yield the places of a vehicle type that are no depots."""
    if kind.start_location is not None or kind.start_location_index is not None:
        place = PlaceInput(location=kind.start_location, location_index=kind.start_location_index)
        yield Stand(Depot(kind.id, "start"), place, ("start_location",), ("start_location_index",))
    if isinstance(kind.end, PlaceInput):
        yield Stand(Depot(kind.id, "end"), kind.end, ("end", "location"),
                    ("end", "location_index"))


def places_of(request: PlanRequest) -> list[Place]:
    """Return all places, in the order of the problem's nodes."""
    stands = [stand.place for kind in request.fleet for stand in stands_of(kind)]
    return [*request.depots, *stands, *request.customers]


def paths_of(request: PlanRequest) -> list[Path]:
    """Return the path of each place's location, in the same order."""
    depots = [("depots", index, "location") for index in range(len(request.depots))]
    stands = [("fleet", index, *stand.location) for index, kind in enumerate(request.fleet)
              for stand in stands_of(kind)]
    customers = [("customers", index, "location") for index in range(len(request.customers))]
    return [*depots, *stands, *customers]


def nowhere_of(request: PlanRequest) -> int | None:
    """Return the node where open routes end, behind all places but customers; None: none does."""
    if all(kind.end != "open" for kind in request.fleet):
        return None
    return len(places_of(request)) - len(request.customers)


def depots_of(request: PlanRequest) -> tuple[Depot, ...]:
    """Return the nodes where trips may begin or end."""
    depots = [Depot(depot.id) for depot in request.depots]
    depots += [stand.depot for kind in request.fleet for stand in stands_of(kind)]
    if nowhere_of(request) is not None:
        depots.append(NOWHERE)
    return tuple(depots)


class Places(NamedTuple):
    """Nodes where vehicles of a type begin, end and reload; None: at their depot."""

    depot: int
    start: int | None
    end: int | None
    reload: tuple[int, ...]


def places_of_type(kind: VehicleTypeInput, depots: Sequence[Depot]) -> Places:
    """Return where vehicles of a type begin, end and reload, among the problem's depots."""
    nodes = {stand.depot.kind: depots.index(stand.depot) for stand in stands_of(kind)}
    end = depots.index(NOWHERE) if kind.end == "open" else nodes.get("end")
    home = 0 if kind.depot is None else depots.index(Depot(kind.depot))
    reload = sorted({depots.index(Depot(name)) for name in kind.reload_depots} - {home})
    return Places(home, nodes.get("start"), end, tuple(reload))
