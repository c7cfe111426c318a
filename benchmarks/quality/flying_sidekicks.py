"""Tandem on the multiple flying sidekicks TSP, under its own energies, against proven optima.

`python -m benchmarks.quality.flying_sidekicks`: one truck, one to four UAVs, 8 customers; the
makespan counts. A plan's energies are those of `murray-raj-2020` in docs/use/drones.md. What
`Problem` lacks: the truck's own service takes turns with launches and recoveries there, in any
order. So a problem fixes at whom service comes first, in the leg there, and at whom last, in the
leg on; each plan that the search finds is timed in the best of all orders, which is what the next
problem fixes.

References
----------
Murray and Raj (2020), the multiple flying sidekicks traveling salesman problem: parcel delivery
with multiple drones, Transportation Research Part C 110:368-398.
"""

import csv
import math
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from app.requests.conversion.powers import murray_raj_flight, murray_raj_vertical
from benchmarks.peers.versus import machine
from benchmarks.results import gap_percent
from benchmarks.rows import appended, read_rows
from model.judge.check import check
from model.engine.instance import pack
from model.problem import (
    MS_PER_HOUR, Customer, Depot, DroneType, Energy, FloatArray, Problem, Travel, VehicleType,
)
from model.search.improve import SearchConfig, improve
from model.search.strategy import Moves
from model.solution import Solution

UNIT = 10**6
"""Units of time in a second, and of weight in a pound: rounded legs are off by microseconds."""

KG_PER_LB, PAYLOAD_LB = 0.453592, 5.0
TRUCK_SERVICE, SERVICE, LAUNCH, RECOVERY = 30.0, 60.0, 60.0, 30.0
ALTITUDE, HALF_TURN, EARTH_RADIUS = 50.0, 0.5, 6_378_100.0
CRUISE = {"101": 31.2928, "102": 31.2928, "103": 15.6464, "104": 15.6464}
BATTERY = {"101": 457_503.0, "102": 904_033.0, "103": 291_094.0, "104": 562_990.0}

EQUAL = 1e-6
"""Largest relative excess over an optimum of a plan that reaches it."""

SLICE = 0.05
"""Seconds for the search of one problem."""

Flight = tuple[int, int, int, int]  # stop of launch, customer, stop of recovery, UAV


@dataclass(frozen=True, eq=False)
class Sidekicks:
    """An instance for a number of UAVs of a type; node 0 is the depot."""

    name: str
    uav: str
    count: int
    optimum: float  # seconds
    drive: FloatArray  # (node, node) seconds
    fly: FloatArray  # (node, node) seconds, climb and descent included
    pounds: Sequence[float]  # by node

    @property
    def key(self) -> tuple[str, str, int]:
        """What tells it from others."""
        return self.name, self.uav, self.count

    def left(self, launch: int, customer: int, recovery: int) -> float:
        """Return what a sortie leaves for hovering, in seconds."""
        kg = self.pounds[customer] * KG_PER_LB
        taken = (_leg_joules(self.uav, float(self.fly[launch, customer]), kg)
                 + _leg_joules(self.uav, float(self.fly[customer, recovery]), 0.0))
        return (BATTERY[self.uav] - taken) / murray_raj_vertical(0.0, 0.0)


def climb_seconds(uav: str) -> tuple[float, float]:
    """Return how long climb and descent of a leg take."""
    return ALTITUDE / (CRUISE[uav] / 2) + HALF_TURN, ALTITUDE / (CRUISE[uav] / 4)


def _leg_joules(uav: str, seconds: float, kg: float) -> float:
    speed, (up, down) = CRUISE[uav], climb_seconds(uav)
    return (murray_raj_vertical(kg, speed / 2) * up + murray_raj_vertical(kg, speed / 4) * down
            + murray_raj_flight(kg, speed) * (seconds - up - down))


def load(folder: Path, known: Path) -> list[Sidekicks]:
    """Return the instances whose optimum is proven, in the order of the file."""
    with known.open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["proven_optimal"] == "yes"]
    read = {row["instance"]: _read(folder / "instances" / row["instance"]) for row in rows}
    found = []
    for row in rows:
        drive, great_circle, pounds = read[row["instance"]]
        fly = great_circle / CRUISE[row["uav_type"]] + sum(climb_seconds(row["uav_type"]))
        found.append(Sidekicks(row["instance"], row["uav_type"], int(row["num_uavs"]),
                               float(row["best_known"]), drive, fly, pounds))
    return found


