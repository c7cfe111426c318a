"""The variant that has every rule at once."""

from dataclasses import replace

import numpy as np

from model.problem import Problem, Travel, VehicleType
from training.fleets import (
    Prices,
    assemble,
    draw_drones,
    draw_prices,
    draw_profile,
    draw_types,
    shuffled,
    with_limits,
    with_shift,
)
from training.ground import Square, integer, log_uniform, uniform
from training.orders import (
    UNOFFERED,
    Orders,
    Reach,
    draw_demand,
    draw_service,
    open_orders,
    reach_of,
    with_modes,
    with_releases,
    with_skills,
    with_soft_windows,
    with_windows,
)
from training.variants import InstanceConfig, draw_ground


def mixed(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Every rule at once, each by chance.

    1 to 3 types (`fleets.draw_types`), from 1 or 2 depots, roads asymmetric by up to 40 % a leg.
    The first type, which can serve every customer, has drones seven times out of ten, the others
    half as often; shares of the customers are reserved as in `drone`. Shifts of 3 to 12 crossings,
    trips, limits and profiles as in `multitrip`; windows at 20 to 90 % of the customers, soft in
    three of ten instances and partly soft in two; skills in three of ten; release times in three
    of ten. In 30 % of the instances up to 10 % of the customers can't be served (`_spoiled`).
    """
    depots = 2 if rng.random() < config.second_depot else 1
    noise = uniform(rng, 0.05, config.max_noise) if rng.random() < config.asymmetric else 0.0
    ground = draw_ground(rng, num_customers, config, depots, noise)
    demand = draw_demand(rng, num_customers, 1 if rng.random() < 0.7 else integer(rng, 2, 3))
    orders = open_orders(demand, draw_service(rng, num_customers, ground))
    prices = draw_prices(rng, ground, fixed=0.5, distance=0.8, time=0.5)
    opens = int(integer(rng, 0, 8) * ground.crossing)
    length = uniform(rng, 3.0, 12.0) * ground.crossing
    types, travel = draw_types(rng, ground, orders, prices, integer(rng, 1, 3), length)
    travel = (*travel, ground.flight(log_uniform(rng, 0.8, 3.0)))
    ruled = [_with_rules(rng, kind, ground, orders, prices, travel, (opens, length), index == 0)
             for index, kind in enumerate(types)]
    first, reach = ruled[0]
    orders = _timed(rng, orders, reach, ground, max(prices.per_hour, prices.per_km
                                                    * ground.side_km / ground.crossing_hours))
    if first.drones is not None:
        orders = with_modes(rng, orders, first, travel[-1],
                            (uniform(rng, 0.0, 0.15), uniform(rng, 0.0, 0.2)), depot_only=True)
    if rng.random() < 0.3:
        orders = with_skills(rng, orders, uniform(rng, 0.05, 0.25))
    if rng.random() < config.spoiled:
        orders = _spoiled(rng, orders, first, uniform(rng, 0.0, config.max_spoiled))
    return assemble(ground, orders, shuffled(rng, tuple(kind for kind, _ in ruled)), travel)


def _with_rules(rng: np.random.Generator, kind: VehicleType, ground: Square, orders: Orders,
                prices: Prices, travel: tuple[Travel, ...], day: tuple[int, float],
                is_first: bool) -> tuple[VehicleType, Reach]:
    """Draw depot, drones, trips, profile, shift and limits of a type."""
    opens, length = day
    kind = replace(kind, depot=integer(rng, 0, ground.num_depots - 1))
    if rng.random() < (0.7 if is_first else 0.35):
        kind = replace(kind, drones=draw_drones(rng, ground, len(travel) - 1, orders, prices))
    if rng.random() < 0.5:
        kind = replace(kind, max_trips=integer(rng, 2, 3),
                       reload_duration=int(uniform(rng, 0.0, 0.3) * ground.crossing))
    if rng.random() < 0.3:
        kind = replace(kind, speed_profile=draw_profile(rng, opens, opens + int(length)))
    if not is_first:
        later = int(uniform(rng, 0.0, 0.2) * length)
        opens, length = opens + later, length - later
    kind, reach = with_shift(kind, reach_of(kind, travel, ground.num_depots),
                             orders.service_duration, opens, length)
    return with_limits(rng, kind, reach, orders.service_duration, ground, (0.4, 0.2)), reach


def _timed(rng: np.random.Generator, orders: Orders, reach: Reach, ground: Square,
           cost_per_hour: float) -> Orders:
    """Draw windows, softness and release times."""
    width = log_uniform(rng, 0.2, 2.0) * ground.crossing
    orders = with_windows(rng, orders, reach, uniform(rng, 0.2, 0.9), (0.5 * width, 1.5 * width))
    softness = rng.random()
    if softness < 0.5:
        share = 1.0 if softness < 0.3 else 0.5
        orders = with_soft_windows(rng, orders, cost_per_hour, share)
    if rng.random() < 0.3:
        orders = with_releases(rng, orders, reach, uniform(rng, 0.2, 1.0))
    return orders


def _spoiled(rng: np.random.Generator, orders: Orders, largest: VehicleType,
             share: float) -> Orders:
    """Make a share of the customers unservable: too early, too heavy, or a skill no one has."""
    num_customers = len(orders.demand)
    fault = np.where(rng.random(num_customers) < share, rng.integers(1, 4, num_customers), 0)
    too_early, too_heavy = fault == 1, fault == 2
    heavy = np.array(largest.capacity) + 1 + orders.demand
    return replace(
        orders,
        earliest=np.where(too_early, 0, orders.earliest),
        latest=np.where(too_early, largest.earliest, orders.latest),
        late_cost=np.where(too_early, np.nan, orders.late_cost),
        demand=np.where(too_heavy[:, None], heavy, orders.demand),
        skills=np.where(fault == 3, UNOFFERED, orders.skills))
