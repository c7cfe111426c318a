"""What is to be planned: depots, customers, a fleet and its travel matrices.

Inside `model`, times are integer milliseconds since plan start, distances integer millimetres,
amounts integer thousandths or smaller parts, so that simulator, search and checker agree exactly.
Costs are floats.
"""

from bisect import bisect_left
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from model.energy import Energy
from model.overtime import Overtime as Overtime

IntArray = NDArray[np.int64]
FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
UIntArray = NDArray[np.uint64]

UNLIMITED = 2**42
"""Stands for "no limit" on a time (ms) or a distance (mm)."""

UNREACHABLE = 2**50
"""Duration and distance of a flight that can't be flown."""

MAX_QUANTITY = 10**12
"""Largest time (ms), distance (mm) or amount (parts) that a problem may state."""

MAX_MONEY = 1e12
"""Largest price that a request states."""

USUAL_DECIMALS = 3
"""Decimals of amounts, unless a problem states others."""

FULL_SPEED = 1_000_000
"""Factor of a speed profile at which a leg takes its matrix duration."""

MS_PER_HOUR = 3_600_000
MM_PER_KM = 1_000_000

ServedBy = Literal["truck", "drone", "either"]
DepotKind = Literal["depot", "start", "end", "nowhere"]


def _require(condition: bool, name: str, value: object) -> None:
    """Raise `ValueError` naming the field and its value unless `condition` holds."""
    if not condition:
        raise ValueError(f"{name}: {value!r} is not allowed")


def _require_quantity(name: str, value: int, limit: int = MAX_QUANTITY) -> None:
    _require(0 <= value <= limit, name, value)


def _require_rate(name: str, value: float) -> None:
    _require(0 <= value < float("inf"), name, value)


@dataclass(frozen=True)
class Depot:
    """A place where trips may begin or end."""

    id: str
    kind: DepotKind = "depot"
    """Where vehicles of type `id` start or end; nowhere: at a customer, which no drone flies to."""


@dataclass(frozen=True)
class Customer:
    """Place with a demand, served once by a truck or a drone."""

    id: str
    demand: tuple[int, ...]  # (dimension,) parts, by Problem.amount_decimals
    service_duration: int = 0
    earliest: int = 0  # first start of service that needs no waiting
    latest: int = UNLIMITED  # last arrival that is not late
    late_cost_per_hour: float | None = None  # None: the window is hard
    early_cost_per_hour: float = 0.0
    served_by: ServedBy = "either"
    skills: frozenset[str] = frozenset()
    release_time: int = 0  # parcel is at the depot from then on
    unassigned_cost: float | None = None  # of leaving it out; None: the problem's
    gaps: tuple[tuple[int, int], ...] = ()
    """Between several windows: last arrival in one, first start of service in the next."""

    def __post_init__(self) -> None:
        for amount in self.demand:
            _require_quantity(f"customer {self.id} demand", amount)
        _require_quantity(f"customer {self.id} service_duration", self.service_duration)
        _require_quantity(f"customer {self.id} release_time", self.release_time)
        _require_quantity(f"customer {self.id} earliest", self.earliest)
        _require(self.earliest <= self.latest, f"customer {self.id} latest", self.latest)
        _require(self.latest <= UNLIMITED, f"customer {self.id} latest", self.latest)
        opens = self.earliest
        for closes, reopens in self.gaps:
            _require(opens <= closes < reopens, f"customer {self.id} gaps", self.gaps)
            opens = reopens
        _require(opens <= self.latest, f"customer {self.id} gaps", self.gaps)
        _require_rate(f"customer {self.id} early_cost_per_hour", self.early_cost_per_hour)
        _require_rate(f"customer {self.id} late_cost_per_hour", self.late_cost_per_hour or 0.0)
        _require_rate(f"customer {self.id} unassigned_cost", self.unassigned_cost or 0.0)

    @property
    def openings(self) -> tuple[int, ...]:
        """When each window opens."""
        return (self.earliest, *(reopens for _, reopens in self.gaps))


@dataclass(frozen=True)
class SpeedProfile:
    """Speed by time of day, piecewise constant, as a share of the matrix speed."""

    times: tuple[int, ...]  # (change,) ms, strictly increasing
    factors: tuple[int, ...]  # (change + 1,) in 1..FULL_SPEED; the first holds before times[0]

    def __post_init__(self) -> None:
        _require(len(self.factors) == len(self.times) + 1, "speed profile factors", self.factors)
        for factor in self.factors:
            _require(1 <= factor <= FULL_SPEED, "speed profile factor", factor)
        for time, following in zip(self.times, self.times[1:], strict=False):
            _require(time < following, "speed profile times", self.times)
        for time in self.times:
            _require_quantity("speed profile time", time)