def _read(folder: Path) -> tuple[FloatArray, FloatArray, list[float]]:
    """Return seconds driven, metres flown and pounds of parcels."""
    places = np.atleast_2d(np.loadtxt(folder / "tbl_locations.csv", delimiter=",", comments="%"))
    legs = np.loadtxt(folder / "tbl_truck_travel_data_PG.csv", delimiter=",", comments="%")
    drive = np.zeros((len(places), len(places)))
    drive[legs[:, 0].astype(int), legs[:, 1].astype(int)] = legs[:, 2]
    latitude, longitude = np.radians(places[:, 2]), np.radians(places[:, 3])
    half = (np.sin((latitude[:, None] - latitude) / 2) ** 2 + np.cos(latitude)[:, None]
            * np.cos(latitude) * np.sin((longitude[:, None] - longitude) / 2) ** 2)
    return drive, 2 * EARTH_RADIUS * np.arcsin(np.sqrt(half)), places[:, 5].tolist()


def _scaled(values: FloatArray) -> Travel:
    whole = np.rint(values * UNIT).astype(np.int64)
    np.fill_diagonal(whole, 0)
    return Travel(whole, whole)


def to_problem(instance: Sidekicks, first: frozenset[int]) -> Problem:
    """Return the problem in which the truck serves some customers before all else there.

    All others it serves after all else.
    """
    nodes = range(1, len(instance.pounds))
    before = np.array([TRUCK_SERVICE * (node in first) for node in range(len(instance.pounds))])
    after = np.array([0.0, *(TRUCK_SERVICE * (node not in first) for node in nodes)])
    customers = tuple(
        Customer(str(node), (round(instance.pounds[node] * UNIT),), served_by=(
            "either" if instance.pounds[node] <= PAYLOAD_LB else "truck")) for node in nodes)
    drones = DroneType(
        instance.count, (round(PAYLOAD_LB * UNIT),), travel=1,
        launch_duration=round(LAUNCH * UNIT), recovery_duration=round(RECOVERY * UNIT),
        service_duration=round(SERVICE * UNIT), energy=_energy(instance))
    truck = VehicleType("truck", 1, (sum(customer.demand[0] for customer in customers),), travel=0,
                        cost_per_hour=MS_PER_HOUR / UNIT, works_since=0, drones=drones)
    return Problem((Depot("depot"),), customers, (truck,),
                   (_scaled(instance.drive + after[:, None] + before), _scaled(instance.fly)),
                   np.zeros((len(instance.pounds), 2)), unassigned_cost=1e6)


def _energy(instance: Sidekicks) -> Energy:
    speed, (up, down) = CRUISE[instance.uav], climb_seconds(instance.uav)
    weights = tuple(sorted({0.0, PAYLOAD_LB, *(
        pounds for pounds in instance.pounds if 0 < pounds <= PAYLOAD_LB)}))
    kg = [weight * KG_PER_LB for weight in weights]

    def vertical(at: float) -> tuple[int, ...]:
        return tuple(round(murray_raj_vertical(weight, at) * 1000) for weight in kg)

    return Energy(
        available=round(BATTERY[instance.uav] * 1000 * UNIT), usable_share=1.0,
        weights=tuple(round(weight * UNIT) for weight in weights),
        cruise=tuple(round(murray_raj_flight(weight, speed) * 1000) for weight in kg),
        hover=vertical(0.0), climb=vertical(speed / 2), descent=vertical(speed / 4),
        climb_duration=round(up * UNIT), descent_duration=round(down * UNIT))


@dataclass
class Timing:
    """The best order of all that is done at the stops of a plan."""

    instance: Sidekicks
    stops: Sequence[int]
    flights: Sequence[Flight]
    best: float = math.inf
    first: frozenset[int] = frozenset()  # customers of the truck who are served before all else
    _back: dict[int, float] = field(default_factory=dict)

    def solve(self) -> "Timing":
        """Try all orders that may be best. In place; returns itself."""
        self._arrive(0, 0.0, frozenset())
        return self

    def _arrive(self, stop: int, now: float, first: frozenset[int]) -> None:
        launches = frozenset(i for i, flight in enumerate(self.flights) if flight[0] == stop)
        recoveries = frozenset(i for i, flight in enumerate(self.flights) if flight[2] == stop)
        served = stop in (0, len(self.stops) - 1)
        self._work(stop, now, launches, recoveries, served, first)

    def _work(self, stop: int, now: float, launches: frozenset[int], recoveries: frozenset[int],
              served: bool, first: frozenset[int]) -> None:
        """Do what is left to do at a stop, in each order."""
        if now + self._least(stop, launches, recoveries, served) >= self.best - 1e-9:
            return
        if served and not launches and not recoveries:
            if stop == len(self.stops) - 1:
                self.best, self.first = now, first
            else:
                leg = float(self.instance.drive[self.stops[stop], self.stops[stop + 1]])
                self._arrive(stop + 1, now + leg, first)
            return
        if not served:
            untouched = all((flight[0] != stop or i in launches)
                            and (flight[2] != stop or i in recoveries)
                            for i, flight in enumerate(self.flights))
            self._work(stop, now + TRUCK_SERVICE, launches, recoveries, True,
                       first | {self.stops[stop]} if untouched else first)
        for i in recoveries:
            launch, customer, recovery, _ = self.flights[i]
            begin = max(now, self._back[i])
            limit = self.instance.left(self.stops[launch], customer, self.stops[recovery])
            if begin - self._back[i] <= limit:
                self._work(stop, begin + RECOVERY, launches, recoveries - {i}, served, first)
        for i in launches:
            launch, customer, recovery, uav = self.flights[i]
            if any(self.flights[j][3] == uav for j in recoveries):
                continue
            fly = self.instance.fly
            self._back[i] = (now + LAUNCH + float(fly[self.stops[launch], customer]) + SERVICE
                             + float(fly[customer, self.stops[recovery]]))
            self._work(stop, now + LAUNCH, launches - {i}, recoveries, served, first)

    def _least(self, stop: int, launches: frozenset[int], recoveries: frozenset[int],
               served: bool) -> float:
        """Return how long all that is left takes the truck at least."""
        later = range(stop, len(self.stops) - 1)
        return (sum(float(self.instance.drive[self.stops[p], self.stops[p + 1]]) for p in later)
                + TRUCK_SERVICE * (max(0, len(self.stops) - 2 - stop) + (not served))
                + LAUNCH * (len(launches) + sum(flight[0] > stop for flight in self.flights))
                + RECOVERY * (len(recoveries) + sum(flight[2] > stop for flight in self.flights)))


