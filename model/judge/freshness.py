"""How long parcels are aboard before their customers are served."""

from model.problem import Problem
from model.solution import Stop, Trip, Visit


def first_departure(trip: Trip) -> int:
    """Return when truck or drone first leaves the depot."""
    take_offs = [sortie.launch_time for sortie in trip.sorties if sortie.launch_stop == 0]
    return min([trip.stops[0].departure, *take_offs])


def excess_aboard(problem: Problem, trip: Trip, halt: Stop | Visit) -> int:
    """Return by how much a customer's parcel is too long aboard."""
    limit = problem.customer_at(halt.node).max_time_aboard
    return 0 if limit is None else halt.service_start - first_departure(trip) - limit


def most_excess(problem: Problem, trip: Trip) -> int:
    """Return by how much a parcel is too long aboard at most; 0 if none is."""
    halts: list[Stop | Visit] = [
        *trip.stops[1:-1], *(visit for sortie in trip.sorties for visit in sortie.visits)]
    return max([0, *(excess_aboard(problem, trip, halt) for halt in halts)])
