"""What changes from an earlier plan: orders that move, and times that were promised."""

from bisect import bisect_left
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from model.problem import MS_PER_HOUR, Problem
from model.solution import Route, Solution


@dataclass(frozen=True)
class ChangePrices:
    """Money for each change of a plan gone on from."""

    vehicle: float = 0.0  # an order served by another vehicle
    position: float = 0.0  # an order of the same vehicle at another place of its route
    promise_per_minute: float = 0.0  # by which an order is reached sooner or later than promised

    @property
    def by_place(self) -> bool:
        """Whether it counts where in a route an order is, or when."""
        return bool(self.position or self.promise_per_minute)


class OrderPlace(NamedTuple):
    """Where an order is in a plan."""

    vehicle: tuple[int, int]  # type, number
    position: int  # in the vehicle's day
    is_flown: bool
    arrival: int  # ms


@dataclass(frozen=True)
class EarlierPlan:
    """What changes are counted from, by the first place of each order."""

    prices: ChangePrices
    places: Mapping[int, OrderPlace]
    promised: Mapping[int, int] = field(default_factory=dict)  # ms


class PlanChanges(NamedTuple):
    """How much of a plan changed."""

    vehicle: int  # orders with another vehicle
    position: int  # orders that changed places, the fewest that tell the new order
    promised: int  # ms, sum over orders

    def cost(self, prices: ChangePrices) -> float:
        """Return what the changes cost."""
        return (self.vehicle * prices.vehicle + self.position * prices.position
                + self.promised * 60 / MS_PER_HOUR * prices.promise_per_minute)


def earlier_plan(problem: Problem, plan: Solution, prices: ChangePrices,
                 promised: Mapping[int, int], gone: Collection[tuple[int, int]]) -> EarlierPlan:
    """Return what changes are counted from.

    Parameters
    ----------
    problem
        Customers of the plan who aren't in it have negative nodes: they don't count.
    plan
        The plan gone on from.
    prices
        What changes cost.
    promised
        When customers, by node, were told that they are reached, in ms; others by the plan.
    gone
        Vehicles that do nothing more: whoever takes over from them doesn't count as moved.
    """
    places = _places(problem, plan)
    times = {node: place.arrival for node, place in places.items()} | {
        problem.first_place(node): at for node, at in promised.items()}
    return EarlierPlan(prices, {node: place for node, place in places.items()
                           if place.vehicle not in gone}, times)


def count_changes(problem: Problem, plan: Solution, earlier: EarlierPlan) -> PlanChanges:
    """Return how much changed; who is left out doesn't count."""
    now = _places(problem, plan)
    moved, stayed = 0, defaultdict[tuple[int, int], list[int]](list)
    switched = 0
    for node, place in sorted(now.items(), key=lambda item: item[1].position):
        was = earlier.places.get(node)
        if was is None:
            continue
        if was.vehicle != place.vehicle:
            moved += 1
        elif was.is_flown != place.is_flown:
            switched += 1
        else:
            stayed[place.vehicle].append(was.position)
    late = sum([abs(place.arrival - earlier.promised[node])
                for node, place in now.items() if node in earlier.promised])
    return PlanChanges(moved, switched + sum(map(_out_of_order, stayed.values())), late)


def _out_of_order(positions: list[int]) -> int:
    """Return how many of some numbers have to go until the others ascend."""
    ends: list[int] = []  # by length: the least last number of an ascending row
    for position in positions:
        at = bisect_left(ends, position)
        ends[at:at + 1] = [position]
    return len(positions) - len(ends)


def _places(problem: Problem, plan: Solution) -> dict[int, OrderPlace]:
    places = {}
    for route in plan.routes:
        vehicle = route.driven_by
        for position, (node, is_flown, arrival) in enumerate(_in_order(route)):
            if node >= problem.num_depots:
                places[problem.first_place(node)] = OrderPlace(vehicle, position, is_flown, arrival)
    return places


def _in_order(route: Route) -> Iterator[tuple[int, bool, int]]:
    """Yield whom a vehicle serves in the order of its stops, flights by where they begin."""
    for trip in route.trips:
        for index, stop in enumerate(trip.stops):
            if 0 < index < len(trip.stops) - 1 and not stop.is_launch_site:
                yield stop.node, False, stop.arrival
            for sortie in trip.sorties:
                if sortie.launch_stop == index:
                    for visit in sortie.visits:
                        yield visit.node, True, visit.arrival
