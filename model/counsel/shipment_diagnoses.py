"""Why a vehicle that brings a shipment alone breaks a rule, and what would change that."""

from collections.abc import Iterator
from dataclasses import replace

from model.counsel.diagnoses import DIAGNOSES
from model.counsel.diagnosis import Diagnosis, up_to_tenth, with_type
from model.counsel.remedy import LAST_WINDOW, Change, in_minutes, in_units
from model.counsel.trial import Attempt
from model.judge.clock import MS_PER_MINUTE
from model.judge.lags import starts_of
from model.judge.pairs import times_between
from model.judge.rules import amounts
from model.problem import MAX_QUANTITY, UNLIMITED
from model.problem.shipment import MOST_DETOUR


def shipment_broken(attempt: Attempt) -> Diagnosis:
    """Return the rule that is hardest to change of those that a shipment's trip breaks.

    Nothing is offered for the detours of one fetched in parts, each its own.
    """
    (shipment,) = attempt.problem.shipments
    unknown = {"TIME_BETWEEN"} if shipment.more and shipment.max_detour is not None else ()
    for violation in attempt.evaluation.violations:
        if violation.code not in CODES or violation.code in unknown:
            return Diagnosis(violation.code,
                             f"Alone on {attempt.vehicle_type.id}: {violation.message}.")
    code = next(code for code in CODES if code in attempt.codes)
    return (DIAGNOSES | OWN)[code](attempt)


def _capacity(attempt: Attempt) -> Diagnosis:
    (shipment,), kind = attempt.problem.shipments, attempt.vehicle_type
    needed = tuple(map(max, kind.capacity, shipment.total))
    return Diagnosis(
        "CAPACITY", f"Its amount of {amounts(attempt.problem, shipment.total)} exceeds the "
        f"capacity of {amounts(attempt.problem, kind.capacity)}.",
        (Change("capacity", amounts=in_units(attempt.problem, needed)),),
        with_type(attempt, replace(kind, capacity=needed)))


def _windows(attempt: Attempt) -> Diagnosis:
    """Say at which end, or both, it would be too late."""
    customers, told = list(attempt.problem.customers), list[str]()
    changes: list[Change] = []
    most = 0
    for index, late in _late_ends(attempt):
        end, customer = _end_name(attempt, index), customers[index]
        later = up_to_tenth(late, MS_PER_MINUTE)
        most = max(most, customer.latest + later)
        customers[index] = replace(customer, latest=min(customer.latest + later, UNLIMITED))
        name, window = ("last window", LAST_WINDOW) if customer.gaps else ("window", 0)
        told.append(f"{in_minutes(later)} after the {name} of its {end} closes")
        changes.append(Change("end_window", end, later, window=window))
    return Diagnosis(
        "TIME_WINDOW", f"The earliest arrival is {' and '.join(told)}.",
        tuple(changes) if most <= MAX_QUANTITY else (),
        replace(attempt.problem, customers=tuple(customers)))


def _end_name(attempt: Attempt, index: int) -> str:
    """Return which end a customer is, of several pickups with its name among them."""
    (shipment,), customers = attempt.problem.shipments, attempt.problem.customers
    if index == len(customers) - 1:
        return "delivery"
    part = customers[index].id.removeprefix(f"{shipment.id}/pickup/")
    return f"pickup {part}" if shipment.more else "pickup"


def _late_ends(attempt: Attempt) -> Iterator[tuple[int, int]]:
    """Yield which customers are served too late, and by how much."""
    problem = attempt.problem
    starts = starts_of(attempt.solution.routes[0].visits)
    for index, customer in enumerate(problem.customers):
        late = starts[problem.num_depots + index] - customer.latest
        if customer.late_cost_per_hour is None and late > 0:
            yield index, late


def _time_between(attempt: Attempt) -> Diagnosis:
    """Say that it would be under way for too long, and which of its limits would have to be more.
    """
    problem, kind = attempt.problem, attempt.vehicle_type
    (_, _, excess), = times_between(problem, kind, attempt.solution.routes[0].trips[0])
    (shipment,) = problem.shipments
    direct = problem.travel[kind.travel].duration.item(shipment.pickup, shipment.delivery)
    needed = (shipment.longest_between(direct) or 0) + up_to_tenth(excess, MS_PER_MINUTE)
    changes = []
    if shipment.max_time_between is not None and shipment.max_time_between < needed:
        needed = up_to_tenth(needed, MS_PER_MINUTE)
        shipment = replace(shipment, max_time_between=min(needed, MAX_QUANTITY))
        changes.append(Change("time_between", quantity=needed))
    if shipment.max_detour is not None and direct * shipment.max_detour // 1000 < needed and direct:
        detour = min(-(-needed * 1000 // direct), MOST_DETOUR)
        shipment = replace(shipment, max_detour=detour)
        changes.append(Change("detour", quantity=detour))
    return Diagnosis(
        "TIME_BETWEEN", f"It would be under way {in_minutes(up_to_tenth(excess, MS_PER_MINUTE))} "
        "longer than it may be.",
        tuple(changes) if needed <= MAX_QUANTITY else (),
        replace(problem, shipments=(shipment,)))


def _stops(attempt: Attempt) -> Diagnosis:
    kind, ends = attempt.vehicle_type, len(attempt.problem.shipments[0].nodes)
    return Diagnosis("STOPS", f"{kind.id} makes fewer stops than its {ends}, by its max_stops.",
                     (Change("stops", kind.id, ends),),
                     with_type(attempt, replace(kind, max_stops=ends)))


OWN = {"CAPACITY": _capacity, "TIME_WINDOW": _windows, "TIME_BETWEEN": _time_between,
       "MAX_STOPS": _stops}

CODES = tuple([code for known in DIAGNOSES
               for code in ((known, "TIME_BETWEEN") if known == "TIME_WINDOW" else (known,))])
"""Broken rules, the hardest to change first."""
