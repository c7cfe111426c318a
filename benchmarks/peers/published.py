"""Instances of public benchmark sets, in the integer units of each set's convention."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from vrplib import read_solution  # type: ignore[import-untyped]

from app.formats.files.importers import read_instance_file
from app.formats.files.instance import FileVehicles, InstanceFile, distances
from app.schemas.fields import Rounding
from model.problem import (
    MM_PER_KM, UNLIMITED, BoolArray, Customer, Depot, FloatArray, IntArray, Problem, Travel,
    VehicleType,
)

NO_LIMIT = 2**40
"""Stands for "no limit" in `Published.latest`."""

MODEL_UNITS = 1000
"""Millimetres and milliseconds per unit of distance and time, thousandths per unit of demand."""

DETOURS_PER_CUSTOMER = 10
"""A customer left out costs as much as this many of the longest trips, in dearest vehicles."""


Gaps = tuple[tuple[int, int], ...]
"""As in `Customer`, in the unit of a set."""


@dataclass(frozen=True)
class Convention:
    """How a set counts: its unit is 1/`scale` of the file's."""

    scale: int  # integer units per unit of distance and time in the file
    rounding: Rounding  # of distances, to whole units
    divisor: int  # objective units per unit of published cost


@dataclass(frozen=True)
class PublishedVehicle:
    """Equal vehicles."""

    count: int
    capacity: int
    fixed_cost: int  # in integer objective units
    unit_cost: int  # objective units per unit of distance
    depot: int = 0  # node
    max_duration: int | None = None  # from departure to return
    serves: tuple[int, ...] | None = None  # nodes; None: all customers


@dataclass(frozen=True, eq=False)
class Published:
    """A public instance in the integer units of its set's convention; depots come first."""

    name: str
    set_name: str
    coordinates: FloatArray  # (node, 2) as in the file
    demand: IntArray  # (node,)
    earliest: IntArray  # (node,) of the start of service; of the depot: its opening
    latest: IntArray  # (node,) NO_LIMIT where the set has no windows
    service: IntArray  # (node,)
    release: IntArray  # (node,)
    travel: IntArray  # (node, node) distance, which is the duration too
    vehicles: tuple[PublishedVehicle, ...]  # types, in the order of the file
    max_trips: int  # per vehicle
    has_windows: bool
    divisor: int  # published cost = integer objective / divisor
    best_known: float  # published cost, nan if unknown
    num_depots: int = 1
    prize: IntArray | None = None
    """(node,) Objective units lost with a customer left out; None: nobody may be."""
    gaps: tuple[Gaps, ...] = ()
    """(node,) Last start of service in one window and first in the next; (): a window each."""
    pickup: IntArray | None = None  # (node,) amount taken in, `demand` being what is brought
    pickups_last: bool = False  # and only behind all deliveries of a route, at least one
    is_open: bool = False  # routes end with their last customer: at the last depot, no place

    @property
    def num_customers(self) -> int:
        """Customers."""
        return len(self.demand) - self.num_depots

    @property
    def customers(self) -> range:
        """Their nodes."""
        return range(self.num_depots, len(self.demand))

    def end_of(self, kind: PublishedVehicle) -> int:
        """Return the depot where routes of a type end."""
        return self.num_depots - 1 if self.is_open else kind.depot

    def gaps_at(self, node: int) -> Gaps:
        """Return what lies between the windows of a customer."""
        return self.gaps[node] if self.gaps else ()


_DIMACS = Convention(scale=10, rounding="dimacs", divisor=10)

CONVENTIONS: dict[str, Convention] = {
    "solomon": _DIMACS,
    "homberger_200": _DIMACS,
    "homberger_400": _DIMACS,
    "homberger_1000": _DIMACS,
    "mtvrptwr": _DIMACS,
    "cvrp_x": Convention(scale=1, rounding="round", divisor=1),
    # The files state costs a hundredfold.
    "hfvrp": Convention(scale=1000, rounding="thousandths", divisor=100_000),
    "xxl": Convention(scale=1, rounding="round", divisor=1),
}
"""Sets of `data` by folder name."""

BY_NAME = ("xxl",)
"""Sets that have a table of best known costs of their own, and of which instances are read by name
alone, since all their legs are laid out. None are where none are named."""


