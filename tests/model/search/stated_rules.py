"""Problems that state one rule or another, as the tables of the pages on the search name them."""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from model.problem import (
    FULL_SPEED, MS_PER_HOUR, UNLIMITED, Break, DroneType, Energy, Fairness, IncompatibleGoods,
    Overtime, Problem, Relation, SpeedProfile, VehicleType,
)
from training.instances import generate

HOUR = MS_PER_HOUR
BATTERY = Energy(10**9, 1.0, (0, 1000), *((1000, 2000),) * 4, charge=500)
DRONES = DroneType(count=2, capacity=(10**6,), travel=0)


def with_customers(**stated: object) -> Callable[[Problem], Problem]:
    """Return what lets the first customer state something."""
    return lambda problem: replace(problem, customers=(
        replace(problem.customers[0], **stated), *problem.customers[1:]))


def with_vehicles(**stated: object) -> Callable[[Problem], Problem]:
    """Return what lets all vehicles state something."""
    return lambda problem: replace(problem, vehicle_types=tuple(
        replace(kind, **stated) for kind in problem.vehicle_types))


def with_another(**stated: object) -> Callable[[Problem], Problem]:
    """Return what adds a type of vehicles like the first but for what it states."""
    return lambda problem: replace(problem, vehicle_types=(
        *problem.vehicle_types, replace(problem.vehicle_types[0], id="another", **stated)))


RULES = {
    "working time costs": with_vehicles(cost_per_hour=1.0),
    "overtime costs": with_vehicles(latest=8 * HOUR, overtime=Overtime(1.0)),
    "working time is limited": with_vehicles(max_working_duration=8 * HOUR),
    "trips are several": with_vehicles(max_trips=2),
    "parcels come later": with_customers(release_time=HOUR),
    "trucks have drones": with_vehicles(drones=DRONES),
    "lateness costs": with_customers(latest=HOUR, late_cost_per_hour=1.0),
    "being late costs once": with_customers(latest=HOUR, late_cost_per_hour=0.0, late_cost=1.0),
    "waiting costs": with_customers(earliest=HOUR, early_cost_per_hour=1.0),
    "speed changes": with_vehicles(
        speed_profile=SpeedProfile((HOUR,), (FULL_SPEED, FULL_SPEED // 2))),
    "drivers have breaks": with_vehicles(breaks=(Break("rest", HOUR, HOUR, 2 * HOUR),)),
    "drones are charged aboard": with_vehicles(drones=replace(DRONES, energy=BATTERY)),
    "it is too windy at times": with_vehicles(
        drones=replace(DRONES, storms=((HOUR, 2 * HOUR),))),
    "trips in the air are limited": with_vehicles(flies=True, endurance=HOUR),
    "trips in the air wait for calm": with_vehicles(flies=True, storms=((HOUR, 2 * HOUR),)),
    "batteries are charged between trips": with_vehicles(flies=True, energy=BATTERY),
    "windows are several": with_customers(gaps=((HOUR, 2 * HOUR),)),
    "the last end costs": lambda problem: replace(
        problem, fairness=Fairness(makespan_cost_per_hour=1.0)),
    "time aboard is limited": with_customers(max_time_aboard=HOUR),
    "customers are in an order": lambda problem: replace(problem, relations=(
        Relation("before", (problem.num_depots, problem.num_depots + 1)),)),
    "what is aboard costs": with_vehicles(cost_per_load_km=1.0),
    "one vehicle": with_vehicles(count=1),
    "no windows": lambda problem: replace(problem, customers=tuple(
        replace(customer, latest=UNLIMITED) for customer in problem.customers)),
    "one drone a truck": with_vehicles(drones=replace(DRONES, count=1)),
    "flights cost as much as drives": with_vehicles(
        drones=replace(DRONES, count=1, cost_per_km=1.0)),
    "batteries are swapped": with_vehicles(drones=replace(DRONES, swap_duration=HOUR)),
    "setups": with_customers(setup_duration=HOUR),
    "sorties of several": with_vehicles(drones=replace(DRONES, max_customers_per_sortie=2)),
    "types that drive alike": with_another(fixed_cost=10.0),
    "types that drive otherwise": with_another(latest=8 * HOUR),
    "vehicles cost more by customer": lambda problem: replace(
        problem, vehicle_costs=np.ones((len(problem.vehicle_types), problem.num_customers))),
    "goods that must not go together": lambda problem: replace(with_customers(
        goods=frozenset({"food"}))(problem), incompatible_goods=(
            IncompatibleGoods(frozenset({"food", "fuel"})),)),
}


def plain(num_customers: int = 5) -> Problem:
    """Return a problem of hard windows, loads and distance alone."""
    problem = generate(np.random.default_rng(0), num_customers, "cvrp")
    truck = problem.vehicle_types[0]
    kind = VehicleType(truck.id, truck.count, truck.capacity, truck.travel, cost_per_km=1.0)
    windowed = replace(problem.customers[1], latest=6 * HOUR)
    return replace(problem, vehicle_types=(kind,),
                   customers=(problem.customers[0], windowed, *problem.customers[2:]))


def stating(rules: Iterable[str], problem: Problem) -> Problem:
    """Return a problem that states more, rules by their names."""
    for rule in rules:
        problem = RULES[rule](problem)
    return problem
