"""Why a customer is unassigned, and what would change that.

For each vehicle type the customer is tried alone; `check` judges these attempts and every remedy
offered.
"""

import math
import time
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import chain
from math import ceil

from model.counsel.combined_remedies import Diagnose, combined_remedy, customer_broken
from model.counsel.diagnoses import DIAGNOSES, missed_window
from model.counsel.diagnosis import Diagnosis
from model.counsel.lag_remedies import lag_remedy
from model.counsel.remedy import Change, Remedy, remedy_of
from model.counsel.rest_remedies import rest_remedy
from model.counsel.shipment_diagnoses import shipment_broken
from model.counsel.through import BY_LEGS, Passage, names_of, passage_to
from model.counsel.trial import (
    Attempt, attempts, small_problem, try_shipment, try_truck,
)
from model.judge.check import check
from model.judge.hubs import lacks_battery, lacks_charger
from model.judge.metrics import unassigned_cost
from model.judge.relations import kept_off, who_decides, who_waits
from model.problem import MAX_MONEY, Problem, Shipment, VehicleType
from model.solution import Solution


@dataclass(frozen=True)
class Reason:
    """Why no vehicle of a type serves a customer."""

    vehicle_type: int
    code: str
    message: str
    remedies: tuple[Remedy, ...] = ()  # each suffices: none, one or two

    @property
    def remedy(self) -> str | None:
        """What suffices, in words."""
        return str(self.remedies[0]) if self.remedies else None

    @property
    def other_remedy(self) -> str | None:
        """What else does."""
        return str(self.remedies[1]) if len(self.remedies) > 1 else None

    def or_by(self, remedy: Remedy) -> "Reason":
        """Return a reason that has one more remedy, in place of a second."""
        return replace(self, remedies=(*self.remedies[:1], remedy))


POSSIBLE = frozenset({"BATTERIES", "CHARGERS", "COST", "FLEET_EXHAUSTED", "SEARCH"})
"""Reasons why somebody is left out whom a vehicle could serve."""


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
    """Return why no vehicle of a type serves the customer at `node`. As `explain`.

    Of several places that is of his own, unless he could be served at another, or fewer changes
    would do there.
    """
    told = _explain_at(problem, solution, index, node, until)
    if told.code in POSSIBLE:
        return told
    for place in problem.places_of(node)[1:]:
        reason = _explain_at(problem, solution, index, place, until)
        if reason.code in POSSIBLE:
            return _at_place(problem, reason, place)
        if _changes(reason) < _changes(told):
            told = _at_place(problem, reason, place)
    return told


def _changes(reason: Reason) -> float:
    """Return how many limits a remedy changes; infinity: there is none."""
    return len(reason.remedies[0].parts) if reason.remedies else math.inf


def _at_place(problem: Problem, reason: Reason, place: int) -> Reason:
    """Return a reason with the name of the place that it is about."""
    name = problem.customer_at(place).id
    message = reason.message[0].lower() + reason.message[1:]
    if reason.message.startswith(problem.vehicle_types[reason.vehicle_type].id):
        message = reason.message

    def there(change: Change) -> Change:
        return change._replace(of=name) if change.limit == "window" else change

    return replace(reason, message=f"At {name} {message}", remedies=tuple(
        [remedy.with_changes(there) for remedy in reason.remedies]))


def _explain_at(problem: Problem, solution: Solution, index: int, node: int,
                until: float) -> Reason:
    """Return the same of one place alone."""
    vehicle_type = problem.vehicle_types[index]
    if time.perf_counter() >= until:
        return _unknown(index, vehicle_type.id)
    if node in problem.shipment_at:
        return _shipment_left_out(problem, solution, index, problem.shipment_at[node])
    served_by = problem.customer_at(node).served_by
    if vehicle_type.flies and served_by == "truck":
        message = f"Only a truck may serve it and {vehicle_type.id} flies."
        return Reason(index, "KIND", message, _by_other(problem, index, node, "by_drone"))
    if served_by == "drone" and vehicle_type.drones is None and not vehicle_type.flies:
        message = f"Only a drone may serve it and {vehicle_type.id} carries none."
        return Reason(index, "KIND", message, _by_other(problem, index, node, "by_truck"))
    tried = attempts(problem, index, node)
    first = next(tried)
    for attempt in chain((first,), tried):
        if not attempt.codes:
            kept = _by_relation(problem, solution, index, node)
            return (_unused(problem, solution, index, node, attempt) if kept is None
                    else _unrelated(problem, solution, kept))
        if time.perf_counter() >= until:
            return _unknown(index, vehicle_type.id)
    if first.codes <= BY_LEGS:
        passage = passage_to(problem, index, node)
        if passage is not None and _is_better(passage, first):
            return _by_way_of_others(problem, solution, passage, node)
    return _failed(problem, index, node, first)


