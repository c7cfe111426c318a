"""`VehicleTypeInput` -> `VehicleType`, with its drones."""

from collections.abc import Collection, Sequence
from dataclasses import replace

from app.requests.conversion.amounts import counted
from app.requests.conversion.energy import to_energy
from app.requests.conversion.places import places_of_type
from app.requests.conversion.travels import Travels
from app.requests.conversion.units import optional_thousandths, thousandths
from app.schemas.driving import DrivingRulesInput
from app.schemas.drones import DronesInput, Flyer, TurnaroundInput
from app.schemas.vehicle import BreakInput, OvertimeInput, VehicleTypeInput
from model.problem import (
    MAX_QUANTITY, UNLIMITED, Break, Depot, DrivingRules, DroneType, Overtime, Storms, VehicleType,
    within_hours,
)


def to_vehicle_type(stated: VehicleTypeInput, depots: Sequence[Depot], travels: Travels,
                    decimals: Sequence[int],
                    amounts: Collection[Sequence[int]]) -> VehicleType:
    """Convert a valid vehicle type; of the problem are `depots`, and `amounts` both ways."""
    travel, speed_profile = travels.drive(stated)
    places, shift = places_of_type(stated, depots), stated.shift
    drones = [_drones(stated, each, travels, decimals, amounts) for each in stated.drone_types
              if each.count > 0]
    kind = within_hours(depots, VehicleType(
        id=stated.id,
        count=stated.count,
        capacity=counted(stated.capacity, decimals),
        travel=travel,
        depot=places.depot,
        start=places.start,
        end=places.end,
        reload_depots=places.reload,
        fixed_cost=stated.costs.fixed, cost_per_km=stated.costs.per_km,
        cost_per_hour=stated.costs.per_hour,
        cost_per_stop=stated.costs.per_stop,
        cost_per_load_km=stated.costs.per_load_km,
        speed_profile=speed_profile,
        earliest=thousandths(shift.earliest),
        latest=UNLIMITED if shift.latest is None else thousandths(shift.latest),
        max_working_duration=optional_thousandths(stated.max_working_duration),
        max_trip_distance=optional_thousandths(stated.max_trip_distance),
        max_travel_duration=optional_thousandths(stated.max_travel_duration),
        overtime=_overtime(stated.overtime),
        max_trips=stated.max_trips,
        max_stops=stated.max_stops, max_sorties=stated.max_sorties,
        max_airborne=stated.max_airborne,
        truck_waits=stated.truck_waits,
        reload_duration=thousandths(stated.reload_duration),
        skills=frozenset(stated.skills),
        pickups=stated.pickups, lifo=stated.lifo,
        drones=drones[0] if drones else None,
        more_drones=tuple(drones[1:]),
        co2_kg_per_km=stated.co2_kg_per_km,
        co2_kg_per_kwh=stated.co2_kg_per_kwh,
        breaks=tuple([_break(each, decimals) for each in stated.breaks]),
        driving=driving_rules(stated.driving_rules),
    ))
    kind = _in_time(kind, travels)
    return _flying(kind, stated, travels, decimals, amounts) if stated.flies else kind


def _in_time(kind: VehicleType, travels: Travels) -> VehicleType:
    """Return vehicles whose work is over before any leg would be that isn't there."""
    if not travels.lack_ways({kind.travel, *(each.travel for each in kind.drone_types)}):
        return kind
    most, overtime = MAX_QUANTITY - 1, kind.overtime
    if overtime is not None:
        most //= 2
        overtime = replace(overtime, max_duration=min(overtime.max_duration, most))
    latest = max(kind.earliest, min(kind.latest, most))
    return replace(kind, latest=latest, overtime=overtime)


def _flying(kind: VehicleType, stated: VehicleTypeInput, travels: Travels, decimals: Sequence[int],
            amounts: Collection[Sequence[int]]) -> VehicleType:
    """Return vehicles that fly by themselves; batteries are swapped while they reload."""
    turnaround = stated.turnaround or TurnaroundInput()
    return replace(
        kind, flies=True,
        max_range=optional_thousandths(stated.max_range),
        straight=0 if stated.max_range is None else travels.straight(),
        storms=_storms(stated, stated, travels),
        endurance=UNLIMITED if stated.endurance is None else thousandths(stated.endurance),
        launch_duration=thousandths(stated.launch_duration),
        recovery_duration=thousandths(stated.recovery_duration),
        reload_duration=kind.reload_duration + thousandths(turnaround.swap_duration),
        energy=(None if stated.energy is None
                else to_energy(stated, stated.energy, decimals, amounts)))


def _break(stated: BreakInput, decimals: Sequence[int]) -> Break:
    latest = stated.start.latest
    return Break(
        stated.id, thousandths(stated.duration), thousandths(stated.start.earliest),
        UNLIMITED if latest is None else thousandths(latest),
        after_departure=stated.after_departure, anywhere=stated.at == "anywhere", paid=stated.paid,
        max_load=None if stated.max_load is None else counted(stated.max_load, decimals))


def driving_rules(stated: DrivingRulesInput | None) -> DrivingRules | None:
    """Return rules as stated; None if there are none."""
    if stated is None:
        return None

    def limit(duration: float | None) -> int:
        return UNLIMITED if duration is None else thousandths(duration)

    return DrivingRules(
        limit(stated.max_driving), thousandths(stated.break_duration or 0.0),
        tuple(map(thousandths, stated.split or ())), limit(stated.max_driving_per_day),
        limit(stated.max_work_before_break), thousandths(stated.driven_before),
        thousandths(stated.worked_before), stated.while_drones_fly)


def _overtime(stated: OvertimeInput | None) -> Overtime | None:
    if stated is None:
        return None
    longest = stated.max_duration
    return Overtime(stated.cost_per_hour, UNLIMITED if longest is None else thousandths(longest))


def _storms(kind: VehicleTypeInput, flyer: Flyer, travels: Travels) -> Storms:
    return tuple([(storm.begin, storm.end) for storm in travels.winds.storms(kind, flyer)])


def _drones(kind: VehicleTypeInput, stated: DronesInput, travels: Travels, decimals: Sequence[int],
            amounts: Collection[Sequence[int]]) -> DroneType:
    turnaround = stated.turnaround or TurnaroundInput()
    return DroneType(
        id=stated.id,
        count=stated.count,
        capacity=counted(stated.capacity, decimals),
        travel=travels.fly(kind, stated),
        endurance=UNLIMITED if stated.endurance is None else thousandths(stated.endurance),
        endurance_includes_waiting=stated.endurance_includes_waiting,
        max_range=optional_thousandths(stated.max_range),
        storms=_storms(kind, stated, travels),
        straight=0 if stated.max_range is None else travels.straight(),
        launch_duration=thousandths(stated.launch_duration),
        recovery_duration=thousandths(stated.recovery_duration),
        service_duration=optional_thousandths(stated.service_duration),
        swap_duration=thousandths(turnaround.swap_duration),
        batteries=turnaround.batteries,
        max_customers_per_sortie=stated.max_customers_per_sortie,
        energy=(None if stated.energy is None
                else to_energy(stated, stated.energy, decimals, amounts)),
        cost_per_km=stated.costs.per_km,
        cost_per_hour=stated.costs.per_hour,
    )
