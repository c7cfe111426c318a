"""`PlanRequest` -> `Problem` and planning options; quantities are rounded here, once."""

from collections.abc import Sequence

import numpy as np

from app.conversion.amounts import counted, decimals_of
from app.conversion.preparing import UNHURRIED, Preparing
from app.conversion.travels import Ground, Travels
from app.conversion.units import optional_thousandths, thousandths
from app.schemas.request import CustomerInput, DronesInput, PlanRequest, VehicleTypeInput
from model.problem import (
    FULL_SPEED,
    MM_PER_KM,
    MS_PER_HOUR,
    UNLIMITED,
    UNREACHABLE,
    Customer,
    Depot,
    DroneType,
    Problem,
    Travel,
    VehicleType,
)

DETOURS_PER_CUSTOMER = 10
"""A customer left out costs as much as this many vehicles sent out for it alone."""


def to_problem(request: PlanRequest, preparing: Preparing = UNHURRIED,
               ground: Ground | None = None) -> Problem:
    """Convert a valid request, unless the work on it is to end; `ground` may be known already."""
    travels = Travels(request, preparing, ground)
    travels.expect_legs()
    depots = {depot.id: node for node, depot in enumerate(request.depots)}
    decimals = decimals_of(request.customers, request.fleet)
    vehicle_types = tuple(
        _vehicle_type(vehicle_type, 0 if vehicle_type.depot is None else depots[vehicle_type.depot],
                      travels, decimals)
        for vehicle_type in request.fleet
    )
    customers = tuple([_customer(customer, decimals) for customer in request.customers])
    unassigned_cost = request.unassigned_cost
    if unassigned_cost is None:
        unassigned_cost = default_unassigned_cost(customers, vehicle_types, travels.built())
    return Problem(
        depots=tuple(Depot(depot.id) for depot in request.depots),
        customers=customers,
        vehicle_types=vehicle_types,
        travel=travels.built(),
        coordinates=travels.coordinates(),
        unassigned_cost=unassigned_cost,
        amount_decimals=decimals,
    )


def default_unassigned_cost(customers: Sequence[Customer], vehicle_types: Sequence[VehicleType],
                            travels: Sequence[Travel]) -> float:
    """Return a cost larger than any detour: that of many vehicles used for one customer each.

    Each drives the longest leg there and back, serves longest, and works and is late or early as
    long as the latest time that the problem states.
    """
    stated = [time for customer in customers
              for time in (customer.earliest, customer.latest, customer.release_time)]
    stated += [kind.latest for kind in vehicle_types]
    horizon = max([time for time in stated if time < UNLIMITED], default=0) / MS_PER_HOUR
    service = max([customer.service_duration for customer in customers], default=0) / MS_PER_HOUR
    longest = [_longest_leg(travel) for travel in travels]
    detour = max(_vehicle_cost(kind, longest, service + horizon) for kind in vehicle_types)
    late = max([customer.late_cost_per_hour or 0.0 for customer in customers], default=0.0)
    early = max([customer.early_cost_per_hour for customer in customers], default=0.0)
    return max(1.0, DETOURS_PER_CUSTOMER * detour + (late + early) * horizon)


def _vehicle_cost(kind: VehicleType, longest: Sequence[tuple[float, float]],
                  other_hours: float) -> float:
    """Return the cost of a vehicle, and its drones, that goes the longest leg there and back.

    `longest` has the kilometres and hours of each travel's.
    """
    slowest = min(kind.speed_profile.factors) / FULL_SPEED if kind.speed_profile else 1.0
    kilometres, hours = longest[kind.travel]
    cost = (kind.fixed_cost + 2 * kilometres * kind.cost_per_km
            + (2 * hours / slowest + other_hours) * kind.cost_per_hour)
    if kind.drones is not None:
        kilometres, hours = longest[kind.drones.travel]
        cost += (2 * kilometres * kind.drones.cost_per_km
                 + (2 * hours + other_hours) * kind.drones.cost_per_hour)
    return cost


def _longest_leg(travel: Travel) -> tuple[float, float]:
    """Return the largest distance in kilometres and the largest duration in hours."""
    millimetres, milliseconds = travel.distance.max(initial=0), travel.duration.max(initial=0)
    if milliseconds < UNREACHABLE:
        return float(millimetres) / MM_PER_KM, float(milliseconds) / MS_PER_HOUR
    reachable = travel.duration < UNREACHABLE
    return (float(np.max(travel.distance, where=reachable, initial=0)) / MM_PER_KM,
            float(np.max(travel.duration, where=reachable, initial=0)) / MS_PER_HOUR)


def _customer(stated: CustomerInput, decimals: Sequence[int]) -> Customer:
    window = stated.time_window
    return Customer(
        id=stated.id,
        demand=counted(stated.demand, decimals),
        service_duration=thousandths(stated.service_duration),
        earliest=thousandths(window.earliest),
        latest=UNLIMITED if window.latest is None else thousandths(window.latest),
        late_cost_per_hour=window.late_cost_per_hour,
        early_cost_per_hour=window.early_cost_per_hour,
        served_by=stated.served_by,
        skills=frozenset(stated.skills),
        release_time=thousandths(stated.release_time),
    )


def _vehicle_type(stated: VehicleTypeInput, depot: int, travels: Travels,
                  decimals: Sequence[int]) -> VehicleType:
    travel, speed_profile = travels.drive(stated)
    shift = stated.shift
    return VehicleType(
        id=stated.id,
        count=stated.count,
        capacity=counted(stated.capacity, decimals),
        travel=travel,
        depot=depot,
        fixed_cost=stated.costs.fixed,
        cost_per_km=stated.costs.per_km,
        cost_per_hour=stated.costs.per_hour,
        speed_profile=speed_profile,
        earliest=thousandths(shift.earliest),
        latest=UNLIMITED if shift.latest is None else thousandths(shift.latest),
        max_working_duration=optional_thousandths(stated.max_working_duration),
        max_trip_distance=optional_thousandths(stated.max_trip_distance),
        max_trips=stated.max_trips,
        reload_duration=thousandths(stated.reload_duration),
        skills=frozenset(stated.skills),
        drones=_drones(stated.drones, travels, decimals),
    )


def _drones(stated: DronesInput | None, travels: Travels,
            decimals: Sequence[int]) -> DroneType | None:
    if stated is None or stated.count == 0:
        return None
    return DroneType(
        count=stated.count,
        capacity=counted(stated.capacity, decimals),
        travel=travels.fly(stated),
        endurance=UNLIMITED if stated.endurance is None else thousandths(stated.endurance),
        endurance_includes_waiting=stated.endurance_includes_waiting,
        launch_duration=thousandths(stated.launch_duration),
        recovery_duration=thousandths(stated.recovery_duration),
        service_duration=optional_thousandths(stated.service_duration),
        max_customers_per_sortie=stated.max_customers_per_sortie,
        cost_per_km=stated.costs.per_km,
        cost_per_hour=stated.costs.per_hour,
    )