def timing_of(instance: Sidekicks, solution: Solution) -> Timing:
    """Return the best order of what a plan does."""
    trip = solution.routes[0].trips[0]
    flights = [(sortie.launch_stop, sortie.visits[0].node, sortie.recovery_stop, sortie.drone)
               for sortie in trip.sorties]
    return Timing(instance, [stop.node for stop in trip.stops], flights).solve()


def plan(instance: Sidekicks, seconds: float, seed: int) -> float:
    """Return the best makespan found in so many seconds."""
    rng = np.random.default_rng(seed)
    deadline, best = time.perf_counter() + seconds, math.inf
    first, seen = frozenset[int](), set[frozenset[int]]()
    while time.perf_counter() < deadline:
        seen.add(first)
        until = min(deadline, time.perf_counter() + SLICE)
        found = _timed(instance, first, int(rng.integers(2**31)), until)
        best = min(best, found.best)
        first = found.first
        while first in seen and len(seen) < 2 ** (len(instance.pounds) - 1):
            first ^= {int(rng.integers(1, len(instance.pounds)))}
    return best


def _timed(instance: Sidekicks, first: frozenset[int], seed: int, until: float) -> Timing:
    """Search one problem and time its plan."""
    problem = to_problem(instance, first)
    nobody = Solution((), tuple(range(1, problem.num_nodes)))
    config = SearchConfig(seed, 1, moves=Moves(loops=False))
    solution = improve(problem, pack([problem]), nobody, config, until).solution
    if check(problem, solution).violations or solution.unassigned:
        return Timing(instance, (0, 0), ())
    return timing_of(instance, solution)


@dataclass(frozen=True)
class Result:
    """One run."""

    instance: str
    uav: str
    count: int
    budget_s: float
    seed: int
    makespan: float
    optimum: float
    gap_percent: float
    machine: str


def measure(instances: Iterable[Sidekicks], seconds: float, seed: int) -> Iterator[Result]:
    """Yield the result of each instance."""
    for instance in instances:
        makespan = plan(instance, seconds, seed)
        gap = gap_percent(makespan, instance.optimum)
        typer.echo(f"{instance.name} {instance.uav} x {instance.count}: {gap:.4f} %")
        yield Result(*instance.key, seconds, seed, round(makespan, 6), instance.optimum,
                     round(gap, 6), machine())


def main(
    data: Annotated[Path, typer.Option(help="folder with the public sets")]
    = Path("../shared/data"),
    output: Annotated[Path, typer.Option(help="CSV to write to, or to go on with")]
    = Path("runs/bench/flying_sidekicks.csv"),
    seconds: Annotated[float, typer.Option(help="budget of each run")] = 5.0,
    seed: int = 1,
) -> None:
    """Measure what isn't measured yet and say how many optima are reached."""
    instances = load(data / "truck_drone" / "mfstsp_murray_raj",
                     data / "mfstsp_energy" / "best_known.csv")
    known = {(row.instance, row.uav, row.count, row.budget_s, row.seed)
             for row in read_rows(output, Result)}
    left = [instance for instance in instances if (*instance.key, seconds, seed) not in known]
    for _ in appended(output, Result, measure(left, seconds, seed)):
        pass
    rows = [row for row in read_rows(output, Result)
            if (row.budget_s, row.seed) == (seconds, seed)]
    reached = sum(row.gap_percent <= 100 * EQUAL for row in rows)
    worst = max([row.gap_percent for row in rows], default=0.0)
    typer.echo(f"{reached} of {len(rows)} optima reached, worst {worst:.4f} %")


if __name__ == "__main__":
    typer.run(main)
