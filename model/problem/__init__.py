"""What is to be planned, in integers."""

from model.problem.breaks import MAX_BREAKS, Break
from model.problem.customer import Customer, Depot, DepotKind, IncompatibleGoods, ServedBy
from model.problem.driving import REST, DrivingRules
from model.problem.energy import MAX_BATTERY, MAX_POINTS, MAX_POWER, MICROJOULES_PER_WH, Energy
from model.problem.fairness import Balance, Before, Fairness, Measure
from model.problem.fleet import DroneType, Pickups, SpeedProfile, VehicleType
from model.problem.hours import keeps_hours, within_hours
from model.problem.hubs import limits_chargers, shares_chargers
from model.problem.overtime import Overtime
from model.problem.problem import Problem
from model.problem.quantities import (
    FULL_SPEED, MAX_DIMENSIONS, MAX_MONEY, MAX_QUANTITY, MM_PER_KM, MOST_INCOMPATIBLE, MS_PER_HOUR,
    UNLIMITED, UNREACHABLE, USUAL_DECIMALS, BoolArray, FloatArray, Int32Array, IntArray, UIntArray,
)
from model.problem.relation import (
    MOST_IN_ORDER, MOST_RELATIONS, SINCE_PLAN_START, Lag, Relation, RelationKind,
)
from model.problem.shipment import MOST_PICKUPS, Part, Shipment
from model.problem.storms import (
    MAX_CLOSINGS, MAX_STORMS, MAX_TIMED_ZONES, Closings, Storms, barred,
)
from model.problem.straight import Points, StraightLegs
from model.problem.travel import Travel
from model.problem.zones import has_timed_zones, zones_of

__all__ = [
    "FULL_SPEED", "MAX_BATTERY", "MAX_BREAKS", "MAX_CLOSINGS", "MAX_DIMENSIONS", "MAX_MONEY",
    "MAX_POINTS", "MAX_POWER", "MAX_QUANTITY", "MAX_STORMS", "MAX_TIMED_ZONES",
    "MICROJOULES_PER_WH", "MM_PER_KM", "MOST_INCOMPATIBLE", "MOST_IN_ORDER", "MOST_PICKUPS",
    "MOST_RELATIONS", "MS_PER_HOUR", "REST", "SINCE_PLAN_START", "UNLIMITED", "UNREACHABLE",
    "USUAL_DECIMALS", "Balance", "Before", "BoolArray", "Break", "Closings", "Customer", "Depot",
    "DepotKind", "DrivingRules", "DroneType", "Energy", "Fairness", "FloatArray",
    "IncompatibleGoods", "Int32Array", "IntArray", "Lag", "Measure", "Overtime", "Part", "Pickups",
    "Points", "Problem", "Relation", "RelationKind", "ServedBy", "Shipment", "SpeedProfile",
    "Storms", "StraightLegs", "Travel", "UIntArray", "VehicleType", "barred", "has_timed_zones",
    "keeps_hours", "limits_chargers", "shares_chargers", "within_hours", "zones_of",
]
