"""Vehicles that differ in nothing but their names, and what limits their loads."""

from dataclasses import dataclass

import numpy as np

from model.dialects.vroom.errors import RefusedError
from model.dialects.vroom.places import Sites
from model.dialects.vroom.request import Request, VroomVehicle
from model.dialects.vroom.timing import ProfileRates
from model.problem import MAX_DIMENSIONS, IntArray


@dataclass(frozen=True)
class VehicleKind:
    """Vehicles that are alike."""

    vehicles: tuple[int, ...]  # indices into the request's vehicles
    stated: VroomVehicle  # the first of them
    start: int  # site or NOWHERE
    end: int
    type: str  # empty if no job names it
    rates: ProfileRates


@dataclass(frozen=True, eq=False)
class Loads:
    """What counts against capacity, one column for each dimension."""

    delivery: IntArray  # (job, dimension); none of shipments
    pickup: IntArray
    moved: IntArray  # by the shipment of which it is an end
    capacity: IntArray  # (kind, dimension)
    kept: tuple[int, ...]  # which of the amounts stated these are


def find_kinds(request: Request, places: Sites) -> tuple[VehicleKind, ...]:
    """Group the vehicles of a request."""
    named = {name for job in request.jobs
             for name in (*job.setup_per_type, *job.service_per_type)}
    groups: dict[tuple[object, ...], list[int]] = {}
    for index, vehicle in enumerate(request.vehicles):
        key = (
            places.starts[index], places.ends[index], vehicle.profile, vehicle.costs,
            vehicle.capacity, vehicle.skills,
            vehicle.type if vehicle.type in named else "", vehicle.time_window,
            vehicle.speed_factor, vehicle.max_tasks, vehicle.max_travel_time,
            vehicle.max_distance,
            tuple((each.service, each.time_windows, each.max_load) for each in vehicle.breaks))
        groups.setdefault(key, []).append(index)
    return tuple(_kind(request, places, members, named) for members in groups.values())


def _kind(request: Request, places: Sites, members: list[int], named: set[str]) -> VehicleKind:
    stated = request.vehicles[members[0]]
    has_costs = places.legs[stated.profile].costs is not None
    return VehicleKind(tuple(members), stated, int(places.starts[members[0]]),
                       int(places.ends[members[0]]), stated.type if stated.type in named else "",
                       ProfileRates.of(stated, has_costs))


def find_loads(request: Request, kinds: tuple[VehicleKind, ...]) -> Loads:
    """Return the amounts that may fill a vehicle, or be too much during a break.

    Raises
    ------
    RefusedError
        If there are too many.
    """
    capacities = np.array([kind.stated.capacity for kind in kinds], np.int64)
    nothing = (0,) * capacities.shape[1]
    is_job = np.array([[job.kind == "job"] for job in request.jobs], np.bool_)
    brought = np.array([job.delivery or nothing for job in request.jobs], np.int64)
    taken = np.array([job.pickup or nothing for job in request.jobs], np.int64)
    moved = np.where(is_job, 0, brought + taken)
    brought, taken = brought * is_job, taken * is_job
    during_breaks = [each.max_load for kind in kinds for each in kind.stated.breaks
                     if each.max_load is not None]
    least = np.array([capacities.min(axis=0), *during_breaks]).min(axis=0)
    # Of a shipment, both ends count: that is more than there ever is aboard.
    fills = np.flatnonzero((brought + taken + moved).sum(axis=0) > least)
    if len(fills) > MAX_DIMENSIONS:
        raise RefusedError(f"capacity: {len(fills)} amounts may fill a vehicle, and "
                           f"{MAX_DIMENSIONS} can be planned here.")
    if not len(fills):
        none = np.zeros((len(request.jobs), 1), np.int64)
        return Loads(none, none, none, np.zeros((len(kinds), 1), np.int64), ())
    return Loads(brought[:, fills], taken[:, fills], moved[:, fills], capacities[:, fills],
                 tuple(fills.tolist()))
