"""Vehicles and their drones."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from model.problem.breaks import MAX_BREAKS, Break
from model.problem.customer import Customer
from model.problem.driving import DrivingRules
from model.problem.energy import Energy
from model.problem.overtime import Overtime
from model.problem.quantities import (
    FULL_SPEED, UNLIMITED, Count, Microjoules, Millimetres, Milliseconds, Money, MoneyPerHour,
    MoneyPerKm, MoneyPerLoadKm, Parts, Rate, TimeLimit, require, require_units,
)
from model.problem.storms import Closings, Storms, require_closings, require_storms

Pickups = Literal["any", "last"]


@dataclass(frozen=True)
class SpeedProfile:
    """Speed by time of day, piecewise constant, as a share of the matrix speed."""

    times: tuple[Milliseconds, ...]  # (change,) strictly increasing
    factors: tuple[int, ...]  # (change + 1,) in 1..FULL_SPEED; the first holds before times[0]

    def __post_init__(self) -> None:
        require(len(self.factors) == len(self.times) + 1, "speed profile factors", self.factors)
        for factor in self.factors:
            require(1 <= factor <= FULL_SPEED, "speed profile factor", factor)
        for time, following in zip(self.times, self.times[1:], strict=False):
            require(time < following, "speed profile times", self.times)
        require_units(self, "speed profile")


@dataclass(frozen=True)
class DroneType:
    """Equal drones that ride on each truck of a type."""

    count: Count
    capacity: tuple[Parts, ...]  # (dimension,)
    travel: int  # index into Problem.travel
    endurance: TimeLimit = UNLIMITED  # from take-off to the beginning of recovery
    endurance_includes_waiting: bool = True  # False: to the drone's arrival there
    launch_duration: Milliseconds = 0
    recovery_duration: Milliseconds = 0
    service_duration: Milliseconds | None = None  # None: the customer's
    service_durations: Mapping[str, Milliseconds] = field(default_factory=dict)
    """By customer's id, instead."""
    max_customers_per_sortie: Count = 1
    max_range: Millimetres | None = None  # to customers from where it is launched, and recovered
    straight: int = 0  # index into Problem.travel, whose distances tell that
    storms: Storms = ()  # no flight may be in the air then
    closings: Closings = ()  # nor any to or from these zones
    cost_per_km: MoneyPerKm = 0.0
    cost_per_hour: MoneyPerHour = 0.0
    energy: Energy | None = None  # what a sortie may take of the battery; None: any
    swap_duration: Milliseconds = 0  # of the battery, before each launch of a trip but the first
    batteries: Count | None = None  # for each trip, all drones' together; None: enough
    has_launched: bool = False  # on the trip that its truck is on, before it goes on
    id: str | None = None  # among the types of drones on a truck; for people

    def __post_init__(self) -> None:
        require(self.count >= 1, "drone count", self.count)
        require(self.max_customers_per_sortie >= 1, "drone max_customers_per_sortie",
                 self.max_customers_per_sortie)
        require_units(self, "drone")
        require_storms("drone storms", self.storms)
        require_closings("drone closings", self.closings)

    def service_at(self, customer: Customer) -> int:
        """Return how long it serves a customer."""
        own = self.service_durations.get(customer.id, self.service_duration)
        return customer.service_duration if own is None else own


