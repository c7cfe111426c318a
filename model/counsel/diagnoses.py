"""Rules that a vehicle breaks which serves a customer alone: in words, and what would change that.
"""

from collections.abc import Callable
from dataclasses import replace
from operator import gt

from model.counsel.diagnosis import (
    Diagnosis, drones_of, more_of, name_of, told_apart, up_to_tenth, with_type,
)
from model.counsel.flight_diagnoses import (
    endurance_broken, energy_broken, hours_broken, max_range_broken, unreachable_broken,
    wind_broken,
)
from model.counsel.remedy import LAST_WINDOW, Change, if_stated, in_minutes, in_units
from model.counsel.route_limits import too_much
from model.counsel.trial import Attempt, attempts
from model.judge.clock import MS_PER_MINUTE
from model.judge.driving import excesses
from model.judge.freshness import excess_aboard
from model.judge.metrics import allowed_overtime
from model.judge.rules import amounts
from model.problem import UNLIMITED, Depot, Overtime, Problem
from model.solution import Stop, Visit


def _vehicle(attempt: Attempt) -> Diagnosis:
    name = attempt.vehicle_type.id
    return Diagnosis("VEHICLE", f"{name} may not serve it.",
                     (Change("vehicles", name, names=(name,)),),
                     replace(attempt.problem, may_serve=None))


def _skills(attempt: Attempt) -> Diagnosis:
    vehicle_type, needed = attempt.vehicle_type, attempt.customer.skills
    missing = tuple(sorted(needed - vehicle_type.skills))
    changed = replace(vehicle_type, skills=vehicle_type.skills | needed)
    return Diagnosis("SKILLS", f"{vehicle_type.id} lacks {', '.join(missing)}.",
                     (Change("skills", vehicle_type.id, names=missing),),
                     with_type(attempt, changed))


def _goods(attempt: Attempt) -> Diagnosis:
    apart = [each.goods & attempt.customer.goods for each in attempt.problem.incompatible_goods]
    names = " and ".join(sorted(frozenset().union(*(goods for goods in apart if len(goods) > 1))))
    return Diagnosis("GOODS", f"Its own {names} may not be carried together.")


def _too_much(attempt: Attempt, limit: tuple[int, ...], whose: str) -> str:
    """Say which of a customer's amounts exceeds a limit."""
    customer = attempt.customer
    name, amount = (("demand", customer.demand) if any(map(gt, customer.demand, limit))
                    else ("pickup", customer.taken_in))
    return (f"Its {name} of {amounts(attempt.problem, amount)} exceeds the {whose} of "
            f"{amounts(attempt.problem, limit)}.")


def _enough(attempt: Attempt, limit: tuple[int, ...]) -> tuple[int, ...]:
    """Return a limit raised to what a customer asks for."""
    return tuple(map(max, limit, attempt.customer.demand, attempt.customer.taken_in))


def _capacity(attempt: Attempt) -> Diagnosis:
    vehicle_type = attempt.vehicle_type
    needed = _enough(attempt, vehicle_type.capacity)
    return Diagnosis(
        "CAPACITY", _too_much(attempt, vehicle_type.capacity, "capacity"),
        (Change("capacity", amounts=in_units(attempt.problem, needed)),),
        with_type(attempt, replace(vehicle_type, capacity=needed)),
    )


def _payload(attempt: Attempt) -> Diagnosis:
    vehicle_type, drones = attempt.vehicle_type, drones_of(attempt)
    needed = _enough(attempt, drones.capacity)
    changed = replace(vehicle_type, drones=replace(drones, capacity=needed))
    return Diagnosis(
        "CAPACITY", _too_much(attempt, drones.capacity, f"drone capacity{name_of(drones)}"),
        (Change("drone_capacity", told_apart(drones), amounts=in_units(attempt.problem, needed)),),
        with_type(attempt, changed),
    )


def _pickup_order(attempt: Attempt) -> Diagnosis:
    vehicle_type = attempt.vehicle_type
    return Diagnosis(
        "PICKUP_ORDER",
        f"{vehicle_type.id} picks up only after it has delivered something on the same trip.",
        (Change("pickups", vehicle_type.id),),
        with_type(attempt, replace(vehicle_type, pickups="any")))


