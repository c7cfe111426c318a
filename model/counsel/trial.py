"""Trips on which one customer is tried alone, on a vehicle that nobody else uses."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from itertools import islice, permutations
from typing import NamedTuple

import numpy as np

from model.judge.check import Evaluation, check
from model.judge.clock import leg_start
from model.judge.flown_trips import wait_for_calm
from model.judge.launches import launch_duration
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import time_route
from model.judge.timing import (
    RouteDecision, SortieDecision, TripDecision, read_decision, schedule,
)
from model.problem import Customer, DroneType, Problem, Shipment, Travel, VehicleType
from model.solution import Solution

MAX_LAUNCH_PLACES = 4
"""Other customers' places, nearest first, where a drone is tried if it fails from the depot."""

MOST_ORDERS = 24
"""Orders of a shipment's pickups that are tried: all of four."""

BROUGHT_FROM = (0, 0), (1, 0), (1, 1)
"""How many stops before its trip's end a drone is launched, and recovered, that delivers."""

MAX_HOSTS = 4
"""Other customers, nearest first, to whom something is delivered before a pickup is tried."""

HOPELESS = frozenset({"VEHICLE", "SKILLS", "GOODS", "CAPACITY"})
"""Rules that whoever breaks them on one trip breaks on all."""


class Attempt(NamedTuple):
    """The customer, the last one of a problem of its own, on one trip."""

    problem: Problem
    solution: Solution
    evaluation: Evaluation

    @property
    def customer(self) -> Customer:
        """The customer who is tried."""
        return self.problem.customers[-1]

    @property
    def vehicle_type(self) -> VehicleType:
        """The type of the vehicle."""
        return self.problem.vehicle_types[0]

    @property
    def codes(self) -> set[str]:
        """Which rules are broken."""
        return {violation.code for violation in self.evaluation.violations}


def small_problem(problem: Problem, kind: int, nodes: Sequence[int],
                  drones: DroneType | None = None, sites: tuple[int, ...] = ()) -> Problem:
    """Return a problem of one type of vehicle, where it begins and ends, and some customers.

    The first depot is where it begins; where it ends is the last but for launch `sites`. It has no
    other `drones`, and depots have enough for who flies.
    """
    vehicle_type, table = problem.vehicle_types[kind], problem.may_serve
    depots = list(dict.fromkeys((vehicle_type.begins_at, vehicle_type.ends_at)))
    ends, depots = len(depots) - 1, [*depots, *sites]
    places = np.array([*depots, *nodes])
    rows = places[:, None]
    travels = [problem.travel[vehicle_type.travel]]
    if drones is not None:
        travels += [problem.travel[drones.travel], problem.travel[drones.straight]]
        drones = replace(drones, travel=1, straight=2)
    elif vehicle_type.max_range is not None:
        travels.append(problem.travel[vehicle_type.straight])
    return Problem(
        depots=tuple([replace(problem.depots[depot], batteries=None, chargers=None)
                      for depot in depots]),
        customers=tuple([problem.customer_at(node) for node in nodes]),
        vehicle_types=(replace(vehicle_type, depot=0, start=0, end=ends, travel=0,
                               straight=len(travels) - 1, drones=drones, more_drones=(),
                               charge_left=(), reload_depots=()),),
        travel=tuple([Travel(each.duration[rows, places], each.distance[rows, places])
                      for each in travels]),
        coordinates=problem.coordinates[places],
        unassigned_cost=problem.unassigned_cost,
        amount_decimals=problem.amount_decimals,
        incompatible_goods=problem.incompatible_goods,
        shipments=problem.shipments_among([*depots, *nodes]),
        relations=problem.relations_among([*depots, *nodes]),
        fairness=replace(problem.fairness, min_vehicles=0, before=(), last_end=0),
        may_serve=None if table is None else table[[kind]][:, np.array(nodes) - problem.num_depots],
        vehicle_costs=problem.vehicle_costs_of([kind], nodes),
    )


def _judge(problem: Problem, decision: TripDecision) -> Attempt:
    decided = RouteDecision(0, 0, (decision,))
    if problem.vehicle_types[0].breaks or problem.vehicle_types[0].driving:
        route = time_route(problem, decided, "", EVERYTHING_OPEN).route
    else:
        route = schedule(problem, decided)
    solution = Solution((route,))
    return Attempt(problem, solution, check(problem, solution))


