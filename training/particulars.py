"""The variant with rules about addresses, service, freshness, goods, batteries and drones."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from model.problem import (
    FULL_SPEED,
    UNLIMITED,
    Customer,
    DroneType,
    IncompatibleGoods,
    Problem,
    VehicleType,
)
from training.ground import integer, log_uniform, uniform
from training.pickups import pickups
from training.variants import InstanceConfig, drone, multitrip, vrptw
from training.variety import FIRST, various

GROUNDS = (vrptw, multitrip, drone, pickups, various)
"""What the rules are added to."""

GOODS = ("food", "paint", "soap", "wood")


def particular(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Rules that all others lack, each by chance, on top of one of `GROUNDS`.

    Several customers at an address, with a setup there of 0.2 to 0.9 of what their service took;
    service by type of vehicle, 0.3 to 1 times as long, up to 1.5 times by types that needn't serve
    everyone; parcels aboard for 1.1 to 4 times the way to their customer; goods kept apart on trips
    and on vehicles; batteries that are swapped at launch, and how many there are, or charged aboard
    at 0.2 to 3 times the power of a flight with nothing aboard; lighter drones beside the others.
    """
    problem = GROUNDS[integer(rng, 0, len(GROUNDS) - 1)](rng, num_customers, config)
    for rule, chance in ((_at_addresses, 0.5), (_with_setups, 0.6), (_served_by_type, 0.5),
                         (_kept_fresh, 0.4), (_kept_apart, 0.4), (_swapping, 0.6),
                         (_charging, 0.5), (_beside_lighter_drones, 0.4)):
        if rng.random() < chance:
            problem = rule(rng, problem)
    return problem


def _at_addresses(rng: np.random.Generator, problem: Problem) -> Problem:
    """Move some customers to the places of others, and let them be served as those are.

    Not where drones alone serve somebody, perhaps from a place that nobody would be at any more.
    """
    if any(customer.served_by == "drone" for customer in problem.customers):
        return problem
    first, number = problem.num_depots, problem.num_customers
    addresses = rng.integers(0, number, max(1, int(number * uniform(rng, 0.2, 0.8))))
    host = np.where(rng.random(number) < 0.7, rng.choice(addresses, number), np.arange(number))
    host[addresses] = addresses
    nodes = np.concatenate([np.arange(first), first + host])
    customers = tuple([
        replace(problem.customers[there], id=own.id, demand=own.demand, pickup=own.pickup,
                site=first + there)
        for own, there in zip(problem.customers, host.tolist(), strict=True)])
    return replace(problem, customers=customers, coordinates=problem.coordinates[nodes],
                   travel=tuple([travel.among(nodes) for travel in problem.travel]))


def _with_setups(rng: np.random.Generator, problem: Problem) -> Problem:
    """Let parts of the services be setups; windows are later by as much."""
    share, least = uniform(rng, 0.3, 1.0), uniform(rng, 0.2, 0.8)

    def split(customer: Customer) -> Customer:
        if customer.served_by == "drone" or rng.random() > share:
            return customer
        setup = int(customer.service_duration * uniform(rng, least, 0.9))
        is_open = customer.latest == UNLIMITED
        return replace(
            customer, setup_duration=setup, service_duration=customer.service_duration - setup,
            earliest=customer.earliest + (0 if is_open else setup),
            latest=UNLIMITED if is_open else min(UNLIMITED, customer.latest + setup),
            gaps=tuple([(closes + setup, opens + setup) for closes, opens in customer.gaps]))

    return replace(problem, customers=tuple(map(split, problem.customers)))


def _served_by_type(rng: np.random.Generator, problem: Problem) -> Problem:
    """Let vehicles of some types, or their drones, serve some customers in times of their own."""
    def own(kind: VehicleType | DroneType, most: float) -> dict[str, int]:
        share = uniform(rng, 0.2, 1.0)
        return {customer.id: int(kind.service_at(customer) * uniform(rng, 0.3, most))
                for customer in problem.customers if rng.random() < share}

    def changed(kind: VehicleType) -> VehicleType:
        is_needed = kind.id == FIRST or len(problem.vehicle_types) == 1
        if rng.random() < 0.6:
            kind = replace(kind, service_durations=own(kind, 1.0 if is_needed else 1.5))
        if kind.drones is not None and rng.random() < 0.6:
            kind = replace(kind, drones=replace(kind.drones,
                                                service_durations=own(kind.drones, 1.0)))
        return kind

    return replace(problem, vehicle_types=tuple(map(changed, problem.vehicle_types)))


