"""From the body of a request to the body of its reply."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from pydantic_core import to_json

from app.formats.vroom.errors import INPUT, TOO_LARGE, VroomError, input_error, refused
from app.formats.vroom.places import StatedPlaces, find_places
from app.formats.vroom.reading import read_request
from app.formats.vroom.reply import ReplyWriter
from app.formats.vroom.roads import add_lines
from app.formats.vroom.schemas import VroomOptionsInput, VroomRequest
from app.formats.vroom.translate import given_routes, translate
from app.formats.vroom.violations import add_violations
from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.workplace import Workplace
from app.requests.conversion.preparing import Preparing, patience
from app.schemas.errors import InvalidRequestError
from app.serving.load.received import ReceivedBody
from app.serving.settings import Settings
from model.dialects.vroom.checking import drive, route_faults
from model.dialects.vroom.errors import RefusedError
from model.dialects.vroom.kinds import VehicleKind
from model.dialects.vroom.models import Routes
from model.dialects.vroom.places import Sites
from model.dialects.vroom.planning import Planning
from model.dialects.vroom.reasons import reasons_of
from model.dialects.vroom.request import Request
from model.dialects.vroom.timing import RouteTimer, TimedVroomRoute
from model.dialects.vroom.work import LegLimit
from model.engine.cores import num_cores
from model.planner import Listener, Planner, PlanOptions, PlanResult
from model.problem import Problem
from model.solution import Solution

EXPLORATION_SECONDS = (0.1, 0.25, 0.5, 1.0, 2.0, 5.0)
"""How long to search by `options.x`."""

LINES = 2.0
"""Seconds in which roads have to tell the lines of all routes, where they are asked for."""

LEAST_PREPARING = 0.25
"""Seconds by which the work before the search is judged at least: `x` 0 asks for the least search,
whatever the request's size."""

SECONDS_PER_JOB = 2e-4
"""Kept back for the last check and the reply."""


def answer(planner: Planner, body: ReceivedBody, settings: Settings,
           should_stop: Callable[[], bool],
           on_plan: Callable[[Mapping[str, Any]], None] = lambda _: None,
           roads: Roads = NO_ROADS, on_refused: Callable[[], None] = lambda: None) -> bytes:
    """Return the reply to a VROOM request as JSON; `on_plan` is told it.

    `on_refused` is called for each plan found on the way that breaks a rule of VROOM's.

    The search ends as soon as `should_stop` says so, with the best plan so far.

    Raises
    ------
    VroomError
        If `body` is no request that can be planned here.
    PlanCheckError
        If the plan found breaks a rule.
    """
    # Since then, not since the body came: waiting for a turn is no work on the request.
    began = time.thread_time()
    request = read_request(body.content, settings.max_customers, settings.max_customers)
    preparing = preparing_of(request.options, began, settings, should_stop)
    try:
        places = find_places(request, settings.vroom_speeds, settings.max_legs, preparing, roads)
        reply = _answer(planner, request, places, body, settings, preparing, on_refused)
        if request.options.g and places.on_roads:
            add_lines(reply, {vehicle.id: vehicle.profile for vehicle in request.vehicles
                              if vehicle.profile in places.on_roads}, roads,
                      time.perf_counter() + LINES)
    except InvalidRequestError as error:
        raise VroomError(TOO_LARGE, error.errors[0].message) from error
    except RefusedError as error:
        raise refused(error) from error
    on_plan(reply)
    return to_json(reply)


def answer_there(place: Workplace, body: ReceivedBody,
                 should_stop: Callable[[], bool]) -> bytes:
    """Return the same where plans are made; raises as `answer` does."""
    return answer(place.service.planner, body, place.settings, should_stop,
                  place.count_vroom_plan, place.service.roads, place.count_refused_plan)


def preparing_of(stated: VroomOptionsInput, began: float, settings: Settings,
                 should_stop: Callable[[], bool]) -> Preparing:
    """Return the work before the search, which is a part of the time limit."""
    seconds = search_seconds(stated, settings)
    return Preparing(
        should_stop, max(LEAST_PREPARING, seconds),
        f"the time limit of {seconds:g} s, which options.l states up to "
        f"{settings.max_plan_seconds:g} s (TANDEM_MAX_PLAN_SECONDS)", began=began,
        work="Legs and a first plan",
        advice="send fewer jobs, or fewer vehicles that drive unlike each other",
        patience=patience(settings.max_plan_seconds) if stated.l is None else 0.0)


