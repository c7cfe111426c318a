"""Where a request's vehicles begin and end, beside its depots: further nodes of the problem."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from app.requests.conversion.units import by_name
from app.schemas.customer import CustomerInput
from app.schemas.fields import Avoided
from app.schemas.launch_site import LaunchSiteInput
from app.schemas.request import DepotInput, PlanRequest, RoadsInput
from app.schemas.vehicle import PlaceInput, VehicleTypeInput
from model.problem import BoolArray, Depot

Place = DepotInput | PlaceInput | CustomerInput | LaunchSiteInput
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


@dataclass(frozen=True)
class PlacedRequest:
    """A request and its places as nodes of the problem, worked out once and carried along."""

    request: PlanRequest

    @cached_property
    def _stands(self) -> list[tuple[int, Stand]]:
        """Places of vehicle types that are no depots, by the type's index."""
        return [(index, stand) for index, kind in enumerate(self.request.fleet)
                for stand in stands_of(kind)]

    @cached_property
    def _sites(self) -> list[tuple[Depot, Place, Path]]:
        """Launch sites as nodes, what is said of each place, and the path of its location.

        Those stated, then, if a truck may come back to them, depots and customers once more.
        """
        request = self.request
        sites: list[tuple[Depot, Place, Path]] = [
            (Depot(site.id, "launch_site", stop_cost=site.cost,
                   **by_name(site.time_window, Depot)),
             site, ("launch_sites", index, "location"))
            for index, site in enumerate(request.launch_sites)]
        if not any(revisits(kind) for kind in request.fleet):
            return sites
        sites += [(Depot(depot.id, "launch_site"), depot, ("depots", index, "location"))
                  for index, depot in enumerate(request.depots) if depot.launch]
        sites += [(Depot(customer.id, "launch_site", after=customer.id), customer,
                   ("customers", index, "location"))
                  for index, customer in enumerate(request.customers) if customer.launch]
        return sites

    @cached_property
    def places(self) -> list[Place]:
        """All places, in the order of the problem's nodes, but for nowhere."""
        request = self.request
        return [*request.depots, *(stand.place for _, stand in self._stands),
                *(place for _, place, _ in self._sites), *request.customers]

    @cached_property
    def paths(self) -> list[Path]:
        """The path of each place's location, in the same order."""
        request = self.request
        return [*(("depots", index, "location") for index in range(len(request.depots))),
                *(("fleet", index, *stand.location) for index, stand in self._stands),
                *(path for *_, path in self._sites),
                *(("customers", index, "location") for index in range(len(request.customers)))]

    @cached_property
    def nowhere(self) -> int | None:
        """The node where open routes end, behind all places but customers; None: none does."""
        if all(kind.end != "open" for kind in self.request.fleet):
            return None
        return len(self.places) - len(self.request.customers)

    @property
    def num_nodes(self) -> int:
        """How many nodes the problem has, nowhere among them."""
        return len(self.places) + (self.nowhere is not None)

    @cached_property
    def depots(self) -> tuple[Depot, ...]:
        """The nodes where trips may begin or end."""
        depots = [Depot(depot.id, **by_name(depot, Depot), **by_name(depot.time_window, Depot))
                  for depot in self.request.depots]
        depots += [stand.depot for _, stand in self._stands]
        depots += [site for site, *_ in self._sites]
        return tuple(depots if self.nowhere is None else [*depots, NOWHERE])

    @cached_property
    def curb(self) -> BoolArray | None:
        """(place,) which ones roads lead to on one side of the street; None: to none of them."""
        roads = self.request.roads
        usual = roads.approach if isinstance(roads, RoadsInput) else "any"
        curb: BoolArray = np.array([
            isinstance(place, CustomerInput) and (place.approach or usual) == "curb"
            for place in self.places])
        return curb if curb.any() else None

    @property
    def curb_path(self) -> Path:
        """Where the request first says that a place has a side of the street."""
        stated = [path for path, place in zip(self.paths, self.places, strict=True)
                  if isinstance(place, CustomerInput) and place.approach == "curb"]
        return (*stated[0][:-1], "approach") if stated else ("roads", "approach")

    @property
    def names(self) -> list[tuple[str, str]]:
        """The kind and the id of each place, in their order."""
        depots = [(depot.kind, depot.id) for depot in self.depots if depot != NOWHERE]
        return [*depots, *(("customer", customer.id) for customer in self.request.customers)]

    @property
    def sites(self) -> list[int | None]:
        """A number for each node, equal at one place, where a vehicle that is there needs no setup.

        None where nobody asks for a setup, and nowhere.
        """
        if not any(customer.setup_duration for customer in self.request.customers):
            return [None] * self.num_nodes
        numbers: dict[object, int] = {}
        by_index = bool(self.request.matrices)
        sites: list[int | None] = [
            numbers.setdefault(place.location_index if by_index else place.location, len(numbers))
            for place in self.places]
        if self.nowhere is not None:
            sites.insert(self.nowhere, None)
        return sites


    def may_stop(self, kinds: Sequence[int], serves: BoolArray | None) -> BoolArray | None:
        """Return (type, depot) which vehicles may stop at launch sites; None if there are none.

        Parameters
        ----------
        kinds
            By type of the problem: its index in the fleet.
        serves
            (type, launch site stated) who is allowed there; None: anybody anywhere.
        """
        if not self._sites:
            return None
        stated, first = len(self.request.launch_sites), len(self.request.depots) + len(self._stands)
        table: BoolArray = np.zeros((len(kinds), len(self.depots)), np.bool_)
        table[:, first:first + stated] = True if serves is None else serves
        again = [revisits(self.request.fleet[kind]) for kind in kinds]
        table[again, first + stated:first + len(self._sites)] = True
        return table


def avoided(kind: VehicleTypeInput) -> tuple[Avoided, ...]:
    """Return what vehicles of a type avoid on roads, each once and in one order."""
    return tuple(sorted(set(kind.avoid)))


def revisits(kind: VehicleTypeInput) -> bool:
    """Tell whether trucks of a type may come back to places for their drones."""
    return kind.revisits and any(drones.count > 0 for drones in kind.drone_types)


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
    named = {depot.id: node for node, depot in enumerate(depots) if depot.kind == "depot"}
    home = 0 if kind.depot is None else named[kind.depot]
    reload = sorted({named[name] for name in kind.reload_depots} - {home})
    return Places(home, nodes.get("start"), end, tuple(reload))
