"""What limits the work of those who drive, each a little looser, or no longer."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

from model.judge.breaks import begin_of, window_of
from model.judge.clock import MS_PER_MINUTE
from model.judge.driving import driver_behind
from model.judge.loads import trip_loads
from model.judge.metrics import RouteMetrics, TripMetrics
from model.judge.pairs import times_between
from model.problem import MAX_QUANTITY, UNLIMITED, Break, Problem, VehicleType
from model.solution import Route, Solution, Trip

_Unit = Literal["minute", "unit", "rule"]
_Changed = tuple[str, _Unit, float | None, VehicleType]
"""A field, the unit of one more, how many are left, and the type with one more, or without it."""


def duty_limits(kind: VehicleType, measured: RouteMetrics | None,
                trip: TripMetrics | None) -> Iterator[_Changed]:
    """Yield what a type of vehicle may work overtime, and have on a trip."""
    if kind.overtime is not None and kind.overtime.max_duration < UNLIMITED:
        most = kind.overtime.max_duration
        longer = replace(kind.overtime, max_duration=most + MS_PER_MINUTE)
        slack = None if measured is None else (most - measured.overtime) / MS_PER_MINUTE
        yield "overtime.max_duration", "minute", slack, replace(kind, overtime=longer)
    if kind.max_stops is not None:
        slack = None if trip is None else float(kind.max_stops - len(trip.stop_loads) + 2)
        yield "max_stops", "unit", slack, replace(kind, max_stops=kind.max_stops + 1)
    if kind.pickups == "last":
        yield "pickups", "rule", None, replace(kind, pickups="any")
    if kind.max_sorties is not None:
        slack = None if trip is None else float(kind.max_sorties - len(trip.sorties))
        yield "max_sorties", "unit", slack, replace(kind, max_sorties=kind.max_sorties + 1)
    if kind.most_airborne < kind.num_drones:
        yield "max_airborne", "unit", None, replace(kind, max_airborne=kind.most_airborne + 1)
    if kind.lifo:
        yield "lifo", "rule", None, replace(kind, lifo=False)
    if kind.truck_waits:
        yield "truck_waits", "rule", None, replace(kind, truck_waits=False)


def rest_limits(problem: Problem, kind: VehicleType, route: Route | None) -> Iterator[_Changed]:
    """Yield when breaks begin, what is aboard meanwhile, the breaks themselves, and long drives.

    `route` is one of the type's that has the customer; None: none has.
    """
    for number, each in enumerate(kind.breaks):
        def with_break(changed: Break, number: int = number) -> VehicleType:
            return replace(kind, breaks=(*kind.breaks[:number], changed,
                                         *kind.breaks[number + 1:]))

        name, taken = f"breaks[{each.id}]", _taken(problem, kind, number, route)
        if each.latest < UNLIMITED:
            later = min(each.latest + MS_PER_MINUTE, UNLIMITED)
            yield (f"{name}.start.latest", "minute", None if taken is None else taken[0],
                   with_break(replace(each, latest=later)))
            # A break that may begin at any time is due on no route.
            yield name, "rule", None, with_break(replace(each, latest=UNLIMITED))
        for dimension, most in enumerate(each.max_load or ()):
            unit = 10**problem.amount_decimals[dimension]
            limit = [*(each.max_load or ())]
            limit[dimension] = min(most + unit, MAX_QUANTITY)
            yield (f"{name}.max_load" + (f"[{dimension}]" if len(limit) > 1 else ""), "unit",
                   None if taken is None else (most - taken[1][dimension]) / unit,
                   with_break(replace(each, max_load=tuple(limit))))
    yield from _driving_limits(kind, route)


def _taken(problem: Problem, kind: VehicleType, number: int,
           route: Route | None) -> tuple[float, tuple[int, ...]] | None:
    """Return how many minutes later a break could begin, and what is aboard; None: not taken."""
    for trip in () if route is None else route.trips:
        for taken in trip.breaks:
            if route is not None and taken.number == number:
                _, closes = window_of(kind.breaks[number], begin_of(kind, route.trips[0]))
                return ((closes - taken.start) / MS_PER_MINUTE,
                        trip_loads(problem, kind, trip)[taken.stop + 1])
    return None


def _driving_limits(kind: VehicleType, route: Route | None) -> Iterator[_Changed]:
    """Yield how long somebody may drive, or work, without a rest, and drive in a day."""
    rules = kind.driving
    if rules is None:
        return
    if rules.max_driving < UNLIMITED:
        longer = replace(rules, max_driving=min(rules.max_driving + MS_PER_MINUTE, UNLIMITED))
        yield "driving_rules.max_driving", "minute", None, replace(kind, driving=longer)
    if rules.max_work < UNLIMITED:
        longer = replace(rules, max_work=min(rules.max_work + MS_PER_MINUTE, UNLIMITED))
        yield "driving_rules.max_work_before_break", "minute", None, replace(kind, driving=longer)
    if rules.max_driving_per_day < UNLIMITED:
        day = None if route is None else driver_behind(rules, kind, route.trips).day
        longer = replace(rules, max_driving_per_day=min(rules.max_driving_per_day + MS_PER_MINUTE,
                                                        UNLIMITED))
        yield ("driving_rules.max_driving_per_day", "minute",
               None if day is None else (rules.max_driving_per_day - day) / MS_PER_MINUTE,
               replace(kind, driving=longer))
    if not rules.while_drones_fly:
        yield ("driving_rules.while_drones_fly", "rule", None,
               replace(kind, driving=replace(rules, while_drones_fly=True)))


_Whole = tuple[str, float | None, Problem]
"""A field, how much is left, and the problem with one more, or less, of it."""


def between_limits(problem: Problem, node: int, kind: VehicleType | None,
                   trip: Trip | None) -> Iterator[_Whole]:
    """Yield how long a shipment may be under way of which the customer at `node` is an end.

    `trip` serves him, by a vehicle of a `kind`; None: none does.
    """
    each = problem.shipment_at.get(node)
    if each is None or each.max_time_between is None:
        return
    slack = None
    if kind is not None and trip is not None and each.max_detour is None:
        slack = next((-excess / MS_PER_MINUTE for _, name, excess
                      in times_between(problem, kind, trip) if name == each.id), None)
    longer = replace(each, max_time_between=min(each.max_time_between + MS_PER_MINUTE,
                                                MAX_QUANTITY))
    yield "max_time_between", slack, replace(problem, shipments=tuple([
        longer if other is each else other for other in problem.shipments]))


def fleet_limits(problem: Problem, solution: Solution) -> Iterator[_Whole]:
    """Yield how many vehicles are to be used at least; one fewer may save something."""
    fairness = problem.fairness
    if fairness.min_vehicles:
        kinds = {route.vehicle_type for route in solution.routes}
        used = len({(route.vehicle_type, route.vehicle) for route in solution.routes})
        used += sum(not each.kinds & kinds for each in fairness.before)
        yield "fairness.min_vehicles", float(used - fairness.min_vehicles), replace(
            problem, fairness=replace(fairness, min_vehicles=fairness.min_vehicles - 1))
