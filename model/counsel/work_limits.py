"""What limits the work of those who drive, each a little looser, or no longer."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Literal, TypeVar

from model.counsel.route_limits import ROUTE_LIMITS
from model.judge.breaks import begin_of, window_of
from model.judge.clock import MS_PER_MINUTE
from model.judge.driving import driver_after
from model.judge.loads import trip_loads
from model.judge.metrics import RouteMetrics
from model.judge.pairs import times_between
from model.problem import MAX_QUANTITY, UNLIMITED, Break, Problem, VehicleType
from model.problem.limits import Whose, limits_of
from model.solution import Route, Solution, Trip

Unit = Literal["minute", "km", "unit", "rule"]
"""Of a rule without a number a unit more is the rule itself, lifted."""

Owner = TypeVar("Owner")

_Changed = tuple[str, Unit, float | None, Owner]
"""A field, the unit of one more, how many are left, and its owner with one more, or without it."""


def loosened(owner: Owner, used: Mapping[str, int], *whose: Whose) -> Iterator[_Changed[Owner]]:
    """Yield the numbers that limit somebody; `used` is how much of each is, as far as known."""
    for name, limit, most in limits_of(owner, *whose):
        slack = (most - used[name]) / limit.step.size if name in used else None
        yield limit.path, limit.step.name, slack, limit.raised(owner, limit.step.size)


def used_by(kind: VehicleType, route: Route, measured: RouteMetrics, number: int) -> dict[str, int]:
    """Return how much a route has of what limits it, and its trip of a number."""
    trip = measured.trips[number]
    used = {
        **{row.name: row.used(route, measured) for row in ROUTE_LIMITS.values()},
        "shift": route.trips[-1].stops[-1].departure, "overtime": measured.overtime,
        "stops": len(trip.stop_loads) - 2, "sorties": len(trip.sorties),
        "trip_distance": trip.distance,
        "endurance": trip.duration - kind.launch_duration - kind.recovery_duration}
    if kind.driving is not None:
        used["driving_day"] = driver_after(kind.driving, kind, route.trips).day
    return used


def duty_rules(kind: VehicleType) -> Iterator[_Changed[VehicleType]]:
    """Yield what a type of vehicle may not do, and its drones."""
    if kind.pickups == "last":
        yield "pickups", "rule", None, replace(kind, pickups="any")
    if kind.most_airborne < kind.num_drones:
        yield "max_airborne", "unit", None, replace(kind, max_airborne=kind.most_airborne + 1)
    if kind.lifo:
        yield "lifo", "rule", None, replace(kind, lifo=False)
    if kind.truck_waits:
        yield "truck_waits", "rule", None, replace(kind, truck_waits=False)
    if kind.storms:
        yield "max_wind_kmh", "rule", None, replace(kind, storms=())
    if kind.driving is not None and not kind.driving.while_drones_fly:
        yield ("driving_rules.while_drones_fly", "rule", None,
               replace(kind, driving=replace(kind.driving, while_drones_fly=True)))


def break_limits(problem: Problem, kind: VehicleType,
                 route: Route | None) -> Iterator[_Changed[VehicleType]]:
    """Yield when breaks begin, what is aboard meanwhile, and the breaks themselves.

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
    used = {}
    if kind is not None and trip is not None and each.max_detour is None:
        excess = next((excess for _, name, excess in times_between(problem, kind, trip)
                       if name == each.id), None)
        if excess is not None:
            used["time_between"] = each.max_time_between + excess
    for field, _, slack, longer in loosened(each, used, "shipment"):
        yield field, slack, replace(problem, shipments=tuple([
            longer if other is each else other for other in problem.shipments]))


def fleet_limits(problem: Problem, solution: Solution) -> Iterator[_Whole]:
    """Yield how many vehicles are to be used at least; one fewer may save something."""
    fairness = problem.fairness
    if fairness.min_vehicles:
        kinds = {route.vehicle_type for route in solution.routes}
        used = len({route.driven_by for route in solution.routes})
        used += sum(not each.kinds & kinds for each in fairness.before)
        yield "fairness.min_vehicles", float(used - fairness.min_vehicles), replace(
            problem, fairness=replace(fairness, min_vehicles=fairness.min_vehicles - 1))
