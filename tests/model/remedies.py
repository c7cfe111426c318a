"""Problems as the remedies say that they would have to be."""

import re
from collections.abc import Callable
from dataclasses import replace

from model.judge.explain import Reason
from model.problem import MICROJOULES_PER_WH, Customer, DroneType, Overtime, Problem, VehicleType

MINUTE = 60_000
KM = 1_000_000


def applied(problem: Problem, reason: Reason, node: int) -> Problem:
    """Return a problem changed as a remedy for a customer says, of several limits by each."""
    remedy, kind = reason.remedy or "", problem.vehicle_types[reason.vehicle_type]
    first, *others = re.split(" and (?=if |without )", remedy)
    if others:
        for each in (first, *(f"fits {other}" for other in others)):
            problem = applied(problem, replace(reason, remedy=each), node)
        return problem
    for pattern, change in ON_TYPE.items():
        if found := re.fullmatch(pattern, remedy):
            kinds = list(problem.vehicle_types)
            kinds[reason.vehicle_type] = change(kind, found[1])
            return replace(problem, vehicle_types=tuple(kinds))
    for pattern, alter in ON_CUSTOMER.items():
        if found := re.fullmatch(pattern, remedy):
            customers = list(problem.customers)
            index = node - problem.num_depots
            customers[index] = alter(customers[index], found[1])
            return replace(problem, customers=tuple(customers))
    if re.fullmatch("fits if .+ may serve it", remedy) and problem.may_serve is not None:
        table = problem.may_serve.copy()
        table[reason.vehicle_type, node - problem.num_depots] = True
        return replace(problem, may_serve=table)
    if found := re.fullmatch("fits if drones may take off at (.+)", remedy):
        return replace(problem, depots=tuple(
            replace(depot, launch=depot.launch or depot.id == found[1])
            for depot in problem.depots))
    found = re.fullmatch("served if unassigned_cost were above (.+)", remedy)
    assert found, remedy
    return replace(problem, unassigned_cost=float(found[1]) + 0.01)


def _amounts(text: str) -> tuple[int, ...]:
    return tuple(round(float(amount) * 1000) for amount in text.split(", "))


def _units(text: str, unit: int) -> int:
    return round(float(text) * unit)


def _drones(kind: VehicleType) -> DroneType:
    assert kind.drones is not None
    return kind.drones


def _longer_endurance(kind: VehicleType, text: str) -> VehicleType:
    drones = _drones(kind)
    return replace(kind, drones=replace(drones, endurance=drones.endurance + _units(text, MINUTE)))


def _longer_range(kind: VehicleType, text: str) -> VehicleType:
    if kind.flies:
        return replace(kind, max_range=(kind.max_range or 0) + _units(text, KM))
    drones = _drones(kind)
    return replace(kind, drones=replace(
        drones, max_range=(drones.max_range or 0) + _units(text, KM)))


def _wider_window(customer: Customer, text: str) -> Customer:
    number, minutes = text.split(" closed ")
    gaps = list(customer.gaps)
    closes, opens = gaps[int(number) - 1]
    gaps[int(number) - 1] = (min(closes + _units(minutes, MINUTE), opens - 1), opens)
    return replace(customer, gaps=tuple(gaps))


def _larger_battery(kind: VehicleType, text: str) -> VehicleType:
    energy = _drones(kind).energy
    assert energy is not None
    # As from a request, whose battery has no more decimals.
    stated = energy.available / energy.usable_share / MICROJOULES_PER_WH + float(text)
    available = round(stated * energy.usable_share * MICROJOULES_PER_WH)
    return replace(kind, drones=replace(_drones(kind), energy=replace(energy, available=available)))


def _longer(overtime: Overtime | None, text: str) -> Overtime:
    assert overtime is not None
    return replace(overtime, max_duration=overtime.max_duration + _units(text, MINUTE))


def _drive_longer(kind: VehicleType, text: str) -> VehicleType:
    assert kind.driving is not None
    return replace(kind, driving=replace(kind.driving, max_driving_per_day=_units(text, MINUTE)))


ON_TYPE: dict[str, Callable[[VehicleType, str], VehicleType]] = {
    "fits if endurance were (.+) minutes? longer": _longer_endurance,
    "fits if max_range were (.+) km longer": _longer_range,
    "fits without max_wind_km(h)": lambda kind, _: replace(
        kind, storms=(), drones=kind.drones and replace(kind.drones, storms=())),
    "fits with a battery of (.+) Wh more": _larger_battery,
    "fits if the drone capacity were at least (.+)": lambda kind, text: replace(
        kind, drones=replace(_drones(kind), capacity=_amounts(text))),
    "fits if capacity were at least (.+)": lambda kind, text: replace(
        kind, capacity=_amounts(text)),
    "fits if .+ had (.+)": lambda kind, text: replace(
        kind, skills=kind.skills | set(text.split(", "))),
    "fits if .+'s shift ended (.+) minutes? later": lambda kind, text: replace(
        kind, latest=kind.latest + _units(text, MINUTE)),
    "fits if .+ could work (.+) minutes? more overtime": lambda kind, text: replace(
        kind, overtime=_longer(kind.overtime, text)),
    "fits if .+ could make (.+) stop": lambda kind, text: replace(kind, max_stops=int(text)),
    "fits if .+ could launch (.+) sortie": lambda kind, text: replace(kind, max_sorties=int(text)),
    "fits if .+ carried (.+) battery": lambda kind, text: replace(
        kind, drones=replace(_drones(kind), batteries=int(text))),
    "fits if .+ could work (.+) minutes? longer": lambda kind, text: replace(
        kind, max_working_duration=(kind.max_working_duration or 0) + _units(text, MINUTE)),
    "fits if .+ could travel (.+) minutes? longer": lambda kind, text: replace(
        kind, max_travel_duration=(kind.max_travel_duration or 0) + _units(text, MINUTE)),
    "fits if .+'s drivers could drive (.+) minutes? a day": _drive_longer,
    "fits if trips could be (.+) km longer": lambda kind, text: replace(
        kind, max_trip_distance=(kind.max_trip_distance or 0) + _units(text, KM)),
    "fits if .+ may pick up at any tim(e)": lambda kind, _: replace(kind, pickups="any"),
    "fits if .+ could make another tri(p)": lambda kind, _: replace(
        kind, max_trips=kind.max_trips + 1),
    "fits with one more vehicl(e)": lambda kind, _: replace(kind, count=kind.count + 1),
}
ON_CUSTOMER: dict[str, Callable[[Customer, str], Customer]] = {
    "fits if its (?:last )?window closed (.+) minutes? later": lambda customer, text: replace(
        customer, latest=customer.latest + _units(text, MINUTE)),
    r"fits if its window (\d+ closed .+) minutes? later": _wider_window,
    "fits if it could be aboard (.+) minutes? longer": lambda customer, text: replace(
        customer, max_time_aboard=(customer.max_time_aboard or 0) + _units(text, MINUTE)),
    "served if its unassigned_cost were above (.+)": lambda customer, text: replace(
        customer, unassigned_cost=float(text) + 0.01),
    "fits if a (?:truck|drone) may serve (it)": lambda customer, _: replace(
        customer, served_by="either"),
}
