"""Tiny problems that mix all rules; every time is a whole number of minutes."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from model.problem import (
    FULL_SPEED, MM_PER_KM, UNLIMITED, UNREACHABLE, Customer, Depot, DroneType, Energy,
    IncompatibleGoods, Overtime, Problem, SpeedProfile, Travel, VehicleType,
)
from model.travel.matrices import with_nowhere

MINUTE = 60_000

RUSH_HOUR = SpeedProfile((5 * MINUTE, 15 * MINUTE), (FULL_SPEED, FULL_SPEED // 3, FULL_SPEED))


def _draw(rng: np.random.Generator, low: int, high: int, unit: int = MINUTE) -> int:
    return int(rng.integers(low, high + 1)) * unit


def _maybe(rng: np.random.Generator, share: float, low: int, high: int,
           unit: int = MINUTE) -> int | None:
    return _draw(rng, low, high, unit) if rng.random() < share else None


def _travel(rng: np.random.Generator, num_nodes: int, longest: int, blocked: float) -> Travel:
    """Draw legs, at random or between places on a street; some can't be flown."""
    steps = rng.integers(1, longest + 1, (num_nodes, num_nodes))
    if rng.random() < 0.5:
        place = rng.integers(0, longest + 1, num_nodes)
        steps = np.abs(place[:, None] - place)
    np.fill_diagonal(steps, 0)
    closed = rng.random(steps.shape) < blocked
    np.fill_diagonal(closed, False)
    return Travel(np.where(closed, UNREACHABLE, steps * MINUTE).astype(np.int64),
                  np.where(closed, UNREACHABLE, steps * MM_PER_KM).astype(np.int64))


def _customer(rng: np.random.Generator, name: int, dimensions: int) -> Customer:
    earliest = _maybe(rng, 0.5, 0, 30) or 0
    width = _maybe(rng, 0.5, 0, 25)
    return Customer(
        str(name), tuple(_draw(rng, 0, 3, 1) for _ in range(dimensions)),
        service_duration=_draw(rng, 0, 4),
        earliest=earliest, latest=UNLIMITED if width is None else earliest + width,
        late_cost_per_hour=None if rng.random() < 0.6 else 30.0, late_cost=2.0 * (name % 3),
        early_cost_per_hour=float(rng.integers(0, 2)) * 6,
        served_by=("truck", "drone", "either", "either")[int(rng.integers(4))],
        skills=frozenset({"cold"} if rng.random() < 0.2 else ()),
        release_time=_maybe(rng, 0.3, 1, 20) or 0)


def _drones(rng: np.random.Generator, dimensions: int) -> DroneType:
    endurance = _maybe(rng, 0.8, 3, 25)
    return DroneType(
        count=int(rng.integers(1, 3)),
        capacity=tuple(_draw(rng, 1, 3, 1) for _ in range(dimensions)), travel=1,
        endurance=UNLIMITED if endurance is None else endurance,
        endurance_includes_waiting=bool(rng.random() < 0.6), launch_duration=_draw(rng, 0, 2),
        recovery_duration=_draw(rng, 0, 2), service_duration=_maybe(rng, 0.3, 0, 3),
        cost_per_km=0.5, cost_per_hour=float(rng.integers(0, 2)) * 5)


def _vehicle_type(rng: np.random.Generator, name: int, dimensions: int, num_depots: int,
                  drone_share: float) -> VehicleType:
    earliest = _maybe(rng, 0.4, 1, 10) or 0
    max_working = _maybe(rng, 0.6, 8, 45)
    # Where the working duration counts, times have to stay whole minutes.
    rush = max_working is None and rng.random() < 0.3
    shift = _maybe(rng, 0.4, 15, 60)
    return VehicleType(
        str(name), count=int(rng.integers(1, 3)),
        capacity=tuple(_draw(rng, 3, 8, 1) for _ in range(dimensions)), cost_per_hour=20.0,
        travel=0, depot=int(rng.integers(num_depots)), fixed_cost=float(rng.integers(0, 3)),
        earliest=earliest, latest=UNLIMITED if shift is None else earliest + shift, cost_per_km=1.0,
        max_working_duration=max_working, speed_profile=RUSH_HOUR if rush else None,
        max_trip_distance=_maybe(rng, 0.3, 8, 25, MM_PER_KM),
        max_trips=int(rng.integers(1, 4)), reload_duration=_draw(rng, 0, 5),
        skills=frozenset({"cold"} if rng.random() < 0.6 else ()),
        drones=_drones(rng, dimensions) if rng.random() < drone_share else None)


