"""Why a customer is unassigned, and what would change that.

For each vehicle type the customer is tried alone; `check` judges these attempts and every remedy
offered.
"""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import chain
from math import ceil
from typing import NamedTuple

from model.judge.check import check
from model.judge.clock import MS_PER_MINUTE
from model.judge.energy import sortie_energy
from model.judge.metrics import allowed_overtime
from model.judge.rules import airborne_duration, amounts, decimal, watt_hours
from model.judge.trial import Attempt, attempts, small_problem, try_truck
from model.problem import (
    MAX_BATTERY, MAX_MONEY, MAX_QUANTITY, MICROJOULES_PER_WH, MM_PER_KM, UNLIMITED, DroneType,
    Overtime, Problem, VehicleType,
)
from model.solution import Solution


@dataclass(frozen=True)
class Reason:
    """Why no vehicle of a type serves a customer."""

    vehicle_type: int
    code: str
    message: str
    remedy: str | None = None  # a change that suffices, if one is known


class _Diagnosis(NamedTuple):
    """A broken rule in words, and the problem changed so that it is kept."""

    code: str
    message: str
    remedy: str | None = None
    problem: Problem | None = None


def explain(problem: Problem, solution: Solution, node: int,
            until: float = math.inf) -> tuple[Reason, ...]:
    """Return one reason per vehicle type why the customer at `node` is unassigned.

    After `until`, on `time.perf_counter`, no more than that the search found no room.
    """
    if time.perf_counter() >= until:
        return unexplained(problem)
    return tuple(explain_type(problem, solution, index, node, until)
                 for index in range(len(problem.vehicle_types)))


def explain_type(problem: Problem, solution: Solution, index: int, node: int,
                 until: float = math.inf) -> Reason:
    """Return why no vehicle of a type serves the customer at `node`. As `explain`."""
    vehicle_type = problem.vehicle_types[index]
    if time.perf_counter() >= until:
        return _unknown(index, vehicle_type.id)
    if problem.customer_at(node).served_by == "drone" and vehicle_type.drones is None:
        message = f"Only a drone may serve it and {vehicle_type.id} carries none."
        return Reason(index, "KIND", message, _remedy_by_truck(problem, index, node))
    tried = attempts(problem, index, node)
    first = next(tried)
    for attempt in chain((first,), tried):
        if not attempt.codes:
            return _unused(problem, solution, index, attempt)
        if time.perf_counter() >= until:
            return _unknown(index, vehicle_type.id)
    return _failed(problem, index, node, first)


def unexplained(problem: Problem) -> tuple[Reason, ...]:
    """Return what is true of a customer for whom there was no time to find out more."""
    return _all_unknown(tuple([kind.id for kind in problem.vehicle_types]))


@lru_cache(maxsize=4)
def _all_unknown(ids: tuple[str, ...]) -> tuple[Reason, ...]:
    """Return these reasons by the types' ids: made once for thousands of customers."""
    return tuple(map(_unknown, range(len(ids)), ids))


def _unknown(index: int, name: str) -> Reason:
    return Reason(index, "SEARCH", f"The search found no room for it on {name}; there was no time "
                  "left to find out whether there could be any.")


def _unused(problem: Problem, solution: Solution, index: int, attempt: Attempt) -> Reason:
    """Say why an attempt that keeps all rules is not in the plan."""
    vehicle_type, cost = problem.vehicle_types[index], attempt.evaluation.cost.total
    *hosts, _ = attempt.problem.customers
    way = f"{vehicle_type.id} could serve it alone"
    if hosts:
        way = f"A drone of {vehicle_type.id} could serve it from a stop at {hosts[0].id}"
    used = len({route.vehicle for route in solution.routes if route.vehicle_type == index})
    left_out = problem.cost_of_leaving_out(attempt.customer)
    is_dear = not hosts and cost >= left_out
    price = f"{ceil(cost * 100) / 100:.2f}"
    at_price = f"{way} at a cost of {price}; leaving it out costs {left_out:.2f}"
    if used >= vehicle_type.count:
        why = "it is" if vehicle_type.count == 1 else f"all {vehicle_type.count} are"
        if is_dear:
            return Reason(index, "COST", f"{at_price}, and {why} in use.")
        would_do = not hosts and vehicle_type.part_of in (None, vehicle_type.id)
        return Reason(index, "FLEET_EXHAUSTED", f"{way}, but {why} in use.",
                      "fits with one more vehicle" if would_do else None)
    if is_dear:
        whose = "" if attempt.customer.unassigned_cost is None else "its "
        remedy = (f"served if {whose}unassigned_cost were above {price}" if cost < MAX_MONEY
                  else None)
        return Reason(index, "COST", f"{at_price}.", remedy)
    return Reason(index, "SEARCH", f"{way}, but the search did not find room for it.")


