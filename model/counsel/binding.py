"""Which limits bind where a customer is served, and what a unit more of each would save.

A limit is changed by a unit and the customer put at the places that it might make legal or cheaper:
what is said to be saved is the difference between two plans that the judge has judged.
"""

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile
from typing import Literal, NamedTuple

from model.counsel.alternatives import Findings, here_of, visit_of
from model.counsel.bench import Bench, Trial
from model.counsel.flight_limits import hour_limits, hub_limits
from model.counsel.lifting import lifted
from model.counsel.screening import best_first, share_over
from model.counsel.work_limits import (
    between_limits, break_limits, duty_rules, fleet_limits, loosened, used_by,
)
from model.judge.clock import MS_PER_MINUTE, opening
from model.judge.energy import charges, sortie_energy
from model.judge.freshness import excess_aboard
from model.judge.loads import highest, sortie_loads
from model.judge.places import Place
from model.judge.rules import airborne_duration, farthest
from model.problem import (
    MAX_POWER, MAX_QUANTITY, MICROJOULES_PER_WH, UNLIMITED, DroneType, Energy, Problem, VehicleType,
)
from model.problem.altered import with_customers
from model.problem.limits import LIMITS
from model.solution import Sortie, Trip

Unit = Literal["minute", "unit", "km", "vehicle", "trip", "Wh", "W", "rule"]
"""Of a rule without a number a unit more is the rule itself, lifted."""

Whose = Literal["customer", "vehicle_type", "request"]

NOT_WORTH = 1e-6
"""Less than this share of a plan's cost is rounding."""

WATT = 1000
"""In mW."""

MAX_RETRIES, MAX_LIFTED = 6, 24
"""Places tried that would be cheaper, if only they were legal, and of all vehicles where a rule of
the customer is lifted."""


class Limit(NamedTuple):
    """A limit, by how much it isn't reached, and the problem with a unit more of it."""

    field: str  # as requests name it
    whose: Whose
    kind: int | None  # the vehicle type that has it; None: the customer has it, or the request
    unit: Unit
    slack: float | None  # units; None: the plan doesn't come near it
    problem: Problem
    gives_trips: bool = False  # a unit more is a trip more, which is at no place tried before
    node: int | None = None  # the customer, or end of a shipment, that has it


@dataclass(frozen=True)
class Binding:
    """A limit that is reached, or of which a unit more would save something."""

    limit: Limit
    saves_per_unit: float


def find_binding(bench: Bench, findings: Findings,
                 until: float = math.inf) -> tuple[tuple[Binding, ...], bool]:
    """Return what binds, as far as is found by an instant, and whether there was time for all.

    `findings` are those of `find_alternatives`; `until` is on `time.perf_counter`. Nothing binds
    who is served already.
    """
    if bench.done_by is not None:
        return (), True
    here = here_of(bench, share_over(0.5, until))
    begun = _best_now(bench, findings, here)
    cost = begun.evaluation.cost.total
    places = [here, here if begun is bench.plan else begun.place,
              *_cheaper_but_illegal(bench, findings, cost)]
    found: list[Binding] = []
    for limit in _limits(bench, places):
        if time.perf_counter() >= until:
            return tuple(found), False
        saved = cost - _cost_with(bench, limit, places, until)
        if saved <= NOT_WORTH * max(1.0, abs(cost)):
            saved = 0.0
        is_reached = limit.slack is not None and limit.slack <= 0 and not limit.gives_trips
        if saved or is_reached:
            found.append(Binding(limit, saved))
    return (tuple(sorted(found, key=lambda each: -each.saves_per_unit)),
            time.perf_counter() < until)


def _best_now(bench: Bench, findings: Findings, here: Place | None) -> Trial:
    """Return the best that can be done with the customer as things are."""
    known = [bench.plan, *[each.trial for each in findings.alternatives
                           if each.window is None and not each.companions
                           and each.trial.evaluation.is_feasible]]
    if here is not None:
        known.append(bench.put(here))
    return min(known, key=lambda trial: trial.rank)


def _cheaper_but_illegal(bench: Bench, findings: Findings, cost: float) -> list[Place]:
    """Return places that would be cheaper than what can be done, if only they were legal."""
    cheaper = [draft for draft in findings.drafts
               if draft.timed.judged.violations and bench.without + draft.added < cost]
    return [draft.place for draft in sorted(cheaper, key=lambda draft: draft.rank)[:MAX_RETRIES]]


