"""Trucks stop at launch sites for their drones alone, where and when they may."""

from dataclasses import replace

import numpy as np
import pytest

from model.counsel.bench import Bench
from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import UNLIMITED, Depot
from model.problem.revisits import with_revisits
from model.solution import Solution

MINUTE = 60_000

SITE, A, B, C, D = 1, 2, 3, 4, 5
"""On a street: a at 1 km, b at 2, c at 3, d at 4, the site at 3.5; a truck takes two minutes each,
a drone one."""


@pytest.fixture
def street(tiny_problem, customers, truck, drones):
    """Return a problem of one truck with a drone and a launch site, changed as is stated."""
    def changed(on_site=None, **on_truck):
        carrier = replace(truck, **{"cost_per_km": 1.0, "cost_per_stop": 1.0, "drones": drones}
                          | on_truck)
        problem = tiny_problem(*customers, truck=carrier, places=(0, 3.5, 1, 2, 3, 4), num_depots=2)
        return replace(problem, depots=(problem.depots[0],
                                        Depot("car park", "launch_site", **(on_site or {}))))
    return changed


def plan(problem, *trips):
    """One route of these trips; all other customers are unassigned."""
    route = schedule(problem, RouteDecision(0, 0, trips))
    first = problem.num_depots
    served = {node for trip in trips for node in trip.customers(first)}
    return Solution((route,), tuple(sorted(set(range(first, problem.num_nodes)) - served)))


D_FROM_SITE = TripDecision((0, A, SITE, 0), (SortieDecision((D,), 2, 2),), start=0)


def codes(problem, solution):
    return [violation.code for violation in check(problem, solution).violations]


def test_a_truck_stops_for_its_drone_and_serves_nobody(street):
    problem = street(on_site={"stop_cost": 2.5})
    solution = plan(problem, D_FROM_SITE)
    evaluation = check(problem, solution)
    assert evaluation.violations == ()
    _, a, site, _ = solution.routes[0].trips[0].stops
    assert (site.is_launch_site, a.is_launch_site) == (True, False)
    assert site.arrival == site.service_start
    # One customer by truck, and the stop.
    assert evaluation.cost.stops == 1.0 + 2.5
    assert evaluation.routes[0].trips[0].distance == 7_000_000


def test_stops_at_launch_sites_are_no_customers(street):
    problem = street(max_stops=1)
    assert codes(problem, plan(problem, D_FROM_SITE)) == []


def test_no_drone_takes_off_before_a_launch_site_opens(street):
    problem = street(on_site={"earliest": 60 * MINUTE})
    stops = plan(problem, D_FROM_SITE).routes[0].trips[0].stops
    assert stops[2].arrival < stops[2].service_start == 60 * MINUTE
    sortie = plan(problem, D_FROM_SITE).routes[0].trips[0].sorties[0]
    assert sortie.launch_time >= 60 * MINUTE


def test_whoever_comes_too_late_breaks_the_window_of_a_launch_site(street):
    arrival = plan(street(), D_FROM_SITE).routes[0].trips[0].stops[2].arrival
    for latest, expected in ((arrival, []), (arrival - 1, ["TIME_WINDOW"])):
        problem = street(on_site={"latest": latest})
        assert codes(problem, plan(problem, D_FROM_SITE)) == expected


def test_not_all_may_stop(street):
    problem = replace(street(), may_stop=np.array([[True, False]]))
    (violation,) = check(problem, plan(problem, D_FROM_SITE)).violations
    assert (violation.code, violation.path) == ("LAUNCH_SITE", "routes[0].trips[0].stops[2]")
    assert violation.message == "truck may not stop at car park for its drones"


def test_no_trip_ends_at_a_launch_site(street):
    problem = street()
    trip = TripDecision((0, A, SITE), start=0)
    assert codes(problem, plan(problem, trip)) == ["DEPOT"]


@pytest.mark.parametrize(("nodes", "sorties", "expected"), [
    # b has been served by the truck, then by the drone recovered before, or not yet.
    (("a", "b", "c", "again b"), (("d", 2, 3),), []),
    (("a", "c", "again b"), (("b", 1, 2), ("d", 3, 3)), []),
    (("a", "again b", "c"), (("d", 2, 2), ("b", 3, 3)), ["LAUNCH_SITE"]),
    (("again b", "b"), (("d", 1, 1),), ["LAUNCH_SITE"]),
])
def test_places_are_revisited_once_their_customers_are_served(
        nodes, sorties, expected, tiny_problem, customers, truck, drones):
    problem = with_revisits(tiny_problem(*customers, truck=replace(truck, drones=drones)), [0])
    node = {customer.id: index for index, customer
            in enumerate(problem.customers, problem.num_depots)}
    node |= {f"again {depot.id}": index for index, depot in enumerate(problem.depots)
             if depot.is_launch_site}
    trip = TripDecision((0, *map(node.__getitem__, nodes), 0), tuple(
        SortieDecision((node[name],), launch, recovery) for name, launch, recovery in sorties),
        start=0)
    assert codes(problem, plan(problem, trip)) == expected


def test_vehicles_of_other_types_do_not_come_back(tiny_problem, customers, truck, drones):
    carrier = replace(truck, drones=drones)
    problem = tiny_problem(*customers, truck=carrier, more_types=(replace(carrier, id="other"),))
    again = with_revisits(problem, [1])
    assert len(again.launch_sites) == 1 + problem.num_customers
    assert [again.allows_stop(kind, again.launch_sites[0]) for kind in (0, 1)] == [False, True]
    assert with_revisits(problem, []) is problem
    assert all(again.depots[site].latest == UNLIMITED for site in again.launch_sites)


def test_place_that_is_revisited_lies_in_the_zones_of_its_customer(
        tiny_problem, customers, truck, drones):
    held = (replace(customers[0], zones=2), *customers[1:])
    again = with_revisits(tiny_problem(*held, truck=replace(truck, drones=drones)), [0])
    assert {again.depots[site].id: again.depots[site].zones for site in again.launch_sites} == {
        "depot-0": 0} | {customer.id: customer.zones for customer in held}


def test_who_is_left_out_takes_stops_for_his_drone_along(street):
    problem = street(on_site={"stop_cost": 2.5})
    for trips, cost in (((D_FROM_SITE,), 1.0),
                        ((TripDecision((0, SITE, 0), (SortieDecision((D,), 1, 1),)),), 0.0)):
        bench = Bench(problem, plan(problem, *trips), D)
        assert bench.left_out.evaluation.cost.stops == cost
        assert bench.left_out.evaluation.violations == ()
