"""Why a truck can't serve a customer whom it would serve best on its way through others.

Where legs are shorter by way of others, what keeps a truck from going there and straight back says
little: the shortest ways through others are tried instead.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product
from typing import NamedTuple

import numpy as np

from model.counsel.diagnosis import up_to_tenth
from model.counsel.remedy import in_minutes
from model.counsel.route_limits import ROUTE_LIMITS, too_much
from model.judge.clock import MS_PER_MINUTE
from model.judge.metrics import allowed_overtime
from model.judge.network import NEVER, Network, network_of
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import TimedRoute, time_route
from model.judge.timing import RouteDecision, TripDecision
from model.problem import UNLIMITED, BoolArray, Depot, Problem, VehicleType
from model.problem.limits import LIMITS

MOST_CUSTOMERS = 250
"""Among so many customers ways through others are looked for."""

MOST_NAMES = 5
"""So many customers on a way are named."""

BY_LEGS = frozenset({"TIME_WINDOW", "TIME_ABOARD", "SHIFT", *ROUTE_LIMITS})
"""Rules that shorter legs may keep."""


class Lacking(NamedTuple):
    """What a trip through others lacks, and the type of vehicle that wouldn't lack it."""

    code: str
    words: str  # what happens
    changed: VehicleType


@dataclass(frozen=True)
class Passage:
    """A trip that serves a customer and others on its way."""

    timed: TimedRoute
    others: tuple[int, ...]  # nodes, in order
    lacks: Lacking | None  # None: nothing


def passage_to(problem: Problem, kind: int, node: int) -> Passage | None:
    """Return the best trip found to a customer through others.

    None if none keeps the rules, or would if one of them were a little less strict, or the way
    straight there and back is shortest.
    """
    net = _network(problem, kind)
    if net is None or node not in net.nodes:
        return None
    place = int(np.flatnonzero(net.nodes == node)[0])
    best: Passage | None = None
    tried: set[tuple[int, ...]] = {(place,)}
    for between in _ways(net, place):
        if between in tried:
            continue
        tried.add(between)
        nodes = tuple([int(net.nodes[each]) for each in between])
        found = _tried(problem, kind, node, nodes)
        if found is not None and found.lacks is None:
            return found
        if found is not None and (best is None or _rank(found) < _rank(best)):
            best = found
    return best


@lru_cache(maxsize=8)
def _network(problem: Problem, kind: int) -> Network | None:
    """Return the network among all customers; None if they are many, or legs are straight."""
    travel = problem.travel[problem.vehicle_types[kind].travel]
    if travel.straight is not None or problem.num_customers > MOST_CUSTOMERS:
        return None
    return network_of(problem, kind, np.arange(problem.num_depots, problem.num_nodes))


def _ways(net: Network, place: int) -> Iterator[tuple[int, ...]]:
    """Yield places in order: shortest ways there and back through others, in time or distance."""
    for in_time in (True, False):
        outward, homeward = (_path(_tree(net, in_time, back), place) for back in (False, True))
        there, home = outward[::-1], homeward
        for before, behind in product((there, ()), (home, ())):
            yield (*before, place, *[each for each in behind if each not in before])
        if not set(there).isdisjoint(home):
            # One of both ways goes elsewhere, so that nobody is served twice.
            yield (*there, place, *_path(_tree_without(net, in_time, True, there), place))
            yield (*_path(_tree_without(net, in_time, False, home), place)[::-1], place, *home)


class _Tree(NamedTuple):
    """Shortest ways between one place and all others."""

    root: int
    towards: list[int]  # (place,) the next one on its way to the root


def _path(tree: _Tree, place: int) -> tuple[int, ...]:
    """Return the places between one and the root of a tree, without these."""
    places, at = [], tree.towards[place]
    while at != tree.root:
        places.append(at)
        at = tree.towards[at]
    return tuple(places)


@lru_cache(maxsize=16)
def _tree(net: Network, in_time: bool, back: bool) -> _Tree:
    return _tree_without(net, in_time, back, ())


