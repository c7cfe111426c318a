"""Why jobs are left out, in words."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from model.dialects.vroom.checking import route_faults
from model.dialects.vroom.kinds import VehicleKind
from model.dialects.vroom.places import Sites
from model.dialects.vroom.request import Request, VroomVehicle

MOST_LOOKS = 2000
"""Jobs, each with a kind of vehicle, that are looked at: some tenths of a second."""

MOST_TOLD = 3
"""Reasons of one job."""

FULL = "Other jobs leave the vehicles that could serve it no room for it."
FREE = "Vehicle {id} is free and could serve it: no such plan was found in time."


def reasons_of(request: Request, places: Sites, kinds: Sequence[VehicleKind], used: Collection[int],
               left_out: Sequence[int]) -> Mapping[int, list[str]]:
    """Return why each job was left out; nothing of the last ones where they are too many.

    Parameters
    ----------
    used
        Vehicles that have a route, indices into the request's vehicles.
    """
    told = left_out[:max(1, MOST_LOOKS // len(kinds))]
    resting = replace(request, vehicles=tuple([
        replace(vehicle, breaks=()) for vehicle in request.vehicles]))
    return {job: _reasons(request, resting, places, kinds, used, job) for job in told}


def _reasons(request: Request, resting: Request, places: Sites, kinds: Sequence[VehicleKind],
             used: Collection[int], job: int) -> list[str]:
    """Return what keeps all vehicles from a job alone, else what it may be.

    `resting` is the request without breaks.
    """
    found, could = list[str](), False
    for kind in kinds:
        faults = list(route_faults(request, places, kind.vehicles[0], _alone(request, job)))
        if not faults:
            free = [vehicle for vehicle in kind.vehicles if vehicle not in used]
            if free:
                return [FREE.format(id=request.vehicles[free[0]].id)]
            could = True
        elif kind.stated.breaks and not any(route_faults(
                resting, places, kind.vehicles[0], _alone(request, job))):
            faults = [_of_breaks(kind.stated)]
        found += faults
    return [FULL] if could else found[:MOST_TOLD]


def _of_breaks(stated: VroomVehicle) -> str:
    """Say which break of a vehicle leaves it no time, as each route has all, within its own time.
    """
    begin, end = stated.time_window or (0, None)
    for each in stated.breaks:
        first, last = ((0, None) if each.time_windows is None
                       else (each.time_windows[0][0], each.time_windows[-1][1]))
        if last is not None and last < begin:
            return (f"Break {each.id} of vehicle {stated.id} starts by {last} at the latest, and "
                    f"the vehicle begins at {begin}.")
        if end is not None and max(first, begin) + each.service > end:
            return (f"Break {each.id} of vehicle {stated.id} isn't over before "
                    f"{max(first, begin) + each.service}, and the vehicle ends at {end}.")
    return f"Breaks leave vehicle {stated.id} no time for it."


def _alone(request: Request, job: int) -> list[int]:
    """Return the shortest route with a job: with both ends, if it is one of a shipment."""
    mate = request.jobs[job].mate
    if mate is None:
        return [job]
    return [job, mate] if request.jobs[job].kind == "pickup" else [mate, job]