def _too_far_or_long(code: str) -> Callable[[Attempt], Diagnosis]:
    """Return what says by how much the way there and back is beyond a limit of a vehicle."""
    def broken(attempt: Attempt) -> Diagnosis:
        kind, (route,) = attempt.vehicle_type, attempt.solution.routes
        found = too_much(code, kind, route, attempt.evaluation.routes[0])
        return Diagnosis(found.limit.code,
                         found.limit.alone.format(more=found.more, of=kind.id),
                         found.remedy, with_type(attempt, found.changed))

    return broken


def _visit(attempt: Attempt) -> Stop | Visit:
    """Return where the customer is served, by the truck or a drone."""
    trip = attempt.solution.routes[0].trips[0]
    return trip.sorties[0].visits[0] if trip.sorties else trip.stops[1]


def _stops(attempt: Attempt) -> Diagnosis:
    vehicle_type = attempt.vehicle_type
    return Diagnosis("STOPS", f"{vehicle_type.id} serves nobody itself, by its max_stops.",
                     (Change("stops", vehicle_type.id, 1),),
                     with_type(attempt, replace(vehicle_type, max_stops=1)))


def _sorties(attempt: Attempt) -> Diagnosis:
    vehicle_type = attempt.vehicle_type
    return Diagnosis("SORTIES", f"No drone of {vehicle_type.id} takes off, by its max_sorties.",
                     (Change("sorties", vehicle_type.id, 1),),
                     with_type(attempt, replace(vehicle_type, max_sorties=1)))


def _batteries(attempt: Attempt) -> Diagnosis:
    vehicle_type = attempt.vehicle_type
    drones = replace(drones_of(attempt), batteries=1)
    own = tuple(filter(None, [drones.id]))
    return Diagnosis("SORTIES", f"No drone of {vehicle_type.id} takes off, by its batteries.",
                     (Change("batteries_aboard", vehicle_type.id, 1, names=own),),
                     with_type(attempt, replace(vehicle_type, drones=drones)))


def _launch(attempt: Attempt) -> Diagnosis:
    place, *others = attempt.problem.depots
    allowed = replace(attempt.problem, depots=(replace(place, launch=True), *others))
    return Diagnosis("LAUNCH", f"No drone takes off at {place.id}, by its launch.",
                     (Change("launch", place.id),), allowed)


def _time_window(attempt: Attempt) -> Diagnosis:
    customer = attempt.customer
    late = up_to_tenth(_visit(attempt).service_start - customer.latest, MS_PER_MINUTE)
    enough = customer.latest + late
    changed = replace(customer, latest=min(enough, UNLIMITED))
    name, window = ("last window", LAST_WINDOW) if customer.gaps else ("window", 0)
    return Diagnosis(
        "TIME_WINDOW",
        f"The earliest arrival is {in_minutes(late)} after its {name} closes.",
        if_stated(Change("window", quantity=late, window=window), enough),
        replace(attempt.problem, customers=(changed,)),
    )


def missed_window(attempt: Attempt) -> Diagnosis | None:
    """Say that waiting for a window breaks a rule, and widen the one before it.

    None if nobody waits between two windows, or that doesn't suffice.
    """
    customer, arrival = attempt.customer, _visit(attempt).ready
    missed = [number for number, (closes, opens) in enumerate(customer.gaps)
              if closes < arrival < opens]
    if not missed:
        return None
    (number,) = missed
    closes, opens = customer.gaps[number]
    late = up_to_tenth(arrival - closes, MS_PER_MINUTE)
    # Windows don't touch: one that would is closed just before the next opens.
    wider = (min(closes + late, opens - 1), opens)
    gaps = (*customer.gaps[:number], wider, *customer.gaps[number + 1:])
    changed = replace(attempt.problem, customers=(replace(customer, gaps=gaps),))
    if all(again.codes for again in attempts(changed, 0, changed.num_depots)):
        return None
    return Diagnosis(
        "TIME_WINDOW",
        f"The earliest arrival is {in_minutes(late)} after its window {number + 1} closes, and "
        f"window {number + 2} is too late for {attempt.vehicle_type.id}.",
        (Change("window", quantity=late, window=number + 1),),
    )


