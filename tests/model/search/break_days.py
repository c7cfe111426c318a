"""Compares the search with all ways to drive small days with breaks: `python -m
tests.model.search.break_days`.

One truck, one to three customers or two shipments, one or two breaks; all in whole minutes.
Orders, places of breaks and departures are enumerated by a clock of its own, and what is found
cheapest is judged. With `--orders`, the judge's times of each order are compared.

On 29 November 2026, 2,000 days from seed 10000 and 1,000 with `--soft` from seed 3000 had 11,925
orders that can be driven: none is refused, none dearer.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations, combinations_with_replacement, pairwise, permutations, product
from typing import Annotated, Any

import numpy as np
import typer

from model.engine.instance import pack
from model.judge.breaks import BreakDecision
from model.judge.check import check
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import time_route
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import Break, Customer, Depot, Problem, Relation, Shipment, Travel, VehicleType
from model.search.improve import SearchConfig, improve
from model.solution import Solution

MINUTE = 60_000
LEFT_OUT = 60.0
Places = tuple[tuple[int, int, str], ...]
"""Number of a break, leg, and where on it."""


def _minutes(rng: np.random.Generator, low: int, high: int) -> int:
    return int(rng.integers(low, high + 1)) * MINUTE


def _breaks(rng: np.random.Generator) -> tuple[Break, ...]:
    breaks, opens = [], _minutes(rng, 0, 14)
    for number in range(int(rng.integers(1, 3))):
        closes = opens + _minutes(rng, 0, 8)
        breaks.append(Break(
            str(number), _minutes(rng, 1, 6), opens, closes, paid=bool(rng.random() < 0.6),
            anywhere=bool(rng.random() < 0.4), after_departure=bool(rng.random() < 0.3)))
        opens = closes + _minutes(rng, 0, 8)
    return tuple(breaks)


def _customer(rng: np.random.Generator, name: int, may_be_timed: bool,
              is_soft: bool) -> Customer:
    customer = Customer(str(name), (1,), service_duration=_minutes(rng, 0, 3))
    if rng.random() < 0.6:
        earliest = _minutes(rng, 0, 30)
        customer = replace(customer, earliest=earliest, latest=earliest + _minutes(rng, 0, 12))
        if is_soft:
            customer = replace(customer, early_cost_per_hour=float(rng.integers(0, 2)) * 20,
                               late_cost_per_hour=float(rng.integers(1, 4)) * 20)
    if may_be_timed and rng.random() < 0.3:
        customer = replace(customer, max_time_aboard=_minutes(rng, 4, 20))
    return customer


def small_day(rng: np.random.Generator, is_soft: bool = False) -> Problem:
    """Draw a day."""
    is_soft = is_soft and bool(rng.random() < 0.7)
    is_shipped = bool(rng.random() < 0.3)
    count = 4 if is_shipped else int(rng.integers(1, 4))
    steps = rng.integers(1, 8, (count + 1, count + 1))
    steps = np.minimum(steps, steps.T)
    np.fill_diagonal(steps, 0)
    customers = [_customer(rng, index, not is_shipped, is_soft) for index in range(count)]
    shipments: tuple[Shipment, ...] = ()
    relations: tuple[Relation, ...] = ()
    if is_shipped:
        customers = [replace(each, demand=(0,), unassigned_cost=LEFT_OUT if index % 2 == 0 else 0.0)
                     for index, each in enumerate(customers)]
        shipments = tuple(
            Shipment(str(index), 1 + 2 * index, 2 + 2 * index, (1,),
                     _minutes(rng, 3, 15) if rng.random() < 0.6 else None,
                     int(rng.integers(1, 4)) * 1000 if rng.random() < 0.4 else None)
            for index in range(2))
    elif count > 1 and rng.random() < 0.4:
        least = _minutes(rng, 0, 8)
        relations = (Relation("before", (1, 2), "vehicle", least, least + _minutes(rng, 0, 10)),)
    truck = VehicleType(
        "truck", 1, (9,), 0, cost_per_km=1.0,
        cost_per_hour=30.0 if rng.random() < 0.7 else 0.0, latest=60 * MINUTE,
        max_working_duration=_minutes(rng, 12, 40) if rng.random() < 0.4 else None,
        breaks=_breaks(rng))
    travel = Travel(steps * MINUTE, steps * 100_000)
    return Problem((Depot("hub"),), tuple(customers), (truck,), (travel,),
                   rng.random((count + 1, 2)), unassigned_cost=LEFT_OUT, shipments=shipments,
                   relations=relations)


@dataclass(frozen=True)
class Drive:
    """One way to drive a day."""

    nodes: tuple[int, ...]
    places: Places
    start: int


class Clock:
    """Times drives of a day's truck: what each costs, None if it breaks a rule."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.truck, = problem.vehicle_types
        size = problem.num_nodes
        self.legs = [[problem.travel[0].duration.item(origin, to) for to in range(size)]
                     for origin in range(size)]

    def cost(self, drive: Drive) -> float | None:
        """Return what working on a drive costs, and windows that it misses."""
        time, missed = drive.start, 0.0
        starts: dict[int, int] = {}
        row = (0, *drive.nodes, 0)
        for leg, (origin, node) in enumerate(pairwise(row)):
            here = [(number, place) for number, behind, place in drive.places if behind == leg]
            arrival = self._drive(self.legs[origin][node], here, drive.start, time)
            if arrival is None:
                return None
            time = arrival
            if node:
                start = self._start(node, time, starts, drive.start)
                if start is None:
                    return None
                starts[node] = start
                missed += self._missed(node, arrival, start)
                time = start + self.problem.customers[node - 1].service_duration
        working = self._end(drive, time)
        return None if working is None else working + missed

    def _missed(self, node: int, arrival: int, start: int) -> float:
        customer = self.problem.customers[node - 1]
        return (max(0, start - customer.latest) * (customer.late_cost_per_hour or 0.0)
                + max(0, customer.earliest - arrival) * customer.early_cost_per_hour) / 3_600_000

    def _end(self, drive: Drive, end: int) -> float | None:
        taken = {number for number, _, _ in drive.places}
        for number, pause in enumerate(self.truck.breaks):
            since = drive.start if pause.after_departure else 0
            is_over = since + pause.earliest + pause.duration <= drive.start
            if number not in taken and since + pause.latest < end and not is_over:
                return None
        working = end - drive.start - sum(
            self.truck.breaks[number].duration for number in taken
            if not self.truck.breaks[number].paid)
        most = self.truck.max_working_duration
        if end > self.truck.latest or (most is not None and working > most):
            return None
        return working / 3_600_000 * self.truck.cost_per_hour

    def _drive(self, left: int, breaks: list[tuple[int, str]], begin: int,
               time: int) -> int | None:
        for number, place in breaks:
            pause = self.truck.breaks[number]
            since = begin if pause.after_departure else 0
            if place == "arrival":
                time, left = time + left, 0
            start = max(time, since + pause.earliest)
            if start > since + pause.latest:
                return None
            if place == "way":
                left -= min(left, start - time)
            time = start + pause.duration
        return time + left

    def _start(self, node: int, time: int, starts: dict[int, int], begin: int) -> int | None:
        customer = self.problem.customers[node - 1]
        lags = [(starts[relation.nodes[0]], relation) for relation in self.problem.relations
                if relation.nodes[1] == node and relation.nodes[0] in starts]
        ready = max([time, *(start + relation.min_lag for start, relation in lags)])
        if ready > customer.latest and customer.late_cost_per_hour is None:
            return None
        start = max(ready, customer.earliest)
        if any(relation.max_lag is not None and start - before > relation.max_lag
               for before, relation in lags):
            return None
        if customer.max_time_aboard is not None and start - begin > customer.max_time_aboard:
            return None
        for shipment in self.problem.shipments:
            if shipment.delivery == node:
                left = (starts[shipment.pickup]
                        + self.problem.customers[shipment.pickup - 1].service_duration)
                direct = self.legs[shipment.pickup][node]
                if ((shipment.max_time_between is not None
                     and start - left > shipment.max_time_between)
                        or (shipment.max_detour is not None
                            and (start - left) * 1000 > direct * shipment.max_detour)):
                    return None
        return start


