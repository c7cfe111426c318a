"""Why a customer is served where he is -> plain data (see `app.schemas.explain`)."""

from collections.abc import Collection, Iterable, Sequence

from app.plans.remedies import Remedies
from app.plans.replies import (
    Data, cost_reply, one_per_type, place_reply, reason_reply, vehicle_name,
)
from app.plans.steps import Steps
from app.plans.task import telling
from app.requests.conversion.units import money, whole
from model.counsel.alternatives import Alternative, visit_of
from model.counsel.bench import Bench, Trial
from model.counsel.binding import Binding, Limit
from model.counsel.explain import Reason
from model.counsel.group_moves import MovedUnit
from model.counsel.idle_drones import Idle
from model.counsel.worth import Worth
from model.judge.clock import window_of
from model.judge.places import Found, find_place
from model.judge.rules import Violation
from model.planner import PlanResult
from model.problem import Problem
from model.solution import Cost, Solution, Stop, Visit


def customer_reply(bench: Bench, alternatives: Iterable[Alternative], binding: Iterable[Binding],
                   reasons: Iterable[Reason], remedies: Remedies, steps: Steps) -> Data:
    """Return what is said of one customer or shipment."""
    problem = bench.problem
    return {
        **subject_reply(bench),
        "cost": cost_reply(bench.plan.evaluation.cost),
        "here": here_reply(bench),
        "alternatives": [_alternative(bench, each) for each in alternatives],
        "binding": [_binding(bench, each, steps) for each in binding],
        "reasons": [reason_reply(problem, bench.node, reason, remedies)
                    for reason in one_per_type(problem, reasons)],
    }


def subject_reply(bench: Bench) -> Data:
    """Return who is moved: a customer, or a shipment as one."""
    problem = bench.problem
    customer = problem.customer_at(problem.first_place(bench.node)).id
    return {"customer": customer if bench.shipment is None else None,
            "shipment": None if bench.shipment is None else bench.shipment.id}


def nobody_reply(cost: Cost) -> Data:
    """Return the same where nobody is asked about."""
    return {"customer": None, "shipment": None, "cost": cost_reply(cost), "here": None,
            "alternatives": [], "binding": [], "reasons": []}


def difference(cost: Cost, less: Cost) -> dict[str, float]:
    """Return by term what a cost is more than another."""
    before = cost_reply(less)
    return {term: money(value - before[term]) for term, value in cost_reply(cost).items()}


def here_reply(bench: Bench) -> Data | None:
    """Return where a plan serves the customer, and what that costs; None: nowhere."""
    if bench.found is None:
        return None
    return placed_reply(bench, bench.plan) | {
        "saving": more_than_without(bench, bench.plan)}


def more_than_without(bench: Bench, trial: Trial) -> dict[str, float]:
    """Return what a plan costs more than without the customer; leaving him out counts nothing."""
    more = difference(trial.evaluation.cost, bench.left_out.evaluation.cost)
    more["total"] = money(more["total"] - more["unassigned"])
    more["unassigned"] = 0.0
    return more


def _alternative(bench: Bench, each: Alternative) -> Data:
    trial = each.trial
    placed = placed_reply(bench, trial, each.companions)
    if each.window is not None:
        placed["window"] = each.window
        if bench.shipment is not None and each.node is not None:
            placed["window_at"] = bench.problem.customer_at(each.node).id
    return {
        "kind": each.kind,
        **placed,
        **companions_reply(bench.problem, each.companions),
        "cost": difference(trial.evaluation.cost, bench.plan.evaluation.cost),
        "feasible": trial.evaluation.is_feasible,
        "reasons": rules_reply(trial.evaluation.violations),
    }


def companions_reply(problem: Problem, companions: Sequence[MovedUnit]) -> Data:
    """Return who goes along, if anybody does."""
    names = [problem.customer_at(problem.first_place(unit.node)).id
             if unit.shipment is None else unit.shipment.id for unit in companions]
    return {"companions": names} if names else {}


def rules_reply(violations: Sequence[Violation]) -> list[Data]:
    """Return which rules are broken, and how."""
    return [{"code": code, "message": message} for code, message in dict.fromkeys(
        (item.code, item.message) for item in telling(violations))]


