"""The rest of a plan by the search, given how it begins: what a beginning is worth at best.

What is left is a problem of its own. The open vehicle becomes a type of one vehicle that begins at
the depot, where it is at once at the customer whom it serves first: a parcel of nothing at its
present place, within no time. Its own legs from the depot to all others are too long to be driven.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from model.engine.instance import Instance, pack
from model.problem import Customer, IntArray, Problem, Travel, VehicleType
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher, read_routes
from model.search.route.engine import ANY, anneal, leg_cost
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.problem_data import make_data
from model.simulation.actions import (
    DRIVE, NUM_KINDS, OPEN, RETURN, apply_route, encode_action, finish, reset,
)
from model.simulation.state import NO_VEHICLE, State, by_term
from model.solution import Route, Solution, Stop, Trip

HOT, COLD = 0.5, 0.05
"""First and last temperature by a leg's cost; the plan to begin with is fair already."""

FAR = 8
"""Times the longest leg that legs are which aren't driven."""

Routes = list[tuple[int, list[int]]]
"""Type of each vehicle and whom it serves, in order; the open vehicle's comes first."""


@dataclass(frozen=True)
class CompletionSetting:
    """A problem, packed alone."""

    problem: Problem
    instance: Instance

    @classmethod
    def of(cls, problem: Problem) -> "CompletionSetting":
        """Pack a problem."""
        return cls(problem, pack([problem]))


@dataclass(frozen=True)
class ProblemRest:
    """What is left of a problem after some actions."""

    problem: Problem
    nodes: IntArray  # of the whole problem
    kinds: tuple[int, ...]  # by type: that of the whole problem
    open_kind: int | None  # type of the vehicle under way, the first if there is one
    place: int  # where it is, a node of the whole


def can_complete(problem: Problem) -> bool:
    """Tell whether what is left of a problem is a problem of trucks that each make one trip."""
    return all(map(_is_plain, problem.vehicle_types)) and not problem.incompatible_goods and all(
        not customer.release_time and customer.max_time_aboard is None
        and not customer.setup_duration and not any(customer.pickup)
        for customer in problem.customers)


def _is_plain(kind: VehicleType) -> bool:
    rarer = (kind.speed_profile, kind.overtime, kind.max_stops, kind.start, kind.end,
             kind.max_working_duration)
    return (kind.drones is None and kind.max_trips == 1 and kind.cost_per_load_km == 0.0
            and kind.pickups == "any" and not kind.service_durations
            and all(value is None for value in rarer))


def state_after(setting: CompletionSetting, actions: IntArray) -> State:
    """Return the state after actions, in one row."""
    state = reset(setting.instance, np.zeros(1, np.int64))
    apply_all(setting.instance, state, 0, actions)
    return state


def apply_all(instance: Instance, state: State, r: int, actions: IntArray) -> None:
    """Let a row of a state take actions, one after another. In place."""
    done = 0
    while done < len(actions):
        done = apply_route(instance, state, r, actions, done)


def cost_of(setting: CompletionSetting, actions: IntArray) -> float:
    """Return what a whole plan costs."""
    state = state_after(setting, actions)
    finish(setting.instance, state, 0)
    return float(by_term(state.cost[:1]).sum())


def is_cut(actions: IntArray, length: int) -> bool:
    """Tell whether what follows the first actions is for the search to say: no vehicle is empty."""
    return length == 0 or actions[length - 1] % NUM_KINDS != OPEN


def what_is_left(setting: CompletionSetting, actions: IntArray) -> ProblemRest | None:
    """Return what is left after actions; None if nobody is, or no vehicle."""
    whole, state = setting.problem, state_after(setting, actions)
    first = whole.num_depots
    vehicle, used = state.under_way(0), state.used[0]
    left = np.flatnonzero(~state.served[0, first:whole.num_nodes]) + first
    plain = {index: replace(kind, count=kind.count - int(used[index]))
             for index, kind in enumerate(whole.vehicle_types) if kind.count > used[index]}
    is_open = vehicle.type != NO_VEHICLE
    if not len(left) or not (plain or is_open):
        return None
    types, kinds, places = list(plain.values()), list(plain), list[int]()
    travel, customers = list(whole.travel), [whole.customer_at(node) for node in left.tolist()]
    table = None if whole.may_serve is None else whole.may_serve[kinds][:, left - first]
    if is_open:
        places = [int(vehicle.node)]
        types.insert(0, _under_way(whole, vehicle, len(travel)))
        kinds.insert(0, int(vehicle.type))
        customers.insert(0, _here(whole, int(vehicle.service_end)))
        table = _table(whole, kinds, left - first)
    source = np.array([*range(first), *places, *left.tolist()])
    legs = [each.among(source) for each in travel]
    if is_open:
        own = legs[types[0].travel if types[0].travel < len(legs) else
                   whole.vehicle_types[kinds[0]].travel]
        legs.append(_from_here(own, types[0].depot, first))
    problem = replace(
        whole, customers=tuple(customers), vehicle_types=tuple(types), travel=tuple(legs),
        coordinates=whole.coordinates[source], may_serve=table)
    return ProblemRest(problem, source, tuple(kinds), 0 if is_open else None,
                       places[0] if places else 0)