def orders(problem: Problem) -> Iterator[tuple[int, ...]]:
    """Yield all orders of some or all nodes that keep who belongs together."""
    nodes = range(1, problem.num_nodes)
    for count in range(problem.num_nodes):
        for order in permutations(nodes, count):
            at = {node: index for index, node in enumerate(order)}
            whole = all((each.pickup in at) == (each.delivery in at)
                        and at.get(each.pickup, 0) <= at.get(each.delivery, 1)
                        for each in problem.shipments)
            ordered = all(at.get(each.nodes[0], -1) < at.get(each.nodes[1], len(at))
                          for each in problem.relations)
            if whole and ordered:
                yield order


def places_of(truck: VehicleType, legs: int) -> Iterator[Places]:
    """Yield all ways to take breaks, in order, on so many legs."""
    where = [(leg, place) for leg in range(legs) for place in ("departure", "way", "arrival")]
    for count in range(len(truck.breaks) + 1):
        for numbers in combinations(range(len(truck.breaks)), count):
            for chosen in combinations_with_replacement(where, count):
                if all(truck.breaks[number].anywhere or place != "way"
                       for number, (_, place) in zip(numbers, chosen, strict=True)):
                    yield tuple((number, leg, place) for number, (leg, place)
                                in zip(numbers, chosen, strict=True))


