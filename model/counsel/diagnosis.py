"""A broken rule in words, what would keep it, and the words that are the same for all rules."""

from dataclasses import replace
from typing import NamedTuple, TypeVar

from model.counsel.remedy import Change, Part, if_stated
from model.counsel.trial import Attempt
from model.problem import DroneType, Problem, VehicleType
from model.problem.limits import LIMITS

Owner = TypeVar("Owner")


class Diagnosis(NamedTuple):
    """A broken rule in words, and the problem changed so that it is kept."""

    code: str
    message: str
    remedy: Part = ()
    problem: Problem | None = None


def more_of(name: str, owner: Owner, excess: int, of: str = "") -> tuple[Part, Owner]:
    """Return what says that a limit would have to be so much more, and its owner with that."""
    limit = LIMITS[name]
    enough = (limit.of(owner) or 0) + excess
    return (if_stated(Change(name, of, enough if limit.is_total else excess), enough),
            limit.raised(owner, excess))


def drones_of(attempt: Attempt) -> DroneType:
    """Return the drones that fly."""
    drones = attempt.vehicle_type.drones
    if drones is None:
        raise ValueError(f"vehicle type {attempt.vehicle_type.id} drones: None is not allowed")
    return drones


def flyer_of(attempt: Attempt) -> DroneType | VehicleType:
    """Return what flies: the vehicle's drones, or the vehicle itself."""
    return attempt.vehicle_type if attempt.vehicle_type.flies else drones_of(attempt)


def told_apart(drones: DroneType | VehicleType) -> str:
    """Return the id of a type of drones where several are told apart, else nothing."""
    return "" if drones.id is None or isinstance(drones, VehicleType) else drones.id


def name_of(drones: DroneType | VehicleType) -> str:
    """Say of which type drones are, where several are told apart."""
    return f" of {told_apart(drones)}" if told_apart(drones) else ""


def with_flyer(attempt: Attempt, flyer: DroneType | VehicleType) -> Problem:
    """Return the problem with other drones, or another vehicle that flies itself."""
    return with_type(attempt, flyer if isinstance(flyer, VehicleType)
                     else replace(attempt.vehicle_type, drones=flyer))


def with_type(attempt: Attempt, vehicle_type: VehicleType) -> Problem:
    """Return the problem with another type of vehicle."""
    return replace(attempt.problem, vehicle_types=(vehicle_type,))


def up_to_tenth(quantity: int, unit: int) -> int:
    """Round up to a tenth of a unit, so that what is said suffices."""
    return -(-quantity * 10 // unit) * unit // 10