def _under_way(whole: Problem, vehicle: np.record, travel: int) -> VehicleType:
    """Return the open vehicle as a type of its own, which begins where it is."""
    kind = whole.vehicle_types[vehicle.type]
    reach = kind.max_trip_distance
    return replace(
        kind, id="under way", count=1, numbers=(), fixed_cost=0.0, travel=travel,
        capacity=tuple(vehicle.load[:whole.num_dimensions].tolist()),
        earliest=int(vehicle.service_end),
        max_trip_distance=None if reach is None else reach - int(vehicle.distance))


def _here(whole: Problem, now: int) -> Customer:
    """Return whom the open vehicle serves first, in no time."""
    return Customer("here", (0,) * whole.num_dimensions, earliest=now, latest=now,
                    unassigned_cost=whole.unassigned_cost)


def _table(whole: Problem, kinds: Sequence[int], customers: IntArray) -> np.ndarray:
    """Return (type, customer) who may serve whom; the first of both belong together."""
    table = np.ones((len(kinds), 1 + len(customers)), np.bool_)
    if whole.may_serve is not None:
        table[:, 1:] = whole.may_serve[list(kinds)][:, customers]
    table[1:, 0] = False
    return table


def _from_here(own: Travel, depot: int, here: int) -> Travel:
    """Return the legs of the open vehicle, whose way from the depot leads to its place alone."""
    result = []
    for matrix in own.arrays():
        legs = matrix.copy()
        legs[depot, here + 1:] = FAR * int(matrix.max())
        legs[depot, here] = 0
        result.append(legs)
    return Travel(*result)


def complete(rest: ProblemRest, routes: Routes, turns: int, seed: int) -> Routes:
    """Return the search's routes for what is left.

    Parameters
    ----------
    rest
        Of a problem.
    routes
        To begin with, in nodes of the whole problem; who isn't served is inserted.
    turns
        Of the search.
    seed
        The same gives the same routes.
    """
    problem = rest.problem
    data = make_data(problem, pack([problem], legs=False))
    searcher = make_searcher(problem, data, _written(rest, routes), np.random.SeedSequence(seed))
    begin_anew(data, searcher, not routes)
    value = searcher.value
    leg, _ = leg_cost(data, searcher)
    value.temperature = HOT * leg
    value.cooling = (COLD / HOT) ** (1 / max(1, turns))
    anneal(data, searcher, turns, ANY)
    return _read(rest, data, searcher)


def _written(rest: ProblemRest, routes: Routes) -> Solution:
    """Return routes of the whole in the numbers of what is left, without times."""
    number = np.full(int(rest.nodes.max()) + 1, -1)
    first = rest.problem.num_depots
    number[rest.nodes[first:]] = np.arange(first, len(rest.nodes))
    used = dict.fromkeys(range(len(rest.kinds)), 0)
    result = []
    for index, (kind, customers) in enumerate(routes):
        here = number[customers].tolist()
        own = rest.kinds.index(kind, 0 if rest.open_kind is None else 1) if (
            rest.open_kind is None or index > 0) else 0
        if rest.open_kind is not None and index == 0:
            here = [first, *here]
        depot = rest.problem.vehicle_types[own].depot
        stops = tuple(Stop(node, 0, 0, 0) for node in (depot, *here, depot))
        result.append(Route(own, used[own], (Trip(stops),)))
        used[own] += 1
    return Solution(tuple(result), ())


def _read(rest: ProblemRest, data: ProblemData, searcher: Searcher) -> Routes:
    """Return the best routes, in nodes of the whole problem, the open vehicle's first."""
    opened, routes = Routes(), Routes()
    for route in read_routes(data, searcher):
        nodes = rest.nodes[[stop.node for trip in route.trips for stop in trip.customer_stops]]
        if route.vehicle_type == rest.open_kind:
            opened = [(rest.kinds[route.vehicle_type], nodes[nodes != rest.place].tolist())]
        else:
            routes.append((rest.kinds[route.vehicle_type], nodes.tolist()))
    if rest.open_kind is not None and not opened:
        opened = [(rest.kinds[rest.open_kind], [])]
    return opened + routes


def to_actions(problem: Problem, routes: Routes, is_open: bool) -> IntArray:
    """Return the actions of routes, of which the first goes on where a vehicle `is_open`."""
    codes = []
    for index, (kind, customers) in enumerate(routes):
        if index > 0 or not is_open:
            codes.append(encode_action(OPEN, kind))
        codes += [encode_action(DRIVE, node) for node in customers]
        codes.append(encode_action(RETURN, problem.vehicle_types[kind].depot))
    return np.array(codes, np.int64)


def to_routes(actions: IntArray, kind: int | None) -> Routes:
    """Return the routes that actions make; the first is a vehicle's of type `kind` if there is one.

    Raises
    ------
    ValueError
        If a drone flies.
    """
    routes: Routes = [] if kind is None else [(kind, [])]
    for code in actions.tolist():
        target, what = divmod(code, NUM_KINDS)
        if what == OPEN:
            routes.append((target, []))
        elif what == DRIVE:
            routes[-1][1].append(target)
        elif what != RETURN:
            raise ValueError(f"action: {code} is a flight")
    return routes


def open_type(actions: IntArray) -> int | None:
    """Return the type of the vehicle that is on its way after actions; None if there is none."""
    if not len(actions) or actions[-1] % NUM_KINDS == RETURN:
        return None
    opened = actions[actions % NUM_KINDS == OPEN]
    return int(opened[-1]) // NUM_KINDS