def _kept_fresh(rng: np.random.Generator, problem: Problem) -> Problem:
    """Limit for how long some parcels are aboard, to no less than the way from any start takes."""
    share, first = uniform(rng, 0.2, 1.0), problem.num_depots
    ways = np.max([problem.travel[kind.travel].duration[kind.begins_at, first:]
                   * FULL_SPEED / min(kind.speed_profile.factors if kind.speed_profile
                                      else (FULL_SPEED,))
                   for kind in problem.vehicle_types], axis=0)

    def limited(customer: Customer, way: float) -> Customer:
        if customer.served_by == "drone" or rng.random() > share:
            return customer
        longest = (way + customer.setup_duration) * log_uniform(rng, 1.1, 4.0)
        return replace(customer, max_time_aboard=int(longest) + 1)

    return replace(problem, customers=tuple(map(limited, problem.customers, ways.tolist())))


def _kept_apart(rng: np.random.Generator, problem: Problem) -> Problem:
    """Give some customers goods, of which some are kept apart."""
    share = uniform(rng, 0.1, 0.9)
    customers = tuple([
        replace(customer, goods=frozenset({GOODS[integer(rng, 0, len(GOODS) - 1)]}))
        if rng.random() < share else customer for customer in problem.customers])
    entries = [IncompatibleGoods(frozenset(GOODS[:2]), "trip" if rng.random() < 0.7 else "vehicle")]
    if rng.random() < 0.3:
        entries.append(IncompatibleGoods(frozenset(GOODS[1:3]), "trip"))
    return replace(problem, customers=customers, incompatible_goods=tuple(entries))


def _swapping(rng: np.random.Generator, problem: Problem) -> Problem:
    """Let batteries be swapped at launch, and limit how many some trucks have."""
    usual = float(problem.travel[0].duration[:].mean())

    def swapping(kind: VehicleType, drones: DroneType) -> VehicleType:
        batteries = integer(rng, 1, 5) if rng.random() < 0.5 else None
        swap = int(uniform(rng, 0.0, 0.2) * usual)
        return replace(kind, drones=replace(drones, swap_duration=swap, batteries=batteries))

    return _where_drones_ride(problem, swapping)


def _charging(rng: np.random.Generator, problem: Problem) -> Problem:
    """Let batteries that limit flights be charged aboard, of which then none is swapped."""
    def charging(kind: VehicleType, drones: DroneType) -> VehicleType:
        if drones.energy is None:
            return kind
        gain = int(drones.energy.cruise[0] * log_uniform(rng, 0.2, 3.0))
        return replace(kind, drones=replace(
            drones, energy=replace(drones.energy, charge=gain), swap_duration=0, batteries=None))

    return _where_drones_ride(problem, charging)


def _beside_lighter_drones(rng: np.random.Generator, problem: Problem) -> Problem:
    """Add a type of one or two drones that lift, last and cost less to some trucks with drones."""
    def equipped(kind: VehicleType, drones: DroneType) -> VehicleType:
        if rng.random() < 0.2:
            return kind
        lift, last, price = (uniform(rng, 0.3, 1.0) for _ in range(3))
        endurance = drones.endurance
        lighter = replace(
            drones, id="lighter", count=integer(rng, 1, 2),
            capacity=tuple([int(lift * most) for most in drones.capacity]),
            endurance=UNLIMITED if endurance == UNLIMITED else int(last * endurance),
            cost_per_km=price * drones.cost_per_km, cost_per_hour=price * drones.cost_per_hour)
        return replace(kind, drones=replace(drones, id="usual"), more_drones=(lighter,))

    return _where_drones_ride(problem, equipped)


def _where_drones_ride(problem: Problem,
                       change: Callable[[VehicleType, DroneType], VehicleType]) -> Problem:
    """Change the vehicle types that have drones, of which they have one type yet."""
    return replace(problem, vehicle_types=tuple([
        kind if kind.drones is None else change(kind, kind.drones)
        for kind in problem.vehicle_types]))
