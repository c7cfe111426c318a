"""Vehicles that differ in nothing but their names, and what limits their loads."""

from dataclasses import dataclass

import numpy as np

from model.dialects.vroom.errors import RefusedError
from model.dialects.vroom.places import Places
from model.dialects.vroom.request import Request, Vehicle
from model.dialects.vroom.timing import Rates
from model.problem import MAX_DIMENSIONS, FloatArray, IntArray


@dataclass(frozen=True)
class Kind:
    """Vehicles that are alike."""

    vehicles: tuple[int, ...]  # indices into the request's vehicles
    stated: Vehicle  # the first of them
    start: int  # site or NOWHERE
    end: int
    type: str  # empty if no job names it
    rates: Rates


@dataclass(frozen=True, eq=False)
class Loads:
    """What counts against capacity, one column for each dimension."""

    demand: IntArray  # (job, dimension)
    capacity: IntArray  # (kind, dimension)
    surplus: FloatArray | None
    """(job,) what is taken minus what is brought, if an amount is both; in shares of capacity."""


def find_kinds(request: Request, places: Places) -> tuple[Kind, ...]:
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
            vehicle.max_distance)
        groups.setdefault(key, []).append(index)
    return tuple(_kind(request, places, members, named) for members in groups.values())


def _kind(request: Request, places: Places, members: list[int], named: set[str]) -> Kind:
    stated = request.vehicles[members[0]]
    has_costs = places.legs[stated.profile].costs is not None
    return Kind(tuple(members), stated, int(places.starts[members[0]]),
                int(places.ends[members[0]]), stated.type if stated.type in named else "",
                Rates.of(stated, has_costs))


def find_loads(request: Request, kinds: tuple[Kind, ...], relaxed: bool) -> Loads:
    """Return the amounts that may fill a vehicle.

    Parameters
    ----------
    relaxed
        What is both brought and taken counts twice, against a capacity each (or only what is more,
        if that is too much to count), and may be too much on the way; else once, the larger for
        each job, which is never too much.

    Raises
    ------
    RefusedError
        If there are too many.
    """
    size = len(kinds[0].stated.capacity)
    nothing = (0,) * size
    brought = np.array([job.delivery or nothing for job in request.jobs], np.int64)
    taken = np.array([job.pickup or nothing for job in request.jobs], np.int64)
    capacities = np.array([kind.stated.capacity for kind in kinds], np.int64)
    strict: list[tuple[IntArray, IntArray]] = []
    loose, looser = strict.copy(), strict.copy()
    surplus = np.zeros(len(request.jobs))
    is_mixed = False
    for more, less, capacity in zip(brought.T, taken.T, capacities.T, strict=True):
        if (more + less).sum() <= capacity.min():
            continue
        strict.append((np.maximum(more, less), capacity))
        if more.any() and less.any():
            is_mixed = True
            surplus += (less - more) / max(1, capacity.max())
            loose += [(more, capacity), (less, capacity)]
            looser.append((more if more.sum() > less.sum() else less, capacity))
        else:
            loose.append(strict[-1])
            looser.append(strict[-1])
    if len(strict) > MAX_DIMENSIONS:
        raise RefusedError(f"capacity: {len(strict)} amounts may fill a vehicle, and "
                           f"{MAX_DIMENSIONS} can be planned here.")
    columns = strict
    if relaxed:
        columns = loose if len(loose) <= MAX_DIMENSIONS else looser
    if not columns:
        columns = [(np.zeros(len(request.jobs), np.int64), np.zeros(len(kinds), np.int64))]
    return Loads(np.stack([demand for demand, _ in columns], axis=1),
                 np.stack([capacity for _, capacity in columns], axis=1),
                 surplus if is_mixed else None)
