"""Vehicle types as rows for the engine, `tandem_vehicle_type` and `tandem_rate`.

What both call the same goes there as it is; what differs is written here.
"""

from collections.abc import Sequence

from model.engine.breaks import Fields, driver_fields, longest_travel
from model.engine.library import dtype_of
from model.engine.records import Record, Records
from model.engine.variants import Variation, index_of, way_of
from model.problem import MS_PER_HOUR, UNLIMITED, DroneType, Energy, Problem, VehicleType

MOST_DRONES = 256
"""How many drones of a truck may be charged aboard."""

ANY, LAST, BEGUN = range(3)

ANY_FLIGHT = 0
"""What storms of the wind bar, in place of the bits of zones."""

NO_PROFILE = -1

WORK_RATES = "time", "overtime"
"""The rates per hour of what a vehicle's work costs."""


def write_type(row: Record, kind: VehicleType, ways: Sequence[Variation], **others: int) -> None:
    """Write what the engine knows of a type, by field, and `others` that it alone can't tell. In
    place.

    What isn't said is 0.
    """
    load, profile = kind.initial_load or (0,) * len(kind.capacity), kind.speed_profile
    own = way_of(kind, True)
    limited = own if kind.limited is None else Variation(kind.limited, False)
    said = {
        **_as_stated(kind), "travel": index_of(ways, own),
        "limited_travel": index_of(ways, limited),
        "changes_ends": _changes_ends(kind), "shift_earliest": kind.earliest,
        "begun": kind.works_since is not None, **_limits_of_work(kind),
        "max_travel_duration": longest_travel(kind), "max_sorties": most_sorties(kind),
        "max_airborne": kind.most_airborne,
        "speed_changes": len(profile.times) if profile is not None else NO_PROFILE,
        "pickup_order": _pickup_order(kind), "carried": load[0],
        "capacity": [most - taken for most, taken in zip(kind.capacity, load, strict=True)],
        **(_itself(kind, ways) if kind.drones is None else _drones(kind.drones, ways)),
        **_battery(kind.energy if kind.drones is None else kind.drones.energy),
        **_storms(kind if kind.flies else kind.drones), **driver_fields(kind),
        "share_before": UNUSED, **others}
    for name, value in said.items():
        if isinstance(value, Sequence):
            row[name][:len(value)] = value
        else:
            row[name] = value


def rate_row(kind: VehicleType, parts_per_unit: int) -> tuple[float, ...]:
    """Return what vehicles of a type cost; amounts in the first dimension have so many parts."""
    drones, worked = kind.drones, _worked(kind) / MS_PER_HOUR * kind.cost_per_hour
    has_limit = kind.latest < UNLIMITED or kind.max_working_duration is not None
    return (
        kind.fixed_cost + worked, kind.cost_per_km, kind.cost_per_stop, kind.cost_per_hour,
        kind.overtime.cost_per_hour if kind.overtime and has_limit else 0.0,
        drones.cost_per_km if drones else 0.0, drones.cost_per_hour if drones else 0.0,
        kind.cost_per_load_km / parts_per_unit)


def limit(stated: int | None) -> int:
    """Return a limit as the engine reads it."""
    return UNLIMITED if stated is None else stated


def _as_stated(kind: VehicleType) -> Fields:
    """Return what a vehicle type and the engine call the same; None is no limit."""
    names = dtype_of("tandem_vehicle_type").names or ()
    stated = {name: getattr(kind, name) for name in names if hasattr(kind, name)}
    return {name: limit(value) for name, value in stated.items()
            if value is None or isinstance(value, int)}


def most_sorties(kind: VehicleType) -> int:
    """Return how many sorties may be flown on a trip, and there are batteries for."""
    batteries = None if kind.drones is None else kind.drones.batteries
    return min(limit(kind.max_sorties), limit(batteries))


def _pickup_order(kind: VehicleType) -> int:
    if kind.pickups == "last" and not kind.has_delivered:
        return LAST
    return BEGUN if kind.pickups == "last" or kind.lifo else ANY


