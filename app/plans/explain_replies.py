"""Why a customer is served where he is -> plain data (see `app.schemas.explain`)."""

from collections.abc import Iterable, Sequence

from app.conversion.units import whole
from app.plans.replies import Data, cost_reply, one_per_type, reason_reply, vehicle_name
from model.judge.alternatives import Alternative, halt_of
from model.judge.bench import Bench, Trial
from model.judge.binding import Binding
from model.judge.clock import window_of
from model.judge.explain import Reason
from model.judge.places import Found, find_place
from model.judge.rules import Violation
from model.judge.worth import Worth
from model.planner import PlanResult
from model.problem import Problem
from model.solution import Cost, Solution


def customer_reply(bench: Bench, alternatives: Iterable[Alternative], binding: Iterable[Binding],
                   reasons: Iterable[Reason]) -> Data:
    """Return what is said of one customer."""
    problem = bench.problem
    return {
        "customer": problem.customer_at(bench.node).id,
        "cost": cost_reply(bench.plan.evaluation.cost),
        "here": _here(bench),
        "alternatives": [_alternative(bench, each) for each in alternatives],
        "binding": [_binding(bench, each) for each in binding],
        "reasons": [reason_reply(problem, reason) for reason in one_per_type(problem, reasons)],
    }


def nobody_reply(cost: Cost) -> Data:
    """Return the same where nobody is asked about."""
    return {"customer": None, "cost": cost_reply(cost), "here": None, "alternatives": [],
            "binding": [], "reasons": []}


def _difference(cost: Cost, less: Cost) -> dict[str, float]:
    before = cost_reply(less)
    return {term: value - before[term] for term, value in cost_reply(cost).items()}


def _here(bench: Bench) -> Data | None:
    if bench.found is None:
        return None
    saving = _difference(bench.plan.evaluation.cost, bench.left_out.evaluation.cost)
    saving["total"] -= saving["unassigned"]
    saving["unassigned"] = 0.0
    return _placed(bench, bench.plan, bench.found) | {"saving": saving}


def _alternative(bench: Bench, each: Alternative) -> Data:
    trial = each.trial
    placed = _placed(bench, trial, find_place(trial.solution, bench.node))
    if each.window is not None:
        placed["window"] = each.window
    return {
        "kind": each.kind,
        **placed,
        "cost": _difference(trial.evaluation.cost, bench.plan.evaluation.cost),
        "feasible": trial.evaluation.is_feasible,
        "reasons": [{"code": code, "message": message} for code, message in dict.fromkeys(
            (item.code, item.message) for item in _telling(trial.evaluation.violations))],
    }


def _telling(violations: Sequence[Violation]) -> Iterable[Violation]:
    """Return broken rules without those that follow from others.

    What differs from what has happened has times that nobody has computed.
    """
    frozen = any(item.code == "FROZEN" for item in violations)
    return [item for item in violations if not (frozen and item.code == "TIME_MISMATCH")]


def _placed(bench: Bench, trial: Trial, found: Found | None) -> Data:
    """Return who serves the customer where and when in a plan."""
    halt = halt_of(trial, bench.node)
    if found is None or halt is None:
        return {"vehicle": None, "by": None, "window": None, "position": None,
                "service_start": None}
    problem, place = bench.problem, found.place
    route = trial.solution.routes[found.route]
    stops = route.trips[place.trip].stops
    by_drone = place.by == "drone"
    return {
        "vehicle": vehicle_name(problem, route),
        "by": place.by,
        "window": window_of(problem.customer_at(bench.node), halt.service_start),
        "position": {
            "trip": place.trip,
            "own_trip": place.own_trip,
            "stop": place.stop,
            "after": _name(problem, stops[place.stop - (not by_drone)].node),
            "recovery_stop": place.recovery if by_drone else None,
            "recovered_at": _name(problem, stops[place.recovery].node) if by_drone else None,
        },
        "service_start": whole(halt.service_start),
    }


def _name(problem: Problem, node: int) -> str:
    if node < problem.num_depots:
        return problem.depots[node].id
    return problem.customer_at(node).id


def _binding(bench: Bench, each: Binding) -> Data:
    limit, problem = each.limit, bench.problem
    return {
        "rule": limit.field,
        "at": (problem.customer_at(bench.node).id if limit.kind is None
               else problem.vehicle_types[limit.kind].type_id),
        "slack": limit.slack,
        "unit": limit.unit,
        "saves_per_unit": each.saves_per_unit,
    }


def drones_reply(problem: Problem, solution: Solution, cost: Cost, sorties: Sequence[Worth],
                 searched: tuple[PlanResult, PlanResult] | None, seconds: float) -> Data:
    """Return what drones save; `searched` are plans with drones and of trucks alone."""
    saves = saves_at_most = None
    if searched is not None:
        flown, driven = searched
        if len(driven.solution.unassigned) <= len(flown.solution.unassigned):
            saves = driven.final_cost - flown.final_cost
        if len(driven.solution.unassigned) <= len(solution.unassigned):
            saves_at_most = driven.final_cost - cost.total
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
        "saves": each.saves,
        "tried": each.is_tried,
    }


def _searched(result: PlanResult) -> Data:
    return {"cost": cost_reply(result.evaluation.cost),
            "unassigned": len(result.solution.unassigned),
            "search_iterations": result.search_iterations}
