"""Plans sent without times, timed as the judge finds best."""

from dataclasses import replace

from app.plans.task import Task
from app.requests.conversion.units import optional_thousandths
from app.requests.plan_reading import read_plan
from app.schemas.untimed import UntimedPlanInput, UntimedRouteInput
from model.judge.check import judge_route
from model.judge.placing import is_exact
from model.judge.retiming import TimedRoute, read_route, time_route
from model.problem import Problem
from model.search.driven import driven_by_search
from model.solution import Route, Solution

MOST_CUSTOMERS = 2000
"""Customers of a problem up to which breaks and rests are placed by the search, too."""


def timed_plan(task: Task, plan: UntimedPlanInput, path: tuple[str | int, ...]) -> Solution:
    """Return a plan for a task; routes that leave out times have them all made.

    Those that can't be read stay without. `path` is where the plan is in the request.

    Raises
    ------
    InvalidRequestError
        If it names what the problem doesn't have.
    NoRoadsError
        If the roads don't tell its legs.
    """
    solution = read_plan(plan, task.problem, path)
    task.learn_legs(solution)
    return replace(solution, routes=tuple([
        _timed(task, route, stated, f"routes[{index}]") if stated.is_untimed else route
        for index, (route, stated) in enumerate(zip(solution.routes, plan.routes, strict=True))]))


def _timed(task: Task, route: Route, stated: UntimedRouteInput, path: str) -> Route:
    problem, past = task.judged_problem, task.setting.past
    if not judge_route(problem, route, path, past).metrics.trips:
        return route
    decision = read_route(problem, route)
    trips = tuple([
        replace(trip, operations=None, start=optional_thousandths(start))
        for trip, start in zip(decision.trips, stated.starts, strict=True)])
    timed = time_route(problem, replace(decision, trips=trips), path, past)
    if task.replanning is not None or any(trip.start is not None for trip in trips) or not (
            _may_rest_otherwise(problem, timed)):
        return timed.route
    driven = driven_by_search(problem, timed.route)
    if driven is None or judge_route(problem, driven, path, past).violations:
        return timed.route
    return driven


def _may_rest_otherwise(problem: Problem, timed: TimedRoute) -> bool:
    """Tell whether a route that breaks rules may not by other breaks and rests."""
    kind = problem.vehicle_types[timed.route.vehicle_type]
    return (bool(timed.judged.violations) and bool(kind.breaks or kind.driving)
            and not is_exact(problem, timed.route) and not problem.lags_across
            and problem.num_customers <= MOST_CUSTOMERS)
