"""`VehicleTypeInput` -> `VehicleType`, with its drones."""

from collections.abc import Collection, Sequence
from dataclasses import replace

from app.requests.conversion.amounts import counted
from app.requests.conversion.energy import to_energy
from app.requests.conversion.leaving_out import NO_END
from app.requests.conversion.places import places_of_type
from app.requests.conversion.travels import Travels
from app.requests.conversion.units import by_name, thousandths
from app.schemas.driving import DrivingRulesInput
from app.schemas.drones import DronesInput, Flyer, TurnaroundInput
from app.schemas.vehicle import BreakInput, VehicleTypeInput
from model.problem import (
    MAX_QUANTITY, UNLIMITED, Break, Depot, DrivingRules, DroneType, Overtime, Storms, VehicleType,
    within_hours,
)


def to_vehicle_type(stated: VehicleTypeInput, depots: Sequence[Depot], travels: Travels,
                    decimals: Sequence[int],
                    amounts: Collection[Sequence[int]]) -> VehicleType:
    """Convert a valid vehicle type; of the problem are `depots`, and `amounts` both ways."""
    travel, speed_profile = travels.drive(stated)
    places = places_of_type(stated, depots)
    drones = [_drones(stated, each, travels, decimals, amounts) for each in stated.drone_types
              if each.count > 0]
    kind = within_hours(depots, VehicleType(
        **by_name(stated, VehicleType),
        **by_name(stated.costs, VehicleType, prefix="cost_"),
        **by_name(stated.shift, VehicleType),
        id=stated.id,
        capacity=counted(stated.capacity, decimals),
        travel=travel,
        depot=places.depot,
        start=places.start,
        end=places.end,
        reload_depots=places.reload,
        fixed_cost=stated.costs.fixed,
        speed_profile=speed_profile,
        overtime=(None if stated.overtime is None
                  else Overtime(**by_name(stated.overtime, Overtime))),
        skills=frozenset(stated.skills),
        pickups=stated.pickups,
        drones=drones[0] if drones else None,
        more_drones=tuple(drones[1:]),
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
        most = NO_END
        overtime = replace(overtime, max_duration=min(overtime.max_duration, most))
    latest = max(kind.earliest, min(kind.latest, most))
    return replace(kind, latest=latest, overtime=overtime)


def _flying(kind: VehicleType, stated: VehicleTypeInput, travels: Travels, decimals: Sequence[int],
            amounts: Collection[Sequence[int]]) -> VehicleType:
    """Return vehicles that fly by themselves; batteries are swapped while they reload."""
    turnaround = stated.turnaround or TurnaroundInput()
    return replace(
        kind, straight=0 if stated.max_range is None else travels.straight(),
        storms=_storms(stated, stated, travels), closings=travels.closings(stated),
        reload_duration=kind.reload_duration + thousandths(turnaround.swap_duration),
        energy=(None if stated.energy is None
                else to_energy(stated, stated.energy, decimals, amounts)))


def _break(stated: BreakInput, decimals: Sequence[int]) -> Break:
    return Break(
        stated.id, **by_name(stated, Break), **by_name(stated.start, Break),
        anywhere=stated.at == "anywhere",
        max_load=None if stated.max_load is None else counted(stated.max_load, decimals))


def driving_rules(stated: DrivingRulesInput | None) -> DrivingRules | None:
    """Return rules as stated; None if there are none."""
    if stated is None:
        return None
    return DrivingRules(
        **{"max_driving": UNLIMITED} | by_name(stated, DrivingRules),
        rest=thousandths(stated.break_duration or 0.0),
        split=tuple(map(thousandths, stated.split or ())),
        max_work=(UNLIMITED if stated.max_work_before_break is None
                  else thousandths(stated.max_work_before_break)))


def _storms(kind: VehicleTypeInput, flyer: Flyer, travels: Travels) -> Storms:
    return tuple([(storm.begin, storm.end) for storm in travels.winds.storms(kind, flyer)])


def _drones(kind: VehicleTypeInput, stated: DronesInput, travels: Travels, decimals: Sequence[int],
            amounts: Collection[Sequence[int]]) -> DroneType:
    turnaround = stated.turnaround or TurnaroundInput()
    return DroneType(
        **by_name(stated, DroneType),
        **by_name(stated.costs, DroneType, prefix="cost_"),
        **by_name(turnaround, DroneType),
        id=stated.id,
        capacity=counted(stated.capacity, decimals),
        travel=travels.fly(kind, stated),
        storms=_storms(kind, stated, travels), closings=travels.closings(stated),
        straight=0 if stated.max_range is None else travels.straight(),
        energy=(None if stated.energy is None
                else to_energy(stated, stated.energy, decimals, amounts)),
    )