def _answer(planner: Planner, stated: VroomRequest, places: StatedPlaces, body: ReceivedBody,
            settings: Settings, preparing: Preparing,
            on_refused: Callable[[], None]) -> Mapping[str, Any]:
    request = translate(stated)
    if stated.options.c:
        return timed(stated, request, places, body)
    options = PlanOptions(
        planner.policies[0],
        threads=min(stated.options.t or settings.search_threads, num_cores()))

    def plan(problem: Problem, options: PlanOptions, start: Solution) -> PlanResult:
        return planner.plan(problem, options, listener=Listener(preparing.should_stop),
                            start=start)

    limit = LegLimit(settings.max_legs, "TANDEM_MAX_LEGS")
    planning = Planning(request, places, plan, options, limit, preparing)
    start = stated_routes(request, places, planning.kinds)
    loaded = time.perf_counter()
    seconds = search_seconds(stated.options, settings) - SECONDS_PER_JOB * len(request.jobs)
    found = planning.find(body.received_at + preparing.waited + seconds, start)
    for _ in range(planning.refused):
        on_refused()
    routes = name_vehicles(request, places, planning.kinds, found.routes)
    solved = time.perf_counter()
    reasons = reasons_of(request, places, planning.kinds, {route.vehicle for route in routes},
                         [job for job in range(len(request.jobs)) if job not in found.served])
    return ReplyWriter(stated, places, request.is_timed, reasons).reply(
        routes, loading=int(1000 * (loaded - body.received_at)),
        solving=int(1000 * (solved - loaded)))


def timed(stated: VroomRequest, request: Request, places: StatedPlaces,
          body: ReceivedBody) -> Mapping[str, Any]:
    """Return the reply that times the routes in `steps`, with what they violate.

    Raises
    ------
    VroomError
        If there is no way, or not at the times that are forced.
    """
    loaded = time.perf_counter()
    routes = []
    for given in given_routes(stated):
        route = RouteTimer(request, places, given.vehicle).drive_given(given)
        if route is None:
            raise VroomError(INPUT, "Infeasible route for vehicle "
                                    f"{request.vehicles[given.vehicle].id}.")
        routes.append(route)
    solved = time.perf_counter()
    reply = ReplyWriter(stated, places, is_timed=True).reply(
        routes, loading=int(1000 * (loaded - body.received_at)),
        solving=int(1000 * (solved - loaded)))
    add_violations(stated, reply)
    return reply


def search_seconds(options: VroomOptionsInput, settings: Settings) -> float:
    """Return the time limit of a request in seconds."""
    seconds = settings.vroom_seconds if options.x is None else EXPLORATION_SECONDS[options.x]
    if options.l is not None:
        seconds = options.l if options.x is None else min(seconds, options.l)
    return min(seconds, settings.max_plan_seconds)


def stated_routes(request: Request, places: Sites, kinds: Sequence[VehicleKind]) -> Routes:
    """Return the routes that `steps` describe, by the index of the vehicle's kind.

    Raises
    ------
    VroomError
        If one breaks a rule.
    """
    routes: dict[int, list[Sequence[int]]] = {}
    faults: list[str] = []
    for number, kind in enumerate(kinds):
        for vehicle in kind.vehicles:
            jobs = request.vehicles[vehicle].steps
            if jobs:
                faults += route_faults(request, places, vehicle, jobs)
                routes.setdefault(number, []).append(jobs)
    if faults:
        raise input_error(faults)
    return routes


def name_vehicles(request: Request, places: Sites, kinds: Sequence[VehicleKind],
                  routes: Routes) -> list[TimedVroomRoute]:
    """Return the routes, each with a vehicle of its kind, in the order of vehicles."""
    timed = [drive(request, places, vehicle, jobs)
             for number, its_routes in routes.items()
             for vehicle, jobs in _matched(request, kinds[number], its_routes)]
    return sorted(timed, key=lambda route: route.vehicle)


def _matched(request: Request, kind: VehicleKind,
             routes: Sequence[Sequence[int]]) -> Iterator[tuple[int, Sequence[int]]]:
    """Yield vehicles that are alike with their routes: the one most like its `steps`, or any."""
    left = list(routes)
    others = []
    for vehicle in kind.vehicles:
        stated = set(request.vehicles[vehicle].steps)
        alike = max(left, key=lambda jobs: len(stated.intersection(jobs)), default=())
        if stated.intersection(alike):
            left.remove(alike)
            yield vehicle, alike
        else:
            others.append(vehicle)
    yield from zip(others, left, strict=False)
