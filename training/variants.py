"""Classes of random problems, each a function that draws its rules anew.

Shared by all, so not restated below:

- Space: a square whose side is 0.1 to 300 km (log-uniform), driven at 4 to 90 km/h. Points are
  uniform, clustered, or half of each (`ground.draw_points`). Durations are drawn as shares of the
  crossing, the time to drive one side.
- Money: driving one side costs 0.01 to 1000 (log-uniform); other prices are shares of it
  (`fleets.draw_prices`). Amounts are integers times a unit of 0.001 to 1000
  (`orders.draw_demand`). So nothing but ratios can be learnt.
- Service: none, equal, or spread around 0.02 to 0.25 crossings (`orders.draw_service`).
- A window opens uniformly between the earliest arrival from the depot and the last opening that
  still allows the return (`orders.with_windows`). Shifts and limits leave room for any one
  customer, so each can be served alone; that all can at once is not checked: fleets may be short.
- Leaving a customer out costs ten times the dearest direct trip (`fleets.drawn_unassigned_cost`).

| variant | what it adds |
| --- | --- |
| `cvrp` | capacity for 5 to 20 customers, one vehicle per customer, distance only |
| `vrptw` | hard windows, distance only: the learned-solver papers' uniform set or like Solomon's |
| `appointed` | hard windows about the times of a plan, like Solomon's classes C; long service |
| `soft` | soft windows (some hard), waiting may cost, time costs, 1 to 1.6 times the fleet needed |
| `hetero` | 2 to 4 types of capacity, speed, cost and count; skills; 1 to 3 dimensions |
| `multitrip` | 1 to 3 trips, reloading, shifts, limits, release times, windows, speed profiles |
| `drone` | 1 to 4 trucks with 1 or 2 drones, reserved customers, cost or completion time |
| `table1` | the shape of the seed paper's Table 1: tight packing, one drone per truck |
| `mixed` | all of these at once, 1 or 2 depots, asymmetric roads, a few customers unservable |
| `pickups` | amounts both ways, or pickups last, open ends, prices of what is aboard |
| `various` | rules that all those lack: places, overtime, stops, batteries, windows, tables, … |
| `particular` | and those: addresses, setups, service by type, freshness, goods, batteries, … |
| `shipments` | parcels that are fetched at one customer and brought to another |
| `chosen` | several places of a customer, prices by vehicle |
| `related` | customers who go together, apart, or one before another |
| `resting` | breaks, rests by driving rules, limits of all legs together |

References
----------
Solomon (1987), Operations Research 35:254-265, for the classes of windows; Uchoa et al. (2017),
EJOR 257:845-858, for the places of depots and clusters.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from model.problem import DroneType, FloatArray, IntArray, Problem, VehicleType
from training.fleets import (
    assemble,
    capacity_for,
    draw_drones,
    draw_prices,
    draw_profile,
    draw_types,
    shuffled,
    truck_type,
    vehicles_needed,
    with_limits,
    with_shift,
)
from training.ground import Square, draw_points, integer, lay_ground, log_uniform, uniform
from training.orders import (
    DRONE,
    EITHER,
    TRUCK,
    Orders,
    draw_demand,
    draw_service,
    open_orders,
    reach_of,
    with_appointments,
    with_modes,
    with_releases,
    with_skills,
    with_soft_windows,
    with_windows,
)

UNIFORM_CAPACITIES = ((20, 50, 100), (30, 40, 50))
"""Customers, and the capacity that the uniform set of the learned-solver papers gives them."""

LEAST_DEMAND, MOST_DEMAND = np.array((2, 8, 0)), np.array((24, 32, 8))
"""Range of demands in `table1`, by index into `SERVED_BY`."""


@dataclass(frozen=True)
class InstanceConfig:
    """Ranges and chances that all variants share."""

    side_km: tuple[float, float] = (0.1, 300.0)  # log-uniform
    speed_kmh: tuple[float, float] = (4.0, 90.0)  # log-uniform
    clustered: float = 0.3  # chance that all customers lie in clusters
    half_clustered: float = 0.2  # chance that each does by the toss of a coin
    second_depot: float = 0.4  # chance, in `mixed`
    asymmetric: float = 0.4  # chance, in `mixed`
    max_noise: float = 0.4  # longest share by which an asymmetric leg exceeds the straight line
    spoiled: float = 0.3  # chance that `mixed` holds unservable customers
    max_spoiled: float = 0.1  # largest share of them


def draw_ground(rng: np.random.Generator, num_customers: int, config: InstanceConfig,
                num_depots: int = 1, noise: float = 0.0) -> Square:
    """Draw points, side and speed."""
    layout = rng.random()
    clustered = 0.0
    if layout < config.clustered:
        clustered = 1.0
    elif layout < config.clustered + config.half_clustered:
        clustered = 0.5
    points = draw_points(rng, num_depots, num_customers, clustered)
    return _scaled(rng, points, config, num_depots, noise)


def _scaled(rng: np.random.Generator, points: FloatArray, config: InstanceConfig,
            num_depots: int = 1, noise: float = 0.0) -> Square:
    return lay_ground(rng, points, num_depots, log_uniform(rng, *config.side_km),
                      log_uniform(rng, *config.speed_kmh), noise)


def cvrp(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """One type, as many vehicles as customers, 5 to 20 mean demands a trip, distance only."""
    ground = draw_ground(rng, num_customers, config)
    demand = draw_demand(rng, num_customers)
    orders = open_orders(demand, np.zeros(num_customers, dtype=np.int64))
    truck = truck_type("truck", num_customers, capacity_for(demand, uniform(rng, 5, 20)),
                   draw_prices(rng, ground, fixed=0.0, distance=1.0, time=0.0))
    return assemble(ground, orders, (truck,), (ground.road(),))


def vrptw(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Hard windows, distance only; `uniform_vrptw` or `solomon_vrptw`, evenly."""
    draw = uniform_vrptw if rng.random() < 0.5 else solomon_vrptw
    return draw(rng, num_customers, config)