def published_set(data: Path, set_name: str, names: Sequence[str] = ()) -> list[Published]:
    """Return the instances of a set that are named, or all if none are, sorted by name.

    Raises
    ------
    ValueError
        If the set is unknown or has no files, or a file holds no instance.
    """
    paths = sorted(path for path in (data / set_name).glob("*") if path.suffix in (".txt", ".vrp"))
    if not paths:
        raise ValueError(f"set: {set_name!r} has no files in {data}")
    named = names or set_name in BY_NAME
    return [read_published(path, set_name) for path in paths if not named or path.stem in names]


def read_published(path: Path, set_name: str) -> Published:
    """Return an instance; its best known cost is from `best_known.csv` in the folder above.

    That of a set read `BY_NAME` is from its own folder.

    Raises
    ------
    ValueError
        If the set is unknown, or the file holds no instance that fits its convention.
    """
    if set_name not in CONVENTIONS:
        raise ValueError(f"set: {set_name!r} is none of {', '.join(CONVENTIONS)}")
    convention = CONVENTIONS[set_name]
    file = read_instance_file(path)
    _require_plain(file, path)
    scale = convention.scale
    limited = np.isfinite(file.latest)
    latest = np.where(limited, file.latest, 0)
    return Published(
        name=path.stem,
        set_name=set_name,
        coordinates=_coordinates(file, path),
        demand=_whole(file.demand, "demand"),
        earliest=_whole(file.earliest * scale, "earliest"),
        latest=np.where(limited, _whole(latest * scale, "latest"), NO_LIMIT),
        service=_whole(file.service * scale, "service"),
        release=_whole(file.release * scale, "release"),
        travel=np.rint(distances(file, convention.rounding) * scale).astype(np.int64),
        vehicles=tuple(_vehicle(kind, scale) for kind in file.vehicles),
        max_trips=_max_trips(file),
        has_windows=file.has_windows,
        divisor=convention.divisor,
        best_known=_best_known(path, set_name),
    )


def _require_plain(file: InstanceFile, path: Path) -> None:
    """Refuse what `Published` can't state."""
    limits = [(kind.max_distance, kind.max_duration) for kind in file.vehicles]
    if (file.depots != (0,) or set(limits) != {(None, None)}
            or len({kind.max_trips for kind in file.vehicles}) > 1):
        raise ValueError(f"{path}: instances of a set have one depot, the first node, vehicles "
                         "that may make equally many trips, and no longest trips")


def _coordinates(file: InstanceFile, path: Path) -> FloatArray:
    if file.coordinates is None:
        raise ValueError(f"{path}: instances of a set have coordinates")
    return file.coordinates


def _whole(values: FloatArray, name: str) -> IntArray:
    """Return whole numbers as integers."""
    whole = np.rint(values)
    if not np.allclose(whole, values, rtol=0, atol=1e-6):
        raise ValueError(f"{name}: the set's unit does not make it whole")
    return whole.astype(np.int64)


def _vehicle(kind: FileVehicles, scale: int) -> PublishedVehicle:
    costs = np.array([kind.capacity, kind.fixed_cost * scale, kind.unit_cost])
    capacity, fixed_cost, unit_cost = _whole(costs, "vehicle").tolist()
    return PublishedVehicle(kind.count, capacity, fixed_cost, unit_cost)


def _max_trips(file: InstanceFile) -> int:
    max_trips = file.vehicles[0].max_trips
    return len(file.customers()) if max_trips is None else max_trips


def best_known_beside(path: Path, column: str) -> float:
    """Return an instance's cost from a column of its folder's `best_known.csv`, nan if unknown."""
    table = path.with_name("best_known.csv")
    if table.is_file():
        with table.open(encoding="utf-8", newline="") as lines:
            for row in csv.DictReader(lines):
                if row["instance"] == path.stem:
                    return float(row[column])
    return float("nan")


def _best_known(path: Path, set_name: str) -> float:
    if set_name in BY_NAME:
        return best_known_beside(path, "best_known")
    table = path.parent.with_name("best_known.csv")
    if not table.is_file():
        return float("nan")
    with table.open(encoding="utf-8", newline="") as lines:
        for row in csv.DictReader(lines):
            if (row["instance"], row["set"]) == (path.stem, set_name):
                return float(row["best_known_cost"])
    return float("nan")


