"""What a reply says of the plan that was given: what is settled, excused, and where parcels are."""

from collections.abc import Collection

from app.plans.replies import Data, vehicle_name
from model.judge.rules import Violation
from model.problem import Problem
from model.replanning.kept import Kept
from model.replanning.replan import Replanning
from model.solution import Route, Solution


def violation_reply(violation: Violation, problem_path: str, plan_path: str) -> Data:
    """Return a broken rule and where, the problem and the plan being at these paths."""
    root = problem_path if violation.path.startswith("customers[") else plan_path
    return {"code": violation.code, "path": f"{root}.{on_the_wire(violation.path)}",
            "message": violation.message}


def on_the_wire(path: str) -> str:
    """Return the checker's path with the names of fields as requests and replies have them."""
    return path.replace(".visits[", ".customers[")


def replan_reply(problem: Problem, replanning: Replanning, solution: Solution,
                 doubtful: Collection[str] = ()) -> Data:
    """Return what the reply to a plan says of the one that was given.

    `doubtful` are customers of whom nobody told whether they were served.
    """
    parcels, changes = _parcels(problem, replanning, solution), replanning.changes(solution)
    settled = {problem.customer_at(problem.first_place(node)).id
               for kept in replanning.kept for node in kept.served} if doubtful else set()
    held = [name for name in dict.fromkeys(doubtful) if name in settled]
    return {
        "settled": [{"vehicle": vehicle_name(problem, kept.route),
                     "trip": len(kept.route.trips) - 1,
                     "stop": _last_settled(problem, kept)}
                    for kept in replanning.kept],
        "excused": [violation_reply(violation, "$", "$") for violation in replanning.excused],
        **({"parcels": parcels} if parcels else {}),
        **({"doubtful": held} if held else {}),
        **({} if changes is None else {"changes": {
            "vehicle": changes.vehicle, "position": changes.position,
            "promise": changes.promised / 1000}}),
    }


def _parcels(problem: Problem, replanning: Replanning, solution: Solution) -> list[Data]:
    """Return whose parcels are aboard vehicles that do nothing more, and who loads them where."""
    loading = {problem.first_place(node): (route, trip) for route in solution.routes
               for trip in route.trips for node in trip.served}
    told = []
    for node, vehicle in replanning.stranded.items():
        own = problem.first_place(node)
        route, trip = loading.get(own, (None, None))
        told.append({
            "id": problem.customer_at(own).id,
            "vehicle": vehicle_name(problem, Route(*vehicle, ())),
            "back": replanning.past.returned[node] / 1000,
            "depot": None if trip is None else problem.depots[trip.stops[0].node].id,
            "by": None if route is None else vehicle_name(problem, route)})
    return told


def _last_settled(problem: Problem, kept: Kept) -> int:
    """Return the last stop of a vehicle's trip that stays, of those that a reply shows."""
    stops = kept.route.trips[-1].stops
    last = len(stops) - 1
    return last if kept.way_on is None and not problem.is_nowhere(stops[last].node) else last - 1
