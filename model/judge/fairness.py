"""What a plan costs as a whole: its end, how unequal its vehicles' work is, and too few of them."""

from collections.abc import Sequence

from model.judge.metrics import RouteMetrics
from model.problem import MM_PER_KM, MS_PER_HOUR, Fairness, Measure, Problem
from model.solution import Cost, Route


def fairness_cost(problem: Problem, routes: Sequence[tuple[Route, RouteMetrics]],
                  makespan: int) -> Cost:
    """Return what a plan costs as a whole, by its routes and its last return."""
    fairness = problem.fairness
    last, used = max(makespan, fairness.last_end), len(_shares(problem, "stops", routes))
    return Cost(makespan=last / MS_PER_HOUR * fairness.makespan_cost_per_hour,
                balance=_balance_cost(problem, fairness, routes),
                too_few_vehicles=fairness.too_few_cost * vehicles_lacking(problem, used))


def vehicles_lacking(problem: Problem, used: int) -> int:
    """Return how many vehicles fewer are used than are to be."""
    return max(0, problem.fairness.min_vehicles - used)


def _balance_cost(problem: Problem, fairness: Fairness,
                  routes: Sequence[tuple[Route, RouteMetrics]]) -> float:
    if fairness.balance is None:
        return 0.0
    measure = fairness.balance.measure
    shares = _shares(problem, measure, routes)
    mean = sum(shares) / len(shares) if shares else 0.0
    if mean == 0.0:
        return 0.0
    unit = {"duration": MS_PER_HOUR, "stops": 1, "load": 10**problem.amount_decimals[0],
            "distance": MM_PER_KM}[measure]
    return fairness.balance.cost * sum([(share - mean) ** 2 for share in shares]) / mean / unit


def _shares(problem: Problem, measure: Measure,
            routes: Sequence[tuple[Route, RouteMetrics]]) -> list[int]:
    """Return the share of each vehicle used, with what it had done before."""
    before = problem.fairness.before
    shares = [each.share for each in before]
    number = {kind: index for index, each in enumerate(before) for kind in each.kinds}
    for route, metrics in routes:
        share = share_of(problem, measure, route, metrics)
        if route.vehicle_type in number:
            shares[number[route.vehicle_type]] += share
        else:
            shares.append(share)
    return shares


def share_of(problem: Problem, measure: Measure, route: Route, metrics: RouteMetrics) -> int:
    """Return what a route is of the work, in ms, stops, parts or mm."""
    if measure == "duration":
        return metrics.working_duration
    if measure == "distance":
        return sum([trip.distance for trip in metrics.trips])
    if measure == "stops":
        return sum([len(trip.customer_stops) for trip in route.trips])
    customers = [problem.customer_at(node) for node in route.served]
    return sum([customer.demand[0] + customer.taken_in[0] for customer in customers])
