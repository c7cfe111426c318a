"""Why drones that a vehicle in use carries fly nothing: what hinders them, or that no flight saves.

Whom they could carry and reach is looked at first; those left are flown to by way of trial, all
others staying as they are, and the judge says what that would cost or break.
"""

import math
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from operator import le
from typing import NamedTuple

import numpy as np

from model.counsel.bench import Bench, Setting
from model.judge.check import JudgedRoute
from model.problem import UNREACHABLE, Customer, DroneType, Problem, VehicleType
from model.solution import Route, Solution, Vehicle

TRIES = 3
"""Flights tried to a customer, the likeliest ones."""

MOST_TRIED = 60
"""Customers flown to by way of trial for a vehicle: its own first, then those who are nearest."""

NOTHING_SAVED = 0.005
"""What isn't worth telling, in the currency of costs."""


class Idle(NamedTuple):
    """Why a vehicle's drones fly nothing."""

    route: int  # index of the vehicle's route
    code: str
    message: str
    node: int | None = None  # the customer of whom it speaks
    cost: float | None = None  # what the best legal flight would cost more


def idle_drones(problem: Problem, solution: Solution, setting: Setting | None = None,
                until: float = math.inf,
                judged: Mapping[int, JudgedRoute] | None = None) -> Iterator[Idle]:
    """Yield why the drones of each vehicle in use fly nothing that has some which don't.

    `until` is on `time.perf_counter`; `judged` are the plan's routes, if known.
    """
    setting = setting or Setting()
    judged = setting.judge_routes(problem, solution) if judged is None else judged
    for index, route in enumerate(solution.routes):
        kind = problem.vehicle_types[route.vehicle_type]
        if kind.num_drones and not any(trip.sorties for trip in route.trips):
            yield _why(problem, solution, index, setting, until, judged)


def _why(problem: Problem, solution: Solution, index: int, setting: Setting, until: float,
         judged: Mapping[int, JudgedRoute]) -> Idle:
    route = solution.routes[index]
    vehicle, kind = route.driven_by, problem.vehicle_types[route.vehicle_type]
    hindered = _hindered(problem, kind, vehicle, setting)
    if hindered is not None:
        return Idle(index, *hindered)
    served = setting.past.served()
    nodes = [node for node in range(problem.num_depots, problem.num_nodes)
             if node not in served and _may_be_flown_to(problem, route.vehicle_type, node)]
    if not nodes:
        return Idle(index, "KIND", "No customer may be served by its drones.")
    light = [node for node in nodes
             if any(_carries(drones, problem.customer_at(node)) for drones in kind.drone_types)]
    if not light:
        return Idle(index, "CAPACITY", "No order is light enough for its drones.")
    if not _launch_stops(problem, route):
        return Idle(index, "LAUNCH", "Its drones may take off at none of its stops.")
    near = _near(problem, kind, route, light)
    if not near:
        return Idle(index, "RANGE", "Nobody whose order its drones can carry is within reach of "
                    "its stops.")
    own = {*route.served}
    order = sorted(near, key=lambda found: found[1] not in own)
    return _tried(problem, solution, index, [node for _, node in order[:MOST_TRIED]], setting,
                  until, judged)


def _hindered(problem: Problem, kind: VehicleType, vehicle: Vehicle,
              setting: Setting) -> tuple[str, str] | None:
    """Return what keeps all drones of a vehicle down, whoever is to be served."""
    if len(setting.past.grounded_on(vehicle)) >= kind.num_drones:
        return "LOST", "Its drones are launched no more."
    if vehicle in setting.past.unavailable:
        return "UNAVAILABLE", "It does nothing more."
    if kind.max_sorties == 0:
        return "SORTIES", "No drone takes off, by its max_sorties."
    if all(drones.batteries == 0 for drones in kind.drone_types):
        return "SORTIES", "No drone takes off, by its batteries."
    return None