def _shipment_left_out(problem: Problem, solution: Solution, index: int,
                       shipment: Shipment) -> Reason:
    """Say why no vehicle of a type brings a shipment, by a trip for it alone."""
    attempt = try_shipment(problem, index, shipment)
    if attempt.evaluation.violations:
        return _with_remedy(index, shipment_broken(attempt), attempt, shipment_broken)
    for node in shipment.nodes:
        related = _by_relation(problem, solution, index, node)
        if related is not None:
            return _unrelated(problem, solution, related)
    return _not_worth(problem, solution, index, shipment.pickup, attempt,
                      f"{problem.vehicle_types[index].id} could bring it alone")


def _is_better(passage: Passage, alone: Attempt) -> bool:
    """Tell whether a trip through others keeps the rules, or takes less time than one alone."""
    return passage.lacks is None or (passage.timed.judged.metrics.working_duration
                                     < alone.evaluation.routes[0].working_duration)


def _by_way_of_others(problem: Problem, solution: Solution, passage: Passage,
                      node: int) -> Reason:
    """Say why a trip that serves a customer among others is not in the plan.

    There is no remedy: what would help takes those others along.
    """
    index = passage.timed.route.vehicle_type
    vehicle_type, others = problem.vehicle_types[index], names_of(problem, passage.others)
    if passage.lacks is not None:
        return Reason(index, passage.lacks.code, f"By way of {others}, the shortest, "
                      f"{vehicle_type.id} {passage.lacks.words}.")
    way = f"{vehicle_type.id} could serve it together with {others}"
    cost = passage.timed.judged.cost.total
    absent = [node, *[each for each in passage.others if each in solution.unassigned]]
    left_out = unassigned_cost(problem, [problem.first_place(each) for each in absent])
    if cost >= left_out:
        price = ceil(cost * 100) / 100
        return Reason(index, "COST", f"{way} at a cost of {price:.2f}; leaving those out who are "
                      f"costs {left_out:.2f}.")
    if not _is_left(problem, solution, index):
        return Reason(index, "FLEET_EXHAUSTED", f"{way}, but {_in_use(vehicle_type)}.")
    return Reason(index, "SEARCH", f"{way}, but the search did not find room for it.")


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


def _unused(problem: Problem, solution: Solution, index: int, node: int,
            attempt: Attempt) -> Reason:
    """Say why an attempt that keeps all rules is not in the plan."""
    vehicle_type = problem.vehicle_types[index]
    *hosts, _ = attempt.problem.customers
    way = f"{vehicle_type.id} could serve it alone"
    if hosts and attempt.solution.routes[0].trips[0].sorties:
        way = f"A drone of {vehicle_type.id} could serve it from a stop at {hosts[0].id}"
    elif hosts:
        way = f"{vehicle_type.id} could serve it after {hosts[0].id}"
    lacking = _lacking_at_hub(problem, solution, index)
    if lacking is not None:
        return replace(lacking, message=f"{way}, but {lacking.message}")
    return _not_worth(problem, solution, index, node, attempt, way)


def _not_worth(problem: Problem, solution: Solution, index: int, node: int, attempt: Attempt,
               way: str) -> Reason:
    """Say what keeps the search from a way that keeps all rules."""
    vehicle_type, cost = problem.vehicle_types[index], attempt.evaluation.cost.total
    hosts = attempt.problem.customers[:-1] if not attempt.problem.shipments else ()
    customer = problem.customer_at(problem.first_place(node))
    left_out = problem.cost_of_leaving_out(customer)
    is_dear = not hosts and cost >= left_out
    price = f"{ceil(cost * 100) / 100:.2f}"
    at_price = f"{way} at a cost of {price}; leaving it out costs {left_out:.2f}"
    if not _is_left(problem, solution, index):
        if is_dear:
            return Reason(index, "COST", f"{at_price}, and {_in_use(vehicle_type)}.")
        would_do = not hosts and vehicle_type.part_of in (None, vehicle_type.id)
        return Reason(index, "FLEET_EXHAUSTED", f"{way}, but {_in_use(vehicle_type)}.",
                      (remedy_of("count"),) if would_do else ())
    if is_dear:
        whose = "" if customer.unassigned_cost is None else "own_"
        remedy = remedy_of(f"{whose}unassigned_cost", quantity=ceil(cost * 100) / 100)
        return Reason(index, "COST", f"{at_price}.", (remedy,) if cost < MAX_MONEY else ())
    return Reason(index, "SEARCH", f"{way}, but the search did not find room for it.")


