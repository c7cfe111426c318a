"""A plan -> the reply of `POST /plan`, as plain data (see `app.schemas.response`)."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from app.plans.energy import energy_models, energy_wh, left_by_sorties, left_by_trips
from app.plans.remedies import Remedies, of_no_request, remedies_reply
from app.requests.conversion.units import money, whole
from app.schemas.customer import place_name
from app.schemas.driving import REST_ID
from app.schemas.shipment import end_name
from model.counsel.explain import Reason, explain
from model.judge.chargers import most_charged
from model.judge.check import Evaluation
from model.judge.fairness import vehicles_lacking
from model.judge.hubs import batteries_taken
from model.judge.metrics import RouteMetrics, SortieMetrics, TripMetrics
from model.planner import PlanOptions, PlanResult
from model.problem import MM_PER_KM, REST, Problem, Shipment
from model.solution import COST_TERMS, Cost, Route, Solution, Sortie, Stop, Trip, Visit

Data = dict[str, Any]

WH_PER_KWH = 1000

MAX_RATE = 1e9
"""Stands for any load where there is no capacity, and any work where none is usual.

JSON knows no infinity.
"""

MOST_REASONS = 10_000
"""Reasons in a reply, of all customers left out together: as many as anybody could read, and not as
many as customers times vehicle types."""

Reasons = Callable[[Solution, int, float], tuple[Reason, ...]]
"""Says why a plan leaves a customer out, as far as is found until an instant."""


def plan_reply(problem: Problem, options: PlanOptions, result: PlanResult,
               reasons: Reasons | None = None, explain_until: float = math.inf,
               remedies: Remedies = of_no_request) -> Data:
    """Return the reply but for `solver.elapsed`'s `validate` and `total`, which are 0.

    `reasons` are those of vehicles that have done nothing yet unless stated; none is looked for
    after `explain_until`, on `time.perf_counter`.
    """
    solution, evaluation = result.solution, result.evaluation
    elapsed = result.elapsed
    why = reasons or partial(explain, problem)
    reply = {
        "status": "partial" if solution.unassigned else "complete",
        "cost": cost_reply(evaluation.cost),
        "routes": [route_reply(problem, route, metrics)
                   for route, metrics in zip(solution.routes, evaluation.routes, strict=True)],
        **_unassigned(problem, solution, lambda node: why(solution, node, explain_until),
                      remedies),
        "summary": summary_reply(problem, solution, evaluation),
        "solver": {
            "policy": options.policy,
            "decoding": options.decoding,
            "seed": options.seed,
            "start": result.start,
            "decoded_cost": money(result.decoded_cost),
            "final_cost": money(result.final_cost),
            "search_iterations": result.search_iterations,
            "threads": result.threads,
            "deterministic": result.deterministic,
            "plans_refused": result.refused,
            "elapsed": {"validate": 0.0, "decode": elapsed.decode, "search": elapsed.search,
                        "check": elapsed.check, "total": 0.0},
        },
    }
    more = {"energy_models": energy_models(problem), "hubs": hubs_reply(problem, solution)}
    return reply | {name: entries for name, entries in more.items() if entries}


def hubs_reply(problem: Problem, solution: Solution) -> list[Data]:
    """Return what is left at depots that have only so much for who flies."""
    taken = batteries_taken(problem, solution.routes)
    return [{"depot": depot.id,
             "batteries_left": _left(depot.batteries, taken[node]),
             "chargers_left": _left(depot.chargers, most_charged(problem, solution, node))}
            for node, depot in enumerate(problem.depots)
            if depot.batteries is not None or depot.chargers is not None]


def _left(stock: int | None, taken: int) -> int | None:
    return None if stock is None else stock - taken


def vehicle_name(problem: Problem, route: Route) -> str:
    """Return the name of a vehicle, such as `truck-1`."""
    return problem.vehicle_types[route.vehicle_type].vehicle_name(route.vehicle)


def cost_reply(cost: Cost) -> Data:
    """Return a cost by term."""
    return {term: money(getattr(cost, term)) for term in ("total", *COST_TERMS)}


def _finite(rate: float | None) -> float | None:
    return None if rate is None else min(rate, MAX_RATE)


def route_reply(problem: Problem, route: Route, metrics: RouteMetrics) -> Data:
    """Return one vehicle's work."""
    name = vehicle_name(problem, route)
    return {
        "vehicle": name,
        "type": problem.vehicle_types[route.vehicle_type].type_id,
        "working_duration": whole(metrics.working_duration),
        "working_rate": _finite(metrics.working_rate),
        "overtime": whole(metrics.overtime),
        "cost": money(metrics.cost),
        "trips": [_trip(problem, route.vehicle_type, name, trip, measured, left)
                  for trip, measured, left in zip(route.trips, metrics.trips,
                                                  left_by_trips(problem, route), strict=True)],
    }