@dataclass(frozen=True)
class VehicleType:
    """`count` equal trucks, with their drones if `drones` is set, or drones that fly themselves."""

    id: str
    count: Count
    capacity: tuple[Parts, ...]  # (dimension,)
    travel: int  # index into Problem.travel; of flights if it flies
    depot: int = 0  # home depot, a node: where a trip may end and the next begin
    fixed_cost: Money = 0.0  # per vehicle used
    cost_per_km: MoneyPerKm = 0.0
    cost_per_hour: MoneyPerHour = 0.0  # of working time
    cost_per_stop: Money = 0.0  # per customer served by the truck
    cost_per_load_km: MoneyPerLoadKm = 0.0  # per unit of the first dimension aboard
    speed_profile: SpeedProfile | None = None
    earliest: Milliseconds = 0  # shift
    latest: TimeLimit = UNLIMITED
    last_by_shift: TimeLimit = UNLIMITED  # last end, with overtime, if its depot is open
    max_working_duration: Milliseconds | None = None
    max_trip_distance: Millimetres | None = None
    max_distance: Millimetres | None = None  # of all its trips together
    limited: int | None = None  # index into Problem.travel, whose distances count for that
    max_travel_duration: Milliseconds | None = None  # on legs, of all its trips together
    overtime: Overtime | None = None  # None: shift and working duration can't be exceeded
    max_trips: Count = 1
    max_stops: Count | None = None  # customers that the truck itself serves on a trip
    max_sorties: Count | None = None  # on a trip, of all drones together
    max_airborne: Count | None = None  # of a truck's drones, at once
    truck_waits: bool = False  # drones are launched and recovered at the same stop
    reload_duration: Milliseconds = 0  # at the depot between trips
    skills: frozenset[str] = frozenset()
    service_durations: Mapping[str, Milliseconds] = field(default_factory=dict)
    """By customer's id, instead."""
    pickups: Pickups = "any"  # "last": on each trip after all deliveries, of which there is one
    has_delivered: bool = False  # on its trip, before it begins
    lifo: bool = False  # only what was loaded last can be unloaded
    drones: DroneType | None = None  # on each truck, numbered from 0
    more_drones: tuple[DroneType, ...] = ()  # of other types, numbered on behind those before
    start: int | None = None  # where its first trip begins, a node; None: at the depot
    end: int | None = None  # where its last trip ends
    reload_depots: tuple[int, ...] = ()  # other nodes where a trip may end and the next begin
    initial_load: tuple[Parts, ...] = ()  # what its trip carries beside its customers'; (): nothing
    charge_left: tuple[Microjoules, ...] = ()  # of each drone, by number, at first; (): full
    busy_until: Milliseconds = 0  # its trip may begin before, and drones fly, but no truck leave
    works_since: Milliseconds | None = None  # its work counts from then; None: from its departure
    part_of: str | None = None  # id of the type of which these are some vehicles; None: all
    numbers: tuple[int, ...] = ()  # of these there, from 0, ascending; (): all
    flies: bool = False  # by itself, from depots: served by it is served by drone
    endurance: TimeLimit = UNLIMITED  # of one that flies: from a trip's take-off to its landing
    launch_duration: Milliseconds = 0  # of one that flies, as each trip begins
    recovery_duration: Milliseconds = 0  # of one that flies, as each trip ends
    energy: Energy | None = None  # of one that flies: what a trip may take of the battery
    max_range: Millimetres | None = None  # of one that flies: to customers from a trip's ends
    storms: Storms = ()  # of one that flies: no trip may be in the air then
    closings: Closings = ()  # of one that flies: nor any to or from these zones
    straight: int = 0  # index into Problem.travel, whose distances tell that
    breaks: tuple[Break, ...] = ()  # of each driver, in the order in which they are taken
    driving: DrivingRules | None = None  # None: drivers need no rest beside their breaks
    co2_kg_per_km: Rate | None = None  # of the truck, for replies alone
    co2_kg_per_kwh: Rate | None = None  # of the energy that its drones use

    def __post_init__(self) -> None:
        require_units(self, f"vehicle type {self.id}")
        require(self.count >= 1, f"vehicle type {self.id} count", self.count)
        require(self.max_trips >= 1, f"vehicle type {self.id} max_trips", self.max_trips)
        has_numbers = len(self.numbers) in (0, self.count)
        require(has_numbers, f"vehicle type {self.id} numbers", self.numbers)
        require(self.earliest <= self.latest, f"vehicle type {self.id} latest", self.latest)
        require(self.max_airborne != 0, f"vehicle type {self.id} max_airborne", self.max_airborne)
        require(self.drones is not None or not self.more_drones,
                f"vehicle type {self.id} more_drones", self.more_drones)
        require(len(self.breaks) <= (0 if self.flies else MAX_BREAKS),
                f"vehicle type {self.id} breaks", len(self.breaks))
        for each in self.breaks:
            require(each.max_load is None or len(each.max_load) == len(self.capacity),
                    f"vehicle type {self.id} break {each.id} max_load", each.max_load)
        self._require_flight()
        self._require_beginning()
        self._require_driving()

    def _require_flight(self) -> None:
        """Raise `ValueError` unless what is said of flights makes sense."""
        name = f"vehicle type {self.id}"
        is_said = (self.endurance != UNLIMITED or self.launch_duration > 0
                   or self.recovery_duration > 0 or self.energy is not None
                   or self.max_range is not None or bool(self.storms or self.closings))
        require_storms(f"{name} storms", self.storms)
        require_closings(f"{name} closings", self.closings)
        require(self.flies or not is_said, f"{name} flies", self.flies)
        if self.flies:
            require(self.drones is None, f"{name} drones", self.drones)
            require(self.speed_profile is None, f"{name} speed_profile", self.speed_profile)

    def _require_beginning(self) -> None:
        """Raise `ValueError` unless what is said of a vehicle's only trip makes sense."""
        for load, most in zip(self.initial_load, self.capacity, strict=bool(self.initial_load)):
            require(load <= most, f"vehicle type {self.id} initial_load", load)
        require((self.works_since or 0) <= self.earliest, f"vehicle type {self.id} works_since",
                self.works_since)
        require(len(self.charge_left) in (0, 1 if self.flies else self.num_drones),
                f"vehicle type {self.id} charge_left", self.charge_left)
        require(self.max_trips == 1 or not self.has_begun, f"vehicle type {self.id} max_trips",
                self.max_trips)

    def _require_driving(self) -> None:
        """Raise `ValueError` unless it has a driver who may rest by rules, and be on legs."""
        require(not self.flies or self.driving is None, f"vehicle type {self.id} driving",
                self.driving)
        require(self.max_travel_duration is None or not self.flies,
                f"vehicle type {self.id} max_travel_duration", self.max_travel_duration)

    @property
    def has_begun(self) -> bool:
        """Tell whether its only trip was begun already."""
        return (any(self.initial_load) or self.busy_until > 0 or self.has_delivered
                or (bool(self.charge_left) and not self.flies)
                or (self.drones is not None and self.drones.has_launched))

    def service_at(self, customer: Customer) -> int:
        """Return how long a truck serves a customer."""
        return self.service_durations.get(customer.id, customer.service_duration)

    @property
    def takes_batteries(self) -> bool:
        """Whether each of its trips takes a battery of those at the depot where it begins."""
        return self.flies and not (self.energy is not None and self.energy.charge)

    @property
    def trips_uncharged(self) -> int:
        """How many trips it makes at most that has no place to charge all day, in rollouts."""
        if not self.flies or self.takes_batteries:
            return UNLIMITED
        return 0 if self.charge_left else 1

    @property
    def most_airborne(self) -> int:
        """How many of a truck's drones may be in the air at once."""
        return self.num_drones if self.max_airborne is None else self.max_airborne

    @property
    def drone_types(self) -> tuple[DroneType, ...]:
        """The types of drones on each truck, in the order of the drones' numbers."""
        return () if self.drones is None else (self.drones, *self.more_drones)

    @property
    def num_drones(self) -> int:
        """How many drones each truck carries, of all types."""
        return sum([drones.count for drones in self.drone_types])

    def drone_index(self, number: int) -> int:
        """Return which of `drone_types` a truck's drone is; the last for one that there isn't."""
        index = 0
        while index < len(self.more_drones) and number >= self.drone_types[index].count:
            number -= self.drone_types[index].count
            index += 1
        return index

    def drone_type(self, number: int) -> DroneType:
        """Return the type of a truck's drone, as `drone_index` says.

        Raises
        ------
        ValueError
            If there are no drones.
        """
        if self.drones is None:
            raise ValueError(f"vehicle type {self.id} drones: None is not allowed")
        return self.drone_types[self.drone_index(number)] if self.more_drones else self.drones

    @property
    def dearest_hour(self) -> float:
        """What an hour of work costs at most."""
        return self.cost_per_hour + (self.overtime.cost_per_hour if self.overtime else 0.0)

    @property
    def type_id(self) -> str:
        """The id of the type of which these are some vehicles, or all."""
        return self.id if self.part_of is None else self.part_of

    def vehicle_name(self, vehicle: int) -> str:
        """Return the name of a vehicle, such as `truck-1`, also of one that there isn't."""
        is_known = 0 <= vehicle < len(self.numbers)
        return f"{self.type_id}-{(self.numbers[vehicle] if is_known else vehicle) + 1}"

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