def cheapest(problem: Problem) -> float:
    """Return what the cheapest plan costs, which is judged."""
    clock, best, chosen = Clock(problem), float("inf"), None
    units = len(problem.shipments) or problem.num_customers
    for order in orders(problem):
        row = (0, *order, 0)
        served = len(order) // 2 if problem.shipments else len(order)
        besides = (units - served) * LEFT_OUT + sum(
            problem.travel[0].distance.item(origin, to) / 1e6
            for origin, to in pairwise(row))
        driven = sum(clock.legs[origin][to] for origin, to in pairwise(row))
        if not order:
            best = min(best, besides)
        elif besides + driven / 3_600_000 * clock.truck.cost_per_hour < best:
            for places in places_of(clock.truck, len(order) + 1):
                for start in range(0, clock.truck.latest - driven + 1, MINUTE):
                    drive = Drive(order, places, start)
                    cost = clock.cost(drive)
                    if cost is not None and besides + cost < best - 1e-9:
                        best, chosen = besides + cost, drive
    if chosen is not None:
        judged = _judged(problem, chosen)
        assert not judged.violations, (judged.violations, chosen)
        assert abs(judged.cost.total - best) < 1e-6, (judged.cost, best, chosen)
    return best


def _judged(problem: Problem, drive: Drive) -> Any:
    breaks = tuple(BreakDecision(*place) for place in drive.places)
    trip = TripDecision((0, *drive.nodes, 0), start=drive.start, breaks=breaks)
    route = schedule(problem, RouteDecision(0, 0, (trip,)))
    return check(problem, Solution((route,), problem.left_out(drive.nodes)))


def found(problem: Problem, turns: int) -> float:
    """Return what the search finds."""
    plan = improve(problem, pack([problem]), Solution((), problem.left_out(())),
                   SearchConfig(turns=turns)).solution
    judged = check(problem, plan)
    assert not judged.violations, judged.violations
    return judged.cost.total


def least_working(problem: Problem, order: tuple[int, ...]) -> float:
    """Return what working and missing windows cost in an order at least; infinite if none is legal.
    """
    clock = Clock(problem)
    driven = sum(clock.legs[origin][to] for origin, to in pairwise((0, *order, 0)))
    found = [clock.cost(Drive(order, places, start)) for places, start in product(
        places_of(clock.truck, len(order) + 1),
        range(0, clock.truck.latest - driven + 1, MINUTE))]
    return min([cost for cost in found if cost is not None], default=float("inf"))


def judged_working(problem: Problem, order: tuple[int, ...]) -> float:
    """Return the same as the judge times an order that states no times."""
    judged = time_route(problem, RouteDecision(0, 0, (TripDecision((0, *order, 0)),)), "route",
                        EVERYTHING_OPEN).judged
    cost = judged.cost
    return float("inf") if judged.violations else cost.time + cost.lateness + cost.earliness


def compare_orders(numbers: range, is_soft: bool) -> None:
    """Compare the judge with enumeration, order by order."""
    count = refused = dearer = 0
    for number in numbers:
        problem = small_day(np.random.default_rng(number), is_soft)
        for order in filter(None, orders(problem)):
            least, judged = least_working(problem, order), judged_working(problem, order)
            assert judged >= least - 1e-6, (number, order, least, judged)
            count += least < float("inf")
            if judged > least + 1e-6:
                refused += judged == float("inf")
                dearer += judged < float("inf")
                typer.echo(f"seed {number}: {order} {least:.3f}, judged {judged:.3f}")
    typer.echo(f"{len(numbers)} days, {count} orders that can be driven, "
               f"{refused} refused, {dearer} dearer")


def main(days: Annotated[int, typer.Option(help="How many are enumerated.")] = 300,
         seed: Annotated[int, typer.Option(help="Seed of the first; later ones count on.")] = 0,
         turns: Annotated[int, typer.Option(help="Turns of the search.")] = 20_000,
         soft: Annotated[bool, typer.Option(help="Some windows are soft.")] = False,
         by_order: Annotated[bool, typer.Option(
             "--orders", help="The judge's times of each order are compared.")] = False) -> None:
    """Compare the search, or the judge, with enumeration."""
    if by_order:
        compare_orders(range(seed, seed + days), soft)
        return
    missed = lost = 0
    for number in range(seed, seed + days):
        problem = small_day(np.random.default_rng(number), soft)
        least = cheapest(problem)
        cost = found(problem, 300)
        if cost > least + 1e-6:
            cost = found(problem, turns)
        if cost > least + 1e-6:
            missed += 1
            lost += cost > least + LEFT_OUT / 2
            typer.echo(f"seed {number}: {least:.3f}, found {cost:.3f}")
        assert cost > least - 1e-6, (number, least, cost)
    typer.echo(f"{days} days, {missed} dearer than the cheapest, {lost} of them leave more out")


if __name__ == "__main__":
    typer.run(main)
