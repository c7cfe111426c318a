"""What the study plans: a task says all that a plan depends on."""

from collections.abc import Iterator
from dataclasses import astuple, dataclass, fields
from typing import Literal

Windows = Literal["off", "soft", "hard"]

WINDOWS: tuple[Windows, ...] = ("off", "soft", "hard")
SPEEDS = ("fixed", "by time of day")
DRONES = (0, 1, 2)
"""On each truck."""

CAPACITIES = (100, 110, 150, 200)
SINGLE, MIXED = "150", "100+150+200"
"""Fleets of the paper's Tables 3 to 5, named by the capacities of their trucks."""

FLEETS = (SINGLE, MIXED, "100", "200")
STUDIED_HOURS = 8.0
POLICIES = ("attention", "pointer")
NOBODY = "insertion"
"""Begins the search where no policy does."""

GREEDY, SAMPLED = "greedy", "128 samples"
NUM_SAMPLES = 128


@dataclass(frozen=True)
class Task:
    """One plan to make."""

    section: str
    customers: int
    case: int  # 1: taken from Table 1
    fleet: str
    hours: float  # longest working duration; 0: no limit
    drones: int  # on each truck
    windows: Windows
    speeds: str
    policy: str  # that begins, or NOBODY; empty: as the service does
    decoding: str  # of the policy
    turns: int  # of the search
    seed: int


@dataclass(frozen=True)
class Planned(Task):
    """A checked plan. Distances in km, a cost per km and per hour of work."""

    cost: float
    fixed: float
    transport: float  # distance and time
    lateness: float
    unassigned: int
    vehicles: int
    trips: int
    sorties: int
    driven: float
    flown: float
    working_hours: float  # of all vehicles
    least_load_rate: float
    mean_load_rate: float
    wall_s: float
    cpu_s: float
    date: str
    machine: str

    @property
    def task(self) -> Task:
        """What was to be planned."""
        return Task(*astuple(self)[:len(fields(Task))])


@dataclass(frozen=True)
class TripRow:
    """A trip of a plan of section `fleets`."""

    customers: int
    case: int
    fleet: str
    seed: int
    vehicle: int  # 1, 2, ...
    trip: int
    capacity: float
    demand: float
    load_rate: float
    course: float  # km, of this trip
    vehicle_course: float  # km, of all trips of the vehicle
    working_rate: float  # of the vehicle


@dataclass(frozen=True)
class Scale:
    """How much is planned."""

    sizes: tuple[int, ...]
    cases: int
    seeds: int
    table1_turns: tuple[int, ...]
    table1_seeds: int
    hours: tuple[float, ...]
    fleet_turns: int  # per customer
    hour_turns: int  # per customer
    drone_sizes: tuple[int, ...]
    drone_cases: int
    drone_turns: int  # per customer
    policy_turns: tuple[int, ...]  # per customer


FULL = Scale(
    sizes=(25, 50, 100), cases=10, seeds=3, table1_turns=(500, 2_000, 6_000, 20_000, 60_000),
    table1_seeds=5,
    hours=(4.0, 5.0, 6.0, 6.5, 7.0, 7.5, 8.0, 9.0, 10.0, 11.0), fleet_turns=1000, hour_turns=240,
    drone_sizes=(50,), drone_cases=5, drone_turns=60, policy_turns=(20, 100))

QUICK = Scale(
    sizes=(25, 50), cases=2, seeds=2, table1_turns=(200, 600, 2_000), table1_seeds=2,
    hours=(4.0, 6.5, 8.0, 11.0), fleet_turns=200, hour_turns=50,
    drone_sizes=(25,), drone_cases=1, drone_turns=20, policy_turns=(20,))


def all_tasks(scale: Scale) -> Iterator[Task]:
    """Yield what a study plans, section after section."""
    yield from table1_tasks(scale)
    yield from fleet_tasks(scale)
    yield from hour_tasks(scale)
    yield from drone_tasks(scale)
    yield from policy_tasks(scale)


def table1_tasks(scale: Scale) -> Iterator[Task]:
    """Table 1 by more and more turns."""
    for turns in scale.table1_turns:
        for seed in range(1, scale.table1_seeds + 1):
            yield Task("table1", 100, 1, "400", 0.0, 1, "off", "fixed", "", GREEDY, turns, seed)


def fleet_tasks(scale: Scale) -> Iterator[Task]:
    """Trucks of one capacity against trucks of all three."""
    for customers, case in _cases(scale.sizes, scale.cases):
        for fleet in FLEETS:
            for seed in range(1, scale.seeds + 1):
                yield Task("fleets", customers, case, fleet, STUDIED_HOURS, 0, "off", "fixed", "",
                           GREEDY, scale.fleet_turns * customers, seed)


def hour_tasks(scale: Scale) -> Iterator[Task]:
    """Working hours by capacity."""
    for customers, case in _cases(scale.sizes, scale.cases):
        for capacity in CAPACITIES:
            for hours in scale.hours:
                yield Task("hours", customers, case, str(capacity), hours, 0, "off", "fixed", "",
                           GREEDY, scale.hour_turns * customers, 1)


def drone_tasks(scale: Scale) -> Iterator[Task]:
    """Drones, windows and speeds, each with each."""
    for customers, case in _cases(scale.drone_sizes, scale.drone_cases):
        for drones in DRONES:
            for windows in WINDOWS:
                for speeds in SPEEDS:
                    yield Task("drones", customers, case, "400", 0.0, drones, windows, speeds, "",
                               GREEDY, scale.drone_turns * customers, 1)


def policy_tasks(scale: Scale) -> Iterator[Task]:
    """Plans by policies alone, and searches that begin with them or with nothing."""
    ways = [(policy, decoding, 0) for policy in POLICIES for decoding in (GREEDY, SAMPLED)]
    ways += [(policy, GREEDY, turns) for turns in scale.policy_turns
             for policy in (*POLICIES, NOBODY)]
    for customers, case in _cases(scale.sizes, scale.cases):
        for policy, decoding, turns in ways:
            yield Task("policies", customers, case, "400", 0.0, 1, "off", "fixed", policy,
                       decoding, turns * customers, 1)


def _cases(sizes: tuple[int, ...], count: int) -> Iterator[tuple[int, int]]:
    for customers in sizes:
        for case in range(1, count + 1):
            yield customers, case
