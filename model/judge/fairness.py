"""What a plan costs as a whole: its end, how unequal its vehicles' work is, and too few of them."""

from collections.abc import Sequence

from model.judge.metrics import RouteMetrics
from model.problem import MM_PER_KM, MS_PER_HOUR, Fairness, Measure, Problem
from model.solution import Cost, Route


def fairness_cost(problem: Problem, routes: Sequence[tuple[Route, RouteMetrics]],
                  makespan: int) -> Cost:
    """Return what a plan costs as a whole, by its routes and its last return."""
    fairness = problem.fairness
    return Cost(makespan=makespan / MS_PER_HOUR * fairness.makespan_cost_per_hour,
                balance=_balance_cost(problem, fairness, routes),
                too_few_vehicles=fairness.too_few_cost * vehicles_lacking(problem, len(routes)))


def vehicles_lacking(problem: Problem, used: int) -> int:
    """Return how many vehicles fewer are used than are to be."""
    return max(0, problem.fairness.min_vehicles - used)


def _balance_cost(problem: Problem, fairness: Fairness,
                  routes: Sequence[tuple[Route, RouteMetrics]]) -> float:
    if fairness.balance is None:
        return 0.0
    shares = [_share(problem, fairness.balance.measure, *each) for each in routes]
    mean = sum(shares) / len(shares) if shares else 0.0
    if mean == 0.0:
        return 0.0
    return fairness.balance.cost * sum([(share - mean) ** 2 for share in shares]) / mean


def _share(problem: Problem, measure: Measure, route: Route, metrics: RouteMetrics) -> float:
    """Return a vehicle's share of the work, in hours, stops, units or km."""
    if measure == "duration":
        return metrics.working_duration / MS_PER_HOUR
    if measure == "distance":
        return sum([trip.distance for trip in metrics.trips]) / MM_PER_KM
    if measure == "stops":
        return float(sum([len(trip.customer_stops) for trip in route.trips]))
    nodes = [stop.node for trip in route.trips for stop in trip.customer_stops]
    nodes += [visit.node for trip in route.trips for sortie in trip.sorties
              for visit in sortie.visits]
    customers = [problem.customer_at(node) for node in nodes]
    amount = sum([customer.demand[0] + customer.taken_in[0] for customer in customers])
    return amount / 10**problem.amount_decimals[0]
