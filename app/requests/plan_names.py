"""What a problem, or a request, has by the names that plans use."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeVar

from app.requests.conversion.places import revisits, stands_of
from app.schemas.customer import CustomerInput
from app.schemas.launch_site import LaunchSiteInput
from app.schemas.plan import TripInput
from app.schemas.request import DepotInput
from app.schemas.vehicle import VehicleTypeInput
from model.problem import Problem, VehicleType

PlaceName = tuple[str, str]
"""Kind and id of a stop."""
Entry = TypeVar("Entry")
Entries = Sequence[DepotInput | CustomerInput | VehicleTypeInput | None] | None


class KnownType(NamedTuple):
    """A vehicle type: its number, itself if more is known of it, and an open route's end."""

    number: int = 0
    kind: VehicleType | None = None
    nowhere: int | None = None

    def recovery_duration(self, drone: int) -> int:
        """Return how long the recovery of a drone takes in ms."""
        if self.kind is None or self.kind.drones is None:
            return 0
        return self.kind.drone_type(drone).recovery_duration


@dataclass(frozen=True)
class Known:
    """What a problem has by name: nodes, those where types start and end by which of it, and types.

    None where some of it is broken, so that nothing can be said to be missing.
    """

    depots: Mapping[str, int] | None
    stands: Mapping[tuple[str, str], int] | None
    customers: Mapping[str, int] | None
    types: Mapping[str, KnownType] | None

    @classmethod
    def by(cls, problem: Problem) -> "Known":
        """Return what a problem has."""
        return cls(
            {depot.id: node for node, depot in enumerate(problem.depots) if depot.kind == "depot"},
            {(depot.kind, depot.id): node for node, depot in enumerate(problem.depots)},
            {customer.id: node
             for node, customer in enumerate(problem.customers, problem.num_depots)},
            {kind.type_id: KnownType(
                index, kind, kind.ends_at if problem.is_nowhere(kind.ends_at) else None)
             for index, kind in enumerate(problem.vehicle_types)})

    @classmethod
    def of(cls, depots: Sequence[DepotInput | None] | None,
           customers: Sequence[CustomerInput | None] | None,
           fleet: Sequence[VehicleTypeInput | None] | None,
           sites: Sequence[LaunchSiteInput | None] | None = ()) -> "Known":
        """Return what the parts of a request have; their numbers mean nothing."""
        stands = None
        if fleet is not None and None not in fleet:
            stands = {(str(stand.depot.kind), stand.depot.id): 0
                      for kind in fleet if kind is not None for stand in stands_of(kind)}
            places: list[DepotInput | CustomerInput | LaunchSiteInput | None] = [*(sites or ())]
            if any(revisits(kind) for kind in fleet if kind is not None):
                places += [*(depots or ()), *(customers or ())]
            stands |= {("launch_site", place.id): 0 for place in places if place is not None}
        kinds = _by_name(fleet)
        return cls(_by_name(depots), stands, _by_name(customers),
                   None if kinds is None else dict.fromkeys(kinds, KnownType()))


def _by_name(entries: Entries) -> dict[str, int] | None:
    if entries is None or None in entries:
        return None
    return {entry.id: 0 for entry in entries if entry is not None}


@dataclass(frozen=True)
class Names:
    """What a request has; None: it isn't known, since some of it is broken."""

    depots: Sequence[DepotInput] | None
    customers: frozenset[str] | None
    fleet: Mapping[str, VehicleTypeInput] | None
    shipment_ends: frozenset[str] = frozenset()  # names among customers
    sites: frozenset[str] | None = None  # of launch sites, and of places that trucks come back to

    @classmethod
    def of(cls, depots: Sequence[DepotInput | None] | None,
           customers: Sequence[CustomerInput | None] | None,
           fleet: Sequence[VehicleTypeInput | None] | None,
           shipment_ends: frozenset[str] = frozenset(),
           sites: Sequence[LaunchSiteInput | None] | None = ()) -> "Names":
        """Collect the names of a request's parts, None standing for what is broken."""
        known, kinds = _unbroken(customers), _unbroken(fleet)
        stands = None
        if all(_unbroken(part) is not None for part in (depots, customers, fleet, sites)):
            stands = Known.of(depots, customers, fleet, sites).stands
        return cls(_unbroken(depots),
                   None if known is None else frozenset(customer.id for customer in known),
                   None if kinds is None else {kind.id: kind for kind in kinds},
                   shipment_ends, None if stands is None else frozenset(
                       name for stop, name in stands if stop == "launch_site"))

    def _home(self, vehicle_type: VehicleTypeInput) -> PlaceName | None:
        """Return the depot of a type."""
        home = vehicle_type.depot
        if home is None and self.depots:
            home = self.depots[0].id
        return None if home is None else ("depot", home)

    def begin(self, kind: VehicleTypeInput, before: TripInput | None) -> PlaceName | None:
        """Return where a type's trip begins, by the one before; None: that isn't known."""
        if before is not None:
            return before.stops[-1].kind, before.stops[-1].id
        stands = {stand.depot.kind for stand in stands_of(kind)}
        return ("start", kind.id) if "start" in stands else self._home(kind)

    def ends(self, kind: VehicleTypeInput, is_last: bool) -> list[PlaceName] | None:
        """Return where a type's trip may end; None: that isn't known, or at a customer."""
        home = self._home(kind)
        if home is None or (is_last and kind.end == "open"):
            return None
        # A vehicle may stay where its last trip was to end.
        places = [home, *(("depot", name) for name in kind.reload_depots)]
        return [("end", kind.id), *places] if is_last and kind.end != "depot" else places


def _unbroken(entries: Sequence[Entry | None] | None) -> list[Entry] | None:
    whole = [entry for entry in entries or () if entry is not None]
    return whole if entries is not None and len(whole) == len(entries) else None
