"""Why customers are left out on a day under way, also by who has been served with whom."""

from dataclasses import replace

import numpy as np

from model.counsel.explain import POSSIBLE, Reason, explain_type
from model.counsel.remedy import remedy_of
from model.judge.past import Past
from model.judge.relations import kept_off, who_decides
from model.problem import Problem
from model.replanning.remainder import Remainder
from model.replanning.workers import vehicle_name
from model.solution import Solution, Vehicle


def bound_reasons(problem: Problem, vehicle: Vehicle, is_aboard: bool) -> tuple[Reason, ...]:
    """Return why a customer is unassigned whom one vehicle alone may serve."""
    name = vehicle_name(problem, vehicle)
    if is_aboard:
        code, why = "ABOARD", f"Its parcel is aboard {name}"
    else:
        code, why = "PINNED", f"It is pinned to {name}"
    return tuple(
        Reason(kind, code, f"{why}, which has no room or time for it." if kind == vehicle.type
               else f"{why}.")
        for kind in range(len(problem.vehicle_types)))


def relation_reason(problem: Problem, past: Past, solution: Solution, kind: int,
                   nodes: tuple[int, ...]) -> Reason | None:
    """Return by which relation no vehicle of a type that is left serves anybody; None if by none.

    Parameters
    ----------
    solution
        The whole plan.
    nodes
        All places of a customer, or ends of a shipment.
    """
    for node in nodes:
        kept = who_decides(problem, solution, node)
        if kept is not None:
            names, vehicle = kept
            why = (f"It is to be served together with {names}, which "
                   f"{vehicle_name(problem, vehicle)} ")
            if vehicle in past.unavailable:
                return Reason(kind, "RELATION", f"{why}has served, and that does nothing more.")
            room = ", and has no room for it" if vehicle.type == kind else ""
            return Reason(kind, "RELATION", f"{why}serves{room}.")
        barred = kept_off(problem, solution, kind, node)
        names = ", ".join(dict.fromkeys(barred.values()))
        lost = {vehicle for vehicle in past.unavailable if vehicle.type == kind}
        if barred and len(barred.keys() | lost) >= problem.vehicle_types[kind].count:
            return Reason(kind, "RELATION", f"It is kept apart from {names}, whom "
                          f"{problem.vehicle_types[kind].id} serves.")
    return None


def barred_reason(problem: Problem, past: Past, left: Remainder, solution: Solution,
                  plan: Solution, barred: tuple[int, int], until: float) -> Reason | None:
    """Return why no vehicle of a type that is left may serve a customer, who could but for others.

    None if it isn't for others whom vehicles serve, or have served, that they may not.

    Parameters
    ----------
    plan
        What of the whole plan, `solution`, is yet to begin, as a plan of what is left.
    barred
        A type, and who is left out, as they are numbered in the whole.
    """
    kind, node = barred
    shipment = problem.shipment_at.get(node)
    nodes = tuple([place for place in problem.places_of(node) if problem.allows(kind, place)])
    if shipment is not None:
        nodes = shipment.nodes if all(problem.allows(kind, end) for end in shipment.nodes) else ()
    here, first = left.numbers, left.problem.num_depots
    table, types = left.problem.may_serve, left.from_depot(kind, node)
    columns = [here[place] - first for place in nodes]
    if not nodes or table is None or table[np.ix_(types, columns)].any():
        return None
    told = relation_reason(problem, past, solution, kind, nodes)
    if told is None and problem.customer_at(node).goods:
        name = problem.vehicle_types[kind].id
        return Reason(kind, "GOODS", f"Its goods may not join what {name} has carried today.")
    if told is None:
        return None
    free = table.copy()
    free[np.ix_(types, columns)] = True
    freed = explain_type(replace(left.problem, may_serve=free, relations=()), plan, types[0],
                         here[node], until)
    return (replace(told, remedies=(remedy_of("relations"),)) if freed.code in POSSIBLE
            else told)
