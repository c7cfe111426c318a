"""The variant with rules of customers, vehicles and drones that the others lack."""

from dataclasses import replace

import numpy as np

from model.problem import (
    UNLIMITED,
    Customer,
    DroneType,
    Energy,
    Overtime,
    Problem,
    Travel,
    VehicleType,
)
from training.fleets import (
    Prices,
    assemble,
    draw_drones,
    draw_prices,
    draw_types,
    shuffled,
    with_limits,
    with_shift,
)
from training.ground import Square, integer, log_uniform, uniform
from training.orders import (
    Orders,
    Reach,
    draw_demand,
    draw_service,
    open_orders,
    reach_of,
    with_modes,
    with_releases,
    with_soft_windows,
    with_windows,
)
from training.pickups import with_open_ends, with_pickups
from training.variants import InstanceConfig, draw_ground

FIRST = "type-1"
"""Id of the type that can serve every customer, as `draw_types` names it."""


def various(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Rules that others lack, each by chance.

    1 to 3 types (`fleets.draw_types`) and 1 to 3 depots, where they begin, reload and end, some at
    their last customer; 1 to 8 dimensions. Overtime at 0.2 to 3 times what driving costs, prices
    and limits of stops, limits of sorties, batteries. Several windows of 0.5 to 4 crossings, some
    soft; prices of being left out of 0.05 to 2 direct trips; pickups, alone or beside a delivery,
    and vehicles that do them last; a table of who may serve whom. The first type can serve
    everyone: alone, or with somebody to deliver to.
    """
    ground = draw_ground(rng, num_customers, config, integer(rng, 1, 3))
    demand = draw_demand(rng, num_customers, 1 if rng.random() < 0.6 else integer(rng, 2, 8))
    orders = open_orders(demand, draw_service(rng, num_customers, ground))
    prices = draw_prices(rng, ground, fixed=0.5, distance=0.8, time=0.5)
    day = int(integer(rng, 0, 8) * ground.crossing), uniform(rng, 3.0, 12.0) * ground.crossing
    types, travel = draw_types(rng, ground, orders, prices, integer(rng, 1, 3), day[1])
    travel = (*travel, ground.flight(log_uniform(rng, 0.8, 3.0)))
    ruled = [_with_places(rng, kind, ground, orders, prices, travel, day) for kind in types]
    first, reach = ruled[0]
    driving = max(prices.per_hour, prices.per_km * ground.side_km / ground.crossing_hours)
    orders = _timed(rng, orders, reach, ground, driving)
    if first.drones is not None:
        orders = with_modes(rng, orders, first, travel[-1],
                            (uniform(rng, 0.0, 0.15), uniform(rng, 0.0, 0.2)), depot_only=True)
    kinds = [_on_duty(rng, kind, ground, prices, driving) for kind, _ in ruled]
    problem = assemble(ground, orders, shuffled(rng, tuple(kinds)), travel)
    for rule, chance in ((_with_gaps, 0.5), (_with_prices, 0.4), (_collecting, 0.5),
                         (_with_table, 0.4), (_opened, 0.3)):
        if rng.random() < chance:
            problem = rule(rng, problem)
    return problem


def _with_places(rng: np.random.Generator, kind: VehicleType, ground: Square, orders: Orders,
                 prices: Prices, travel: tuple[Travel, ...],
                 day: tuple[int, float]) -> tuple[VehicleType, Reach]:
    """Draw drones, trips, depots, shift and limits of a type."""
    def somewhere() -> int:
        return integer(rng, 0, ground.num_depots - 1)

    kind = replace(kind, depot=somewhere(), start=somewhere() if rng.random() < 0.4 else None,
                   end=somewhere() if rng.random() < 0.4 else None)
    if rng.random() < 0.5:
        kind = replace(kind, drones=draw_drones(rng, ground, len(travel) - 1, orders, prices))
    if rng.random() < 0.5:
        also = np.flatnonzero(rng.random(ground.num_depots) < 0.5).tolist()
        kind = replace(kind, max_trips=integer(rng, 2, 3),
                       reload_depots=tuple([node for node in also if node != kind.depot]),
                       reload_duration=int(uniform(rng, 0.0, 0.3) * ground.crossing))
    opens, length = day
    kind, reach = with_shift(kind, reach_of(kind, travel, ground.num_depots),
                             orders.service_duration, opens, length)
    return with_limits(rng, kind, reach, orders.service_duration, ground, (0.4, 0.2)), reach


def _timed(rng: np.random.Generator, orders: Orders, reach: Reach, ground: Square,
           driving: float) -> Orders:
    """Draw windows, softness and release times."""
    width = log_uniform(rng, 0.5, 4.0) * ground.crossing
    orders = with_windows(rng, orders, reach, uniform(rng, 0.2, 0.9), (0.5 * width, 1.5 * width))
    if rng.random() < 0.3:
        orders = with_soft_windows(rng, orders, driving, 0.5)
    if rng.random() < 0.2:
        orders = with_releases(rng, orders, reach, uniform(rng, 0.2, 1.0))
    return orders


def _on_duty(rng: np.random.Generator, kind: VehicleType, ground: Square, prices: Prices,
             driving: float) -> VehicleType:
    """Draw overtime, what stops and loads cost, limits of trips, and a battery."""
    if rng.random() < 0.4:
        longest = (UNLIMITED if rng.random() < 0.3
                   else int(uniform(rng, 0.2, 2.0) * ground.crossing))
        kind = replace(kind, overtime=Overtime(driving * uniform(rng, 0.2, 3.0), longest))
    if rng.random() < 0.4:
        kind = replace(kind, cost_per_stop=driving * ground.crossing_hours * uniform(rng, 0, 0.3))
    if rng.random() < 0.3:
        per_load = prices.per_km * uniform(rng, 0.1, 2.0) * 1000 / kind.capacity[0]
        kind = replace(kind, cost_per_load_km=per_load)
    if rng.random() < 0.4:
        kind = replace(kind, max_stops=integer(rng, 2, 12))
    drones = kind.drones
    if drones is None:
        return kind
    if rng.random() < 0.4:
        kind = replace(kind, max_sorties=integer(rng, 1, 4))
    if rng.random() < 0.5:
        kind = replace(kind, drones=_with_battery(rng, drones, ground))
    return kind


def _with_battery(rng: np.random.Generator, drones: DroneType, ground: Square) -> DroneType:
    """Return drones limited by a battery, too, or instead of the endurance.

    It lasts for whatever the endurance allows, or one of 0.3 to 3 crossings, with the payload
    aboard: so who can be served stays so.
    """
    longest = drones.endurance
    if longest == UNLIMITED:
        longest = int(log_uniform(rng, 0.3, 3.0) * ground.crossing)
    elif rng.random() < 0.5:
        drones = replace(drones, endurance=UNLIMITED)
    empty = log_uniform(rng, 5e4, 2e6)
    full = empty * uniform(rng, 1.0, 4.0)

    def powers(share: float) -> tuple[int, int]:
        return int(empty * share), int(full * share)

    climb = int(uniform(rng, 0.0, 0.02) * ground.crossing) if rng.random() < 0.5 else 0
    most = powers(1.5)[1]
    return replace(drones, energy=Energy(
        available=most * (longest + 4 * climb), usable_share=0.8, weights=(0, drones.capacity[0]),
        cruise=powers(1.0), hover=powers(uniform(rng, 0.5, 1.2)),
        climb=powers(uniform(rng, 1.0, 1.5)), descent=powers(uniform(rng, 0.3, 1.0)),
        climb_duration=climb, descent_duration=climb, lands=rng.random() < 0.7))


def _with_gaps(rng: np.random.Generator, problem: Problem) -> Problem:
    """Cut some windows into two to four."""
    share = uniform(rng, 0.2, 1.0)

    def cut(customer: Customer) -> Customer:
        if customer.latest == UNLIMITED or rng.random() > share:
            return customer
        cuts = np.unique(rng.integers(customer.earliest, customer.latest + 1,
                                      2 * integer(rng, 1, 3))).tolist()
        return replace(customer, gaps=tuple(zip(cuts[::2], cuts[1::2], strict=False)))

    return replace(problem, customers=tuple(map(cut, problem.customers)))


def _with_prices(rng: np.random.Generator, problem: Problem) -> Problem:
    """Let some customers be left out for 0.05 to 2 direct trips."""
    share, direct = uniform(rng, 0.2, 1.0), problem.unassigned_cost / 10
    return replace(problem, customers=tuple([
        replace(customer, unassigned_cost=direct * log_uniform(rng, 0.05, 2.0))
        if rng.random() < share else customer for customer in problem.customers]))


def _collecting(rng: np.random.Generator, problem: Problem) -> Problem:
    """Let trucks pick up at some customers, at some of them nothing else; some types do so last."""
    share, alone = uniform(rng, 0.2, 1.0), uniform(rng, 0.0, 0.6)
    amounts = np.array([customer.demand for customer in problem.customers], np.int64)
    by_drone = np.array([[customer.served_by == "drone"] for customer in problem.customers])
    takes = (rng.random(by_drone.shape) < share) & ~by_drone
    taken = np.where(takes, rng.permutation(amounts), 0)
    given = np.where(takes & (rng.random(by_drone.shape) < alone), 0, amounts)
    customers = tuple([replace(customer, demand=tuple(demand)) for customer, demand
                       in zip(problem.customers, given.tolist(), strict=True)])
    kinds = tuple([replace(kind, pickups="last") if kind.id != FIRST and rng.random() < 0.3
                   else kind for kind in problem.vehicle_types])
    return with_pickups(replace(problem, customers=customers, vehicle_types=kinds), taken)


def _with_table(rng: np.random.Generator, problem: Problem) -> Problem:
    """Draw who may serve whom: the first type everyone, others 50 to 95 %."""
    size = (len(problem.vehicle_types), problem.num_customers)
    table = rng.random(size) < uniform(rng, 0.5, 0.95)
    table[[kind.id == FIRST for kind in problem.vehicle_types]] = True
    return replace(problem, may_serve=table)


def _opened(rng: np.random.Generator, problem: Problem) -> Problem:
    """Let some types' last trips end with their last customer."""
    return with_open_ends(problem, rng.random(len(problem.vehicle_types)) < 0.7)
