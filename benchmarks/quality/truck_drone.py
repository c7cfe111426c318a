"""The public truck-and-drone sets as problems, each under its own rules.

A set is a folder with `reference_values.csv`, whose rows name the instances. Units of length, time
and amount of a set are `UNIT` millimetres, milliseconds and thousandths, and rates are such that
the total cost of a plan is the set's own objective. Customers carry the node numbers of the files.

The set of Murray and Raj (mFSTSP) has a benchmark of its own, `flying_sidekicks`: there truck
service, launches and recoveries at a stop come one after another, not side by side.
"""

import csv
import json
import re
from collections.abc import Callable, Iterator, Mapping
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.quality.truck_drone_rules import CROSSINGS, LOOPS, TruckDroneInstance
from model.problem import (
    MM_PER_KM, MS_PER_HOUR, UNLIMITED, UNREACHABLE, Customer, Depot, DroneType, FloatArray,
    IntArray, Problem, ServedBy, Travel, VehicleType,
)
from model.problem.revisits import with_revisits

UNIT = 10**7
"""Millimetres, milliseconds and thousandths per unit of the files. Fine enough that the rounded
legs of a route are off by less than a millionth of its cost."""

PER_LENGTH = MM_PER_KM / UNIT
"""Rate per km at which a unit of length costs 1."""

PER_TIME = MS_PER_HOUR / UNIT
"""Rate per hour at which a unit of time costs 1."""

NO_RULES: frozenset[str] = frozenset()

SACRAMENTO_TRUCK_SPEED, SACRAMENTO_DRONE_SPEED = 35 / 60, 50 / 60  # miles per minute
SACRAMENTO_ROUTE_MINUTES = 480
SACRAMENTO_COST_PER_MILE = 1.13 * 1.61 * 0.07
SACRAMENTO_DRONE_COST_SHARE = 0.1

JOO_LEE_DRONES = 2
JOO_LEE_DRONE_TIME_SHARE = 0.25  # drone time per unit of distance
JOO_LEE_LONGEST_LEG = 25.0
JOO_LEE_LIGHT_SHARE = 0.75  # of the customers, the lightest: these may be flown to


def _rows(path: Path) -> Iterator[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        yield from csv.DictReader(file)


def _number(text: str) -> float | None:
    return float(text) if text else None


def _scaled(values: FloatArray) -> IntArray:
    return np.rint(values * UNIT).astype(np.int64)


def _straight(points: FloatArray) -> FloatArray:
    x, y = points[:, 0], points[:, 1]
    return np.hypot(x[:, None] - x, y[:, None] - y)


def _problem(points: FloatArray, customers: tuple[Customer, ...], truck: VehicleType,
             travel: tuple[Travel, ...]) -> Problem:
    """Return a problem in which no plan gains by leaving customers out."""
    duration, distance = travel[truck.travel].arrays()
    cost = (distance * (truck.cost_per_km / MM_PER_KM)
            + duration * (truck.cost_per_hour / MS_PER_HOUR))
    worst = float((cost[0] + cost[:, 0])[1:].max())
    return Problem((Depot("0"),), customers, (truck,), travel, points, unassigned_cost=10 * worst)


def _makespan_problem(points: FloatArray, by_truck: frozenset[int], drive: FloatArray,
                      fly: FloatArray, drones: DroneType) -> Problem:
    """Return a problem for one truck, paid by time alone; nodes `by_truck` can't be flown to."""
    customers = tuple(
        Customer(str(node), (UNIT,), served_by="truck" if node in by_truck else "either")
        for node in range(1, len(points)))
    truck = VehicleType("truck", 1, (len(customers) * UNIT,), travel=0, cost_per_hour=PER_TIME,
                        drones=drones)
    travel = tuple(Travel(_scaled(legs), _scaled(legs)) for legs in (drive, fly))
    return _problem(points, customers, truck, travel)


def load_tspd_agatz(folder: Path) -> list[TruckDroneInstance]:
    """Return the TSP-D instances of Agatz, Bouman and Schmidt, then the restricted ones.

    One truck, one drone, makespan, one customer a sortie, loops allowed. `restricted/` limits the
    flight of a sortie, waiting apart, or the customers that a drone may serve.

    A truck may pass a node again to launch or recover there: 32 of 552 published optima do.
    """
    groups = (("tspd_agatz", "instances", "reference_values.csv"),
              ("tspd_agatz_restricted", "restricted", "restricted_reference_values.csv"))
    return [_agatz_instance(folder / subfolder, row, set_name)
            for set_name, subfolder, references in groups for row in _rows(folder / references)]


def _agatz_instance(folder: Path, row: dict[str, str], set_name: str) -> TruckDroneInstance:
    name = row["instance"]
    problem = _agatz_problem(folder / f"{name}.txt")
    with_sites = with_revisits(problem, [0])
    kind = "truck only" if row["method"].startswith("truck-only") else row["kind"]
    return TruckDroneInstance(name, set_name, problem.num_customers, with_sites,
                              float(row["reference_value"]), kind.replace("_", " "), NO_RULES,
                              (with_sites,))


def _agatz_problem(path: Path) -> Problem:
    """Read a file whose drone has the restrictions that its lines name."""
    text = path.read_text(encoding="utf-8")
    lines = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL).splitlines()
    endurance = UNLIMITED
    by_truck: set[int] = set()
    numbers = []
    for words in filter(None, map(str.split, lines)):
        if words[0] == "#MAXFLY" and words[1] != "Infinity":
            endurance = round(float(words[1]) * UNIT)
        elif words[0] == "#NOVISIT":
            by_truck.add(int(words[1]))
        elif not words[0].startswith("#"):
            numbers.append([float(word) for word in words[:2]])
    (truck_factor,), (drone_factor,), (num_nodes,), *places = numbers
    if len(places) != num_nodes:
        raise ValueError(f"{path.stem}: {len(places)} places, {num_nodes:g} nodes")
    points = np.array(places)
    length = _straight(points)
    drones = DroneType(1, (UNIT,), travel=1, endurance=endurance, endurance_includes_waiting=False)
    return _makespan_problem(
        points, frozenset(by_truck), truck_factor * length, drone_factor * length, drones)


