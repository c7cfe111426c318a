"""Tiny problems in which rules mix, a few customers each, for plans that are enumerated."""

import numpy as np

from model.problem import Problem, has_timed_zones
from tests.model.fliers import from_few_hubs, with_fliers
from tests.model.permits import with_closings, with_few_airborne, with_ranges, with_storms
from tests.model.tiny import (
    draw_tiny, with_beginnings, with_dimensions, with_drone_types, with_duty, with_energy,
    with_gaps, with_goods, with_limits_aboard, with_open_ends, with_open_reloads,
    with_own_durations, with_pickups, with_places, with_reloads, with_setups, with_turnaround,
)
from tests.model.tiny_choices import with_choices
from tests.model.tiny_company import with_order, with_relations
from tests.model.tiny_launches import (
    with_few_launch_places, with_launch_sites, with_some_revisits,
)
from tests.model.tiny_prices import with_vehicle_costs
from tests.model.tiny_shipments import with_shipments


def all_rules(rng: np.random.Generator) -> Problem:
    """Draw problems of two or three customers until one has no speed profile."""
    while True:
        problem = draw_tiny(rng, drone_share=0.6)
        if problem.num_customers <= 3 and not any(kind.speed_profile
                                                  for kind in problem.vehicle_types):
            return problem


def all_rules_fliers(rng: np.random.Generator) -> Problem:
    """Return problems some of whose vehicles fly by themselves, some mixed with other rules."""
    while True:
        problem = with_fliers(rng, all_rules(rng))
        if any(kind.flies for kind in problem.vehicle_types):
            changes = (with_gaps, with_pickups, with_setups, with_limits_aboard, with_duty)
            change = changes[int(rng.integers(len(changes)))]
            return change(rng, problem) if rng.random() < 0.4 else problem


def all_rules_few_at_hubs(rng: np.random.Generator) -> Problem:
    """Return problems whose depots have too few batteries, or places to charge, for who flies."""
    while True:
        problem = from_few_hubs(rng, all_rules(rng))
        if problem.limits_hubs and any(kind.flies for kind in problem.vehicle_types):
            return with_reloads(rng, problem) if rng.random() < 0.2 else problem


def all_rules_elsewhere(rng: np.random.Generator) -> Problem:
    return with_places(rng, all_rules(rng))


def all_rules_begun(rng: np.random.Generator) -> Problem:
    return with_beginnings(rng, with_places(rng, all_rules(rng)))


def all_rules_several_windows(rng: np.random.Generator) -> Problem:
    return with_gaps(rng, all_rules(rng))


def all_rules_on_batteries(rng: np.random.Generator) -> Problem:
    while True:
        problem = with_energy(rng, all_rules(rng))
        if any(kind.drones for kind in problem.vehicle_types):
            return problem


def all_rules_swapping(rng: np.random.Generator) -> Problem:
    """Return problems half of which have batteries, windows or vehicles under way as well."""
    while True:
        problem = with_turnaround(rng, all_rules(rng))
        if any(kind.drones for kind in problem.vehicle_types):
            change = (with_energy, with_gaps, with_beginnings)[int(rng.integers(3))]
            return change(rng, problem) if rng.random() < 0.5 else problem


def all_rules_drone_types(rng: np.random.Generator) -> Problem:
    """Return problems some of whose trucks have drones of several types."""
    while True:
        problem = with_drone_types(rng, all_rules(rng))
        if any(kind.more_drones for kind in problem.vehicle_types):
            return problem


def all_rules_in_storms(rng: np.random.Generator) -> Problem:
    """Return problems some of whose drones, or vehicles that fly, don't while it storms."""
    while True:
        problem = with_storms(rng, with_fliers(rng, all_rules(rng), 0.3))
        if any(kind.storms or any(drones.storms for drones in kind.drone_types)
               for kind in problem.vehicle_types):
            return with_gaps(rng, problem) if rng.random() < 0.3 else problem


def all_rules_in_closed_zones(rng: np.random.Generator) -> Problem:
    """Return problems with zones that are closed to some drones, or vehicles that fly, at times."""
    while True:
        problem = with_closings(rng, with_fliers(rng, all_rules(rng), 0.3))
        if has_timed_zones(problem) and any(
                kind.closings or any(drones.closings for drones in kind.drone_types)
                for kind in problem.vehicle_types):
            return with_gaps(rng, problem) if rng.random() < 0.3 else problem