def _changes_ends(kind: VehicleType) -> int:
    """Tell whether trips of a type, if there are several, don't all begin and end at one place."""
    places = {kind.begins_at, kind.ends_at, *kind.reload_places}
    return int(kind.max_trips > 1 and places != {kind.depot})


def _limits_of_work(kind: VehicleType) -> Fields:
    """Return the last end and the longest working duration, with overtime and without.

    The working duration is what is left of it when a vehicle may begin.
    """
    longest, over = kind.max_working_duration, kind.overtime.max_duration if kind.overtime else 0
    usual = UNLIMITED if longest is None else longest - _worked(kind)
    is_endless = longest is None or over == UNLIMITED
    return {"shift_latest": min(UNLIMITED, kind.latest + over), "usual_end": kind.latest,
            "max_working_duration": UNLIMITED if is_endless else usual + over,
            "usual_working": usual}


def _worked(kind: VehicleType) -> int:
    """Return how long a vehicle has worked when it may begin."""
    return 0 if kind.works_since is None else kind.earliest - kind.works_since


def _drones(drones: DroneType, ways: Sequence[Variation]) -> Fields:
    out, home = (index_of(ways, Variation(drones.travel, sets_up)) for sets_up in (True, False))
    straight = (out if drones.max_range is None
                else index_of(ways, Variation(drones.straight, False)))
    relaunch = drones.launch_duration + drones.swap_duration
    return {"drones": drones.count, "drone_travel": out, "home_travel": home,
            "endurance": drones.endurance, "waiting_counts": drones.endurance_includes_waiting,
            "launch_duration": relaunch if drones.has_launched else drones.launch_duration,
            "relaunch_duration": relaunch, "recovery_duration": drones.recovery_duration,
            "straight_travel": straight, "max_range": limit(drones.max_range),
            "payload": drones.capacity}


def _itself(kind: VehicleType, ways: Sequence[Variation]) -> Fields:
    """Return what is said of drones, of a vehicle that has none; it may fly by itself."""
    if not kind.flies:
        return {"drones": 0, "endurance": 0, "max_range": 0}
    travel = index_of(ways, way_of(kind, True))
    straight = travel if kind.max_range is None else index_of(ways, Variation(kind.straight, False))
    return {"drones": 0, "drone_travel": travel, "home_travel": travel,
            "straight_travel": straight, "waiting_counts": True,
            "relaunch_duration": kind.launch_duration, "max_range": limit(kind.max_range)}


def _battery(energy: Energy | None) -> Fields:
    """Return what a drone's battery holds, full at first, and its powers at each weight."""
    if energy is None:
        return {}
    return {"points": len(energy.weights), "battery": energy.available, "lands": energy.lands,
            "climb_duration": energy.climb_duration, "descent_duration": energy.descent_duration,
            "charge": energy.charge, "weights": energy.weights, "cruise": energy.cruise,
            "hover": energy.hover, "climb": energy.climb, "descent": energy.descent,
            "first_charge": (energy.available,) * MOST_DRONES}


def _storms(flyer: DroneType | VehicleType | None) -> Fields:
    """Return how often it storms, from when, until when, and for flights to which zones."""
    storms = [] if flyer is None else sorted(
        [*((begin, end, ANY_FLIGHT) for begin, end in flyer.storms), *flyer.closings])
    return {"storms": len(storms), "storm_from": [begin for begin, *_ in storms],
            "storm_until": [end for _, end, _ in storms],
            "storm_zones": [zones for *_, zones in storms]}


UNUSED = -1
"""Stands for what a vehicle has done that isn't used yet."""


def write_shares(problem: Problem, types: Records) -> None:
    """Write what vehicles have done that are used already. In place."""
    for vehicle in problem.fairness.before:
        for kind in vehicle.kinds:
            types[kind]["share_before"] = vehicle.share