def _cost_with(bench: Bench, limit: Limit, places: Sequence[Place | None],
               until: float) -> float:
    """Return the lowest cost of a legal plan with the customer at one of some places.

    Of those tried until an instant.
    """
    judged = None
    if limit.kind is not None:
        judged = bench.setting.judge_routes(limit.problem, bench.left_out.solution)
    wanted = [*places]
    if limit.gives_trips:
        wanted = [*_further_trips(bench, limit, until)]
    elif limit.unit == "rule" or limit.whose == "request":
        likeliest = best_first(bench.guesses(limit.problem, until))[:MAX_LIFTED]
        wanted += [guess.place for guess in likeliest]
    tried = [bench.finish(bench.draft(place, limit.problem), limit.problem, judged)
             for place in takewhile(lambda _: time.perf_counter() < until, dict.fromkeys(wanted))
             if place is not None]
    return min([trial.evaluation.cost.total for trial in tried if trial.evaluation.is_feasible],
               default=math.inf)


def _further_trips(bench: Bench, limit: Limit, until: float) -> Iterator[Place]:
    """Yield trips that a limit allows the customer for himself."""
    for (vehicle, _), guesses in bench.guesses(limit.problem, until).items():
        own = [guess.place for guess in guesses if guess.place.own_trip]
        if vehicle.type == limit.kind:
            yield from own[:1]


def _limits(bench: Bench, places: Sequence[Place | None]) -> Iterator[Limit]:
    """Yield the limits of the customer, and of the types of vehicles that might serve him."""
    for node in bench.nodes:
        for limit in _customer_limits(bench, node):
            yield limit._replace(node=node)
    for field, freed in lifted(bench.problem, bench.nodes):
        yield Limit(field, "customer", None, "rule", None, freed, node=bench.node)
    kinds = dict.fromkeys([place.vehicle.type for place in (
        None if bench.found is None else bench.found.place, *places) if place is not None])
    one_each = {bench.problem.vehicle_types[kind].type_id: kind for kind in reversed(kinds)}
    for kind in kinds:
        if kind in one_each.values():
            yield from _type_limits(bench, kind)
        yield from _fleet_limits(bench, kind)
    for field, slack, fewer in fleet_limits(bench.problem, bench.plan.solution):
        yield Limit(field, "request", None, "vehicle", slack, fewer)
    for field, kind, richer in hub_limits(bench.problem, bench.plan.solution):
        yield Limit(field, "vehicle_type", kind, "unit", 0.0, richer, gives_trips=True)
    for field, opened in hour_limits(bench.problem):
        yield Limit(field, "request", None, "rule", None, opened)


def _customer_limits(bench: Bench, node: int) -> Iterator[Limit]:
    problem = bench.problem
    customer, visit = problem.customer_at(node), visit_of(bench.plan, node)
    window = "time_windows" if customer.gaps else "time_window"
    last, first = ("[-1]", "[0]") if customer.gaps else ("", "")
    if customer.latest < UNLIMITED:
        slack = None if visit is None else max(0, customer.latest - visit.ready)
        changed = replace(customer, latest=min(customer.latest + MS_PER_MINUTE, UNLIMITED))
        yield Limit(f"{window}{last}.latest", "customer", None, "minute", _in_minutes(slack),
                    with_customers(problem, {node: changed}))
    if customer.earliest > 0:
        slack = None
        if visit is not None and opening(customer, visit.ready) == customer.earliest:
            slack = max(0, visit.ready - customer.earliest)
        changed = replace(customer, earliest=max(0, customer.earliest - MS_PER_MINUTE))
        yield Limit(f"{window}{first}.earliest", "customer", None, "minute", _in_minutes(slack),
                    with_customers(problem, {node: changed}))
    trip = _trip_of(bench)
    used = {}
    if trip is not None and visit is not None and customer.max_time_aboard is not None:
        excess = excess_aboard(problem, _kind_of(bench), trip, visit)
        used["time_aboard"] = min(customer.max_time_aboard + excess, customer.max_time_aboard)
    for field, unit, left, looser in loosened(customer, used, "customer"):
        yield Limit(field, "customer", None, unit, left, with_customers(problem, {node: looser}))
    if customer.release_time > 0:
        slack = None if trip is None else trip.stops[0].arrival - customer.release_time
        changed = replace(customer, release_time=max(0, customer.release_time - MS_PER_MINUTE))
        yield Limit("release_time", "customer", None, "minute", _in_minutes(slack),
                    with_customers(problem, {node: changed}))
    if node == bench.nodes[-1]:
        kind = None if trip is None else _kind_of(bench)
        for field, left, longer in between_limits(problem, node, kind, trip):
            yield Limit(field, "customer", None, "minute", left, longer)


