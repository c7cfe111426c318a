"""The plan that a search begins with where none is given."""

from model.problem import Problem
from model.search.beginning.either_way import shortest_routes
from model.search.beginning.savings import by_nearest, savings_routes
from model.search.route.layout import World
from model.search.world import are_alike, may_be_turned
from model.solution import Route, Solution, Stop, Trip


def first_plan(problem: Problem, world: World) -> Solution:
    """Return routes by savings where no vehicle flies drones and all hold and cost the same.

    Where they begin and end at several places, customers are served from the nearest. What flies is
    up to `world`, in which drones may be left aside. Routes have no times yet.
    """
    everyone = tuple(range(world.num_depots, world.num_nodes))
    if world.type["drones"][:world.num_types].any() or not are_alike(world):
        return Solution((), everyone)
    join = shortest_routes if may_be_turned(world) else savings_routes
    if world.num_types > 1:
        world = world._replace(can=by_nearest(world))
    return Solution(tuple(
        Route(k, number, (Trip(tuple(Stop(node, 0, 0, 0) for node in (
            kind.begins_at, *customers, kind.ends_at))),))
        for k, kind in enumerate(problem.vehicle_types)
        for number, customers in enumerate(
            sorted(join(world, k), key=len, reverse=True)[:kind.count])), everyone)
