"""What leaving a customer out costs where a request doesn't say."""

from collections.abc import Sequence

from model.problem import (
    FULL_SPEED, MAX_QUANTITY, MM_PER_KM, MS_PER_HOUR, USUAL_DECIMALS, Customer, Fairness, Relation,
    Travel, VehicleType,
)

DETOURS_PER_CUSTOMER = 10
"""A customer left out costs as much as this many vehicles sent out for it alone."""

NO_END = MAX_QUANTITY // 2 - 1
"""Milliseconds from which on a time is none: vehicles that lack a leg have to be back by then."""


def default_unassigned_cost(customers: Sequence[Customer], vehicle_types: Sequence[VehicleType],
                            travels: Sequence[Travel],
                            decimals: Sequence[int] = (USUAL_DECIMALS,),
                            fairness: Fairness | None = None,
                            relations: Sequence[Relation] = ()) -> float:
    """Return a cost larger than any detour: that of many vehicles used for one customer each.

    Each drives the longest leg there and back, full, serves longest, and works and is late or early
    as long as the latest time that the problem states, all lags, breaks and rests. Leaving out all
    who state a price of their own costs less, too. Amounts have so many `decimals`.
    """
    stated = [time for customer in customers
              for time in (*customer.openings, customer.latest, customer.release_time)]
    stated += [kind.latest for kind in vehicle_types]
    waits = sum([each.min_lag * len(each.nodes) for each in relations])
    horizon = (max([time for time in stated if time < NO_END], default=0) + waits) / MS_PER_HOUR
    served = [customer.service_duration for customer in customers]
    for kind in vehicle_types:
        served += kind.service_durations.values()
        for drones in kind.drone_types:
            served += drones.service_durations.values()
    setup = max([customer.setup_duration for customer in customers], default=0)
    service = (max(served, default=0) + setup) / MS_PER_HOUR
    longest = [_longest_leg(travel) for travel in travels]
    horizon += max(_paused(kind, 2 * longest[kind.travel][1] / _slowest(kind), service + horizon)
                   for kind in vehicle_types)
    fair = 0.0
    if fairness is not None and fairness.is_stated:
        hours = service + horizon + max(hours / _slowest(kind) * 2 for kind in vehicle_types
                                        for hours in [longest[kind.travel][1]])
        fair = _dearest_whole(customers, vehicle_types, fairness, hours,
                              2 * max(kilometres for kilometres, _ in longest))
    detour = max(_vehicle_cost(kind, longest, service + horizon)
                 + 2 * longest[kind.travel][0] * _cost_when_full(kind, decimals)
                 for kind in vehicle_types)
    # Whoever is served may make all others late.
    late = sum([customer.late_cost_per_hour or 0.0 for customer in customers])
    early = sum([customer.early_cost_per_hour for customer in customers])
    once = sum([customer.late_cost for customer in customers])
    stated_costs = sum([customer.unassigned_cost or 0.0 for customer in customers])
    return max(1.0, fair + DETOURS_PER_CUSTOMER * detour + (late + early) * horizon + once
               + stated_costs)


def _paused(kind: VehicleType, driven: float, others: float) -> float:
    """Return the hours of a vehicle's breaks and rests, by those that it drives, and others."""
    hours = sum([each.duration for each in kind.breaks]) / MS_PER_HOUR
    if kind.driving is not None:
        rules = kind.driving
        spans = (driven * MS_PER_HOUR / rules.max_driving
                 + (driven + others) * MS_PER_HOUR / rules.max_work)
        hours += (1 + spans) * max(rules.rest, sum(rules.split)) / MS_PER_HOUR
    return hours


def _slowest(kind: VehicleType) -> float:
    """Return how fast a vehicle is at least, as a share of its usual speed."""
    return min(kind.speed_profile.factors) / FULL_SPEED if kind.speed_profile else 1.0


def _dearest_whole(customers: Sequence[Customer], vehicle_types: Sequence[VehicleType],
                   fairness: Fairness, hours: float, kilometres: float) -> float:
    """Return what a plan costs as a whole at most, each customer taking so long and so far."""
    cost = hours * len(customers) * fairness.makespan_cost_per_hour
    if fairness.balance is None:
        return cost
    amount = max([customer.demand[0] + customer.taken_in[0] for customer in customers], default=0)
    share = {"duration": hours, "distance": kilometres, "stops": 1.0, "load": float(amount)}
    vehicles = min(len(customers), sum([kind.count for kind in vehicle_types]))
    work = len(customers) * share[fairness.balance.measure]
    return cost + fairness.balance.cost * work * max(0, vehicles - 1)


def _cost_when_full(kind: VehicleType, decimals: Sequence[int]) -> float:
    """Return what a full load costs per kilometre."""
    return kind.cost_per_load_km * kind.capacity[0] / 10**decimals[0]


def _vehicle_cost(kind: VehicleType, longest: Sequence[tuple[float, float]],
                  other_hours: float) -> float:
    """Return the cost of a vehicle, and its drones, that goes the longest leg there and back.

    `longest` has the kilometres and hours of each travel's.
    """
    slowest = _slowest(kind)
    kilometres, hours = longest[kind.travel]
    cost = (kind.fixed_cost + kind.cost_per_stop + 2 * kilometres * kind.cost_per_km
            + (2 * hours / slowest + other_hours) * kind.dearest_hour)
    for drones in kind.drone_types:
        kilometres, hours = longest[drones.travel]
        cost += (2 * kilometres * drones.cost_per_km
                 + (2 * hours + other_hours) * drones.cost_per_hour)
    return cost


def _longest_leg(travel: Travel) -> tuple[float, float]:
    """Return the largest distance in kilometres and the largest duration in hours."""
    milliseconds, millimetres = travel.longest()
    return millimetres / MM_PER_KM, milliseconds / MS_PER_HOUR