def _failed(problem: Problem, index: int, node: int, attempt: Attempt) -> Reason:
    """Say which rule an attempt breaks, with a remedy that was tried."""
    code = next(code for code in DIAGNOSES if code in attempt.codes)
    diagnosis = DIAGNOSES[code](attempt)
    window = _missed_window(attempt)
    if window is not None:
        return Reason(index, window.code, window.message, window.remedy)
    remedy = None
    if diagnosis.problem and not check(diagnosis.problem, attempt.solution).violations:
        remedy = diagnosis.remedy
    elif attempt.customer.served_by == "drone":
        remedy = _remedy_by_truck(problem, index, node)
    return Reason(index, diagnosis.code, diagnosis.message, remedy)


def _remedy_by_truck(problem: Problem, index: int, node: int) -> str | None:
    small = small_problem(problem, index, [node])
    customer = replace(small.customers[0], served_by="either")
    attempt = next(try_truck(replace(small, customers=(customer,))))
    return None if attempt.codes else "fits if a truck may serve it"


def _drones(attempt: Attempt) -> DroneType:
    drones = attempt.vehicle_type.drones
    if drones is None:
        raise ValueError(f"vehicle type {attempt.vehicle_type.id} drones: None is not allowed")
    return drones


def _with_type(attempt: Attempt, vehicle_type: VehicleType) -> Problem:
    return replace(attempt.problem, vehicle_types=(vehicle_type,))


