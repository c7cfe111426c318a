"""Flights to those whom the truck serves at no more cost, which the search needn't look at.

Where distance and loads are all that counts, and a drone flies no shorter or cheaper than its truck
drives, a truck may as well drive to whomever it may serve: as legs are shortest ways, a detour from
one end of the flight is no longer than that. What is left then is a problem of trucks, but for
customers to whom only drones may come.
"""

from collections.abc import Collection
from dataclasses import MISSING, Field, fields, replace
from typing import Any

import numpy as np

from model.engine.instance import Instance
from model.problem import Customer, Depot, IntArray, Problem, VehicleType
from model.search.strategy import Moves

MOST_COMPARED = 1000
"""Nodes up to which all legs by truck and drone are compared, which takes 20 ms there."""

MOST_WALKED = 200
"""Nodes up to which ways by a third place are compared, as far as legs aren't computed: 40 ms."""

LEEWAY = 10
"""Millimetres by which a leg may be longer than another way, as each is rounded."""

PROBLEM = ("depots", "customers", "vehicle_types", "travel", "coordinates", "unassigned_cost",
           "amount_decimals", "may_serve", "must_serve", "incompatible_goods", "num_dimensions")
DEPOT = ("id", "kind", "site", "launch")
CUSTOMER = ("id", "demand", "service_duration", "served_by", "skills", "unassigned_cost", "goods",
            "site", "launch")
VEHICLE_TYPE = ("id", "count", "capacity", "travel", "depot", "fixed_cost", "cost_per_km",
                "earliest", "max_trips", "max_sorties", "max_airborne", "truck_waits",
                "reload_duration", "skills", "service_durations", "drones", "start", "end",
                "reload_depots", "part_of", "numbers", "straight", "co2_kg_per_km",
                "co2_kg_per_kwh")
"""What may be stated. Anything else, rules to come too, may make flights worth their while."""


def without_needless_flights(problem: Problem, instance: Instance,
                             moves: Moves) -> tuple[Instance, Moves]:
    """Return a problem, packed alone, in which no drone flies to whom its truck may as well drive.

    With what the search may do, which doesn't split trips anew where nobody may choose any more.
    Both are the same if no flight is needless.
    """
    plain = [number for number, kind in enumerate(problem.vehicle_types)
             if kind.drones is not None and _states_only(kind, VEHICLE_TYPE)]
    # All customers are looked at only where somebody flies.
    needless = [number for number in plain
                if _flies_no_cheaper(problem, problem.vehicle_types[number])
                ] if plain and _is_plain(problem) else []
    if not needless:
        return instance, moves
    can_fly = instance.can_fly.copy()
    can_fly[0, needless] &= ~instance.can_drive[0, needless]
    either = (instance.can_drive[0] & can_fly[0]).any(axis=1)
    may_choose = bool((either & (instance.type[0]["drones"] == 1)).any())
    return (instance._replace(can_fly=can_fly),
            replace(moves, resplit=moves.resplit and may_choose))


def _is_plain(problem: Problem) -> bool:
    """Tell whether nothing but distance and loads counts, but for what vehicle types state."""
    return (_states_only(problem, PROBLEM)
            and all(_states_only(depot, DEPOT) for depot in problem.depots)
            and all(_states_only(customer, CUSTOMER) for customer in problem.customers))


def _states_only(stated: Problem | Depot | Customer | VehicleType, names: Collection[str]) -> bool:
    """Tell whether all but some fields are as they are by default."""
    return all(_is_default(each, getattr(stated, each.name))
               for each in fields(stated) if each.name not in names)


def _is_default(each: Field[Any], value: Any) -> bool:
    default = each.default if each.default_factory is MISSING else each.default_factory()
    return value is default or (not isinstance(value, np.ndarray) and bool(value == default))


def _flies_no_cheaper(problem: Problem, kind: VehicleType) -> bool:
    """Tell whether each leg costs as much by a type's drones as by its trucks, both ways."""
    assert kind.drones is not None
    if problem.num_nodes > MOST_COMPARED:
        return False
    road, air = problem.travel[kind.travel], problem.travel[kind.drones.travel]
    driven, flown = road.arrays()[1], air.arrays()[1]
    return bool(np.array_equal(driven, driven.T)
                and (flown * kind.drones.cost_per_km >= driven * kind.cost_per_km).all()
                and (road.straight is not None or _are_shortest_ways(driven)))


def _are_shortest_ways(driven: IntArray) -> bool:
    """Tell whether no leg is longer than the way by a third place, as stated tables need not be."""
    return len(driven) <= MOST_WALKED and all(
        bool((driven <= driven[:, [by]] + driven[by] + LEEWAY).all())
        for by in range(len(driven)))