@dataclass(frozen=True)
class DroneType:
    """The drones that ride on each truck of a type."""

    count: int
    capacity: tuple[int, ...]  # (dimension,) parts, by Problem.amount_decimals
    travel: int  # index into Problem.travel
    endurance: int = UNLIMITED  # ms from take-off to the beginning of recovery
    endurance_includes_waiting: bool = True  # False: to the drone's arrival there
    launch_duration: int = 0
    recovery_duration: int = 0
    service_duration: int | None = None  # None: the customer's
    max_customers_per_sortie: int = 1
    cost_per_km: float = 0.0
    cost_per_hour: float = 0.0
    energy: Energy | None = None  # what a sortie may take of the battery; None: any

    def __post_init__(self) -> None:
        _require(self.count >= 1, "drone count", self.count)
        _require(self.max_customers_per_sortie >= 1, "drone max_customers_per_sortie",
                 self.max_customers_per_sortie)
        for amount in self.capacity:
            _require_quantity("drone capacity", amount)
        _require_quantity("drone endurance", self.endurance, UNLIMITED)
        _require_quantity("drone launch_duration", self.launch_duration)
        _require_quantity("drone recovery_duration", self.recovery_duration)
        _require_quantity("drone service_duration", self.service_duration or 0)
        _require_rate("drone cost_per_km", self.cost_per_km)
        _require_rate("drone cost_per_hour", self.cost_per_hour)


@dataclass(frozen=True)
class VehicleType:
    """`count` equal trucks, with their drones if `drones` is set."""

    id: str
    count: int
    capacity: tuple[int, ...]  # (dimension,) parts, by Problem.amount_decimals
    travel: int  # index into Problem.travel
    depot: int = 0  # home depot, a node: where a trip may end and the next begin
    fixed_cost: float = 0.0  # per vehicle used
    cost_per_km: float = 0.0
    cost_per_hour: float = 0.0  # of working time
    cost_per_stop: float = 0.0  # per customer served by the truck
    speed_profile: SpeedProfile | None = None
    earliest: int = 0  # shift
    latest: int = UNLIMITED
    max_working_duration: int | None = None
    max_trip_distance: int | None = None
    overtime: Overtime | None = None  # None: shift and working duration can't be exceeded
    max_trips: int = 1
    max_stops: int | None = None  # customers that the truck itself serves on a trip
    max_sorties: int | None = None  # on a trip, of all drones together
    reload_duration: int = 0  # at the depot between trips
    skills: frozenset[str] = frozenset()
    drones: DroneType | None = None
    start: int | None = None  # where its first trip begins, a node; None: at the depot
    end: int | None = None  # where its last trip ends
    reload_depots: tuple[int, ...] = ()  # other nodes where a trip may end and the next begin
    initial_load: tuple[int, ...] = ()  # what its trip carries beside its customers'; (): nothing
    busy_until: int = 0  # its trip may begin sooner, and drones take off, but no truck leave
    works_since: int | None = None  # its work counts from then; None: from its departure
    part_of: str | None = None  # id of the type of which these are some vehicles; None: all
    numbers: tuple[int, ...] = ()  # of these there, from 0, ascending; (): all
    co2_kg_per_km: float | None = None  # of the truck, for replies alone
    co2_kg_per_kwh: float | None = None  # of the energy that its drones use

    def __post_init__(self) -> None:
        _require(self.count >= 1, f"vehicle type {self.id} count", self.count)
        _require(self.max_trips >= 1, f"vehicle type {self.id} max_trips", self.max_trips)
        has_numbers = len(self.numbers) in (0, self.count)
        _require(has_numbers, f"vehicle type {self.id} numbers", self.numbers)
        for amount in self.capacity:
            _require_quantity(f"vehicle type {self.id} capacity", amount)
        _require(self.earliest <= self.latest <= UNLIMITED, f"vehicle type {self.id} latest",
                 self.latest)
        for name in ("earliest", "reload_duration", "busy_until", "max_working_duration",
                     "max_trip_distance", "max_stops", "max_sorties"):
            _require_quantity(f"vehicle type {self.id} {name}", getattr(self, name) or 0)
        for name in ("fixed_cost", "cost_per_km", "cost_per_hour", "cost_per_stop",
                     "co2_kg_per_km", "co2_kg_per_kwh"):
            _require_rate(f"vehicle type {self.id} {name}", getattr(self, name) or 0.0)
        self._require_beginning()

    def _require_beginning(self) -> None:
        """Raise `ValueError` unless what is said of a vehicle's only trip makes sense."""
        for load, most in zip(self.initial_load, self.capacity, strict=bool(self.initial_load)):
            _require_quantity(f"vehicle type {self.id} initial_load", load, most)
        since = self.works_since or 0
        _require_quantity(f"vehicle type {self.id} works_since", since, self.earliest)
        begun = any(self.initial_load) or self.busy_until > 0
        _require(self.max_trips == 1 or not begun, f"vehicle type {self.id} max_trips",
                 self.max_trips)

    @property
    def type_id(self) -> str:
        """The id of the type of which these are some vehicles, or all."""
        return self.id if self.part_of is None else self.part_of

    def vehicle_name(self, vehicle: int) -> str:
        """Return the name of a vehicle, such as `truck-1`."""
        return f"{self.type_id}-{(self.numbers[vehicle] if self.numbers else vehicle) + 1}"

    @property
    def begins_at(self) -> int:
        """The node where the first trip begins."""
        return self.depot if self.start is None else self.start

    @property
    def ends_at(self) -> int:
        """The node where the last trip ends."""
        return self.depot if self.end is None else self.end

    @property
    def reload_places(self) -> tuple[int, ...]:
        """The nodes where a trip may end and the next begin."""
        return (self.depot, *self.reload_depots)