def _in_minutes(duration: int | None) -> float | None:
    return None if duration is None else duration / MS_PER_MINUTE


def _trip_of(bench: Bench) -> Trip | None:
    """Return the trip that serves the customer."""
    found = bench.found
    return (None if found is None
            else bench.plan.solution.routes[found.route].trips[found.place.trip])


def _kind_of(bench: Bench) -> VehicleType:
    """Return the type of the vehicle that serves the customer."""
    found = bench.found
    if found is None:
        raise ValueError(f"customer {bench.node}: not in the plan")
    return bench.problem.vehicle_types[found.place.vehicle.type]


def _type_limits(bench: Bench, kind: int) -> Iterator[Limit]:
    """Yield the limits of a type of vehicle, and of its drones."""
    problem, found = bench.problem, bench.found
    vehicle_type = problem.vehicle_types[kind]
    is_here = found is not None and found.place.vehicle.type == kind
    for field, unit, slack, changed in (*_truck_limits(bench, vehicle_type, is_here),
                                        *_drone_limits(bench, vehicle_type, is_here)):
        yield Limit(field, "vehicle_type", kind, unit, slack, _all_parts(problem, changed))


def _fleet_limits(bench: Bench, kind: int) -> Iterator[Limit]:
    """Yield how many vehicles there are of a type, and how many trips each makes, if reached."""
    problem = bench.problem
    vehicle_type = problem.vehicle_types[kind]
    trips = [len(route.trips) for route in bench.left_out.solution.routes
             if route.vehicle_type == kind]
    # One more is none of those that customers name.
    if len(trips) == vehicle_type.count and vehicle_type.part_of in (None, vehicle_type.id):
        kinds = [*problem.vehicle_types]
        kinds[kind] = _one_vehicle_more(problem, vehicle_type)
        yield Limit("count", "vehicle_type", kind, "vehicle", 0.0,
                    replace(problem, vehicle_types=tuple(kinds)), gives_trips=True)
    if max(trips, default=0) == vehicle_type.max_trips and not vehicle_type.has_begun:
        changed = replace(vehicle_type, max_trips=vehicle_type.max_trips + 1)
        yield Limit("max_trips", "vehicle_type", kind, "trip", 0.0, _all_parts(problem, changed),
                    gives_trips=True)


def _one_vehicle_more(problem: Problem, kind: VehicleType) -> VehicleType:
    last = max([number for each in problem.vehicle_types if each.type_id == kind.type_id
                for number in each.numbers], default=0)
    numbers = (*kind.numbers, last + 1) if kind.numbers else ()
    return replace(kind, count=kind.count + 1, numbers=numbers)


def _all_parts(problem: Problem, changed: VehicleType) -> Problem:
    """Return a problem in which all vehicles of a type are changed, whoever may serve whom."""
    return replace(problem, vehicle_types=tuple([
        replace(changed, id=kind.id, count=kind.count, numbers=kind.numbers, part_of=kind.part_of)
        if kind.type_id == changed.type_id else kind for kind in problem.vehicle_types]))


_Changed = tuple[str, Unit, float | None, VehicleType]


def _truck_limits(bench: Bench, kind: VehicleType, is_here: bool) -> Iterator[_Changed]:
    found = bench.found if is_here else None
    measured = None if found is None else bench.plan.evaluation.routes[found.route]
    trip = None if found is None or measured is None else measured.trips[found.place.trip]
    for dimension, (most, places) in enumerate(zip(kind.capacity, bench.problem.amount_decimals,
                                                   strict=True)):
        slack = None if trip is None else (most - trip.highest_load[dimension]) / 10**places
        yield (_capacity_field("capacity", kind, dimension), "unit", slack,
               replace(kind, capacity=_one_more(kind.capacity, dimension, 10**places)))
    used = {}
    if found is not None and measured is not None:
        used = used_by(kind, bench.plan.solution.routes[found.route], measured, found.place.trip)
    closes = bench.problem.depots[kind.ends_at].latest
    for limit in loosened(kind, used, "vehicle_type", "flyer"):
        if limit[0] != LIMITS["shift"].path or kind.latest < closes:
            yield limit
    yield from duty_rules(kind)
    yield from break_limits(
        bench.problem, kind, None if found is None else bench.plan.solution.routes[found.route])