def all_rules_few_airborne(rng: np.random.Generator) -> Problem:
    """Return problems of trucks with few of their drones in the air, or that wait for them."""
    while True:
        problem = with_few_airborne(rng, all_rules(rng))
        if any(kind.drones and (kind.truck_waits or kind.most_airborne < kind.num_drones)
               for kind in problem.vehicle_types):
            return problem


def all_rules_in_range(rng: np.random.Generator) -> Problem:
    """Return problems some of whose drones may fly no farther than so."""
    while True:
        problem = all_rules(rng)
        problem = with_ranges(rng, with_fliers(rng, problem, 0.3))
        if any(kind.max_range or any(drones.max_range for drones in kind.drone_types)
               for kind in problem.vehicle_types):
            return problem


def all_rules_open(rng: np.random.Generator) -> Problem:
    return with_open_ends(rng, all_rules(rng))


def all_rules_reloading(rng: np.random.Generator) -> Problem:
    return with_reloads(rng, all_rules(rng))


def all_rules_open_reloading(rng: np.random.Generator) -> Problem:
    return with_open_reloads(rng, all_rules(rng))


def all_rules_of_duty(rng: np.random.Generator) -> Problem:
    problem = with_duty(rng, all_rules(rng))
    return with_beginnings(rng, problem) if rng.random() < 0.3 else problem


def all_rules_both_ways(rng: np.random.Generator) -> Problem:
    problem = with_pickups(rng, all_rules(rng))
    return with_dimensions(rng, problem) if rng.random() < 0.2 else problem


def all_rules_shipments(rng: np.random.Generator) -> Problem:
    """Return problems with a shipment, most of them mixed with another rule."""
    changes = (with_gaps, with_pickups, with_setups, with_duty, with_places, with_goods,
               with_open_reloads, with_own_durations, with_energy)
    change = changes[int(rng.integers(len(changes)))]
    problem = all_rules(rng)
    return with_shipments(rng, change(rng, problem) if rng.random() < 0.6 else problem)


def all_rules_own_durations(rng: np.random.Generator) -> Problem:
    return with_own_durations(rng, all_rules(rng))


def all_rules_goods_apart(rng: np.random.Generator) -> Problem:
    return with_goods(rng, all_rules(rng))


def all_rules_vehicle_costs(rng: np.random.Generator) -> Problem:
    return with_vehicle_costs(rng, all_rules(rng))


def all_rules_in_relation(rng: np.random.Generator) -> Problem:
    problem = with_relations(rng, all_rules(rng))
    return with_goods(rng, problem) if rng.random() < 0.2 else problem


def all_rules_several_places(rng: np.random.Generator) -> Problem:
    """Return problems with a customer of several places, some of them with company or gaps."""
    while True:
        problem = all_rules(rng)
        if problem.num_customers > 1:
            change = (with_relations, with_gaps, with_places)[int(rng.integers(3))]
            return with_choices(rng, change(rng, problem) if rng.random() < 0.4 else problem)


def all_rules_in_order(rng: np.random.Generator) -> Problem:
    return with_order(rng, all_rules(rng))


def all_rules_setups(rng: np.random.Generator) -> Problem:
    return with_setups(rng, all_rules(rng))


def all_rules_limits_aboard(rng: np.random.Generator) -> Problem:
    return with_limits_aboard(rng, all_rules(rng))


def all_rules_few_launch_places(rng: np.random.Generator) -> Problem:
    while True:
        problem = with_few_launch_places(rng, all_rules(rng))
        if problem.forbids_launches and any(kind.drones for kind in problem.vehicle_types):
            return problem


def all_rules_launch_sites(rng: np.random.Generator) -> Problem:
    """Return problems in which some truck may stop at launch sites."""
    while True:
        problem = draw_tiny(rng, drone_share=1.0)
        if 3 <= problem.num_customers <= 4 and not any(kind.speed_profile
                                                       for kind in problem.vehicle_types):
            problem = with_launch_sites(rng, problem)
            if problem.num_customers == 2:
                return problem


def all_rules_revisits(rng: np.random.Generator) -> Problem:
    while True:
        problem = all_rules(rng)
        if problem.num_customers == 2 and any(kind.drones for kind in problem.vehicle_types):
            return with_some_revisits(rng, problem)


def all_rules_at_once(rng: np.random.Generator) -> Problem:
    problem = all_rules(rng)
    for change in (with_gaps, with_duty, with_pickups, with_own_durations, with_goods, with_setups,
                   with_limits_aboard):
        if rng.random() < 0.5:
            problem = change(rng, problem)
    return problem