def load_tspd_large(folder: Path) -> list[TruckDroneInstance]:
    """Return the TSP-D instances of Agatz, Bouman and Schmidt with 175 to 500 nodes, by layout.

    The rules are those of `load_tspd_bogyrbayeva`. Published are means over a layout and a size
    alone, here those of iterative chainlet partitioning (ICP), so that only the mean gap over all
    instances of both tells anything. Sizes of which some are missing are left out.
    """
    return [
        TruckDroneInstance(path.stem, f"tspd_{row['layout']}", problem.num_customers, problem, None,
                           "none", NO_RULES, (problem,), float(row["icp_mean"]))
        for row in _rows(folder / "table.csv")
        if row["alpha"] == "2" and row["files_here"] == row["files_in_repository"]
        for path in sorted(folder.glob(f"{row['layout']}-*-n{row['n']}.txt"))
        for problem in (_agatz_problem(path),)
    ]


def load_tspd_bogyrbayeva(folder: Path) -> list[TruckDroneInstance]:
    """Return the TSP-D test instances of Bogyrbayeva et al.

    The rules are those of `load_tspd_agatz`, but that no truck passes a node again; the drone is
    twice as fast as the truck. The reference is the optimum for 10 customers, else the value of the
    published heuristic (TSP-ep-all), which is also given as `heuristic`.
    """
    sizes: dict[int, list[dict[str, str]]] = {}
    for row in _rows(folder / "reference_values.csv"):
        sizes.setdefault(int(row["n"]), []).append(row)
    instances = []
    for num_nodes, rows in sizes.items():
        lines = (folder / f"n{num_nodes}.txt").read_text(encoding="utf-8").split("\n")
        for row, line in zip(rows, filter(None, lines), strict=True):
            points = np.array(line.split(), dtype=np.float64).reshape(num_nodes, 2)
            length = _straight(points)
            problem = _makespan_problem(points, frozenset(), length, 0.5 * length,
                                        DroneType(1, (UNIT,), travel=1))
            heuristic, exact = float(row["reference_value"]), _number(row["own_exact_dp"])
            reference, kind = (heuristic, "upper bound") if exact is None else (exact, "optimal")
            instances.append(TruckDroneInstance(
                row["instance"], "tspd_bogyrbayeva", num_nodes - 1, problem, reference, kind,
                NO_RULES, (problem,), heuristic))
    return instances


def load_fstsp_murray_chu(folder: Path) -> list[TruckDroneInstance]:
    """Return the FSTSP instances of Murray and Chu, each with both endurances, in minutes.

    One truck, one drone, makespan, one customer a sortie. Launch and recovery take a minute; the
    recovery counts as flight, waiting does not. A launch at the depot before the truck leaves
    costs no time: the cost runs from the first departure, which is the take-off there, so cost
    and objective are equal.

    Differs by the rule "loops" alone, which `Problem` does not have.
    """
    return [_fstsp_instance(folder, row) for row in _rows(folder / "reference_values.csv")]