def again(attempt: Attempt, problem: Problem) -> Attempt:
    """Return the same trip by other rules, its breaks and rests put anew.

    It begins when it did, or as soon as possible if that breaks fewer rules.
    """
    trip, = attempt.solution.routes[0].trips
    decision = replace(read_decision(trip, attempt.vehicle_type), breaks=())
    tried = _judge(problem, decision)
    if not tried.codes:
        return tried
    return min(tried, _judge(problem, replace(decision, start=None)),
               key=lambda each: len(each.codes))


def try_shipment(problem: Problem, kind: int, shipment: Shipment) -> Attempt:
    """Return a trip by a type that serves a shipment alone; by truck if no other is allowed."""
    small = small_problem(problem, kind, shipment.nodes)
    by_truck = _parts_by_truck(small) if shipment.more else _by_truck(small)
    if not by_truck.codes:
        return by_truck
    last = len(shipment.nodes) - 1
    may_fly = {end for end, node in enumerate(shipment.nodes)
               if problem.customer_at(node).served_by != "truck"}
    fetched = [set[int](), *[{end} for end in range(last)], *[{*range(last)}][:last - 1]]
    for drones in problem.vehicle_types[kind].drone_types if may_fly else ():
        small = small_problem(problem, kind, shipment.nodes, drones)
        for flown in [some | brought for brought in (set[int](), {last}) for some in fetched]:
            if flown and flown <= may_fly:
                for flight in BROUGHT_FROM if last in flown else BROUGHT_FROM[:1]:
                    attempt = _judge(small, _alone(small, flown, flight))
                    if not attempt.codes:
                        return attempt
    return by_truck


def _alone(small: Problem, flown: Collection[int],
           brought: tuple[int, int] = (0, 0)) -> TripDecision:
    """Return a trip for one shipment, of which drones serve some ends by number, by truck the rest.

    They fetch it from the trip's start, and deliver it from its end, or as many stops sooner as is
    told of launch and recovery.
    """
    ends = range(small.num_depots, small.num_nodes)
    driven = [node for end, node in enumerate(ends) if end not in flown]
    nodes = (0, *driven, small.vehicle_types[0].ends_at)
    launch, recovery = (len(nodes) - 1 - sooner for sooner in brought)
    return TripDecision(nodes, tuple([
        SortieDecision((node,), launch, recovery) if node == ends[-1]
        else SortieDecision((node,), 0, 0)
        for end, node in enumerate(ends) if end in flown]))


def _parts_by_truck(small: Problem) -> Attempt:
    """Return a trip by truck that picks up a shipment in parts, in the best of some orders."""
    *pickups, delivery = range(small.num_depots, small.num_nodes)
    home = small.vehicle_types[0].ends_at
    tried = [_judge(small, TripDecision((0, *order, delivery, home)))
             for order in islice(permutations(pickups), MOST_ORDERS)]
    return min(tried, key=lambda each: (len(each.codes), each.evaluation.cost.total))


def _by_truck(small: Problem) -> Attempt:
    """Return a truck's trip for one shipment on which fewest rules are broken.

    As soon as possible, or later so that nobody waits for a window to open.
    """
    decision = _alone(small, ())
    best = _judge(small, decision)
    for start in _starts_of_shipment(small):
        if not best.codes:
            break
        tried = _judge(small, replace(decision, start=start))
        best = tried if len(tried.codes) < len(best.codes) else best
    return best


def _starts_of_shipment(problem: Problem) -> Iterator[int]:
    """Yield when a trip begins that reaches an end of a shipment as one of its windows opens."""
    kind, (first, second) = problem.vehicle_types[0], problem.customers
    pickup, delivery = range(problem.num_depots, problem.num_nodes)
    arrivals = [*first.openings]
    for opens in second.openings:
        left = leg_start(opens - problem.setup_between(pickup, delivery),
                         problem.travel[0].duration.item(pickup, delivery), kind.speed_profile)
        arrivals.append(left - kind.service_at(first))
    for arrival in arrivals:
        yield _start_for(problem, pickup, arrival)