def _may_be_flown_to(problem: Problem, kind: int, node: int) -> bool:
    customer = problem.customer_at(node)
    return (customer.served_by != "truck" and problem.allows(kind, node)
            and customer.skills <= problem.vehicle_types[kind].skills)


def _carries(drones: DroneType, customer: Customer) -> bool:
    return (all(map(le, customer.demand, drones.capacity))
            and all(map(le, customer.taken_in, drones.capacity)))


def _launch_stops(problem: Problem, route: Route) -> list[int]:
    """Return the nodes of a route's stops where drones may take off."""
    return [stop.node for trip in route.trips for stop in trip.stops
            if problem.may_launch_at(stop.node)]


def _near(problem: Problem, kind: VehicleType, route: Route,
          nodes: list[int]) -> list[tuple[int, int]]:
    """Return those of some customers who are within reach of a route's stops, the nearest first.

    With the shortest flight each, from a stop to the customer and to a stop.
    """
    stops = np.array(_launch_stops(problem, route))
    ways: dict[int, int] = {}
    for drones in kind.drone_types:
        light = [node for node in nodes if _carries(drones, problem.customer_at(node))]
        if not light:
            continue
        flight, targets = problem.travel[drones.travel].duration, np.array(light)
        own = stops[:, None] == targets
        there = np.where(own, UNREACHABLE, flight[stops[:, None], targets]).min(axis=0)
        back = np.where(own.T, UNREACHABLE, flight[targets[:, None], stops]).min(axis=1)
        for node, out, home in zip(light, there.tolist(), back.tolist(), strict=True):
            way = out + drones.service_at(problem.customer_at(node)) + home
            if max(out, home) < UNREACHABLE and way <= drones.endurance:
                ways[node] = min(way, ways.get(node, way))
    return sorted((way, node) for node, way in ways.items())


def _tried(problem: Problem, solution: Solution, index: int, nodes: list[int], setting: Setting,
           until: float, judged: Mapping[int, JudgedRoute]) -> Idle:
    """Return what comes of flying to each of some customers."""
    route = solution.routes[index]
    vehicle = route.driven_by
    best: tuple[float, int] | None = None
    broken: Counter[str] = Counter()
    message, at = "", nodes[0]
    is_cut = False
    for node in nodes:
        if time.perf_counter() >= until:
            is_cut = True
            break
        bench = Bench(problem, solution, node, setting, judged)
        flights = bench.guesses(wanted=vehicle.__eq__).get((vehicle, "drone"), [])
        trials = [bench.put(guess.place) for guess in flights[:TRIES]]
        legal = [trial.evaluation.cost.total for trial in trials if trial.evaluation.is_feasible]
        if legal:
            more = min(legal) - bench.plan.evaluation.cost.total
            best = min(best or (more, node), (more, node))
        elif trials:
            violation = min(trials, key=lambda trial: trial.rank).evaluation.violations[0]
            broken[violation.code] += 1
            if broken.most_common(1)[0][0] == violation.code:
                message, at = violation.message, node
    if best is not None:
        return _worth(problem, index, *best)
    if is_cut:
        return Idle(index, "UNTRIED", "There was no time to find out.")
    if not broken:
        return Idle(index, "RANGE", "No flight leads from its stops to a customer and back.")
    code, _ = broken.most_common(1)[0]
    return Idle(index, code, f"No flight keeps all rules: to {problem.customer_at(at).id}, "
                f"{message}.", at)


def _worth(problem: Problem, index: int, more: float, node: int) -> Idle:
    name = problem.customer_at(node).id
    if more < -NOTHING_SAVED:
        return Idle(index, "SAVES", f"A flight to {name} would save {-more:.2f}: the search didn't "
                    "find it.", node, more)
    dearer = f"cost {more:.2f} more" if more > NOTHING_SAVED else "cost as much"
    return Idle(index, "COSTS_MORE", f"No flight would save: the best, to {name}, would {dearer}.",
                node, more)
