"""A problem whose limits may be exceeded at a price, and what is left of its plans in the true one.

A search comes from one plan to another through such as break a limit for a while, as one must that
inserts the customers of a group one at a time (Nagata and Bräysy 2009 have vehicles reduced so).
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from model.judge.network import Network
from model.problem import (
    MAX_QUANTITY, MM_PER_KM, MS_PER_HOUR, BoolArray, Customer, Overtime, Problem, Travel,
    VehicleType,
)
from model.together.joint import Joint

PENALTY = 50.0
"""What a leg that no truck can drive in time costs, by what one costs on average that it can."""

LEFT_OUT = 1000.0
"""What leaving somebody out costs, by such a leg: nobody is, as long as vehicles hold all."""


ENDLESS = MAX_QUANTITY - 1
"""Who may work for so many milliseconds, or longer, works as long as there is anything to do."""


def relaxed(problem: Problem, joint: Joint) -> Problem | None:
    """Return the problem with soft limits for trucks alone; None if no truck can serve anybody."""
    kinds = range(len(problem.vehicle_types))
    streets = [joint.streets(kind) for kind in kinds]
    nets = [None if each is None else each.net for each in streets]
    known = [net for net in nets if net is not None]
    if not known:
        return None
    horizon = max(map(_horizon, known))
    cost = max(1e-6, float(np.mean([_leg_cost(net) for net in known])))
    price = PENALTY * cost * MS_PER_HOUR / horizon
    return replace(
        problem,
        customers=tuple(_soft(customer, price, LEFT_OUT * PENALTY * cost)
                        for customer in problem.customers),
        vehicle_types=tuple(_tireless(kind, price, horizon) for kind in problem.vehicle_types),
        travel=tuple(_capped(problem, index, known, min(2 * horizon, MAX_QUANTITY))
                     for index in range(len(problem.travel))),
        unassigned_cost=LEFT_OUT * PENALTY * cost)


def _horizon(net: Network) -> int:
    """Return how long a route may last, or, if it may last for ever, would by legs that are driven.
    """
    kind = net.vehicle_type
    if min(net.latest_end, net.longest_work) < ENDLESS:
        return max(1, min(net.latest_end - kind.earliest, net.longest_work))
    return max(1, int(np.where(_driven(net), net.ride, 0).max(axis=0).sum()))


def _driven(net: Network) -> BoolArray:
    """Mark (place, place) legs that a truck can drive in time."""
    arrival = net.left_from[:, None] + net.ride
    leave = np.maximum(arrival, net.opens) + net.service
    driven: BoolArray = ((arrival <= net.closes) & (leave + net.rest <= net.latest_end)
              & (net.far_there[:, None] + net.far <= net.longest_trip)
              & (net.ride <= net.longest_work))
    driven[:, :net.num_depots] = net.left_from[:, None] + net.ride[:, :net.num_depots] <= (
        net.latest_end)
    np.fill_diagonal(driven, False)
    return driven


def _leg_cost(net: Network) -> float:
    """Return what a leg costs on average that a truck can drive in time."""
    driven, kind = _driven(net), net.vehicle_type
    if not driven.any():
        return 0.0
    return float(net.far[driven].mean() * kind.cost_per_km / MM_PER_KM
                 + net.ride[driven].mean() * kind.cost_per_hour / MS_PER_HOUR)


def _soft(customer: Customer, price: float, left_out: float) -> Customer:
    late = price if customer.late_cost_per_hour is None else customer.late_cost_per_hour
    return replace(customer, late_cost_per_hour=late, max_time_aboard=None,
                   unassigned_cost=None if customer.unassigned_cost is None else left_out)


def _tireless(kind: VehicleType, price: float, horizon: int) -> VehicleType:
    """Return a type whose trucks may work longer, and drive farther, at a price."""
    endless = (kind.latest >= ENDLESS and kind.max_working_duration is None) or (
        kind.max_trip_distance is not None)
    return replace(
        kind, overtime=Overtime(price), max_trip_distance=None, drones=None, more_drones=(),
        charge_left=(), max_sorties=None,
        cost_per_hour=kind.cost_per_hour + (price if endless else 0.0))


def _capped(problem: Problem, index: int, nets: Sequence[Network], longest: int) -> Travel:
    """Return legs of which those that no truck can drive are all equally long."""
    own = [net for net in nets if net.vehicle_type.travel == index]
    duration, distance = problem.travel[index].arrays()
    if not own:
        return problem.travel[index]
    useful = np.zeros(duration.shape, np.bool_)
    for net in own:
        rows = net.nodes[:, None]
        useful[rows, net.nodes] |= _driven(net)
    far = ~useful & (duration > longest // 2)
    most = int(distance[useful].max(initial=0))
    return Travel(np.where(far, longest, duration).astype(np.int64),
                  np.where(far, np.minimum(distance, 2 * most), distance).astype(np.int64))
