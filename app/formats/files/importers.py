"""Published instance files, VRPLIB or Solomon text -> requests of `POST /plan`."""

from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic_core import to_json

from app.formats.files.instance import FileVehicles, InstanceFile, InstanceFileError, distances
from app.formats.files.solomon import is_solomon, read_solomon
from app.formats.files.vrplib import read_vrplib
from app.requests.reading import read_request
from app.schemas.fields import Rounding
from app.schemas.limits import MAX_CUSTOMERS
from model.problem import FloatArray

FileFormat = Literal["auto", "vrplib", "solomon"]

UNIT_SPEED_KMH = 3.6
"""A unit of distance is a metre and takes a unit of time, a second."""

UNITS_PER_KM = 1000

MOST_TRIPS = 1000
"""What a request may state where a file allows any number of trips."""


def read_instance_file(path: Path, file_format: FileFormat = "auto") -> InstanceFile:
    """Return the instance that a file holds.

    Raises
    ------
    InstanceFileError
        If it holds none, or one with rules that Tandem doesn't know.
    """
    # Names in comments may be in any encoding.
    text = path.read_bytes().decode("utf-8-sig", errors="replace")
    if file_format == "solomon" or (file_format == "auto" and is_solomon(text)):
        return read_solomon(text)
    return read_vrplib(text)


def convert_file(path: Path, file_format: FileFormat = "auto",
                 rounding: Rounding = "exact") -> bytes:
    """Return the request of `POST /plan` that plans the instance in a file, as JSON.

    A unit of distance becomes a metre, a unit of time a second, a unit of cost stays one.
    Customers are named as in `.sol` files: by their place in the file, counted from 0.

    Raises
    ------
    RequestError
        If the file holds no instance, or one that no request can state.
    """
    file = read_instance_file(path, file_format)
    num_customers = len(file.customers())
    if num_customers > MAX_CUSTOMERS:
        raise InstanceFileError(f"There are {num_customers} customers and at most "
                                f"{MAX_CUSTOMERS} are allowed.")
    body = to_json(_request(file, rounding))
    read_request(body, policies=None)
    return body


def _request(file: InstanceFile, rounding: Rounding) -> dict[str, Any]:
    if file.edge_weight == "FLOOR_2D":
        rounding = "trunc"  # what is whole stays as it is, however it is rounded
    has_matrices = file.edge_weight not in ("EUC_2D", "FLOOR_2D")
    names = {node: "depot" if len(file.depots) == 1 else f"depot-{number}"
             for number, node in enumerate(file.depots, start=1)}
    request: dict[str, Any] = {
        "depots": [{"id": names[node], **_place(file, node, has_matrices)}
                   for node in file.depots],
        "customers": [_customer(file, node, has_matrices) for node in file.customers()],
        "fleet": [
            {"id": "truck" if len(file.vehicles) == 1 else f"type-{number}",
             **_vehicle_type(file, vehicles, names, has_matrices)}
            for number, vehicles in enumerate(file.vehicles, start=1)
        ],
    }
    if not has_matrices and rounding != "exact":
        request["planar_rounding"] = rounding
    if has_matrices:
        table = _table(distances(file, rounding))
        request["matrices"] = {"truck": {"durations": table, "distances": table}}
    return request


def _place(file: InstanceFile, node: int, has_matrices: bool) -> dict[str, Any]:
    place: dict[str, Any] = {}
    if file.coordinates is not None:
        place["location"] = [_number(value) for value in file.coordinates[node]]
    if has_matrices:
        place["location_index"] = node
    return place


def _customer(file: InstanceFile, node: int, has_matrices: bool) -> dict[str, Any]:
    customer = {
        "id": str(node),
        **_place(file, node, has_matrices),
        "demand": [_number(file.demand[node])],
        "service_duration": _number(file.service[node]),
    }
    if file.has_windows:
        customer["time_window"] = _window(file, node)
    if file.has_releases:
        customer["release_time"] = _number(file.release[node])
    return customer


def _vehicle_type(file: InstanceFile, vehicles: FileVehicles, depots: dict[int, str],
                  has_matrices: bool) -> dict[str, Any]:
    vehicle_type: dict[str, Any] = {
        "depot": depots[vehicles.depot],
        "count": vehicles.count,
        "capacity": [_number(vehicles.capacity)],
        "costs": {"fixed": _number(vehicles.fixed_cost),
                  "per_km": _number(vehicles.unit_cost * UNITS_PER_KM)},
    }
    if not has_matrices:
        vehicle_type["speed_kmh"] = UNIT_SPEED_KMH
    if file.has_windows:
        vehicle_type["shift"] = _window(file, vehicles.depot)
    if vehicles.max_trips != 1:
        useful = min(max(len(file.customers()), 1), MOST_TRIPS)
        vehicle_type["max_trips"] = min(vehicles.max_trips or useful, useful)
    if vehicles.max_distance is not None:
        vehicle_type["max_distance"] = _number(vehicles.max_distance)
    if vehicles.max_duration is not None:
        vehicle_type["max_working_duration"] = _number(vehicles.max_duration)
    return vehicle_type


def _window(file: InstanceFile, node: int) -> dict[str, Any]:
    latest = float(file.latest[node])
    return {"earliest": _number(file.earliest[node]),
            "latest": _number(latest) if np.isfinite(latest) else None}


def _number(value: float) -> float | int:
    """Return a number as JSON has it shortest."""
    return int(value) if float(value).is_integer() else float(value)


def _table(matrix: FloatArray) -> list[list[float]]:
    """Return a matrix as lists, of integers if it is whole."""
    if (matrix == np.floor(matrix)).all():
        return matrix.astype(np.int64).tolist()
    return matrix.tolist()
