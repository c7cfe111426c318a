"""The plan that a search begins with where none is given."""

from collections.abc import Sequence

from model.problem import Problem
from model.search.beginning.either_way import shortest_routes
from model.search.beginning.packing import packed_routes
from model.search.beginning.savings import by_nearest, cost_by_savings, savings_routes
from model.search.neighbourhood.numbering import Numbering
from model.search.route.layout import ProblemData, are_kept
from model.search.problem_data import are_alike, can_be_linked, from_one_place, may_be_turned
from model.solution import Route, Solution, Stop, Trip


def first_plan(problem: Problem, data: ProblemData,
               numbering: Numbering | None = None) -> Solution:
    """Return routes by savings where no vehicle flies drones, and there are no shipments.

    Where vehicles hold and cost the same, but begin and end at several places, and where all fly by
    themselves, customers are served from the nearest. Where they don't, but begin and end at one,
    by the type that serves all at the least cost, and who is left when all its vehicles drive by
    the next; if trips are several or time costs, insertion makes far better plans. What drones fly
    is up to `data`, in which they may be left aside; its numbers of nodes are those of a
    `numbering`, else the problem's. Routes have no times yet.
    """
    everyone = tuple(range(data.num_depots, data.num_nodes))
    if data.type["drones"][:data.num_types].any() or len(data.pair):
        return Solution((), everyone)
    all_fly = all(kind.flies for kind in problem.vehicle_types)
    if not are_alike(data) and not all_fly:
        joined = can_be_linked(data) and from_one_place(data)
        return Solution(tuple(_by_types(problem, data)) if joined else (), everyone)
    data = _without_goods(data)
    if data.num_types > 1:
        data = data._replace(can=by_nearest(data))
    routes: list[Route] = []
    for k in range(data.num_types):
        routes += _routes_of_type(problem, data, k, numbering, routes)
    return Solution(tuple(routes), everyone)


def _without_goods(data: ProblemData) -> ProblemData:
    """Return data in which nobody may serve who goes together with others."""
    kept = are_kept(data)
    return data._replace(can=data.can & ~kept) if kept.any() else data


def _by_types(problem: Problem, data: ProblemData) -> list[Route]:
    """Return routes by one type after another, what serves all at the least cost first."""
    can, routes = data.can.copy(), list[Route]()
    data = data._replace(can=can)
    for k in sorted(range(data.num_types), key=lambda k: cost_by_savings(data, k)):
        more = _routes_of_type(problem, data, k, None, routes)
        can[:, 0, [stop.node for route in more for stop in route.trips[0].stops]] = False
        routes += more
    return routes


def _routes_of_type(problem: Problem, data: ProblemData, k: int,
                    numbering: Numbering | None, beside: Sequence[Route]) -> list[Route]:
    """Return routes of a type, for as many vehicles as there are, those of most customers.

    Those `beside` take of batteries and places to charge.
    """
    kind = problem.vehicle_types[k]
    if kind.flies and (kind.max_trips > 1 or problem.limits_hubs):
        return packed_routes(problem, k, savings_routes(data, k),
                             None if numbering is None else numbering.node.tolist(), beside)
    join = shortest_routes if may_be_turned(data) else savings_routes
    longest = sorted(join(data, k), key=len, reverse=True)[:kind.count]
    return [Route(k, number, (Trip(tuple(Stop(node, 0, 0, 0) for node in (
        kind.begins_at, *customers, kind.ends_at))),)) for number, customers in enumerate(longest)]
