"""Tiny problems that mix the rules of a working day, a few customers each."""

from collections.abc import Callable
from dataclasses import replace
from typing import get_args

import numpy as np

from model.problem import (
    MAX_QUANTITY, Balance, Fairness, Measure, Problem, Travel, VehicleType,
)
from tests.model.search.mixed_rules import all_rules
from tests.model.tiny import (
    draw_tiny, with_duty, with_gaps, with_goods, with_own_durations, with_pickups,
    with_setups,
)
from tests.model.tiny_breaks import with_breaks
from tests.model.tiny_choices import with_choices
from tests.model.tiny_company import with_order, with_relations
from tests.model.tiny_driving import with_driving
from tests.model.tiny_hours import with_hours
from tests.model.tiny_prices import with_vehicle_costs
from tests.model.tiny_shipments import with_shipments

Change = Callable[[np.random.Generator, Problem], Problem]


def with_missing_legs(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which some legs of trucks don't exist."""
    durations, distances = (each.copy() for each in problem.travel[0].arrays())
    closed = rng.random(durations.shape) < 0.1
    np.fill_diagonal(closed, False)
    durations[closed], distances[closed] = MAX_QUANTITY, distances.max()
    most = MAX_QUANTITY // 2 - 1

    def in_time(kind: VehicleType) -> VehicleType:
        """Return vehicles whose work is over before any such leg would be."""
        over = kind.overtime
        return replace(kind, latest=min(kind.latest, most), overtime=None if over is None else
                       replace(over, max_duration=min(over.max_duration, most)))

    return replace(problem, travel=(Travel(durations, distances), *problem.travel[1:]),
                   vehicle_types=tuple(map(in_time, problem.vehicle_types)))


def with_fairness(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose end costs, or unequal work."""
    measure: Measure = rng.choice(get_args(Measure))
    balance = Balance(measure, float(rng.choice((2, 10)))) if rng.random() < 0.7 else None
    makespan = 60.0 if balance is None or rng.random() < 0.3 else 0.0
    return replace(problem, fairness=Fairness(makespan, balance))


def _one_trip(kind: VehicleType) -> VehicleType:
    return replace(kind, max_trips=1)


def resting(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose drivers make one trip each and have breaks, rest by rules, or both."""
    problem = replace(problem, vehicle_types=tuple(map(_one_trip, problem.vehicle_types)))
    if problem.num_customers > 2 or rng.random() < 0.5:
        problem = with_breaks(rng, problem)
        return replace(problem, vehicle_types=tuple(
            replace(kind, breaks=kind.breaks[:2]) for kind in problem.vehicle_types))
    problem = with_driving(rng, problem)
    if rng.random() < 0.4:
        problem = with_breaks(rng, problem)
    return replace(problem, vehicle_types=tuple(
        replace(kind, breaks=kind.breaks[:1]) for kind in problem.vehicle_types))


CHANGES: tuple[Change, ...] = (
    with_vehicle_costs, with_gaps, with_duty, with_goods, with_pickups,
    with_setups, with_own_durations, with_hours, with_missing_legs)
"""What goes with all else."""


def mixed_day(rng: np.random.Generator) -> Problem:
    """Draw a problem of two to five customers that states three rules or more."""
    problem = _few_by_truck(rng) if rng.random() < 0.4 else all_rules(rng)
    size = int(rng.integers(1, 4))
    for index in sorted(rng.choice(len(CHANGES), size, replace=False).tolist()):
        problem = CHANGES[index](rng, problem)
    is_resting = problem.num_customers <= 3 and rng.random() < 0.5
    if is_resting:
        problem = resting(rng, problem)
    if rng.random() < 0.5:
        problem = with_shipments(rng, problem)
    if rng.random() < 0.4:
        problem = with_relations(rng, problem)
    if rng.random() < 0.3:
        problem = with_order(rng, problem)
    elif rng.random() < 0.4:
        problem = with_choices(rng, problem)
    return with_fairness(rng, problem) if rng.random() < 0.2 else problem


def _few_by_truck(rng: np.random.Generator) -> Problem:
    """Draw four or five customers of trucks that make one trip each."""
    while True:
        problem = draw_tiny(rng, drone_share=0.0)
        if problem.num_customers > 3 and not any(kind.speed_profile
                                                 for kind in problem.vehicle_types):
            return replace(problem, vehicle_types=tuple(map(_one_trip, problem.vehicle_types)))


def stated_in(problem: Problem) -> set[str]:
    """Return the names of the rules of a day that a problem states."""
    kinds, stated = problem.vehicle_types, {each.kind for each in problem.relations}
    return {*stated, *(name for name, is_stated in (
        ("shipments", problem.shipments), ("alternatives", problem.choices),
        ("breaks", any(kind.breaks for kind in kinds)),
        ("driving_rules", any(kind.driving for kind in kinds)),
        ("max_travel_duration", any(kind.max_travel_duration is not None for kind in kinds)),
        ("vehicle_costs", problem.vehicle_costs is not None),
        ("fairness", problem.fairness.is_stated),
        ("depot_hours", any(depot.earliest > 0 for depot in problem.depots)),
        ("missing_legs", problem.travel[0].lacks_ways()),
        ("several_windows", any(customer.gaps for customer in problem.customers)),
        ("overtime", any(kind.overtime for kind in kinds)),
        ("goods", problem.incompatible_goods), ("drones", any(kind.drones for kind in kinds)),
        ("pickups", any(customer.pickup for customer in problem.customers)),
        ("setups", any(customer.setup_duration for customer in problem.customers)),
        ("trips", any(kind.max_trips > 1 for kind in kinds))) if is_stated)}