def _drone_limits(bench: Bench, kind: VehicleType, is_here: bool) -> Iterator[_Changed]:
    for index, drones in enumerate(kind.drone_types):
        name = "drones" if drones.id is None else f"drones[{drones.id}]"
        for field, unit, slack, changed in _limits_of(bench, kind, index, is_here):
            others = [*kind.drone_types]
            others[index] = changed
            yield (f"{name}.{field}", unit, slack,
                   replace(kind, drones=others[0], more_drones=tuple(others[1:])))


def _limits_of(bench: Bench, kind: VehicleType, index: int,
               is_here: bool) -> Iterator[tuple[str, Unit, float | None, DroneType]]:
    """Yield the limits of one of the types of drones on a type of vehicle."""
    drones, trip = kind.drone_types[index], _trip_of(bench) if is_here else None
    found = bench.found
    sortie = None
    if found is not None and found.place.by == "drone" and trip is not None:
        sortie = trip.sorties[found.flight]
    if sortie is not None and kind.drone_index(sortie.drone) != index:
        sortie = None
    used = {}
    if trip is not None:
        aboard = [each for each in trip.sorties if kind.drone_index(each.drone) == index]
        used["batteries_aboard"] = len(aboard)
    if sortie is not None and trip is not None:
        used["endurance"] = airborne_duration(bench.problem, drones, trip, sortie)
        ends = [trip.stops[stop].node for stop in (sortie.launch_stop, sortie.recovery_stop)]
        used["range"] = max(
            [farthest(bench.problem, drones, ends, each.node) for each in sortie.visits])
    yield from loosened(drones, used, "flyer", "drones")
    if drones.storms:
        yield "max_wind_kmh", "rule", None, replace(drones, storms=())
    yield from _energy_limits(bench, kind, drones, trip, sortie)
    for dimension, (most, places) in enumerate(zip(drones.capacity, bench.problem.amount_decimals,
                                                   strict=True)):
        slack = None
        if sortie is not None:
            carried = highest(sortie_loads(bench.problem, sortie))
            slack = (most - carried[dimension]) / 10**places
        more = _one_more(drones.capacity, dimension, 10**places)
        yield (_capacity_field("capacity", kind, dimension), "unit", slack,
               replace(drones, capacity=more))


def _energy_limits(bench: Bench, kind: VehicleType, drones: DroneType, trip: Trip | None,
                   sortie: Sortie | None) -> Iterator[tuple[str, Unit, float | None, DroneType]]:
    """Yield what limits drones by their batteries, one of whom flies a sortie of a trip, if any."""
    energy, slack = drones.energy, None
    if energy is None:
        return
    if sortie is not None and trip is not None:
        there = charges(bench.problem, kind, trip)[trip.sorties.index(sortie)]
        taken = sortie_energy(bench.problem, drones, energy, trip, sortie)
        slack = (there - taken) / (energy.usable_share * MICROJOULES_PER_WH)
    yield "energy.battery_wh", "Wh", slack, replace(drones, energy=_one_wh_more(energy))
    if energy.charge:
        stronger = min(energy.charge + WATT, MAX_POWER)
        yield "turnaround.charge_w", "W", None, replace(
            drones, energy=replace(energy, charge=stronger))


def _one_wh_more(energy: Energy) -> Energy:
    """Return the battery with a watt-hour more, as heavy as it is."""
    more = round(energy.usable_share * MICROJOULES_PER_WH)
    return replace(energy, available=energy.available + more)


def _capacity_field(name: str, kind: VehicleType, dimension: int) -> str:
    return f"{name}[{dimension}]" if len(kind.capacity) > 1 else name


def _one_more(capacity: tuple[int, ...], dimension: int, unit: int) -> tuple[int, ...]:
    return tuple([min(most + unit, MAX_QUANTITY) if index == dimension else most
                  for index, most in enumerate(capacity)])