def _by_relation(problem: Problem, solution: Solution, index: int, node: int) -> Reason | None:
    """Say by which relation no vehicle of a type that is left serves a customer; None if one may.
    """
    kind = problem.vehicle_types[index]
    kept = who_decides(problem, solution, node)
    if kept is not None:
        names, vehicle = kept
        name = problem.vehicle_types[vehicle.type].vehicle_name(vehicle.number)
        why = f"It is to be served together with {names}, which {name} serves"
        room = ", and has no room for it" if vehicle.type == index else ""
        return Reason(index, "RELATION", f"{why}{room}.",
                      lag_remedy(problem, solution, index, node) if room else ())
    waiting = _out_of_order(problem, solution, index, node)
    if waiting is not None:
        return waiting
    barred = kept_off(problem, solution, index, node)
    if not barred or len(barred) < kind.count:
        return None
    return Reason(index, "RELATION", f"It is kept apart from {', '.join(barred.values())}, whom "
                  f"{kind.id} serves.", (remedy_of("count", kind.id),)
                  if kind.part_of in (None, kind.id) else ())


def _unrelated(problem: Problem, solution: Solution, reason: Reason) -> Reason:
    """Return a reason with the remedy that relations bind nobody, where a vehicle is left."""
    index = reason.vehicle_type
    if not _is_left(problem, solution, index) or (
            _lacking_at_hub(problem, solution, index) is not None):
        return reason
    return reason.or_by(remedy_of("relations"))


def _out_of_order(problem: Problem, solution: Solution, index: int, node: int) -> Reason | None:
    """Say for whom other vehicles serve no truck of a type comes in time; None if one may."""
    if node not in problem.lags_across:
        return None
    names, bound = who_waits(problem, solution, node)
    if bound is problem or (bound is not None and (node in problem.shipment_at or any(
            not attempt.codes for attempt in attempts(bound, index, node)))):
        return None
    return Reason(index, "RELATION", f"{problem.vehicle_types[index].id} can't serve it in its "
                  f"order with {names}, as the plan serves these.",
                  lag_remedy(problem, solution, index, node))


def _in_use(kind: VehicleType) -> str:
    return "it is in use" if kind.count == 1 else f"all {kind.count} are in use"


def _is_left(problem: Problem, solution: Solution, index: int) -> bool:
    """Tell whether a plan doesn't use all vehicles of a type."""
    used = {route.vehicle for route in solution.routes if route.vehicle_type == index}
    return len(used) < problem.vehicle_types[index].count


def _lacking_at_hub(problem: Problem, solution: Solution, index: int) -> Reason | None:
    """Say what the depot of a type lacks for another of its vehicles; None if nothing."""
    kind, is_left = problem.vehicle_types[index], _is_left(problem, solution, index)
    hub = problem.depots[kind.depot].id
    if lacks_battery(problem, kind, solution):
        return Reason(index, "BATTERIES", f"no charged battery of {hub} is left.",
                      (remedy_of("hub_batteries", hub),) if is_left else ())
    if is_left and lacks_charger(problem, kind, 0, solution):
        return Reason(index, "CHARGERS", f"no place to charge at {hub} is left.",
                      (remedy_of("hub_chargers", hub),))
    return None


def _failed(problem: Problem, index: int, node: int, attempt: Attempt) -> Reason:
    """Say which rule an attempt breaks, with a remedy that was tried."""
    code = next(code for code in DIAGNOSES if code in attempt.codes)
    window = missed_window(attempt)
    if window is not None:
        return Reason(index, window.code, window.message, (Remedy((window.remedy,)),))
    reason = _with_remedy(index, DIAGNOSES[code](attempt), attempt, customer_broken)
    if (not reason.remedies and attempt.customer.served_by == "drone"
            and not attempt.vehicle_type.flies):
        return replace(reason, remedies=_by_other(problem, index, node, "by_truck"))
    return reason


def _with_remedy(index: int, diagnosis: Diagnosis, attempt: Attempt,
                 diagnose: Diagnose) -> Reason:
    """Return a reason with what was tried and suffices, of the rule and of breaks and rests.

    Where neither does alone, of several rules together.
    """
    holds = diagnosis.problem and not check(diagnosis.problem, attempt.solution).violations
    found = [Remedy((part,)) for part in (diagnosis.remedy if holds else (), rest_remedy(attempt))
             if part]
    if not found:
        found = [*filter(None, [combined_remedy(attempt, diagnose)])]
    return Reason(index, diagnosis.code, diagnosis.message, tuple(found))


def _by_other(problem: Problem, index: int, node: int, limit: str) -> tuple[Remedy, ...]:
    """Return that a truck, or a drone, should be allowed, if that suffices."""
    if node in problem.lags_across:
        return ()
    small = small_problem(problem, index, [node])
    customer = replace(small.customers[0], served_by="either")
    attempt = next(try_truck(replace(small, customers=(customer,))))
    return () if attempt.codes else (remedy_of(limit),)