def _fstsp_instance(folder: Path, row: dict[str, str]) -> TruckDroneInstance:
    place = folder / "instances" / row["instance"]
    points = np.loadtxt(place / "nodes.csv", delimiter=",", usecols=(1, 2))[:-1]
    nodes = np.arange(len(points))
    # The last column of a matrix is the way to the end depot, the first one the way to the start.
    columns = np.where(nodes == 0, len(points), nodes)
    drive, fly = (np.loadtxt(place / name, delimiter=",")[nodes[:, None], columns]
                  for name in ("tau.csv", "tauprime.csv"))
    eligible = (place / "Cprime.csv").read_text(encoding="utf-8").replace(",", " ")
    light = {int(word) for word in eligible.split()}
    minutes = int(row["endurance_min"])
    drones = DroneType(1, (UNIT,), travel=1, endurance=(minutes - 1) * UNIT,
                       endurance_includes_waiting=False, launch_duration=UNIT,
                       recovery_duration=UNIT)
    problem = _makespan_problem(points, frozenset(range(1, len(points))) - light, drive, fly,
                                drones)
    return TruckDroneInstance(
        f"{row['instance']}-e{minutes}", "fstsp_murray_chu", len(points) - 1, problem,
        float(row["reference_value"]), "optimal", frozenset({LOOPS}), (problem,))


def load_vrpd_sacramento(folder: Path) -> list[TruckDroneInstance]:
    """Return the VRP-D instances of Sacramento, Pisinger and Ropke, miles and minutes.

    Trucks with a drone each, as many as customers, cost of distance, one customer a sortie.
    Endurance covers flight, drone service, waiting and recovery.

    Every truck serves a customer: from depot to depot takes a truck longer than a route may last,
    so none can stay there and fly its drone alone. Differs by the rule "loops", which `Problem`
    does not have, and in the clock of a launch: it begins when the truck arrives, beside the
    truck's service, not after it, so up to a minute of that service counts as waiting of the
    flight. None of the reference optima depends on this.
    """
    return [_sacramento_instance(folder, row) for row in _rows(folder / "reference_values.csv")]


def _sacramento_instance(folder: Path, row: dict[str, str]) -> TruckDroneInstance:
    file = np.loadtxt(folder / "instances" / f"{row['instance']}.txt", skiprows=2, ndmin=2)
    points = np.vstack([np.zeros(2), file[:, :2]])
    miles = _straight(points)
    longest = SACRAMENTO_ROUTE_MINUTES * UNIT
    drive = _scaled(miles / SACRAMENTO_TRUCK_SPEED)
    drive[0, 0] = longest + 1
    travel = (Travel(drive, _scaled(miles)),
              Travel(_scaled(miles / SACRAMENTO_DRONE_SPEED), _scaled(miles)))
    customers = tuple(Customer(str(node), (amount,), service_duration=2 * UNIT)
                      for node, amount in enumerate(_scaled(file[:, 2]).tolist(), 1))
    rate = SACRAMENTO_COST_PER_MILE * PER_LENGTH
    drones = DroneType(1, (5 * UNIT,), travel=1, endurance=(30 - 1) * UNIT, launch_duration=UNIT,
                       recovery_duration=UNIT, service_duration=UNIT,
                       cost_per_km=SACRAMENTO_DRONE_COST_SHARE * rate)
    truck = VehicleType("truck", len(customers), (1300 * UNIT,), travel=0, cost_per_km=rate,
                        max_working_duration=longest, drones=drones)
    problem = _problem(points, customers, truck, travel)
    reference = _number(row["reference_value"])
    return TruckDroneInstance(
        row["instance"], "vrpd_sacramento", len(customers), problem, reference,
        "none" if reference is None else "optimal", frozenset({LOOPS}), (problem,))


def load_vrptw_drone_joo_lee(folder: Path) -> list[TruckDroneInstance]:
    """Return the VRP with drones and time windows of Joo and Lee, 25 customers of Solomon's.

    Trucks with two drones each, as many as customers, cost of distance: a truck leg costs
    `round(100 d)`, a customer served by drone half of that for the way out and back, rounded,
    which is given half to each leg. No leg of a drone is longer than 25, and only the lightest
    three quarters of the customers are flown to. The truck's time is its distance, the drone's a
    quarter of it.

    Differs by the rule "crossings" alone, which `Problem` does not have. That no drone leaves from
    or returns to the depot is inferred: the published plans have no such flight, though with a
    truck that stays there one would beat an optimum (R101).
    """
    return [_joo_lee_instance(folder, row) for row in _rows(folder / "reference_values.csv")]


