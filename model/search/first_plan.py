"""The plan that a search begins with where none is given."""

from model.problem import Problem
from model.search.beginning.either_way import shortest_routes
from model.search.beginning.savings import savings_routes
from model.search.route.layout import World
from model.search.world import may_be_turned
from model.solution import Route, Solution, Stop, Trip


def first_plan(problem: Problem, world: World) -> Solution:
    """Return routes by savings where all vehicles are alike, none flies drones; else none.

    What flies is up to `world`, in which drones may be left aside. Routes have no times yet.
    """
    everyone = tuple(range(world.num_depots, world.num_nodes))
    if world.num_types > 1 or world.type[0].drones > 0:
        return Solution((), everyone)
    kind, = problem.vehicle_types
    start, end = kind.begins_at, kind.ends_at
    join = shortest_routes if may_be_turned(world) else savings_routes
    routes = sorted(join(world, 0), key=len, reverse=True)[: kind.count]
    return Solution(tuple(
        Route(0, number, (Trip(tuple(Stop(node, 0, 0, 0) for node in (start, *customers, end))),))
        for number, customers in enumerate(routes)), everyone)