def _trip(problem: Problem, kind: int, vehicle: str, trip: Trip, metrics: TripMetrics,
          left: Sequence[Data]) -> Data:
    return {
        "load": _amounts(problem, metrics.load),
        "load_rate": _finite(metrics.load_rate),
        "distance": whole(metrics.distance),
        "duration": whole(metrics.duration),
        "stops": [told for number, (stop, load, at_stop) in enumerate(
                      zip(trip.stops, metrics.stop_loads, left, strict=True))
                  for told in [*([] if problem.is_nowhere(stop.node)
                                 else [_stop(problem, stop, load) | at_stop]),
                               *_breaks_after(problem, kind, trip, number, load)]],
        "sorties": [_sortie(problem, kind, vehicle, _as_told(trip, sortie), measured,
                            behind)
                    for sortie, measured, behind in zip(
                        trip.sorties, metrics.sorties, left_by_sorties(problem, kind, trip),
                        strict=True)],
        "energy_wh": energy_wh(_flights(metrics)),
        **({"charging": [{"start": charge.start / 1000, "end": charge.end / 1000}
                         for charge in trip.charges]} if trip.charges else {}),
    }


def _flights(trip: TripMetrics) -> list[int | None]:
    """Return what each flight of a trip takes, the vehicle's own first."""
    return [trip.energy, *(sortie.energy for sortie in trip.sorties)]


def _breaks_after(problem: Problem, kind: int, trip: Trip, stop: int,
                   load: Sequence[int]) -> list[Data]:
    """Return the breaks between a stop of a trip and the next."""
    return [{
        "kind": "break",
        "id": (REST_ID if taken.number == REST
               else problem.vehicle_types[kind].breaks[taken.number].id),
        "arrival": taken.arrival / 1000,
        "service_start": taken.start / 1000,
        "departure": taken.end / 1000,
        "waiting": (taken.start - taken.arrival) / 1000,
        "lateness": 0.0,
        "load": _amounts(problem, load),
    } for taken in trip.breaks if taken.stop == stop]


def _as_told(trip: Trip, sortie: Sortie) -> Sortie:
    """Return a sortie whose stops are numbered as in a reply, where breaks are stops, too."""
    if not trip.breaks:
        return sortie
    launch, recovery = (stop + sum([taken.stop < stop for taken in trip.breaks])
                        for stop in (sortie.launch_stop, sortie.recovery_stop))
    return replace(sortie, launch_stop=launch, recovery_stop=recovery)


def _stop(problem: Problem, stop: Stop, load: Sequence[int]) -> Data:
    is_depot = stop.node < len(problem.depots)
    place = (problem.depots[stop.node] if is_depot
             else problem.customers[stop.node - len(problem.depots)])
    kind: str = problem.depots[stop.node].kind if is_depot else "customer"
    return {
        "kind": kind, **({"id": place.id} if is_depot else place_reply(problem, stop.node)),
        "arrival": stop.arrival / 1000,
        "service_start": stop.service_start / 1000,
        "departure": stop.departure / 1000,
        **_setup(stop),
        "waiting": (stop.service_start - stop.ready) / 1000,
        "lateness": 0.0 if is_depot else _lateness(problem, stop),
        "load": _amounts(problem, load),
    }


