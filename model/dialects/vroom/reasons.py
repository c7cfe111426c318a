"""Why jobs are left out, in words."""

from collections.abc import Collection, Mapping, Sequence

from model.dialects.vroom.checking import route_faults
from model.dialects.vroom.kinds import Kind
from model.dialects.vroom.places import Places
from model.dialects.vroom.request import Request

MOST_LOOKS = 2000
"""Jobs, each with a kind of vehicle, that are looked at: some tenths of a second."""

MOST_TOLD = 3
"""Reasons of one job."""

FULL = "Other jobs leave the vehicles that could serve it no room for it."
FREE = "Vehicle {id} is free and could serve it: no such plan was found in time."


def reasons_of(request: Request, places: Places, kinds: Sequence[Kind], used: Collection[int],
               left_out: Sequence[int]) -> Mapping[int, list[str]]:
    """Return why each job was left out; nothing of the last ones where they are too many.

    Parameters
    ----------
    used
        Vehicles that have a route, indices into the request's vehicles.
    """
    told = left_out[:max(1, MOST_LOOKS // len(kinds))]
    return {job: _reasons(request, places, kinds, used, job) for job in told}


def _reasons(request: Request, places: Places, kinds: Sequence[Kind], used: Collection[int],
             job: int) -> list[str]:
    """Return what keeps all vehicles from a job alone, else what it may be."""
    found, could = list[str](), False
    for kind in kinds:
        faults = list(route_faults(request, places, kind.vehicles[0], _alone(request, job)))
        if not faults:
            free = [vehicle for vehicle in kind.vehicles if vehicle not in used]
            if free:
                return [FREE.format(id=request.vehicles[free[0]].id)]
            could = True
        found += faults
    return [FULL] if could else found[:MOST_TOLD]


def _alone(request: Request, job: int) -> list[int]:
    """Return the shortest route with a job: with both ends, if it is one of a shipment."""
    mate = request.jobs[job].mate
    if mate is None:
        return [job]
    return [job, mate] if request.jobs[job].kind == "pickup" else [mate, job]