def _up_to_tenth(quantity: int, unit: int) -> int:
    """Round up to a tenth of a unit, so that what is said suffices."""
    return -(-quantity * 10 // unit) * unit // 10


def _if_stated(words: str, quantity: int) -> str | None:
    """Return the words of a remedy, if a request can state the quantity that it asks for."""
    return words if quantity <= MAX_QUANTITY else None


def _minutes(duration: int) -> str:
    number = decimal(duration * 1000 // MS_PER_MINUTE)
    return "1 minute" if number == "1" else f"{number} minutes"


def _km(distance: int) -> str:
    return f"{decimal(distance * 1000 // MM_PER_KM)} km"


def _vehicle(attempt: Attempt) -> _Diagnosis:
    name = attempt.vehicle_type.id
    return _Diagnosis("VEHICLE", f"{name} may not serve it.", f"fits if {name} may serve it",
                      replace(attempt.problem, may_serve=None))


def _skills(attempt: Attempt) -> _Diagnosis:
    vehicle_type, needed = attempt.vehicle_type, attempt.customer.skills
    missing = ", ".join(sorted(needed - vehicle_type.skills))
    changed = replace(vehicle_type, skills=vehicle_type.skills | needed)
    return _Diagnosis("SKILLS", f"{vehicle_type.id} lacks {missing}.",
                      f"fits if {vehicle_type.id} had {missing}", _with_type(attempt, changed))


def _capacity(attempt: Attempt) -> _Diagnosis:
    vehicle_type, demand = attempt.vehicle_type, attempt.customer.demand
    needed = tuple(map(max, vehicle_type.capacity, demand))
    return _Diagnosis(
        "CAPACITY",
        f"Its demand of {amounts(attempt.problem, demand)} exceeds the capacity of "
        f"{amounts(attempt.problem, vehicle_type.capacity)}.",
        f"fits if capacity were at least {amounts(attempt.problem, needed)}",
        _with_type(attempt, replace(vehicle_type, capacity=needed)),
    )


def _payload(attempt: Attempt) -> _Diagnosis:
    vehicle_type, demand = attempt.vehicle_type, attempt.customer.demand
    drones = _drones(attempt)
    needed = tuple(map(max, drones.capacity, demand))
    changed = replace(vehicle_type, drones=replace(drones, capacity=needed))
    return _Diagnosis(
        "CAPACITY",
        f"Its demand of {amounts(attempt.problem, demand)} exceeds the drone capacity of "
        f"{amounts(attempt.problem, drones.capacity)}.",
        f"fits if the drone capacity were at least {amounts(attempt.problem, needed)}",
        _with_type(attempt, changed),
    )


def _unreachable(attempt: Attempt) -> _Diagnosis:
    return _Diagnosis("RANGE", "No flight leads there from the depot and back.")


def _endurance(attempt: Attempt) -> _Diagnosis:
    drones, trip = _drones(attempt), attempt.solution.routes[0].trips[0]
    airborne = airborne_duration(attempt.problem, drones, trip, trip.sorties[0])
    excess = _up_to_tenth(airborne - drones.endurance, MS_PER_MINUTE)
    enough = drones.endurance + excess
    changed = replace(drones, endurance=min(enough, UNLIMITED))
    return _Diagnosis(
        "RANGE",
        f"A flight from the depot and back lasts {_minutes(excess)} more than the endurance.",
        _if_stated(f"fits if endurance were {_minutes(excess)} longer", enough),
        _with_type(attempt, replace(attempt.vehicle_type, drones=changed)),
    )


def _energy(attempt: Attempt) -> _Diagnosis:
    drones, trip = _drones(attempt), attempt.solution.routes[0].trips[0]
    energy = drones.energy
    if energy is None:
        raise ValueError("drone energy: None is not allowed")
    taken = sortie_energy(attempt.problem, drones, energy, trip, trip.sorties[0])
    missing = ceil((taken - energy.available) / energy.usable_share)
    tenths = -(-missing * 10 // MICROJOULES_PER_WH)
    enough = energy.available + round(tenths / 10 * energy.usable_share * MICROJOULES_PER_WH)
    largest = MAX_BATTERY * energy.usable_share * MICROJOULES_PER_WH
    changed = replace(drones, energy=replace(energy, available=enough))
    return _Diagnosis(
        "RANGE",
        f"A flight from the depot and back takes {watt_hours(taken)}, and "
        f"{watt_hours(energy.available)} may be taken.",
        f"fits with a battery of {decimal(tenths, 1)} Wh more" if enough <= largest else None,
        _with_type(attempt, replace(attempt.vehicle_type, drones=changed)),
    )


def _trip_distance(attempt: Attempt) -> _Diagnosis:
    vehicle_type = attempt.vehicle_type
    limit = vehicle_type.max_trip_distance or 0
    distance = attempt.evaluation.routes[0].trips[0].distance
    excess = _up_to_tenth(distance - limit, MM_PER_KM)
    enough = limit + excess
    changed = replace(vehicle_type, max_trip_distance=min(enough, MAX_QUANTITY))
    return _Diagnosis(
        "RANGE",
        f"A trip there and back is {_km(excess)} longer than a trip may be.",
        _if_stated(f"fits if trips could be {_km(excess)} longer", enough),
        _with_type(attempt, changed),
    )


def _arrival(attempt: Attempt) -> int:
    trip = attempt.solution.routes[0].trips[0]
    return (trip.sorties[0].visits[0] if trip.sorties else trip.stops[1]).arrival


def _stops(attempt: Attempt) -> _Diagnosis:
    vehicle_type = attempt.vehicle_type
    return _Diagnosis("STOPS", f"{vehicle_type.id} serves nobody itself, by its max_stops.",
                      f"fits if {vehicle_type.id} could make 1 stop",
                      _with_type(attempt, replace(vehicle_type, max_stops=1)))


def _sorties(attempt: Attempt) -> _Diagnosis:
    vehicle_type = attempt.vehicle_type
    return _Diagnosis("SORTIES", f"No drone of {vehicle_type.id} takes off, by its max_sorties.",
                      f"fits if {vehicle_type.id} could launch 1 sortie",
                      _with_type(attempt, replace(vehicle_type, max_sorties=1)))


def _time_window(attempt: Attempt) -> _Diagnosis:
    customer = attempt.customer
    late = _up_to_tenth(_arrival(attempt) - customer.latest, MS_PER_MINUTE)
    enough = customer.latest + late
    changed = replace(customer, latest=min(enough, UNLIMITED))
    window = "last window" if customer.gaps else "window"
    return _Diagnosis(
        "TIME_WINDOW",
        f"The earliest arrival is {_minutes(late)} after its {window} closes.",
        _if_stated(f"fits if its {window} closed {_minutes(late)} later", enough),
        replace(attempt.problem, customers=(changed,)),
    )


def _missed_window(attempt: Attempt) -> _Diagnosis | None:
    """Say that waiting for a window breaks a rule, and widen the one before it.

    None if nobody waits between two windows, or that doesn't suffice.
    """
    customer, arrival = attempt.customer, _arrival(attempt)
    missed = [number for number, (closes, opens) in enumerate(customer.gaps)
              if closes < arrival < opens]
    if not missed:
        return None
    (number,) = missed
    closes, opens = customer.gaps[number]
    late = _up_to_tenth(arrival - closes, MS_PER_MINUTE)
    # Windows don't touch: one that would is closed just before the next opens.
    wider = (min(closes + late, opens - 1), opens)
    gaps = (*customer.gaps[:number], wider, *customer.gaps[number + 1:])
    changed = replace(attempt.problem, customers=(replace(customer, gaps=gaps),))
    if all(again.codes for again in attempts(changed, 0, changed.num_depots)):
        return None
    return _Diagnosis(
        "TIME_WINDOW",
        f"The earliest arrival is {_minutes(late)} after its window {number + 1} closes, and "
        f"window {number + 2} is too late for {attempt.vehicle_type.id}.",
        f"fits if its window {number + 1} closed {_minutes(late)} later",
    )


def _more_overtime(attempt: Attempt, overtime: Overtime, limit: int, excess: int,
                   code: str, message: str) -> _Diagnosis:
    """Say what more overtime would do, which goes on from a limit that is exceeded by so much."""
    vehicle_type, enough = attempt.vehicle_type, overtime.max_duration + excess
    changed = replace(overtime, max_duration=min(enough, UNLIMITED))
    return _Diagnosis(
        code, message,
        _if_stated(f"fits if {vehicle_type.id} could work {_minutes(excess)} more overtime",
                   max(enough, limit + enough)),
        _with_type(attempt, replace(vehicle_type, overtime=changed)))


def _shift(attempt: Attempt) -> _Diagnosis:
    vehicle_type, overtime = attempt.vehicle_type, attempt.vehicle_type.overtime
    if overtime is not None:
        end = vehicle_type.latest + overtime.max_duration
        excess = _up_to_tenth(attempt.evaluation.makespan - end, MS_PER_MINUTE)
        return _more_overtime(
            attempt, overtime, vehicle_type.latest, excess, "SHIFT",
            f"{vehicle_type.id} would be back {_minutes(excess)} after its shift and all the "
            "overtime allowed.")
    late = _up_to_tenth(attempt.evaluation.makespan - vehicle_type.latest, MS_PER_MINUTE)
    home = "done" if attempt.problem.is_nowhere(vehicle_type.ends_at) else "back"
    enough = vehicle_type.latest + late
    changed = replace(vehicle_type, latest=min(enough, UNLIMITED))
    return _Diagnosis(
        "SHIFT",
        f"{vehicle_type.id} would be {home} {_minutes(late)} after its shift ends.",
        _if_stated(f"fits if {vehicle_type.id}'s shift ended {_minutes(late)} later", enough),
        _with_type(attempt, changed),
    )


def _working_hours(attempt: Attempt) -> _Diagnosis:
    vehicle_type, overtime = attempt.vehicle_type, attempt.vehicle_type.overtime
    limit = vehicle_type.max_working_duration or 0
    most = limit + allowed_overtime(vehicle_type)
    excess = _up_to_tenth(attempt.evaluation.routes[0].working_duration - most, MS_PER_MINUTE)
    if overtime is not None:
        return _more_overtime(
            attempt, overtime, limit, excess, "WORKING_HOURS",
            f"Serving it alone takes {_minutes(excess)} more than {vehicle_type.id} may work with "
            "all the overtime allowed.")
    enough = limit + excess
    changed = replace(vehicle_type, max_working_duration=min(enough, MAX_QUANTITY))
    return _Diagnosis(
        "WORKING_HOURS",
        f"Serving it alone takes {_minutes(excess)} more than {vehicle_type.id} may work.",
        _if_stated(f"fits if {vehicle_type.id} could work {_minutes(excess)} longer", enough),
        _with_type(attempt, changed),
    )


DIAGNOSES: dict[str, Callable[[Attempt], _Diagnosis]] = {
    "VEHICLE": _vehicle,
    "SKILLS": _skills,
    "CAPACITY": _capacity,
    "PAYLOAD": _payload,
    "UNREACHABLE": _unreachable,
    "ENDURANCE": _endurance,
    "ENERGY": _energy,
    "TRIP_DISTANCE": _trip_distance,
    "MAX_STOPS": _stops,
    "MAX_SORTIES": _sorties,
    "TIME_WINDOW": _time_window,
    "SHIFT": _shift,
    "WORKING_DURATION": _working_hours,
}
"""Broken rules, the hardest to change first."""