def draw_tiny(rng: np.random.Generator, drone_share: float = 0.6) -> Problem:
    """Draw a problem of 2 to 5 customers."""
    dimensions, num_depots = int(rng.integers(1, 3)), int(rng.integers(1, 3))
    num_customers = int(rng.integers(2, 6))
    num_nodes = num_depots + num_customers
    kinds = int(rng.integers(1, 3))
    return Problem(
        depots=tuple(Depot(str(index)) for index in range(num_depots)),
        customers=tuple(_customer(rng, index, dimensions) for index in range(num_customers)),
        vehicle_types=tuple(_vehicle_type(rng, index, dimensions, num_depots, drone_share)
                            for index in range(kinds)),
        travel=(_travel(rng, num_nodes, 8, 0.0), _travel(rng, num_nodes, 5, 0.08)),
        coordinates=rng.random((num_nodes, 2)), unassigned_cost=100.0)


def with_own_costs(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which leaving out some customers costs less or more than the others."""
    return replace(problem, customers=tuple(
        replace(customer, unassigned_cost=float(rng.integers(0, 200)))
        if rng.random() < 0.6 else customer for customer in problem.customers))


def with_gaps(rng: np.random.Generator, problem: Problem, share: float = 0.7) -> Problem:
    """Return a problem in which a share of the customers has two to four windows."""
    def several(customer: Customer) -> Customer:
        gaps, opens = [], customer.earliest
        for _ in range(int(rng.integers(1, 4))):
            closes = opens + _draw(rng, 0, 8)
            opens = closes + _draw(rng, 1, 15)
            gaps.append((closes, opens))
        width = _maybe(rng, 0.7, 0, 20)
        return replace(customer, gaps=tuple(gaps),
                       latest=UNLIMITED if width is None else opens + width)

    return replace(problem, customers=tuple(
        several(customer) if rng.random() < share else customer for customer in problem.customers))


def with_drones(kind: VehicleType, change: Callable[[DroneType], DroneType]) -> VehicleType:
    """Return a vehicle type with all types of its drones changed."""
    if kind.drones is None:
        return kind
    first, *others = map(change, kind.drone_types)
    return replace(kind, drones=first, more_drones=tuple(others))


def draw_battery(rng: np.random.Generator, dimensions: int) -> Energy:
    """Draw a battery, with powers at two or three weights."""
    def powers(points: int) -> tuple[int, ...]:
        low = _draw(rng, 0, 3, 1)
        return tuple(low + _draw(rng, 0, 4, 1) * (rng.random() < 0.6) for _ in range(points))

    weights = ((0, 3), (0, 1, 2), (0, 2, 3))[int(rng.integers(3))]
    points = len(weights)
    cruise = tuple(1 + power for power in powers(points))
    return Energy(
        available=_draw(rng, 6, 50), usable_share=1.0, weights=weights, cruise=cruise,
        hover=powers(points), climb=powers(points), descent=powers(points),
        climb_duration=_draw(rng, 0, 1, MINUTE // 2),
        descent_duration=_draw(rng, 0, 1, MINUTE // 2),
        dimension=int(rng.integers(dimensions)), lands=bool(rng.random() < 0.5))


def with_energy(rng: np.random.Generator, problem: Problem, share: float = 1.0) -> Problem:
    """Return a problem in which a share of the types has drones that a battery limits."""
    def powered(drones: DroneType) -> DroneType:
        if rng.random() >= share:
            return drones
        return replace(drones, energy=draw_battery(rng, problem.num_dimensions))

    return replace(problem, vehicle_types=tuple(
        with_drones(kind, powered) for kind in problem.vehicle_types))


def with_drone_types(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which most trucks that have drones carry one or two other types, too.

    Some of these fly by legs of their own.
    """
    slow = problem.travel[1]
    duration, distance = slow.arrays()
    slow = Travel(np.where(duration < UNREACHABLE, 2 * duration, UNREACHABLE), distance)

    def equipped(kind: VehicleType) -> VehicleType:
        if kind.drones is None or rng.random() < 0.2:
            return kind
        number = int(rng.integers(1, 3))
        more = tuple(replace(
            _drones(rng, problem.num_dimensions), id=str(index), count=1,
            travel=int(rng.integers(1, 3)), cost_per_km=float(rng.integers(0, 3)))
            for index in range(number))
        return replace(kind, drones=replace(kind.drones, count=1), more_drones=more)

    return replace(problem, travel=(*problem.travel, slow),
                   vehicle_types=tuple(map(equipped, problem.vehicle_types)))


def with_charging(rng: np.random.Generator, problem: Problem,
                  begun_share: float = 0.3) -> Problem:
    """Return a problem in which the batteries of most types' drones are charged aboard.

    A share of the vehicles that make one trip have drones that aren't full at first. All takes
    whole minutes.
    """
    def charged(drones: DroneType) -> DroneType:
        if drones.energy is None or rng.random() < 0.2:
            return drones
        return replace(drones, energy=replace(drones.energy, charge=1, climb_duration=0,
                                              descent_duration=0))

    def begun(kind: VehicleType) -> VehicleType:
        energies = [kind.drone_type(drone).energy for drone in range(kind.num_drones)]
        if kind.max_trips > 1 or rng.random() >= begun_share:
            return kind
        return replace(kind, charge_left=tuple(
            0 if energy is None else _draw(rng, 0, energy.available // MINUTE)
            for energy in energies))

    problem = with_energy(rng, problem)
    return replace(problem, vehicle_types=tuple(
        begun(with_drones(kind, charged)) for kind in problem.vehicle_types))


def with_turnaround(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which drones' batteries are swapped, and most stocks are small.

    On trips of vehicles under way drones may have been launched before.
    """
    def swapping(kind: VehicleType) -> VehicleType:
        if kind.drones is None:
            return kind
        has_launched = kind.max_trips == 1 and bool(rng.random() < 0.3)
        return with_drones(kind, lambda drones: replace(
            drones, swap_duration=_draw(rng, 0, 4), batteries=_maybe(rng, 0.6, 0, 3, 1),
            has_launched=has_launched))

    return replace(problem, vehicle_types=tuple(map(swapping, problem.vehicle_types)))


def with_duty(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem with overtime, whose stops cost and are limited, as are sorties and legs."""
    def tired(kind: VehicleType) -> VehicleType:
        longest = _maybe(rng, 0.7, 0, 20)
        # Apart, so that all that is drawn later is the same with speeds by the hour and without.
        legs = rng.spawn(1)[0] if kind.speed_profile else rng
        overtime = Overtime(float(rng.integers(0, 60)), UNLIMITED if longest is None else longest)
        return replace(
            kind, overtime=overtime if rng.random() < 0.7 else None,
            cost_per_stop=float(rng.integers(0, 5)), max_stops=_maybe(rng, 0.5, 0, 3, 1),
            max_sorties=_maybe(rng, 0.5, 0, 3, 1),
            max_travel_duration=None if kind.flies else _maybe(legs, 0.5, 4, 40),
            max_distance=_maybe(rng.spawn(1)[0], 0.3, 4, 40, MM_PER_KM))

    return replace(problem, vehicle_types=tuple(map(tired, problem.vehicle_types)))


def with_pickups(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which most customers have something to be picked up, some nothing else.

    Some vehicles pick up only after all that they deliver on a trip.
    """
    kinds = tuple(replace(kind, pickups="last" if rng.random() < 0.4 else "any",
                          cost_per_load_km=float(rng.integers(0, 2)) * 200.0)
                  for kind in problem.vehicle_types)

    def changed(customer: Customer) -> Customer:
        if rng.random() < 0.3:
            return customer
        pickup = tuple(_draw(rng, 0, 4, 1) for _ in customer.demand)
        demand = customer.demand if rng.random() < 0.6 else (0,) * len(pickup)
        return replace(customer, demand=demand, pickup=pickup)

    return replace(problem, customers=tuple(map(changed, problem.customers)), vehicle_types=kinds)


def with_dimensions(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which loads have four to eight dimensions."""
    number = int(rng.integers(4, 9))

    def more(amounts: tuple[int, ...], least: int, most: int) -> tuple[int, ...]:
        return (*amounts, *(_draw(rng, least, most, 1) for _ in range(number - len(amounts))))

    def kind_of(kind: VehicleType) -> VehicleType:
        kind = with_drones(kind, lambda drones: replace(
            drones, capacity=more(drones.capacity, 1, 3)))
        return replace(kind, capacity=more(kind.capacity, 3, 8),
                       initial_load=kind.initial_load and more(kind.initial_load, 0, 2))

    customers = tuple(
        replace(customer, demand=more(customer.demand, 0, 3),
                pickup=customer.pickup and more(customer.pickup, 0, 3))
        for customer in problem.customers)
    return replace(problem, customers=customers, amount_decimals=(3,) * number,
                   vehicle_types=tuple(map(kind_of, problem.vehicle_types)))


def with_own_durations(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which service takes trucks, and drones, of a type longer or shorter."""
    def durations() -> dict[str, int]:
        return {customer.id: _draw(rng, 0, 6) for customer in problem.customers
                if rng.random() < 0.6}

    def changed(kind: VehicleType) -> VehicleType:
        kind = with_drones(kind, lambda drones: replace(drones, service_durations=durations()))
        return replace(kind, service_durations=durations())

    return replace(problem, vehicle_types=tuple(map(changed, problem.vehicle_types)))


def with_setups(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose customers ask for a setup, some of them at one place."""
    def site() -> int | None:
        return int(rng.integers(3)) if rng.random() < 0.7 else None

    return replace(
        problem, depots=tuple(replace(depot, site=site()) for depot in problem.depots),
        customers=tuple(replace(customer, setup_duration=_maybe(rng, 0.7, 1, 5) or 0, site=site())
                        for customer in problem.customers))


def with_limits_aboard(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which some parcels may be aboard for so long and no longer."""
    return replace(problem, customers=tuple(
        replace(customer, max_time_aboard=_maybe(rng, 0.6, 3, 25))
        for customer in problem.customers))


def with_goods(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which some goods must not go with others on one trip or vehicle."""
    names = ("food", "paint", "glass")
    def loaded(customer: Customer) -> Customer:
        number = int(rng.choice(3, p=(0.15, 0.8, 0.05)))
        return replace(customer, goods=frozenset(rng.choice(names, number, replace=False).tolist()))

    apart = tuple(
        IncompatibleGoods(frozenset(rng.choice(names, int(rng.integers(2, 4)),
                                               replace=False).tolist()),
                          "vehicle" if rng.random() < 0.4 else "trip")
        for _ in range(int(rng.integers(1, 3))))
    return replace(problem, customers=tuple(map(loaded, problem.customers)),
                   incompatible_goods=apart)


def with_table(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which not every type of vehicle may serve everyone."""
    size = (len(problem.vehicle_types), problem.num_customers)
    return replace(problem, may_serve=rng.random(size) < 0.6)


def with_places(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose vehicles make one trip and begin and end at any of three depots."""
    first, end = problem.num_depots, problem.num_nodes
    nodes = [*range(first), *rng.integers(first, end, 3 - first), *range(first, end)]
    grid = np.ix_(nodes, nodes)
    kinds = tuple(replace(kind, max_trips=1, start=int(rng.integers(3)), end=int(rng.integers(3)))
                  for kind in problem.vehicle_types)
    return replace(
        problem, depots=tuple(Depot(str(index)) for index in range(3)), vehicle_types=kinds,
        travel=tuple(Travel(each.duration[grid], each.distance[grid]) for each in problem.travel),
        coordinates=problem.coordinates[nodes])


def with_reloads(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose vehicles begin, reload and end at several of three depots."""
    problem = with_places(rng, problem)
    return replace(problem, vehicle_types=tuple(
        replace(kind, max_trips=int(rng.integers(1, 4)), depot=int(rng.integers(3)),
                reload_depots=tuple(np.flatnonzero(rng.random(3) < 0.3).tolist()))
        for kind in problem.vehicle_types))


def with_open_reloads(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem of open routes of several trips that may reload at several depots."""
    return with_open_ends(rng, with_reloads(rng, problem))


def with_open_ends(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem many of whose vehicles end at their last stop."""
    nowhere = problem.num_depots
    drive, *flights = problem.travel
    return replace(
        problem, depots=(*problem.depots, Depot("nowhere", "nowhere")),
        vehicle_types=tuple(replace(kind, end=nowhere) if rng.random() < 0.7 else kind
                            for kind in problem.vehicle_types),
        travel=(with_nowhere(drive, nowhere, False),
                *(with_nowhere(fly, nowhere, True) for fly in flights)),
        coordinates=np.insert(problem.coordinates, nowhere, 0.5, axis=0))


def with_beginnings(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose vehicles have begun to work, loaded, and have something left to do."""
    def begun(kind: VehicleType) -> VehicleType:
        load = tuple(_draw(rng, 0, min(2, most), 1) for most in kind.capacity)
        since = _draw(rng, 0, kind.earliest // MINUTE) if rng.random() < 0.7 else None
        busy = kind.earliest + (_maybe(rng, 0.5, 1, 8) or 0)
        return replace(kind, max_trips=1, initial_load=load, works_since=since, busy_until=busy,
                       has_delivered=bool(rng.random() < 0.5))

    return replace(problem, vehicle_types=tuple(map(begun, problem.vehicle_types)))


def draw_late(rng: np.random.Generator) -> Problem:
    """Draw a problem with drones some of whose windows open long after all else is done."""
    problem = draw_tiny(rng, drone_share=1.0)

    def later(customer: Customer) -> Customer:
        delay = _maybe(rng, 0.6, 20, 90) or 0
        return replace(customer, earliest=customer.earliest + delay,
                       latest=min(customer.latest + delay, UNLIMITED))

    return replace(
        problem, customers=tuple(later(customer) for customer in problem.customers),
        vehicle_types=tuple(
            replace(kind, latest=min(kind.latest + 90 * MINUTE, UNLIMITED),
                    max_working_duration=kind.max_working_duration and _maybe(rng, 0.6, 30, 120))
            for kind in problem.vehicle_types))