def _tree_without(net: Network, in_time: bool, back: bool, barred: Sequence[int]) -> _Tree:
    """Return ways from where the first trip begins, or `back` to where the last ends.

    They don't go through some places that are `barred`.
    """
    legs = net.ride if in_time else net.far
    stay = net.stay if in_time else np.zeros_like(net.stay)
    legs, root = (legs.T, net.end) if back else (legs, net.begin)
    through: BoolArray = np.arange(len(net.nodes)) >= net.num_depots
    through[[*barred]] = False
    length, towards = legs[root].copy(), np.full(len(legs), root)
    while True:
        ways = np.where(through, length + stay, NEVER)[:, None] + legs
        nearest = ways.argmin(axis=0)
        shorter = ways[nearest, np.arange(len(legs))]
        better = shorter < length
        better[root] = False
        if not better.any():
            return _Tree(root, towards.tolist())
        length, towards = np.where(better, shorter, length), np.where(better, nearest, towards)


def _tried(problem: Problem, kind: int, node: int, nodes: tuple[int, ...]) -> Passage | None:
    """Return a trip to some customers, if it keeps the rules or all but one."""
    vehicles = problem.vehicle_types[kind]
    decision = RouteDecision(kind, 0, (TripDecision((vehicles.begins_at, *nodes,
                                                     vehicles.ends_at)),))
    timed = time_route(problem, decision, "", EVERYTHING_OPEN)
    others = tuple([each for each in nodes if each != node])
    if not timed.judged.violations:
        return Passage(timed, others, None)
    lacks = _lacking(problem.depots[vehicles.ends_at], vehicles, timed)
    if lacks is None:
        return None
    types = [*problem.vehicle_types]
    types[kind] = lacks.changed
    depots = tuple([replace(each, latest=UNLIMITED) for each in problem.depots])
    changed = replace(problem, vehicle_types=tuple(types),
                      depots=depots if lacks.code == "SHIFT" else problem.depots)
    again = time_route(changed, decision, "", EVERYTHING_OPEN)
    return None if again.judged.violations else Passage(again, others, lacks)


def _lacking(end: Depot, vehicles: VehicleType, timed: TimedRoute) -> Lacking | None:
    """Say what a trip that breaks one rule lacks; None if it breaks another one."""
    codes = {each.code for each in timed.judged.violations}
    most = min(end.latest, vehicles.latest + allowed_overtime(vehicles))
    if codes == {"SHIFT"} and timed.judged.end <= most:
        return None
    if codes == {"SHIFT"} and end.latest <= vehicles.latest + allowed_overtime(vehicles):
        late = up_to_tenth(timed.judged.end - end.latest, MS_PER_MINUTE)
        return Lacking("SHIFT", f"would be back {in_minutes(late)} after {end.id} closes",
                       replace(vehicles, latest=min(end.latest + late, UNLIMITED)))
    if codes == {"SHIFT"} and vehicles.overtime is not None:
        over = vehicles.overtime.max_duration
        late = up_to_tenth(timed.judged.end - vehicles.latest - over, MS_PER_MINUTE)
        return Lacking("SHIFT", f"would be back {in_minutes(late)} after its shift and all the "
                       "overtime allowed", LIMITS["overtime"].raised(vehicles, late))
    if codes == {"SHIFT"}:
        late = up_to_tenth(timed.judged.end - vehicles.latest, MS_PER_MINUTE)
        return Lacking("SHIFT", f"would be back {in_minutes(late)} after its shift ends",
                       LIMITS["shift"].raised(vehicles, late))
    code, = codes if len(codes) == 1 else ("",)
    if code not in ROUTE_LIMITS or (code == "WORKING_DURATION" and vehicles.overtime is not None):
        return None
    found = too_much(code, vehicles, timed.route, timed.judged.metrics)
    return Lacking(found.limit.code, found.limit.through.format(more=found.more), found.changed)


def _rank(passage: Passage) -> tuple[int, float]:
    """Return what is smaller for a better trip: the route takes less time, or costs less."""
    judged = passage.timed.judged
    return judged.metrics.working_duration, judged.cost.total


def names_of(problem: Problem, nodes: Sequence[int]) -> str:
    """Return customers' ids as a list in words, the first ones of many."""
    names = [problem.customer_at(node).id for node in nodes[:MOST_NAMES]]
    if len(nodes) > MOST_NAMES:
        names[-1] = f"{len(nodes) - MOST_NAMES + 1} others"
    return " and ".join([", ".join(names[:-1]), names[-1]]) if len(names) > 1 else names[0]