def _start_for(problem: Problem, node: int, arrival: int) -> int:
    """Return when a trip begins that reaches a node at an instant, or as soon as it may."""
    kind = problem.vehicle_types[0]
    return max(kind.earliest, *[each.release_time for each in problem.customers],
               leg_start(arrival - problem.setup_between(0, node),
                         problem.travel[0].duration.item(0, node), kind.speed_profile))


def attempts(problem: Problem, kind: int, node: int) -> Iterator[Attempt]:
    """Yield trips by a type that might serve a customer, as long as there is hope."""
    customer = problem.customer_at(node)
    small = small_problem(problem, kind, [node])
    if customer.served_by != ("truck" if small.vehicle_types[0].flies else "drone"):
        for attempt in try_truck(small):
            yield attempt
            if attempt.codes & HOPELESS:
                return
        if _comes_second(problem, kind, customer):
            for host in _delivered_first(problem, kind, node):
                yield _try_after(small_problem(problem, kind, [host, node]))
    if customer.served_by != "truck":
        for drones in problem.vehicle_types[kind].drone_types:
            yield from _try_drones(problem, kind, drones, node)


def _try_drones(problem: Problem, kind: int, drones: DroneType, node: int) -> Iterator[Attempt]:
    """Yield trips on which one of some drones flies to a customer."""
    customer, small = problem.customer_at(node), small_problem(problem, kind, [node], drones)
    loops = [_try_loop(small, drones, opens) for opens in customer.openings]
    yield from loops
    if not loops[0].codes & {*HOPELESS, "PAYLOAD"}:
        for site in _sites_near(problem, kind, drones, node):
            small = small_problem(problem, kind, [node], drones, (site,))
            for opens in customer.openings:
                yield _try_loop_from_site(small, drones, opens)
        for place in _launch_places(problem, kind, drones, node):
            small = small_problem(problem, kind, [place, node], drones)
            for opens in customer.openings:
                yield _try_loop_from_customer(small, drones, opens)


def try_truck(problem: Problem) -> Iterator[Attempt]:
    """Yield trips that don't wait for a window to open where a later start avoids that."""
    for opens in problem.customers[0].openings:
        yield from _try_truck_at(problem, opens)


def _judge_in_calm(problem: Problem, decision: TripDecision, start: int) -> Attempt:
    """Return a trip that begins so, or later where who flies meets a storm."""
    attempt = _judge(problem, decision)
    while wait := wait_for_calm(problem, problem.vehicle_types[0],
                                attempt.solution.routes[0].trips[0]):
        start += wait
        attempt = _judge(problem, replace(decision, start=start))
    return attempt


def _try_truck_at(problem: Problem, opens: int) -> Iterator[Attempt]:
    """Yield trips to a customer as one of its windows opens.

    Other starts matter only for the working duration, when the speed changes: it is shortest
    when a leg begins or ends at a change.
    """
    vehicle_type, customer = problem.vehicle_types[0], problem.customers[0]
    profile, duration = vehicle_type.speed_profile, problem.travel[0].duration
    node, end = problem.num_depots, vehicle_type.ends_at
    start = _start_for(problem, node, opens - vehicle_type.launch_duration)
    first = _judge_in_calm(problem, TripDecision((0, node, end), start=start), start)
    yield first
    if profile is None or first.codes != {"WORKING_DURATION"}:
        return
    outward, homeward = duration.item(0, node), duration.item(node, end)
    earliest = max(vehicle_type.earliest, customer.release_time)
    served = problem.setup_between(0, node) + vehicle_type.service_at(customer)
    for change in profile.times:
        yield from (
            _judge(problem, TripDecision((0, node, end), start=start))
            for start in (
                change,
                leg_start(change, outward, profile),
                leg_start(change - served, outward, profile),
                leg_start(leg_start(change, homeward, profile) - served, outward, profile),
            )
            if start >= earliest
        )


def _comes_second(problem: Problem, kind: int, customer: Customer) -> bool:
    """Tell whether a truck may come to a customer only after it has delivered to another."""
    return (problem.vehicle_types[kind].pickups == "last" and any(customer.pickup)
            and not any(customer.demand))


def _try_after(problem: Problem) -> Attempt:
    """Return a trip to the first customer, then to the second."""
    node, end = problem.num_depots, problem.vehicle_types[0].ends_at
    start = _start_for(problem, node, problem.customers[0].earliest)
    return _judge(problem, TripDecision((0, node, node + 1, end), start=start))


