"""How long parcels are aboard before their customers are served."""

from model.judge.pairs import times_between
from model.problem import Problem, VehicleType
from model.solution import Stop, Trip, Visit


def first_departure(kind: VehicleType, trip: Trip) -> int:
    """Return when truck or drone first leaves the depot; by itself, when its launch begins."""
    if kind.flies:
        return trip.stops[0].departure - kind.launch_duration
    take_offs = [sortie.launch_time for sortie in trip.sorties if sortie.launch_stop == 0]
    return min([trip.stops[0].departure, *take_offs])


def excess_aboard(problem: Problem, kind: VehicleType, trip: Trip, visit: Stop | Visit) -> int:
    """Return by how much a customer's parcel is too long aboard."""
    limit = problem.customer_at(visit.node).max_time_aboard
    return 0 if limit is None else visit.service_start - first_departure(kind, trip) - limit


def most_excess(problem: Problem, kind: VehicleType, trip: Trip) -> int:
    """Return by how much a parcel is too long aboard at most; 0 if none is."""
    return max([0, *(excess_aboard(problem, kind, trip, visit) for visit in trip.visits),
                *(excess for _, _, excess in times_between(problem, kind, trip))])