@dataclass(frozen=True, eq=False)
class Travel:
    """Legs between all nodes by one kind of vehicle, rows are origins."""

    duration: IntArray  # (node, node) ms, UNREACHABLE where there is no leg (drones only)
    distance: IntArray  # (node, node) mm

    def __post_init__(self) -> None:
        for name, matrix in (("duration", self.duration), ("distance", self.distance)):
            _require(matrix.dtype == np.int64, f"travel {name} dtype", matrix.dtype)
            _require(matrix.ndim == 2 and matrix.shape[0] == matrix.shape[1],
                     f"travel {name} shape", matrix.shape)
            # Negative entries are the largest ones here: one look at each is enough, mostly.
            if matrix.view(np.uint64).max(initial=0) > MAX_QUANTITY:
                _require(bool((matrix >= 0).all()), f"travel {name}", "negative entry")
                reachable = (matrix <= MAX_QUANTITY) | (matrix == UNREACHABLE)
                _require(bool(reachable.all()), f"travel {name}", "entry too large")
        _require(self.duration.shape == self.distance.shape, "travel distance shape",
                 self.distance.shape)


@dataclass(frozen=True, eq=False)
class Problem:
    """A complete planning problem.

    Nodes are the depots, in order, then the customers, in order: with one depot, node 0 is the
    depot and nodes 1..n are the customers.
    """

    depots: tuple[Depot, ...]
    customers: tuple[Customer, ...]
    vehicle_types: tuple[VehicleType, ...]
    travel: tuple[Travel, ...]
    coordinates: FloatArray  # (node, 2) any planar unit, seen by the policy alone
    unassigned_cost: float  # per customer left out who states no other
    amount_decimals: tuple[int, ...] = ()  # (dimension,) of demands and capacities; for people
    may_serve: BoolArray | None = None  # (vehicle type, customer); None: any type anyone
    must_serve: bool = False  # whoever states no cost of being left out; for people
    num_dimensions: int = field(init=False)

    def __post_init__(self) -> None:
        _require(len(self.depots) >= 1, "depots", "none")
        _require(len(self.vehicle_types) >= 1, "vehicle types", "none")
        _require_rate("unassigned_cost", self.unassigned_cost)
        dimensions = len(self.vehicle_types[0].capacity)
        _require(1 <= dimensions <= 3, "capacity dimensions", dimensions)
        object.__setattr__(self, "num_dimensions", dimensions)
        if not self.amount_decimals:
            object.__setattr__(self, "amount_decimals", (USUAL_DECIMALS,) * dimensions)
        _require(len(self.amount_decimals) == dimensions, "amount decimals", self.amount_decimals)
        _require(self.coordinates.shape == (self.num_nodes, 2), "coordinates shape",
                 self.coordinates.shape)
        _require(bool(np.isfinite(self.coordinates).all()), "coordinates", "not finite")
        if self.may_serve is not None:
            _require(self.may_serve.dtype == np.bool_, "may_serve dtype", self.may_serve.dtype)
            _require(self.may_serve.shape == (len(self.vehicle_types), self.num_customers),
                     "may_serve shape", self.may_serve.shape)
        for matrix in self.travel:
            _require(matrix.duration.shape == (self.num_nodes, self.num_nodes), "travel shape",
                     matrix.duration.shape)
        for customer in self.customers:
            _require(len(customer.demand) == dimensions, f"customer {customer.id} demand",
                     customer.demand)
        for vehicle_type in self.vehicle_types:
            self._require_consistent(vehicle_type)
        for used in {vehicle_type.travel for vehicle_type in self.vehicle_types}:
            _require(bool(self.travel[used].duration.max() < UNREACHABLE), "travel",
                     "unreachable leg")

    def _require_consistent(self, vehicle_type: VehicleType) -> None:
        name = f"vehicle type {vehicle_type.id}"
        _require(len(vehicle_type.capacity) == self.num_dimensions, f"{name} capacity",
                 vehicle_type.capacity)
        for place in ("depot", "begins_at", "ends_at"):
            node = getattr(vehicle_type, place)
            _require(0 <= node < self.num_depots, f"{name} {place}", node)
        _require(set(vehicle_type.reload_places) <= set(range(self.num_depots)),
                 f"{name} reload_depots", vehicle_type.reload_depots)
        _require(len(vehicle_type.initial_load) in (0, self.num_dimensions), f"{name} initial_load",
                 vehicle_type.initial_load)
        _require(0 <= vehicle_type.travel < len(self.travel), f"{name} travel",
                 vehicle_type.travel)
        if vehicle_type.drones is not None:
            _require(len(vehicle_type.drones.capacity) == self.num_dimensions,
                     f"{name} drone capacity", vehicle_type.drones.capacity)
            _require(0 <= vehicle_type.drones.travel < len(self.travel), f"{name} drone travel",
                     vehicle_type.drones.travel)
            energy = vehicle_type.drones.energy
            _require(energy is None or energy.dimension < self.num_dimensions,
                     f"{name} drone energy", energy)

    @property
    def num_depots(self) -> int:
        """Depots; the first customer's node."""
        return len(self.depots)

    @property
    def num_customers(self) -> int:
        """Customers."""
        return len(self.customers)

    @property
    def num_nodes(self) -> int:
        """Depots and customers."""
        return len(self.depots) + len(self.customers)

    def is_nowhere(self, node: int) -> bool:
        """Tell whether a node is no place: who begins or ends there does so at a customer."""
        return node < len(self.depots) and self.depots[node].kind == "nowhere"

    def allows(self, vehicle_type: int, node: int) -> bool:
        """Tell whether the table lets vehicles of a type serve the customer at a node."""
        return self.may_serve is None or bool(self.may_serve[vehicle_type, node - self.num_depots])

    def find_vehicle(self, type_id: str, number: int) -> tuple[int, int]:
        """Return the index of a vehicle's type, and its number there, from 0.

        A number that there isn't is one that the first type of that id hasn't either.

        Raises
        ------
        KeyError
            If there is no such type.
        """
        parts = [index for index, kind in enumerate(self.vehicle_types) if kind.type_id == type_id]
        for index in parts:
            numbers = self.vehicle_types[index].numbers
            place = bisect_left(numbers, number)
            if numbers[place:place + 1] == (number,):
                return index, place
        if not parts:
            raise KeyError(type_id)
        return parts[0], number

    def cost_of_leaving_out(self, customer: Customer) -> float:
        """Return what leaving a customer out costs."""
        own = customer.unassigned_cost
        return self.unassigned_cost if own is None else own

    def must_be_served(self, customer: Customer) -> bool:
        """Tell whether no price was stated at which a customer may be left out."""
        return self.must_serve and customer.unassigned_cost is None

    def customer_at(self, node: int) -> Customer:
        """Return the customer at a node.

        Raises
        ------
        ValueError
            If `node` is a depot or no node.
        """
        _require(self.num_depots <= node < self.num_nodes, "customer node", node)
        return self.customers[node - self.num_depots]