def _delivered_first(problem: Problem, kind: int, node: int) -> list[int]:
    """Return customers near another to whom a truck of this type may deliver something."""
    first, skills = problem.num_depots, problem.vehicle_types[kind].skills
    near = np.argsort(problem.travel[problem.vehicle_types[kind].travel].duration[first:, node],
                      kind="stable")
    hosts = (index + first for index in near.tolist()
             if index + first != node and _takes_a_parcel(problem.customers[index], skills)
             and problem.allows(kind, index + first))
    return list(islice(hosts, MAX_HOSTS))


def _takes_a_parcel(customer: Customer, skills: frozenset[str]) -> bool:
    """Tell whether a truck with these skills may come to a customer and delivers, no more."""
    return (any(customer.demand) and not any(customer.pickup) and customer.served_by != "drone"
            and customer.skills <= skills)


def _try_loop(problem: Problem, drones: DroneType, opens: int) -> Attempt:
    """Return a flight from the depot and back, to a customer as one of its windows opens."""
    customer, node, end = problem.customers[0], problem.num_depots, problem.vehicle_types[0].ends_at
    flight = problem.travel[1].duration.item(0, node) + problem.setup_between(0, node)
    start = max(problem.vehicle_types[0].earliest, customer.release_time,
                opens - flight - launch_duration(drones, True))
    return _judge(problem, TripDecision((0, end), (SortieDecision((node,), 0, 0),), start=start))


def _try_loop_from_site(problem: Problem, drones: DroneType, opens: int) -> Attempt:
    """Return a trip to the launch site with a loop to a customer, as its window opens."""
    site, node, end = problem.num_depots - 1, problem.num_depots, problem.vehicle_types[0].ends_at
    approach = (launch_duration(drones, True) + problem.travel[1].duration.item(site, node)
                + problem.setup_between(site, node))
    arrival = min(max(problem.depots[site].earliest, opens - approach), problem.depots[site].latest)
    return _judge(problem, TripDecision((0, site, end), (SortieDecision((node,), 1, 1),),
                                        start=_start_for(problem, site, arrival)))


def _sites_near(problem: Problem, kind: int, drones: DroneType, node: int) -> list[int]:
    """Return launch sites near enough to fly from, where a truck of this type may always stop."""
    duration = problem.travel[drones.travel].duration
    longest = drones.endurance - drones.service_at(problem.customer_at(node))
    loops = [(duration.item(site, node) + duration.item(node, site), site)
             for site in problem.launch_sites
             if problem.depots[site].after is None and problem.allows_stop(kind, site)]
    return [site for loop, site in sorted(loops) if loop <= longest][:MAX_LAUNCH_PLACES]


def _try_loop_from_customer(problem: Problem, drones: DroneType, opens: int) -> Attempt:
    """Return a trip to the first customer with a loop to the second, as its window opens."""
    (host, customer), end = problem.customers, problem.vehicle_types[0].ends_at
    there, node = problem.num_depots, problem.num_depots + 1
    approach = (launch_duration(drones, True) + problem.travel[1].duration.item(there, node)
                + problem.setup_between(there, node))
    arrival = min(max(host.earliest, opens - approach), host.latest,
                  customer.latest - approach)
    return _judge(problem, TripDecision((0, there, end), (SortieDecision((node,), 1, 1),),
                                        start=_start_for(problem, there, arrival)))


def _launch_places(problem: Problem, kind: int, drones: DroneType, node: int) -> Iterator[int]:
    """Yield customers near enough to fly from, where a truck of this type may stop."""
    first, customer = problem.num_depots, problem.customer_at(node)
    skills = problem.vehicle_types[kind].skills
    duration = problem.travel[drones.travel].duration
    loops = duration[first:, node] + duration[node, first:]
    is_near = loops <= drones.endurance - drones.service_at(customer)
    if drones.max_range is not None:
        is_near &= problem.travel[drones.straight].distance[first:, node] <= drones.max_range
    near = np.flatnonzero(is_near)
    nearest = near[np.argsort(loops[near], kind="stable")] + first
    hosts = (other for other in nearest.tolist()
             if other != node and (host := problem.customer_at(other)).served_by != "drone"
             and host.launch and host.skills <= skills and problem.allows(kind, other))
    yield from islice(hosts, MAX_LAUNCH_PLACES)