def _time_aboard(attempt: Attempt) -> Diagnosis:
    customer, trip = attempt.customer, attempt.solution.routes[0].trips[0]
    too_long = excess_aboard(attempt.problem, attempt.vehicle_type, trip, _visit(attempt))
    excess = up_to_tenth(too_long, MS_PER_MINUTE)
    remedy, changed = more_of("time_aboard", customer, excess)
    return Diagnosis(
        "TIME_ABOARD",
        f"Its parcel would be aboard {in_minutes(excess)} longer than it may be.", remedy,
        replace(attempt.problem, customers=(changed,)))


def _more_overtime(attempt: Attempt, overtime: Overtime, code: str, message: str) -> Diagnosis:
    """Say what more overtime would do, which goes on from shift and working duration alike."""
    kind, evaluation = attempt.vehicle_type, attempt.evaluation
    ends = [(kind.latest, evaluation.makespan)]
    if kind.max_working_duration is not None:
        ends.append((kind.max_working_duration, evaluation.routes[0].working_duration))
    lacking = max([end - limit - overtime.max_duration for limit, end in ends])
    excess = up_to_tenth(lacking, MS_PER_MINUTE)
    enough = overtime.max_duration + excess
    changed = replace(overtime, max_duration=min(enough, UNLIMITED))
    return Diagnosis(
        code, message,
        if_stated(Change("overtime", kind.id, excess),
                  max([enough, *(limit + enough for limit, end in ends if end > limit)])),
        with_type(attempt, replace(kind, overtime=changed)))


def _depot_hours(attempt: Attempt, closes: int) -> Diagnosis:
    """Say that a vehicle would be back after its depot closes, which its shift might allow."""
    vehicle_type = attempt.vehicle_type
    depot = attempt.problem.depots[vehicle_type.ends_at]
    late = up_to_tenth(attempt.evaluation.makespan - closes, MS_PER_MINUTE)
    return _open_longer(attempt, depot, late, f"{vehicle_type.id} would be back {in_minutes(late)} "
                        f"after {depot.id} closes.")


def _open_longer(attempt: Attempt, depot: Depot, late: int, message: str) -> Diagnosis:
    """Say what a depot would do that closed so much later; a day that it bounds grows with it.

    As far as the shift goes: what that lacks is a limit of its own.
    """
    problem, kind = attempt.problem, attempt.vehicle_type
    enough, changed = depot.latest + late, kind
    suffices = depot is not problem.depots[kind.ends_at] or enough <= kind.last_by_shift
    if depot is problem.depots[kind.ends_at] and kind.latest + allowed_overtime(kind) < enough:
        changed = replace(kind, latest=min(enough, kind.last_by_shift))
    return Diagnosis(
        "SHIFT", message,
        if_stated(Change("depot_hours", depot.id, late), enough)
        if suffices or kind.overtime is None else (),
        replace(with_type(attempt, changed), depots=_open_until(problem, depot, enough)))


def _open_until(problem: Problem, depot: Depot, enough: int) -> tuple[Depot, ...]:
    """Return the depots, one of which closes later."""
    return tuple([replace(each, latest=min(enough, UNLIMITED)) if each is depot else each
                  for each in problem.depots])


def _closed_before_departure(attempt: Attempt) -> Diagnosis | None:
    """Say by how much the depot closes before a vehicle leaves it; None if it doesn't."""
    start, kind = attempt.solution.routes[0].trips[0].stops[0], attempt.vehicle_type
    depot = attempt.problem.depots[start.node]
    if start.departure <= depot.latest:
        return None
    late = up_to_tenth(start.departure - depot.latest, MS_PER_MINUTE)
    comes_back = attempt.evaluation.makespan if kind.ends_at == start.node else start.departure
    return _open_longer(
        attempt, depot, up_to_tenth(comes_back - depot.latest, MS_PER_MINUTE),
        f"{kind.id} would leave {in_minutes(late)} after {depot.id} closes.")


