"""Which routes belong to which region: borders that no two rounds share."""

from collections.abc import Iterator, Sequence
from itertools import islice

import numpy as np

from model.problem import FloatArray, IntArray, Problem
from model.search.regions.region import Region
from model.solution import Solution, Vehicle

ROWS = 1024
"""For how many customers left out the nearest route is looked for together."""


def divide(problem: Problem, plan: Solution, count: int,
           rng: np.random.Generator) -> tuple[Region, ...]:
    """Return up to `count` regions of about as many customers, which share the whole plan.

    Each route is in one region. Who is left out belongs where the nearest route is, and vehicles
    without a route are dealt out anew each time, the first to where most are left out.
    """
    customers = [route.served for route in plan.routes]
    weight = np.array([len(each) for each in customers])
    count = min(count, int(np.count_nonzero(weight)))
    if count == 0:
        return ()
    place = problem.coordinates
    centre = np.array([place[each].mean(axis=0) if each else place[0] for each in customers])
    owner = np.empty(len(centre), np.int64)
    for number, members in enumerate(_split(_seen(centre, place[0], rng), weight,
                                            np.arange(len(centre)), count)):
        owner[members] = number
    heirs = owner[_nearest(place[list(plan.unassigned)], centre)]
    left_out: list[list[int]] = [[] for _ in range(count)]
    heir_of = dict(zip(plan.unassigned, heirs.tolist(), strict=True))
    for each in problem.shipments:
        if each.pickup in heir_of:
            heir_of |= dict.fromkeys(each.nodes, heir_of[each.pickup])
    _gather_related(problem, plan, owner, heir_of)
    for node, heir in heir_of.items():
        left_out[heir].append(node)
    size = np.bincount(owner, weight, minlength=count) + [len(each) for each in left_out]
    spare = _dealt(problem, plan, size.astype(np.int64), [len(each) for each in left_out], rng)
    return tuple(
        Region(Solution(tuple(plan.routes[index] for index in np.flatnonzero(owner == number)),
                        tuple(left_out[number])), tuple(spare[number]))
        for number in range(count) if size[number])


def _gather_related(problem: Problem, plan: Solution, owner: IntArray,
                    heir_of: dict[int, int]) -> None:
    """Let who is left out be in the region of those with whom they go. In place."""
    if not problem.keeps_together:
        return
    region = {node: int(owner[index]) for index, route in enumerate(plan.routes)
              for node in route.served}
    for each in problem.relations:
        if each.keeps_together:
            served = [region[node] for node in each.nodes if node in region]
            left = [node for node in each.nodes if node in heir_of]
            for node in left:
                heir_of[node] = served[0] if served else heir_of[left[0]]


def _seen(centre: FloatArray, depot: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Return (route, 2) places turned at random, or angle and distance from the first depot."""
    angle = rng.uniform(0, 2 * np.pi)
    if rng.random() < 0.5:
        sine, cosine = np.sin(angle), np.cos(angle)
        return centre @ np.array([[cosine, -sine], [sine, cosine]])
    east, north = (centre - depot).T
    far = np.hypot(east, north)
    turned: FloatArray = (np.arctan2(north, east) - angle) % (2 * np.pi)
    # As long as they are there where most routes are.
    return np.stack([turned * np.median(far), far], axis=1)


def _split(seen: FloatArray, weight: IntArray, members: IntArray, count: int) -> Iterator[IntArray]:
    """Yield `count` groups of routes, as compact and as equal as one cut after another has them."""
    if count == 1:
        yield members
        return
    spread = seen[members].max(axis=0) - seen[members].min(axis=0)
    order = members[np.argsort(seen[members, int(spread[1] > spread[0])], kind="stable")]
    few = count // 2
    middle = np.cumsum(weight[order]) - weight[order] / 2
    cut = int(np.searchsorted(middle, weight[order].sum() * few / count))
    cut = min(max(cut, few), len(order) - (count - few))
    yield from _split(seen, weight, order[:cut], few)
    yield from _split(seen, weight, order[cut:], count - few)


def _nearest(places: FloatArray, centre: FloatArray) -> IntArray:
    """Return the route whose centre is nearest to each place."""
    found = [np.zeros(0, np.int64)]
    for begin in range(0, len(places), ROWS):
        apart = places[begin:begin + ROWS, None] - centre
        found.append((apart ** 2).sum(axis=2).argmin(axis=1))
    return np.concatenate(found)


def _dealt(problem: Problem, plan: Solution, size: IntArray, left_out: Sequence[int],
           rng: np.random.Generator) -> list[list[Vehicle]]:
    """Return the vehicles without a route of each region, no more than it has customers."""
    used = {route.driven_by for route in plan.routes}
    order = sorted(rng.permutation(len(size)).tolist(), key=lambda number: -left_out[number])
    dealt: list[list[Vehicle]] = [[] for _ in size]
    for kind, vehicle_type in enumerate(problem.vehicle_types):
        free = (Vehicle(kind, number) for number in range(vehicle_type.count)
                if (kind, number) not in used)
        for index, vehicle in enumerate(islice(free, int(size.max()) * len(size))):
            region = order[index % len(order)]
            if index // len(order) < size[region]:
                dealt[region].append(vehicle)
    return dealt