def uniform_vrptw(rng: np.random.Generator, num_customers: int,
                  config: InstanceConfig) -> Problem:
    """The distribution of the learned-solver papers, at any scale.

    Uniform points, horizon 4.6 crossings, service 0.15 to 0.18, windows of 0.18 to 0.2 at every
    customer, demands 1 to 9, capacity 30, 40 and 50 for 20, 50 and 100 customers.
    """
    ground = _scaled(rng, rng.random((num_customers + 1, 2)), config)
    demand = rng.integers(1, 10, size=(num_customers, 1)) * 1000
    service = (ground.crossing * (0.15 + 0.03 * rng.random(num_customers))).astype(np.int64)
    capacity = int(np.interp(num_customers, *UNIFORM_CAPACITIES)) * 1000
    truck = truck_type("truck", num_customers, (capacity,),
                   draw_prices(rng, ground, fixed=0.0, distance=1.0, time=0.0))
    return _with_hard_windows(rng, ground, open_orders(demand, service), truck, 4.6, 1.0,
                              (0.18, 0.2))


def solomon_vrptw(rng: np.random.Generator, num_customers: int,
                  config: InstanceConfig) -> Problem:
    """Like Solomon's classes: short or long days, narrow or wide windows at 25 to 100 %.

    A short day is 2.5 to 5 crossings with 8 to 16 mean demands a trip, a long one (40 %) 8 to 36
    crossings with 15 to 60. Windows are 2 to 10 % of the day or 10 to 50 % of it; half of the
    time widths are nearly equal.
    """
    ground = draw_ground(rng, num_customers, config)
    demand, service = draw_demand(rng, num_customers), draw_service(rng, num_customers, ground)
    is_long = rng.random() < 0.4
    day = log_uniform(rng, 8, 36) if is_long else uniform(rng, 2.5, 5)
    customers = log_uniform(rng, 15, 60) if is_long else uniform(rng, 8, 16)
    mean = day * (log_uniform(rng, 0.02, 0.1) if rng.random() < 0.5 else uniform(rng, 0.1, 0.5))
    spread = 0.05 if rng.random() < 0.5 else 0.8
    truck = truck_type("truck", num_customers, capacity_for(demand, customers),
                   draw_prices(rng, ground, fixed=0.0, distance=1.0, time=0.0))
    share = (0.25, 0.5, 0.75, 1.0)[integer(rng, 0, 3)]
    return _with_hard_windows(rng, ground, open_orders(demand, service), truck, day, share,
                              ((1 - spread) * mean, (1 + spread) * mean))


