"""What a candidate leads to: its unserved neighbours, near by and in time. Compiled.

A policy that builds a plan step by step must guess what a step costs later. These features look
one customer further: what comes next, what can no longer come, what would better come before.
"""

from typing import NamedTuple

from model.kernel.compiled import inlined
from model.kernel.flight import unreachable
from model.kernel.instance import NONE
from model.kernel.leg import lookup
from model.kernel.load import demand_of, num_tiers, picked_of
from model.kernel.records import Record
from model.kernel.stop import (
    closing, end_of_service, lateness, service_duration, start_of_service, waiting,
)
from model.problem import UNLIMITED, BoolArray, IntArray
from model.simulation.vehicle_log import Setting

NUM_COMPANY = 3
"""How many unserved neighbours of a candidate are looked at for how near they are."""
NUM_PROSPECTS = 8
"""How many unserved neighbours of a candidate are timed."""


class Unit(NamedTuple):
    """The units of one problem that steps need: ms, ms, cost."""

    time: float
    near: float
    cost: float


@inlined
def ratio(value: float, scale: float) -> float:
    """Squash a length of any size to 0..1, half at `scale`."""
    return value / (value + scale) if value > 0 else 0.0


@inlined
def slack(limit: int, used: int, scale: float) -> float:
    """Squash what a limit leaves to 0..1, half at `scale`; 1 where there is no limit."""
    return 1.0 if limit >= UNLIMITED else ratio(float(limit - used), scale)


@inlined
def excess(value: int, scale: float) -> float:
    """Clip a difference to three times `scale`, -1..1; 1 where there is nothing to compare."""
    return 1.0 if value >= UNLIMITED else max(min(value / scale / 3.0, 1.0), -1.0)


@inlined
def _describe_company(drive: IntArray, neighbours: IntArray, served: BoolArray, here: int,
                      node: int, unit: Unit, feature: Record) -> None:
    """Describe how close a candidate's unserved neighbours are. In place."""
    found = 0
    feature.next_way = feature.third_way = feature.next_excess = 1.0
    for rank in range(neighbours.shape[1]):
        other = neighbours[node, rank]
        if other < 0 or found == NUM_COMPANY:
            return
        if served[other]:
            continue
        found += 1
        way = lookup(drive, node, other)
        feature.third_way = ratio(way, unit.near)
        if found == 1:
            feature.next_way = feature.third_way
            feature.next_excess = excess(way - lookup(drive, here, node), unit.near)


@inlined
def _asked(setting: Setting, node: int) -> int:
    """Return what a customer asks to be carried in the first dimension, whichever way is more."""
    delivered = demand_of(setting.node[node])[0]
    if num_tiers(setting.amount) == 0:
        return delivered
    return max(delivered, picked_of(setting.amount, node, 0)[0])


@inlined
def _describe_drive(setting: Setting, neighbours: IntArray, served: BoolArray, load: int,
                    here: int, node: int, outlook: Record, unit: Unit,
                    feature: Record) -> None:
    """Describe which neighbours could be driven to after `node`, and from which to it. In place.

    By fixed speeds, the first dimension of the `load` left, and without drones: a guess.
    """
    nodes, drive, place = setting.node, setting.drive, setting.node[node]
    arrival, way = outlook.arrival, lookup(setting.drive, here, node)
    leave = outlook.start + service_duration(place)
    left = load - _asked(setting, node)
    soonest = tightest = detour = later = UNLIMITED
    seen = lost = 0
    for rank in range(neighbours.shape[1]):
        other = neighbours[node, rank]
        if other < 0 or seen == NUM_PROSPECTS:
            break
        if served[other]:
            continue
        seen += 1
        there, latest = nodes[other], closing(nodes[other])
        past, back = lookup(drive, here, other), lookup(drive, other, node)
        then, directly = leave + lookup(drive, node, other), arrival - way + past
        if lateness(place, end_of_service(there, NONE) + back) == 0:
            later = min(later, back + waiting(place, latest + service_duration(there) + back))
        if then <= latest and _asked(setting, other) <= left:
            soonest = min(soonest, start_of_service(there, then) - leave)
            if latest < UNLIMITED:
                tightest = min(tightest, latest - then)
        elif directly <= latest:
            lost += 1
        if directly <= latest and lateness(place, end_of_service(there, directly) + back) == 0:
            detour = min(detour, past + back - way)
    feature.next_duration = 1.0 if soonest >= UNLIMITED else ratio(float(soonest), unit.near)
    feature.next_slack = slack(tightest, 0, unit.time)
    feature.lost = lost / max(1, seen)
    feature.detour_before = excess(detour, unit.near)
    feature.later_duration = 1.0 if later >= UNLIMITED else ratio(float(later), unit.near)


@inlined
def _describe_flight(setting: Setting, neighbours: IntArray, served: BoolArray, here: int,
                     node: int, outlook: Record, unit: Unit, feature: Record) -> None:
    """Describe at which neighbours the drone could meet the truck. In place.

    How soon, how long the truck would wait, and the least detour of the truck to serve `node`
    itself on its way to one.
    """
    drive, fly = setting.drive, setting.fly_home
    takeoff = outlook.arrival - lookup(setting.fly, here, node)
    ready = outlook.start + service_duration(setting.node_by_air[node])
    soonest = wait = detour = UNLIMITED
    seen = 0
    for rank in range(neighbours.shape[1]):
        other = neighbours[node, rank]
        if other < 0 or seen == NUM_PROSPECTS:
            break
        if served[other] or unreachable(lookup(fly, node, other)):
            continue
        seen += 1
        drone, truck = ready + lookup(fly, node, other) - takeoff, lookup(drive, here, other)
        soonest = min(soonest, max(drone, truck))
        wait = min(wait, max(0, drone - truck))
        detour = min(detour, lookup(drive, here, node) + lookup(drive, node, other) - truck)
    feature.next_duration = 1.0 if soonest >= UNLIMITED else ratio(float(soonest), unit.near)
    feature.next_slack = 1.0 if wait >= UNLIMITED else ratio(float(wait), unit.near)
    feature.detour_before = excess(detour, unit.near)


@inlined
def describe_neighbours(setting: Setting, neighbours: IntArray, served: BoolArray, load: int,
                        here: int, node: int, outlook: Record, unit: Unit, by_air: bool,
                        feature: Record) -> None:
    """Describe what serving `node` from `here` means for its unserved neighbours. In place.

    Parameters
    ----------
    setting
        The open vehicle's.
    neighbours
        (node, rank) nearest first, -1 behind the last.
    served
        (node,).
    load
        Of the open vehicle, what is left in the first dimension.
    here
        Node of the vehicle.
    node
        The candidate.
    outlook
        Of `legal_actions`.
    unit
        Of the problem.
    by_air
        A drone serves the candidate.
    feature
        ACTION of the candidate.
    """
    _describe_company(setting.drive, neighbours, served, here, node, unit, feature)
    if by_air:
        _describe_flight(setting, neighbours, served, here, node, outlook, unit, feature)
    else:
        _describe_drive(setting, neighbours, served, load, here, node, outlook, unit, feature)