def _shift(attempt: Attempt) -> Diagnosis:
    vehicle_type, overtime = attempt.vehicle_type, attempt.vehicle_type.overtime
    closed = _closed_before_departure(attempt)
    if closed is not None:
        return closed
    closes = attempt.problem.depots[vehicle_type.ends_at].latest
    if closes <= vehicle_type.latest + allowed_overtime(vehicle_type) and closes < UNLIMITED:
        return _depot_hours(attempt, closes)
    if overtime is not None:
        end = vehicle_type.latest + overtime.max_duration
        excess = up_to_tenth(attempt.evaluation.makespan - end, MS_PER_MINUTE)
        return _more_overtime(
            attempt, overtime, "SHIFT",
            f"{vehicle_type.id} would be back {in_minutes(excess)} after its shift and all the "
            "overtime allowed.")
    late = up_to_tenth(attempt.evaluation.makespan - vehicle_type.latest, MS_PER_MINUTE)
    home = "done" if attempt.problem.is_nowhere(vehicle_type.ends_at) else "back"
    remedy, changed = more_of("shift", vehicle_type, late, vehicle_type.id)
    return Diagnosis(
        "SHIFT", f"{vehicle_type.id} would be {home} {in_minutes(late)} after its shift ends.",
        remedy, with_type(attempt, changed))


def _working_hours(attempt: Attempt) -> Diagnosis:
    vehicle_type, overtime = attempt.vehicle_type, attempt.vehicle_type.overtime
    if overtime is None:
        return _too_far_or_long("WORKING_DURATION")(attempt)
    most = (vehicle_type.max_working_duration or 0) + allowed_overtime(vehicle_type)
    excess = up_to_tenth(attempt.evaluation.routes[0].working_duration - most, MS_PER_MINUTE)
    return _more_overtime(
        attempt, overtime, "WORKING_HOURS",
        f"Serving it alone takes {in_minutes(excess)} more than {vehicle_type.id} may work "
        "with all the overtime allowed.")


def _breaks(attempt: Attempt) -> Diagnosis:
    wrong = next(each for each in attempt.evaluation.violations if each.code == "BREAK")
    return Diagnosis("BREAK", f"Alone on {attempt.vehicle_type.id}, {wrong.message}.")


def _driving(attempt: Attempt) -> Diagnosis:
    kind, trips = attempt.vehicle_type, attempt.solution.routes[0].trips
    rules, found = kind.driving, list(excesses(kind, trips))
    if rules is None or {each.what for each in found} != {"day"}:
        return Diagnosis("DRIVING", f"Serving it alone takes longer than drivers of {kind.id} may "
                         "be at the wheel, or at work.")
    excess = up_to_tenth(found[0].excess, MS_PER_MINUTE)
    day = rules.max_driving_per_day
    enough = up_to_tenth(day + excess, MS_PER_MINUTE)
    remedy, changed = more_of("driving_day", kind, enough - day, kind.id)
    return Diagnosis(
        "DRIVING",
        f"Serving it alone takes {in_minutes(excess)} more than drivers of {kind.id} may be at the "
        "wheel in a day.",
        remedy, with_type(attempt, changed))


def _unreachable(attempt: Attempt) -> Diagnosis:
    trip = attempt.solution.routes[0].trips[0]
    if attempt.vehicle_type.flies or trip.sorties:
        return unreachable_broken(attempt)
    return Diagnosis("UNREACHABLE", f"The matrices of {attempt.vehicle_type.id} have no leg to it "
                     "from where its trips begin, or none back.")


DIAGNOSES: dict[str, Callable[[Attempt], Diagnosis]] = {
    "VEHICLE": _vehicle,
    "SKILLS": _skills,
    "GOODS": _goods,
    "CAPACITY": _capacity,
    "PAYLOAD": _payload,
    "PICKUP_ORDER": _pickup_order,
    "UNREACHABLE": _unreachable,
    "MAX_RANGE": max_range_broken,
    "WIND": wind_broken,
    "AIRSPACE": hours_broken,
    "ENDURANCE": endurance_broken,
    "ENERGY": energy_broken,
    **{code: _too_far_or_long(code)
       for code in ("TRIP_DISTANCE", "DISTANCE", "TRAVEL_DURATION")},
    "LAUNCH": _launch,
    "MAX_STOPS": _stops,
    "MAX_SORTIES": _sorties,
    "BATTERIES": _batteries,
    "TIME_WINDOW": _time_window,
    "TIME_ABOARD": _time_aboard,
    "SHIFT": _shift,
    "BREAK": _breaks,
    "DRIVING": _driving,
    "WORKING_DURATION": _working_hours,
}
"""Broken rules, the hardest to change first."""