def place_reply(problem: Problem, node: int) -> Data:
    """Return who is served at a node, and at which place if it isn't his own."""
    name, first = problem.customer_at(node).id, problem.first_place(node)
    if node in problem.shipment_at:
        shipment = problem.shipment_at[node]
        if node == shipment.delivery:
            return {"kind": "delivery", "id": shipment.id}
        part = _part(problem, shipment, node)
        return {"kind": "pickup", "id": shipment.id, **({} if part is None else {"part": part})}
    if node == first:
        return {"id": name}
    own = problem.customer_at(first).id
    return {"id": own, "alternative": name.removeprefix(place_name(own, ""))}


def _part(problem: Problem, shipment: Shipment, pickup: int) -> str | None:
    """Return which of a shipment's `pickups` one is; None if it isn't stated so."""
    name, before = problem.customer_at(pickup).id, end_name(shipment.id, "pickup", "")
    return name.removeprefix(before) if name.startswith(before) else None


def _left_out(problem: Problem, shipment: Shipment) -> Data:
    """Return which shipment is left out, and its parts."""
    parts = [_part(problem, shipment, pickup) for pickup in shipment.pickups]
    named = {"kind": "shipment", "id": shipment.id}
    return named if parts == [None] else named | {"parts": parts}


def _amounts(problem: Problem, load: Sequence[int]) -> list[float]:
    """Return amounts in the client's unit."""
    return [amount / 10**places
            for amount, places in zip(load, problem.amount_decimals, strict=True)]


def _lateness(problem: Problem, visit: Stop | Visit) -> float:
    latest = problem.customers[visit.node - len(problem.depots)].latest
    return max(0, visit.service_start - latest) / 1000


def _setup(visit: Stop | Visit) -> Data:
    """Return the field of a visit's setup, if there is one."""
    return {"setup": visit.setup / 1000} if visit.setup else {}


def _sortie(problem: Problem, kind: int, vehicle: str, sortie: Sortie,
            metrics: SortieMetrics, left: Sequence[Data]) -> Data:
    drone_type = problem.vehicle_types[kind].drone_type(sortie.drone).id
    return {
        "drone": f"{vehicle}/drone-{sortie.drone + 1}",
        **({"drone_type": drone_type} if drone_type is not None else {}),
        "launch_stop": sortie.launch_stop,
        "recovery_stop": sortie.recovery_stop,
        "load": _amounts(problem, metrics.loads[0]),
        "customers": [
            {
                **place_reply(problem, visit.node),
                "arrival": visit.arrival / 1000,
                "service_start": visit.service_start / 1000,
                "departure": visit.departure / 1000,
                **_setup(visit),
                "lateness": _lateness(problem, visit),
                "load": _amounts(problem, load),
                **behind,
            }
            for visit, load, behind in zip(sortie.visits, metrics.loads[1:], left, strict=False)
        ],
        "launch_time": whole(sortie.launch_time),
        "recovery_time": whole(sortie.recovery_time),
        "distance": whole(metrics.distance),
        "duration": whole(metrics.duration),
        "energy_wh": energy_wh([metrics.energy]),
        **left[-1],
    }


def _unassigned(problem: Problem, solution: Solution,
                why: Callable[[int], tuple[Reason, ...]], remedies: Remedies) -> Data:
    """Return the fields of a reply on who is left out."""
    told: list[Data] = []
    left_out = frozenset(solution.unassigned)
    room, unexplained = MOST_REASONS, 0
    for node in solution.unassigned:
        shipment = problem.shipment_at.get(node)
        # Of one that was aboard a vehicle which broke down not all ends are.
        if shipment is not None and node != next(filter(left_out.__contains__, shipment.nodes)):
            continue
        reasons = one_per_type(problem, why(node)) if room > 0 else []
        room -= len(reasons)
        unexplained += not reasons
        named = ({"id": problem.customer_at(node).id} if shipment is None
                 else _left_out(problem, shipment))
        told.append({**named,
                     "reasons": [reason_reply(problem, node, reason, remedies)
                                 for reason in reasons]})
    return {"unassigned": told} | ({"unexplained": unexplained} if unexplained else {})