def to_problem(instance: Published) -> Problem:
    """Return an instance whose plans cost what the set's convention says.

    A unit of distance is a metre, a unit of time a second.
    """
    legs = instance.travel * MODEL_UNITS
    customers = tuple([_customer(instance, node) for node in instance.customers])
    vehicle_types = tuple([_vehicle_type(instance, index)
                           for index in range(len(instance.vehicles))])
    longest = max(int((instance.travel[kind.depot] + instance.travel[:, kind.depot]).max())
                  for kind in instance.vehicles)
    dearest = max(kind.unit_cost for kind in instance.vehicles) * longest
    dearest += max(kind.fixed_cost for kind in instance.vehicles)
    return Problem(_depots(instance), customers, vehicle_types, (Travel(legs, legs),),
                   instance.coordinates,
                   unassigned_cost=DETOURS_PER_CUSTOMER * dearest / instance.divisor,
                   may_serve=_may_serve(instance))


def _depots(instance: Published) -> tuple[Depot, ...]:
    count = instance.num_depots - instance.is_open
    depots = [Depot("depot")] if count == 1 else [
        Depot(f"depot-{number}") for number in range(1, count + 1)]
    return tuple(depots + [Depot("nowhere", "nowhere")] * instance.is_open)


def _may_serve(instance: Published) -> BoolArray | None:
    if all(kind.serves is None for kind in instance.vehicles):
        return None
    nodes = np.array(instance.customers)
    return np.stack([np.isin(nodes, nodes if kind.serves is None else kind.serves)
                     for kind in instance.vehicles])


def _customer(instance: Published, node: int) -> Customer:
    return Customer(
        str(node), (int(instance.demand[node]) * MODEL_UNITS,),
        service_duration=int(instance.service[node]) * MODEL_UNITS,
        earliest=int(instance.earliest[node]) * MODEL_UNITS,
        latest=_model_latest(instance, node),
        release_time=int(instance.release[node]) * MODEL_UNITS,
        unassigned_cost=(None if instance.prize is None
                         else int(instance.prize[node]) / instance.divisor),
        gaps=tuple([(closes * MODEL_UNITS, reopens * MODEL_UNITS)
                    for closes, reopens in instance.gaps_at(node)]),
        pickup=(() if instance.pickup is None
                else (int(instance.pickup[node]) * MODEL_UNITS,)))


def _vehicle_type(instance: Published, index: int) -> VehicleType:
    kind = instance.vehicles[index]
    name = "truck" if len(instance.vehicles) == 1 else f"type-{index + 1}"
    return VehicleType(
        name, kind.count, (kind.capacity * MODEL_UNITS,), travel=0, depot=kind.depot,
        fixed_cost=kind.fixed_cost / instance.divisor,
        cost_per_km=kind.unit_cost * MM_PER_KM / (MODEL_UNITS * instance.divisor),
        earliest=int(instance.earliest[kind.depot]) * MODEL_UNITS,
        latest=_model_latest(instance, kind.depot),
        max_working_duration=(None if kind.max_duration is None
                              else kind.max_duration * MODEL_UNITS),
        max_trips=instance.max_trips, pickups="last" if instance.pickups_last else "any",
        end=instance.end_of(kind) if instance.is_open else None)


def _model_latest(instance: Published, node: int) -> int:
    latest = int(instance.latest[node])
    return UNLIMITED if latest == NO_LIMIT else latest * MODEL_UNITS


def read_routes(path: Path) -> list[list[list[int]]]:
    """Return the trips of each vehicle in a `.sol` file, in order; 0 is a reload there."""
    routes: list[list[list[int]]] = []
    for visits in read_solution(path)["routes"]:
        trips: list[list[int]] = [[]]
        for node in visits:
            if node:
                trips[-1].append(node)
            else:
                trips.append([])
        routes.append([trip for trip in trips if trip])
    return routes


def routes_of_types(instance: Published, routes: Sequence[list[list[int]]]
                    ) -> list[tuple[int, list[list[int]]]]:
    """Return the type of vehicle k, as the file counts them, with the trips of `routes[k]`.

    Their nodes are as in the file, which doesn't count a depot that is no place.

    Raises
    ------
    ValueError
        If there are more routes than vehicles.
    """
    types = [index for index, kind in enumerate(instance.vehicles) for _ in range(kind.count)]
    if len(routes) > len(types):
        raise ValueError(f"routes: {len(routes)} for {len(types)} vehicles")
    return [(kind, [[node + instance.is_open for node in trip] for trip in trips])
            for kind, trips in zip(types, routes, strict=False) if trips]