def _with_hard_windows(rng: np.random.Generator, ground: Square, orders: Orders,
                       truck: VehicleType, day: float, share: float,
                       width: tuple[float, float]) -> Problem:
    """Finish an instance of one truck type; day and width in crossings."""
    travel = (ground.road(),)
    truck, reach = with_shift(truck, reach_of(truck, travel, 1), orders.service_duration, 0,
                              day * ground.crossing)
    low, high = width[0] * ground.crossing, width[1] * ground.crossing
    return assemble(ground, with_windows(rng, orders, reach, share, (low, high)), (truck,), travel)


def appointed(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Hard windows about the times at which a plan of nearest neighbours would serve.

    Mostly clustered. Service takes 0.05 to 1.2 crossings, equal or spread. A trip of the plan has 6
    to 40 customers, and a load 0.9 to 1.5 times their mean demands. Windows at 25 to 100 % of the
    customers are 3 to 40 % of the day wide, which is the plan's longest trip and up to as much
    again.
    """
    layout = rng.random()
    points = draw_points(rng, 1, num_customers,
                         1.0 if layout < 0.5 else 0.5 if layout < 0.75 else 0.0)
    ground = _scaled(rng, points, config)
    demand = draw_demand(rng, num_customers)
    spread = 0.0 if rng.random() < 0.5 else 0.8
    factor = 1.0 + spread * (rng.random(num_customers) - 0.5)
    mean = log_uniform(rng, 0.05, 1.2) * ground.crossing
    orders = open_orders(demand, (mean * factor).astype(np.int64))
    customers = log_uniform(rng, 6, 40)
    start, longest = _times_of_plan(rng, ground, orders.service_duration, math.ceil(customers))
    truck = truck_type("truck", num_customers,
                       capacity_for(demand, customers * uniform(rng, 0.9, 1.5)),
                       draw_prices(rng, ground, fixed=0.0, distance=1.0, time=0.0))
    travel = (ground.road(),)
    truck, reach = with_shift(truck, reach_of(truck, travel, 1), orders.service_duration, 0,
                              longest * uniform(rng, 1.05, 2.0))
    width = log_uniform(rng, 0.03, 0.4) * truck.latest
    orders = with_appointments(rng, orders, reach, (0.25, 0.5, 0.75, 1.0)[integer(rng, 0, 3)],
                               start, width)
    return assemble(ground, orders, (truck,), travel)


def _times_of_plan(rng: np.random.Generator, ground: Square, service: IntArray,
                   customers: int) -> tuple[IntArray, float]:
    """Return when each customer's service begins in a plan, and how long its longest trip takes.

    Trips begin with a random customer not yet served and go on to the nearest.
    """
    duration = ground.road().duration
    start, longest = np.zeros(len(service), dtype=np.int64), 0.0
    left = rng.permutation(len(service)) + 1
    while left.size:
        place, now = 0, 0
        for number in range(min(customers, left.size)):
            chosen = 0 if number == 0 else int(duration[place, left].argmin())
            following = int(left[chosen])
            now += int(duration[place, following])
            start[following - 1] = now
            now += int(service[following - 1])
            place, left = following, np.delete(left, chosen)
        longest = max(longest, now + float(duration[place, 0]))
    return start, longest


def soft(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Soft windows of 0.05 to 1.5 crossings in a day of 3 to 10, at 30 to 100 % of the customers.

    In three of ten instances, 30 % of the windows are hard. Time always costs, distance mostly,
    vehicles often; 4 to 16 mean demands a trip. The shift ends 1.3 days after it begins.
    """
    ground = draw_ground(rng, num_customers, config)
    demand, service = draw_demand(rng, num_customers), draw_service(rng, num_customers, ground)
    orders, travel = open_orders(demand, service), (ground.road(),)
    day = uniform(rng, 3, 10) * ground.crossing
    prices = draw_prices(rng, ground, fixed=0.5, distance=0.7, time=1.0)
    capacity = capacity_for(demand, uniform(rng, 4, 16))
    count = math.ceil(vehicles_needed(ground, orders, capacity, day) * uniform(rng, 1.0, 1.6))
    truck = truck_type("truck", count, capacity, prices)
    truck, reach = with_shift(truck, reach_of(truck, travel, 1), service,
                              int(integer(rng, 0, 8) * ground.crossing), day)
    width = log_uniform(rng, 0.05, 1.5) * ground.crossing
    orders = with_windows(rng, orders, reach, uniform(rng, 0.3, 1.0), (0.5 * width, 1.5 * width))
    orders = with_soft_windows(rng, orders, prices.per_hour, 0.7 if rng.random() < 0.3 else 1.0)
    truck = replace(truck, latest=truck.latest + int(0.3 * day))
    return assemble(ground, orders, (truck,), travel)


def hetero(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """2 to 4 types, skills at 0 or 5 to 25 % of the customers, 1 to 3 dimensions.

    Fixed costs mostly; half of the instances have hard windows of 0.1 to 2 crossings at 30 to
    100 % of the customers, in a day of 4 to 10.
    """
    ground = draw_ground(rng, num_customers, config)
    demand = draw_demand(rng, num_customers, integer(rng, 1, 3))
    orders = open_orders(demand, draw_service(rng, num_customers, ground))
    prices = draw_prices(rng, ground, fixed=0.8, distance=0.9, time=0.4)
    day = uniform(rng, 4, 10) * ground.crossing if rng.random() < 0.5 else math.inf
    types, travel = draw_types(rng, ground, orders, prices, integer(rng, 2, 4), day)
    if rng.random() < 0.6:
        orders = with_skills(rng, orders, uniform(rng, 0.05, 0.25))
    if day < math.inf:
        first, reach = with_shift(types[0], reach_of(types[0], travel, 1),
                                  orders.service_duration, 0, day)
        types = tuple(replace(kind, latest=first.latest) for kind in types)
        width = log_uniform(rng, 0.1, 2.0) * ground.crossing
        orders = with_windows(rng, orders, reach, uniform(rng, 0.3, 1.0), (0.5 * width, width))
    return assemble(ground, orders, shuffled(rng, types), travel)


def multitrip(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """1 to 3 trips of 4 to 10 mean demands in a shift made for 0.8 to 1.6 times that many.

    Reloading takes up to 0.3 crossings. By chance: a working limit (50 %), a distance limit
    (30 %), release times (50 %, at 20 to 100 % of the customers), a speed profile (40 %), hard
    windows (60 %, of 0.2 to 2 crossings at 20 to 100 %). Vehicles: 1.1 to 2 times those needed.
    """
    ground = draw_ground(rng, num_customers, config)
    demand, service = draw_demand(rng, num_customers), draw_service(rng, num_customers, ground)
    orders, travel = open_orders(demand, service), (ground.road(),)
    trips, customers = integer(rng, 1, 3), uniform(rng, 4, 10)
    capacity = capacity_for(demand, customers)
    opens = int(integer(rng, 0, 8) * ground.crossing)
    trip = ground.crossing * (1.0 + 0.3 * customers) + customers * float(service.mean())
    length = trips * trip * uniform(rng, 0.8, 1.6)
    needed = vehicles_needed(ground, orders, capacity, length, trips)
    count = math.ceil(needed * uniform(rng, 1.1, 2.0))
    truck = replace(truck_type("truck", count, capacity, draw_prices(rng, ground, 0.5, 0.8, 0.4)),
                    max_trips=trips, reload_duration=int(uniform(rng, 0, 0.3) * ground.crossing))
    if rng.random() < 0.4:
        truck = replace(truck, speed_profile=draw_profile(rng, opens, opens + int(length)))
    truck, reach = with_shift(truck, reach_of(truck, travel, 1), service, opens, length)
    truck = with_limits(rng, truck, reach, service, ground, (0.5, 0.3))
    if rng.random() < 0.6:
        width = log_uniform(rng, 0.2, 2.0) * ground.crossing
        orders = with_windows(rng, orders, reach, uniform(rng, 0.2, 1.0), (0.5 * width, width))
    if rng.random() < 0.5:
        orders = with_releases(rng, orders, reach, uniform(rng, 0.2, 1.0))
    return assemble(ground, orders, (truck,), travel)


def drone(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """1 to 4 trucks of one type with drones 0.8 to 3 times as fast (`fleets.draw_drones`).

    Trucks are filled to 50 to 95 %. Three of ten instances cost nothing but time, the others
    distance and by chance time. Up to 15 % of the customers are for drones only, up to 20 % for
    trucks only. One instance in five has hard windows of 0.3 to 2 crossings at 20 to 80 %.
    """
    ground = draw_ground(rng, num_customers, config)
    demand, service = draw_demand(rng, num_customers), draw_service(rng, num_customers, ground)
    only_time = rng.random() < 0.3
    prices = draw_prices(rng, ground, 0.0 if only_time else 0.3, 0.0 if only_time else 1.0,
                         1.0 if only_time else 0.4)
    travel = (ground.road(), ground.flight(log_uniform(rng, 0.8, 3.0)))
    trucks, orders = integer(rng, 1, 4), open_orders(demand, service)
    capacity = capacity_for(demand, num_customers / trucks / uniform(rng, 0.5, 0.95))
    truck = replace(truck_type("truck", trucks, capacity, prices),
                    drones=draw_drones(rng, ground, 1, orders, prices))
    is_windowed = rng.random() < 0.2
    orders = with_modes(rng, orders, truck, travel[1],
                        (uniform(rng, 0.0, 0.15), uniform(rng, 0.0, 0.2)), is_windowed)
    if is_windowed:
        day = (2.0 + 0.4 * num_customers / trucks) * uniform(rng, 0.8, 1.6) * ground.crossing
        truck, reach = with_shift(truck, reach_of(truck, travel, 1), service, 0, day)
        width = log_uniform(rng, 0.3, 2.0) * ground.crossing
        orders = with_windows(rng, orders, reach, uniform(rng, 0.2, 0.8), (0.5 * width, width))
    return assemble(ground, orders, (truck,), travel)


def table1(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """The shape of the seed paper's Table 1; `config` has no part in it.

    75 km by 75 km, uniform; 10 % for drones only (demand 0 to 8), 10 % for trucks only (8 to 32),
    the others for either (2 to 24). One truck per 25 customers with one drone that carries 10 and
    flies 1 to 2 times as fast, however long. A kilometre costs 1, by drone 1 or 0.25 to 1.
    The trucks' capacity is filled to 85 to 98.5 %.
    """
    points = rng.random((num_customers + 1, 2))
    ground = lay_ground(rng, points, 1, side_km=75.0, speed_kmh=40.0)
    reserved = round(0.1 * num_customers)
    kinds = np.full(num_customers, EITHER)
    kinds[:reserved] = DRONE
    kinds[num_customers - reserved:] = TRUCK
    kinds = rng.permutation(kinds)
    demand = rng.integers(LEAST_DEMAND[kinds], MOST_DEMAND[kinds] + 1)[:, None] * 1000
    orders = replace(open_orders(demand, np.zeros(num_customers, dtype=np.int64)),
                     served_by=kinds)
    trucks = max(round(num_customers / 25), 1)
    room = math.ceil(int(demand.sum()) / uniform(rng, 0.85, 0.985) / trucks / 1000) * 1000
    flights = DroneType(1, (10_000,), travel=1,
                        cost_per_km=1.0 if rng.random() < 0.5 else uniform(rng, 0.25, 1.0))
    truck = VehicleType("truck", trucks, (max(room, int(demand.max())),), travel=0,
                        cost_per_km=1.0, drones=flights)
    travel = (ground.road(), ground.flight(uniform(rng, 1.0, 2.0)))
    return assemble(ground, orders, (truck,), travel)
