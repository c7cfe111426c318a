"""Reads VRPLIB files: capacities, windows, release times, several trips, fleets and depots.

The sections are those of PyVRP's dialect. What Tandem can't state is refused by its name.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import groupby
from typing import Any, get_args

import numpy as np
from vrplib.parse import parse_vrplib  # type: ignore[import-untyped]

from app.formats.files.instance import EdgeWeight, FileVehicles, InstanceFile, InstanceFileError
from model.problem import FloatArray

Fields = dict[str, Any]

TYPES = frozenset({
    "ACVRP", "CVRP", "CVRPTW", "DCVRP", "DVRP", "HFVRP", "HFVRPTW", "HVRP", "MDVRP", "MDVRPTW",
    "MTVRP", "MTVRPTW", "MTVRPTWR", "VRP", "VRPTW", "VRPTWR",
})
"""Those whose rules are all stated by the fields below."""

IGNORED = frozenset({"comment", "display_data_type", "edge_weight_format", "name",
                     "node_coord_type", "type"})
NODE_FIELDS = frozenset({"demand", "node_coord", "release_time", "service_time", "time_window"})
VEHICLE_FIELDS = frozenset({
    "capacity", "vehicles_depot", "vehicles_fixed_cost", "vehicles_max_distance",
    "vehicles_max_duration", "vehicles_max_reloads", "vehicles_reload_depot",
    "vehicles_unit_distance_cost",
})
OTHER_FIELDS = frozenset({"depot", "dimension", "distance", "edge_weight", "edge_weight_type",
                          "vehicles"})
KNOWN = IGNORED | NODE_FIELDS | VEHICLE_FIELDS | OTHER_FIELDS


def read_vrplib(text: str) -> InstanceFile:
    """Return the instance that a VRPLIB file holds.

    Raises
    ------
    InstanceFileError
        If it is none, or has rules that Tandem doesn't know.
    """
    try:
        fields: Fields = parse_vrplib(text, compute_edge_weights=False)
    except (ValueError, RuntimeError, LookupError, TypeError, AttributeError) as error:
        raise InstanceFileError(f"This is no VRPLIB file: {error}") from error
    _refuse_unknown(fields)
    _require_numbered(text)
    size = _dimension(fields)
    depots = _depots(fields, size)
    demand = _numbers(fields, "demand", (size,))
    edge_weight = _edge_weight(fields)
    is_explicit = edge_weight == "EXPLICIT"
    has_points = "node_coord" in fields or not is_explicit
    windows = _windows(fields, size)
    file = InstanceFile(
        name=str(fields.get("name", "")),
        depots=depots,
        coordinates=_numbers(fields, "node_coord", (size, 2)) if has_points else None,
        edge_weight=edge_weight,
        explicit_weights=_numbers(fields, "edge_weight", (size, size)) if is_explicit else None,
        demand=demand,
        earliest=windows[:, 0],
        latest=windows[:, 1],
        service=_service(fields, size, depots),
        release=_numbers(fields, "release_time", (size,), 0.0),
        vehicles=_vehicles(fields, demand, depots),
    )
    _require_free_depots(file)
    return file


def _refuse_unknown(fields: Fields) -> None:
    unknown = [name.upper() for name in fields if name not in KNOWN]
    if unknown:
        raise InstanceFileError(f"Tandem doesn't know what {', '.join(unknown)} asks for.")
    kind = str(fields.get("type", "CVRP")).upper()
    if kind not in TYPES:
        raise InstanceFileError(f"TYPE {kind} is not supported: {', '.join(sorted(TYPES))} are.")
    if "distance" in fields and {"time_window", "vehicles_reload_depot"} & fields.keys():
        raise InstanceFileError("DISTANCE is not supported with time windows or several trips.")


def _require_numbered(text: str) -> None:
    """Refuse sections whose lines are not numbered from 1: the numbers are not looked at again."""
    section, number = "", 0
    for line in map(str.strip, text.splitlines()):
        if not line or line.startswith("#"):
            continue
        if "_SECTION" in line:
            section, number = line.strip(" :").removesuffix("_SECTION"), 0
        elif "EOF" in line:
            return
        elif section not in ("", "DEPOT", "EDGE_WEIGHT"):
            number += 1
            if line.split()[0] != str(number):
                raise InstanceFileError(
                    f"{section}_SECTION has {line!r} as its line {number}: number the lines "
                    "from 1, in order.")


def _dimension(fields: Fields) -> int:
    size = fields.get("dimension", "missing")
    if not isinstance(size, int) or size < 1:
        raise InstanceFileError(f"DIMENSION is {size}: state the number of nodes.")
    return size


def _edge_weight(fields: Fields) -> EdgeWeight:
    stated = fields.get("edge_weight_type", "EXPLICIT" if "edge_weight" in fields else None)
    for kind in get_args(EdgeWeight):
        if stated == kind:
            return kind
    raise InstanceFileError(f"EDGE_WEIGHT_TYPE {stated} is not supported: "
                            f"{', '.join(get_args(EdgeWeight))} are.")


def _depots(fields: Fields, size: int) -> tuple[int, ...]:
    """Return the depots' nodes; without a section it is the first."""
    depots = np.ravel(fields.get("depot", 0)).tolist()
    if not depots or len(set(depots)) < len(depots) or not set(depots) <= set(range(size)):
        raise InstanceFileError("DEPOT_SECTION must list nodes of the file, each once.")
    return tuple(map(int, depots))


