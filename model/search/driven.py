"""Routes timed as the search times them, with breaks and rests where it places them."""

from dataclasses import replace

from model.engine.instance import pack
from model.problem import Problem
from model.search.beginning.packing import timed
from model.search.neighbourhood.neighbourhood import make_neighbourhood
from model.search.problem_data import make_data
from model.solution import Route, Solution


def driven_by_search(problem: Problem, route: Route) -> Route | None:
    """Return a route without times with those by which it costs least, as far as the search finds.

    None if it finds none.
    """
    instance = pack([problem], False)
    neighbourhood = make_neighbourhood(problem, instance)
    data = make_data(problem, instance, neighbourhood=neighbourhood)
    found = timed(problem, data, neighbourhood.numbering,
                  Solution((replace(route, vehicle=0),), problem.left_out(route.served)))
    if len(found.routes) != 1 or _places(found.routes[0]) != _places(route):
        return None
    return replace(found.routes[0], vehicle=route.vehicle)


def _places(route: Route) -> list[list[int]]:
    return [[stop.node for stop in trip.stops] for trip in route.trips]
