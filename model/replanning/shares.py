"""What vehicles under way have done of the work, where it is to be shared fairly."""

from collections.abc import Mapping
from dataclasses import replace

from model.judge.check import judge_route
from model.judge.fairness import share_of
from model.judge.past import Past
from model.problem import Before, Fairness, Measure, Problem
from model.replanning.kept import Kept
from model.replanning.workers import VehicleWorker
from model.solution import Vehicle


def fairness_left(problem: Problem, past: Past, kept: Mapping[Vehicle, Kept],
                  owners: Mapping[int, VehicleWorker]) -> Fairness:
    """Return prices of what is left of a plan as a whole, beside what has been done.

    `owners` are the types that are one vehicle, by their index.
    """
    fairness = problem.fairness
    if not fairness.is_stated:
        return fairness
    measure: Measure = "stops" if fairness.balance is None else fairness.balance.measure
    kinds = {vehicle: frozenset(kind for kind, own in owners.items() if own.vehicle == vehicle)
             for vehicle in kept}
    going_on = {own.vehicle for own in owners.values() if own.is_under_way}
    before = [Before(kinds[vehicle], _done(problem, past, route, measure, vehicle in going_on))
              for vehicle, route in kept.items()]
    ends = [route.end for vehicle, route in kept.items() if vehicle not in going_on]
    return replace(fairness, before=tuple(before), last_end=max(ends, default=0))


def _done(problem: Problem, past: Past, own: Kept, measure: Measure, goes_on: bool) -> int:
    """Return a vehicle's share so far, without the way home if it goes on with its trip."""
    share = share_of(problem, measure, own.route, judge_route(problem, own.route, "", past).metrics)
    if not goes_on or own.way_on is None:
        return share
    if measure == "duration":
        return share - max(0, own.end - own.way_on.ready)
    if measure == "distance":
        kind = problem.vehicle_types[own.vehicle.type]
        home = own.decision.trips[-1].nodes[-2:]
        return share - problem.travel[kind.travel].distance.item(*home)
    return share