def _joo_lee_instance(folder: Path, row: dict[str, str]) -> TruckDroneInstance:
    path = folder / "instances" / f"{row['instance']}.txt"
    file = np.loadtxt(path, skiprows=8)
    capacity = float(path.read_text(encoding="utf-8").splitlines()[4].split()[1])
    points = file[:, 1:3]
    length = _straight(points)
    cost = np.rint(100 * length)
    drive = Travel(_scaled(length), _scaled(cost))
    closed = length > JOO_LEE_LONGEST_LEG
    closed[0, :] = closed[:, 0] = True
    fly = Travel(*(np.where(closed, UNREACHABLE, _scaled(legs)) for legs in (
        JOO_LEE_DRONE_TIME_SHARE * length, np.rint(cost / 2) / 2)))
    amounts, earliest, latest, services = _scaled(file[:, 3:7].T).tolist()
    lightest = sorted(amounts[1:])[:int(JOO_LEE_LIGHT_SHARE * (len(points) - 1))]
    customers = tuple(
        Customer(str(node), (amounts[node],), services[node], earliest[node], latest[node])
        for node in range(1, len(points)))
    drones = DroneType(JOO_LEE_DRONES, (lightest[-1],), travel=1, cost_per_km=PER_LENGTH)
    truck = VehicleType("truck", len(customers), (round(capacity * UNIT),), travel=0,
                        cost_per_km=PER_LENGTH, earliest=earliest[0], latest=latest[0],
                        drones=drones)
    problem = _problem(points, customers, truck, (drive, fly))
    reference = float(row["reference_value"])
    kind = "optimal" if reference == float(row["lower_bound"]) else "upper bound"
    return TruckDroneInstance(row["instance"], "vrptw_drone_joo_lee", len(customers), problem,
                              reference, kind, frozenset({CROSSINGS}), (problem,))


def load_hvdrp_karak(folder: Path) -> list[TruckDroneInstance]:
    """Return the HVDRP instances of Karak and Abdelghany, one variant per choice of stations.

    One truck, its drones, cost of distance, several customers a sortie. The truck halts at
    stations only and need not visit all: a variant holds those that it visits as customers
    without demand, the first one all of them. Drones serve all others, from stations only, within
    their range; times and waiting do not matter.
    """
    return [_karak_instance(folder, row) for row in _rows(folder / "reference_values.csv")]


def _karak_instance(folder: Path, row: dict[str, str]) -> TruckDroneInstance:
    path = folder / "instances" / f"{row['instance']}.hvdrp.json"
    data = json.loads(path.read_text(encoding="utf-8"))["symmetric"]
    stations, clients = data["stationCoordinates"], data["clientCoordinates"]
    variants = tuple(_karak_problem(data, list(chosen))
                     for count in range(len(stations), 0, -1)
                     for chosen in combinations(stations, count))
    return TruckDroneInstance(row["instance"], "hvdrp_karak", len(clients), variants[0],
                              float(row["reference_value"]), "optimal", frozenset(), variants)


def _karak_problem(data: dict[str, Any], stations: list[dict[str, Any]]) -> Problem:
    """Return the problem of visiting just these stations.

    Raises
    ------
    ValueError
        If the drones differ.
    """
    specification, *others = ({**drone, "id": 0} for drone in data["droneSpecification"])
    if any(other != specification for other in others):
        raise ValueError(f"droneSpecification: {data['droneSpecification']!r} is not allowed")
    clients = data["clientCoordinates"]
    points = np.array([(place["x"], place["y"])
                       for place in (data["depotCoordinates"], *stations, *clients)], np.float64)
    length = _scaled(_straight(points))
    flight = length.copy()
    flight[0, :] = flight[:, 0] = UNREACHABLE
    customers = (*(_karak_customer(place, "truck", 0.0, 0.0) for place in stations),
                 *(_karak_customer(place, "drone", place["delivery"], place["pickup"])
                   for place in clients))
    weight = round(specification["weight"] * UNIT)
    drones = DroneType(
        1 + len(others), (weight,), travel=1, endurance=round(specification["range"] * UNIT),
        endurance_includes_waiting=False, max_customers_per_sortie=len(clients),
        cost_per_km=specification["cost"] * PER_LENGTH)
    load = sum(sum(customer.demand) + sum(customer.pickup) for customer in customers)
    truck = VehicleType("truck", 1, (load,), travel=0, cost_per_km=data["vehicleCost"] * PER_LENGTH,
                        drones=drones)
    return _problem(points, customers, truck, (Travel(length, length), Travel(flight, flight)))


def _karak_customer(place: dict[str, Any], served_by: ServedBy, delivery: float,
                    pickup: float) -> Customer:
    return Customer(str(place["label"]), (round(delivery * UNIT),), served_by=served_by,
                    pickup=(round(pickup * UNIT),))


LOADERS: Mapping[str, Callable[[Path], list[TruckDroneInstance]]] = {
    "tspd_agatz": load_tspd_agatz,
    "tspd_bogyrbayeva": load_tspd_bogyrbayeva,
    "tspd_large": load_tspd_large,
    "fstsp_murray_chu": load_fstsp_murray_chu,
    "vrpd_sacramento": load_vrpd_sacramento,
    "vrptw_drone_joo_lee": load_vrptw_drone_joo_lee,
    "hvdrp_karak": load_hvdrp_karak,
}
"""Reads the folder of a set, by its name."""