def placed_reply(bench: Bench, trial: Trial, companions: Sequence[MovedUnit] = ()) -> Data:
    """Return who serves the customer where and when in a plan, or all ends of the shipment."""
    moved = {*bench.nodes, *(node for unit in companions for node in unit.nodes)}
    placed = [(node, found, visit) for node in bench.nodes
              if (found := find_place(trial.solution, node)) is not None
              and (visit := visit_of(trial, node)) is not None]
    if not placed:
        return {"vehicle": None, "by": None, "window": None, "position": None,
                "service_start": None}
    placed.sort(key=lambda each: each[2].service_start)
    problem = bench.problem
    ends = [{**place_reply(problem, node), **_at_place(problem, trial, (node, found, visit), moved),
             "arrival": whole(visit.arrival)} for node, found, visit in placed]
    node, found, _ = placed[0]
    at = {name: what for name, what in place_reply(problem, node).items() if name == "alternative"}
    reply = {"vehicle": vehicle_name(problem, trial.solution.routes[found.route]), **at,
             **_at_place(problem, trial, placed[0], moved)}
    if bench.shipment is None:
        return reply
    by = "drone" if any(end["by"] == "drone" for end in ends) else "truck"
    return reply | {"by": by, "ends": ends}


def _at_place(problem: Problem, trial: Trial, placed: tuple[int, Found, Stop | Visit],
              moved: Collection[int]) -> Data:
    """Return who comes to a node, in which window, where in the vehicle's work and when.

    `moved` are all who were put there.
    """
    (node, found, visit), place = placed, placed[1].place
    trip = trial.solution.routes[found.route].trips[place.trip]
    stops, by_drone = trip.stops, place.by == "drone"
    return {
        "by": "drone" if problem.vehicle_types[place.vehicle.type].flies else place.by,
        "window": window_of(problem.customer_at(node), visit.service_start),
        "position": {
            "trip": place.trip,
            "own_trip": {*trip.served} <= {*moved},
            "stop": place.stop,
            "after": _name(problem, stops[place.stop - (not by_drone)].node),
            "recovery_stop": place.recovery if by_drone else None,
            "recovered_at": _name(problem, stops[place.recovery].node) if by_drone else None,
        },
        "service_start": whole(visit.service_start),
    }


def _name(problem: Problem, node: int) -> str:
    if node < problem.num_depots:
        return problem.depots[node].id
    return problem.customer_at(node).id


def _binding(bench: Bench, each: Binding, steps: Steps) -> Data:
    limit, problem = each.limit, bench.problem
    at = ("" if limit.whose == "request" else _name_of_limited(bench, limit)
          if limit.kind is None else problem.vehicle_types[limit.kind].type_id)
    return {
        "rule": limit.field,
        "at": at,
        "slack": limit.slack,
        "unit": limit.unit,
        "saves_per_unit": each.saves_per_unit,
        "changes": steps(limit, at, bench.shipment is not None and at == bench.shipment.id),
    }


def _name_of_limited(bench: Bench, limit: Limit) -> str:
    """Return the name of the customer whose limit it is, or of a shipment that has it whole."""
    if bench.shipment is not None and (limit.unit == "rule" or limit.field == "max_time_between"):
        return bench.shipment.id
    return bench.problem.customer_at(bench.node if limit.node is None else limit.node).id


def drones_reply(problem: Problem, solution: Solution, cost: Cost, sorties: Sequence[Worth],
                 searched: tuple[PlanResult, PlanResult] | None, seconds: float) -> Data:
    """Return what drones save; `searched` are plans with drones and of trucks alone."""
    saves = saves_at_most = None
    if searched is not None:
        flown, driven = searched
        if len(driven.solution.unassigned) <= len(flown.solution.unassigned):
            saves = money(driven.final_cost - flown.final_cost)
        if len(driven.solution.unassigned) <= len(solution.unassigned):
            saves_at_most = money(driven.final_cost - cost.total)
    return {
        "sorties": [_worth(problem, solution, each) for each in sorties],
        "saves": saves,
        "saves_at_most": saves_at_most,
        "seconds": seconds,
        "with_drones": None if searched is None else _searched(searched[0]),
        "trucks_alone": None if searched is None else _searched(searched[1]),
    }


def _worth(problem: Problem, solution: Solution, each: Worth) -> Data:
    route = solution.routes[each.route]
    sortie = route.trips[each.trip].sorties[each.sortie]
    return {
        "vehicle": vehicle_name(problem, route),
        "trip": each.trip,
        "sortie": each.sortie,
        "customers": [problem.customer_at(visit.node).id for visit in sortie.visits],
        "saves": None if each.saves is None else money(each.saves),
        "tried": each.is_tried,
    }


def idle_reply(problem: Problem, solution: Solution, each: Idle) -> Data:
    """Return why a vehicle's drones fly nothing."""
    return {
        "vehicle": vehicle_name(problem, solution.routes[each.route]),
        "code": each.code,
        "message": each.message,
        "customer": None if each.node is None else problem.customer_at(each.node).id,
        "cost": None if each.cost is None else money(each.cost),
    }


def _searched(result: PlanResult) -> Data:
    return {"cost": cost_reply(result.evaluation.cost),
            "unassigned": len(result.solution.unassigned),
            "search_iterations": result.search_iterations}
