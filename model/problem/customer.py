"""Customers, and the places where trips begin and end."""

from dataclasses import dataclass
from typing import Literal

from model.problem.quantities import (
    UNLIMITED, Count, Milliseconds, Money, MoneyPerHour, Parts, TimeLimit, require, require_units,
)

DepotKind = Literal["depot", "start", "end", "nowhere", "launch_site"]
ServedBy = Literal["truck", "drone", "either"]


@dataclass(frozen=True, slots=True)
class Depot:
    """A place where trips may begin or end, or where trucks may stop for their drones alone."""

    id: str
    kind: DepotKind = "depot"
    """Where vehicles of type `id` start or end; nowhere: at a customer, which no drone flies to."""
    site: int | None = None  # places with equal numbers are one place
    launch: bool = True  # drones may take off, and be recovered, there
    zones: int = 0  # with hours, in which it lies, as bits
    earliest: Milliseconds = 0  # no trip begins or ends there before; at a launch site no flight
    latest: TimeLimit = UNLIMITED  # last departure and return; at a launch site last arrival
    stop_cost: Money = 0.0  # of each stop there
    after: str | None = None  # id of the customer who has been served before, by the same vehicle
    batteries: Count | None = None  # charged, for trips of who flies from there; None: enough
    chargers: Count | None = None  # for who flies from there, each for one at a time; None: enough

    def __post_init__(self) -> None:
        require_units(self, f"{self.kind} {self.id}")
        require(self.earliest <= self.latest, f"{self.kind} {self.id} latest", self.latest)

    @property
    def is_launch_site(self) -> bool:
        """Tell whether trucks may stop there amid a trip."""
        return self.kind == "launch_site"


@dataclass(frozen=True, slots=True)
class Customer:
    """Place with a demand, served once by a truck or a drone."""

    id: str
    demand: tuple[Parts, ...]  # (dimension,)
    service_duration: Milliseconds = 0
    earliest: Milliseconds = 0  # first start of service that needs no waiting
    latest: TimeLimit = UNLIMITED  # last arrival that is not late
    late_cost_per_hour: MoneyPerHour | None = None  # None: the window is hard
    early_cost_per_hour: MoneyPerHour = 0.0
    served_by: ServedBy = "either"
    skills: frozenset[str] = frozenset()
    release_time: Milliseconds = 0  # parcel is at the depot from then on
    unassigned_cost: Money | None = None  # of leaving it out; None: the problem's
    goods: frozenset[str] = frozenset()
    max_time_aboard: Milliseconds | None = None  # from the trip's departure to the start of service
    setup_duration: Milliseconds = 0  # before service, for who comes from another place
    site: int | None = None  # places with equal numbers are one place
    gaps: tuple[tuple[TimeLimit, TimeLimit], ...] = ()
    """Between several windows: last arrival in one, first start of service in the next."""
    pickup: tuple[Parts, ...] = ()  # (dimension,) taken in, to where the trip ends; (): nothing
    launch: bool = True  # drones may take off, and be recovered, from a truck there
    zones: int = 0  # with hours, in which it lies, as bits
    late_cost: Money = 0.0  # once, of coming late at all; where the window is soft
    span: tuple[int, int] | None = None
    """From when to when service begins, by who was served before; trucks wait, at no price."""

    def __post_init__(self) -> None:
        require_units(self, f"customer {self.id}")
        require(self.earliest <= self.latest, f"customer {self.id} latest", self.latest)
        opens = self.earliest
        for closes, reopens in self.gaps:
            require(opens <= closes < reopens, f"customer {self.id} gaps", self.gaps)
            opens = reopens
        require(opens <= self.latest, f"customer {self.id} gaps", self.gaps)

    @property
    def openings(self) -> tuple[int, ...]:
        """When each window opens."""
        return (self.earliest, *(reopens for _, reopens in self.gaps))

    @property
    def taken_in(self) -> tuple[int, ...]:
        """What is picked up, by dimension."""
        return self.pickup or (0,) * len(self.demand)


@dataclass(frozen=True, slots=True)
class IncompatibleGoods:
    """Goods no two of which may be carried on one trip, or by one vehicle on all its trips."""

    goods: frozenset[str]
    scope: Literal["trip", "vehicle"] = "trip"