def _numbers(fields: Fields, name: str, shape: tuple[int, ...],
             default: float | None = None) -> FloatArray:
    """Return a field of finite numbers; one number stands for equal ones."""
    if name not in fields and default is None:
        raise InstanceFileError(f"{name.upper()} is missing.")
    try:
        stated = np.asarray(fields.get(name, default), dtype=np.float64)
    except ValueError as error:
        raise InstanceFileError(f"{name.upper()} is not made of numbers: {error}") from error
    if stated.shape != shape and (stated.ndim or len(shape) > 1):
        raise InstanceFileError(f"{name.upper()} has the shape {stated.shape}, not {shape}.")
    if not np.isfinite(stated).all() or (name != "node_coord" and (stated < 0).any()):
        raise InstanceFileError(f"{name.upper()} has an entry that is negative or not finite.")
    return np.array(np.broadcast_to(stated, shape))


def _windows(fields: Fields, size: int) -> FloatArray:
    """Return the (node, 2) windows, open where the file has none."""
    if "time_window" in fields:
        return _numbers(fields, "time_window", (size, 2))
    return np.tile([0.0, np.inf], (size, 1))


def _service(fields: Fields, size: int, depots: tuple[int, ...]) -> FloatArray:
    """Return service durations; one for all is meant for customers alone."""
    service = _numbers(fields, "service_time", (size,), 0.0)
    if not np.ndim(fields.get("service_time", 0)):
        service[list(depots)] = 0
    return service


def _require_free_depots(file: InstanceFile) -> None:
    for name in ("demand", "service", "release"):
        if getattr(file, name)[list(file.depots)].any():
            raise InstanceFileError(f"A depot has a {name} other than 0.")


def _vehicles(fields: Fields, demand: FloatArray,
              depots: tuple[int, ...]) -> tuple[FileVehicles, ...]:
    """Return the fleet; equal vehicles that follow one another are one entry."""
    count = _vehicle_count(fields, len(demand) - len(depots))
    vehicles = _single_vehicles(fields, count, float(demand.sum()), depots)
    return tuple(replace(kind, count=len(list(group))) for kind, group in groupby(vehicles))


def _vehicle_count(fields: Fields, num_customers: int) -> int:
    """Return the stated number of vehicles; without one, one for each customer."""
    per_vehicle = [len(fields[name]) for name in sorted(VEHICLE_FIELDS & fields.keys())
                   if not np.isscalar(fields[name])]
    count = fields.get("vehicles", per_vehicle[0] if per_vehicle else max(num_customers, 1))
    if not isinstance(count, int) or count < 1:
        raise InstanceFileError(f"VEHICLES is {count}: state the number of vehicles.")
    return count


def _single_vehicles(fields: Fields, count: int, total_demand: float,
                     depots: tuple[int, ...]) -> Iterator[FileVehicles]:
    def column(name: str, default: float) -> list[float]:
        return _numbers(fields, name, (count,), default).tolist()

    def limits(name: str) -> list[float] | list[None]:
        return column(name, 0.0) if name in fields else [None] * count

    homes = column("vehicles_depot", depots[0] + 1)
    for home, capacity, fixed_cost, unit_cost, trips, distance, duration in zip(
        homes,
        column("capacity", total_demand),
        column("vehicles_fixed_cost", 0.0),
        column("vehicles_unit_distance_cost", 1.0),
        _max_trips(fields, count, homes),
        limits("vehicles_max_distance"),
        limits("distance" if "distance" in fields else "vehicles_max_duration"),
        strict=True,
    ):
        if home - 1 not in depots:
            raise InstanceFileError(f"VEHICLES_DEPOT names {home:g}, which is no depot.")
        yield FileVehicles(1, capacity, fixed_cost, unit_cost, int(home) - 1, trips, distance,
                           duration)


def _max_trips(fields: Fields, count: int, homes: list[float]) -> list[int | None]:
    """Return how many trips each vehicle may make; None is any number."""
    reloads = fields.get("vehicles_reload_depot")
    if reloads is None:
        return [1] * count
    if len(reloads) != count:
        raise InstanceFileError(f"VEHICLES_RELOAD_DEPOT has {len(reloads)} lines for {count} "
                                "vehicles.")
    stated = "vehicles_max_reloads" in fields
    most = _numbers(fields, "vehicles_max_reloads", (count,), 0.0).tolist()
    trips: list[int | None] = []
    for home, line, limit in zip(homes, reloads, most, strict=True):
        places = np.atleast_1d(line).tolist()
        if places not in ([], [home]):
            raise InstanceFileError(f"VEHICLES_RELOAD_DEPOT names {places}: vehicles reload at "
                                    f"their own depot, {home:g}.")
        trips.append(1 if not places else int(limit) + 1 if stated else None)
    return trips
