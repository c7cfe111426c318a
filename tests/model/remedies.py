"""Problems as the remedies say that they would have to be."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from model.counsel.explain import Reason
from model.counsel.remedy import Change
from model.problem import MICROJOULES_PER_WH, Customer, DroneType, Problem, VehicleType


def told(reason: Reason) -> tuple[object, ...]:
    """Return a reason with its remedies in words."""
    return (reason.vehicle_type, reason.code, reason.message,
            *filter(None, [reason.remedy, reason.other_remedy]))


def applied(problem: Problem, reason: Reason, node: int) -> Problem:
    """Return a problem changed as the first remedy for a customer says."""
    for change in reason.remedies[0].changes:
        problem = _changed(problem, reason.vehicle_type, node - problem.num_depots, change)
    return problem


def _changed(problem: Problem, index: int, customer: int, change: Change) -> Problem:
    if change.limit in ON_TYPE:
        kinds = list(problem.vehicle_types)
        kinds[index] = ON_TYPE[change.limit](kinds[index], change)
        return replace(problem, vehicle_types=tuple(kinds))
    if change.limit in ON_CUSTOMER:
        customers = list(problem.customers)
        customers[customer] = ON_CUSTOMER[change.limit](customers[customer], change)
        return replace(problem, customers=tuple(customers))
    if change.limit == "vehicles" and problem.may_serve is not None:
        table = problem.may_serve.copy()
        table[index, customer] = True
        return replace(problem, may_serve=table)
    if change.limit == "launch":
        return replace(problem, depots=tuple(
            replace(depot, launch=depot.launch or depot.id == change.of)
            for depot in problem.depots))
    assert change.limit == "unassigned_cost", change
    return replace(problem, unassigned_cost=change.quantity + 0.01)


def _raise(owner: Any, field: str, change: Change) -> Any:
    return replace(owner, **{field: (getattr(owner, field) or 0) + int(change.quantity)})


def _amounts(change: Change) -> tuple[int, ...]:
    return tuple(round(amount * 1000) for amount in change.amounts)


def _drones(kind: VehicleType) -> DroneType:
    assert kind.drones is not None
    return kind.drones


def _wider_window(customer: Customer, change: Change) -> Customer:
    if change.window <= 0:
        return replace(customer, latest=customer.latest + int(change.quantity))
    gaps = list(customer.gaps)
    closes, opens = gaps[change.window - 1]
    gaps[change.window - 1] = (min(closes + int(change.quantity), opens - 1), opens)
    return replace(customer, gaps=tuple(gaps))


def _larger_battery(kind: VehicleType, change: Change) -> VehicleType:
    energy = _drones(kind).energy
    assert energy is not None
    # As from a request, whose battery has no more decimals.
    stated = energy.available / energy.usable_share / MICROJOULES_PER_WH + change.quantity / 10
    available = round(stated * energy.usable_share * MICROJOULES_PER_WH)
    return replace(kind, drones=replace(_drones(kind), energy=replace(energy, available=available)))


def _overtime(kind: VehicleType, change: Change) -> VehicleType:
    assert kind.overtime is not None
    return replace(kind, overtime=replace(
        kind.overtime, max_duration=kind.overtime.max_duration + int(change.quantity)))


def _drive_longer(kind: VehicleType, change: Change) -> VehicleType:
    assert kind.driving is not None
    return replace(kind, driving=replace(kind.driving, max_driving_per_day=int(change.quantity)))


ON_TYPE: dict[str, Callable[[VehicleType, Change], VehicleType]] = {
    "endurance": lambda kind, change: replace(
        kind, drones=_raise(_drones(kind), "endurance", change)),
    "range": lambda kind, change: _raise(kind, "max_range", change) if kind.flies else replace(
        kind, drones=_raise(_drones(kind), "max_range", change)),
    "wind": lambda kind, _: replace(
        kind, storms=(), drones=kind.drones and replace(kind.drones, storms=())),
    "battery": _larger_battery,
    "drone_capacity": lambda kind, change: replace(
        kind, drones=replace(_drones(kind), capacity=_amounts(change))),
    "capacity": lambda kind, change: replace(kind, capacity=_amounts(change)),
    "skills": lambda kind, change: replace(kind, skills=kind.skills | set(change.names)),
    "shift": lambda kind, change: _raise(kind, "latest", change),
    "overtime": _overtime,
    "stops": lambda kind, change: replace(kind, max_stops=int(change.quantity)),
    "sorties": lambda kind, change: replace(kind, max_sorties=int(change.quantity)),
    "batteries_aboard": lambda kind, change: replace(
        kind, drones=replace(_drones(kind), batteries=int(change.quantity))),
    "work": lambda kind, change: _raise(kind, "max_working_duration", change),
    "travel": lambda kind, change: _raise(kind, "max_travel_duration", change),
    "distance": lambda kind, change: _raise(kind, "max_distance", change),
    "driving_day": _drive_longer,
    "trip_distance": lambda kind, change: _raise(kind, "max_trip_distance", change),
    "pickups": lambda kind, _: replace(kind, pickups="any"),
    "trips": lambda kind, _: replace(kind, max_trips=kind.max_trips + 1),
    "count": lambda kind, _: replace(kind, count=kind.count + 1),
}
ON_CUSTOMER: dict[str, Callable[[Customer, Change], Customer]] = {
    "window": _wider_window,
    "time_aboard": lambda customer, change: _raise(customer, "max_time_aboard", change),
    "own_unassigned_cost": lambda customer, change: replace(
        customer, unassigned_cost=change.quantity + 0.01),
    "by_truck": lambda customer, _: replace(customer, served_by="either"),
    "by_drone": lambda customer, _: replace(customer, served_by="either"),
}