def reason_reply(problem: Problem, node: int, reason: Reason, remedies: Remedies) -> Data:
    """Return why vehicles of a type don't serve a customer."""
    return {
        "vehicle_type": problem.vehicle_types[reason.vehicle_type].type_id,
        "code": reason.code,
        "message": reason.message,
        **remedies_reply([remedies(node, reason, remedy) for remedy in reason.remedies]),
    }


def one_per_type(problem: Problem, reasons: Iterable[Reason]) -> list[Reason]:
    """Return one reason for each type of the request, of those for its parts.

    That of vehicles which may serve the customer, and a remedy, tell more.
    """
    if all(kind.part_of is None for kind in problem.vehicle_types):
        return list(reasons)
    told: dict[str, Reason] = {}
    for reason in reasons:
        name = problem.vehicle_types[reason.vehicle_type].type_id
        told[name] = max(told.get(name, reason), reason,
                         key=lambda reason: (reason.code != "VEHICLE", reason.remedy is not None))
    return list(told.values())


def summary_reply(problem: Problem, solution: Solution, evaluation: Evaluation) -> Data:
    """Return a plan in numbers, even if it breaks rules."""
    trips = [trip for route in evaluation.routes for trip in route.trips]
    sorties = [sortie for trip in trips for sortie in trip.sorties]
    flown = _flown_by_themselves(problem, solution, evaluation)
    served = _served(problem, solution)
    rates = [min(trip.load_rate, MAX_RATE) for trip in trips] or [0.0]
    left_out = problem.left_out(served)
    return {
        "customers": len(served) + len(left_out),
        "served": len(served),
        "must_unserved": sum([problem.must_be_served(problem.customer_at(node))
                              for node in {*map(problem.unit_of, left_out)}]),
        "vehicles": len(solution.routes),
        "vehicles_lacking": vehicles_lacking(problem, len(solution.routes)),
        "trips": len(trips),
        "sorties": len(sorties),
        "distance": whole(sum(trip.distance for trip in trips) - flown),
        "drone_distance": whole(sum(sortie.distance for sortie in sorties) + flown),
        "energy_wh": energy_wh([energy for trip in trips for energy in _flights(trip)]),
        "load_rate": {"min": min(rates), "mean": sum(rates) / len(rates), "max": max(rates)},
        "makespan": whole(evaluation.makespan),
        "co2_kg": _co2(problem, solution, evaluation),
    }


def _flown_by_themselves(problem: Problem, solution: Solution, evaluation: Evaluation) -> int:
    """Return how far vehicles fly that do so by themselves, in mm."""
    return sum([trip.distance for route, metrics in zip(solution.routes, evaluation.routes,
                                                        strict=True)
                if 0 <= route.vehicle_type < len(problem.vehicle_types)
                and problem.vehicle_types[route.vehicle_type].flies for trip in metrics.trips])


def _co2(problem: Problem, solution: Solution, evaluation: Evaluation) -> float | None:
    """Return the kilograms of CO2 of a plan; None if no vehicle type states any."""
    kinds = problem.vehicle_types
    if all(kind.co2_kg_per_km is None and kind.co2_kg_per_kwh is None for kind in kinds):
        return None
    total = 0.0
    for route, metrics in zip(solution.routes, evaluation.routes, strict=True):
        kind = kinds[route.vehicle_type]
        driven = sum(trip.distance for trip in metrics.trips) / MM_PER_KM
        flown = energy_wh([energy for trip in metrics.trips for energy in _flights(trip)])
        total += driven * (kind.co2_kg_per_km or 0.0)
        total += (flown or 0.0) / WH_PER_KWH * (kind.co2_kg_per_kwh or 0.0)
    return money(total)


def _served(problem: Problem, solution: Solution) -> set[int]:
    """Return the nodes of the customers who are served."""
    return {node for node in solution.served if problem.num_depots <= node < problem.num_nodes}
