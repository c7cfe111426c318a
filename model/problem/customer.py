"""Customers, and the places where trips begin and end."""

from dataclasses import dataclass
from typing import Literal

from model.problem.quantities import UNLIMITED, require, require_quantity, require_rate

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
    earliest: int = 0  # no trip begins or ends there before; at a launch site no flight
    latest: int = UNLIMITED  # last departure and return; at a launch site last arrival
    stop_cost: float = 0.0  # of each stop there
    after: str | None = None  # id of the customer who has been served before, by the same vehicle
    batteries: int | None = None  # charged, for trips of who flies from there; None: enough
    chargers: int | None = None  # for who flies from there, each for one at a time; None: enough

    def __post_init__(self) -> None:
        require_quantity(f"{self.kind} {self.id} earliest", self.earliest)
        require(self.earliest <= self.latest <= UNLIMITED, f"{self.kind} {self.id} latest",
                self.latest)
        require_rate(f"{self.kind} {self.id} stop_cost", self.stop_cost)
        require_quantity(f"{self.kind} {self.id} batteries", self.batteries or 0)
        require_quantity(f"{self.kind} {self.id} chargers", self.chargers or 0)

    @property
    def is_launch_site(self) -> bool:
        """Tell whether trucks may stop there amid a trip."""
        return self.kind == "launch_site"


@dataclass(frozen=True, slots=True)
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
    goods: frozenset[str] = frozenset()
    max_time_aboard: int | None = None  # from the trip's departure to the start of service
    setup_duration: int = 0  # before service, for who comes from another place
    site: int | None = None  # places with equal numbers are one place
    gaps: tuple[tuple[int, int], ...] = ()
    """Between several windows: last arrival in one, first start of service in the next."""
    pickup: tuple[int, ...] = ()  # (dimension,) parts taken in, to where the trip ends; (): nothing
    launch: bool = True  # drones may take off, and be recovered, from a truck there
    late_cost: float = 0.0  # once, of coming late at all; where the window is soft
    span: tuple[int, int] | None = None
    """From when to when service begins, by who was served before; trucks wait, at no price."""

    def __post_init__(self) -> None:
        for amount in self.demand:
            require_quantity(f"customer {self.id} demand", amount)
        for amount in self.pickup:
            require_quantity(f"customer {self.id} pickup", amount)
        for name in ("service_duration", "setup_duration", "release_time", "earliest",
                     "max_time_aboard"):
            require_quantity(f"customer {self.id} {name}", getattr(self, name) or 0)
        require(self.earliest <= self.latest, f"customer {self.id} latest", self.latest)
        require(self.latest <= UNLIMITED, f"customer {self.id} latest", self.latest)
        opens = self.earliest
        for closes, reopens in self.gaps:
            require(opens <= closes < reopens, f"customer {self.id} gaps", self.gaps)
            opens = reopens
        require(opens <= self.latest, f"customer {self.id} gaps", self.gaps)
        require_rate(f"customer {self.id} early_cost_per_hour", self.early_cost_per_hour)
        require_rate(f"customer {self.id} late_cost_per_hour", self.late_cost_per_hour or 0.0)
        require_rate(f"customer {self.id} late_cost", self.late_cost)
        require_rate(f"customer {self.id} unassigned_cost", self.unassigned_cost or 0.0)

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
