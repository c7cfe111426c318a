"""From the body of a request to the body of its reply."""

import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from pydantic_core import to_json

from app.conversion.preparing import Preparing
from app.errors import InvalidRequestError
from app.load.bodies import ReceivedBody
from app.settings import Settings
from app.vroom.checking import drive, route_faults
from app.vroom.errors import TOO_LARGE, VroomError, input_error
from app.vroom.kinds import Kind
from app.vroom.models import Routes
from app.vroom.places import Places, find_places
from app.vroom.planning import Planning
from app.vroom.reading import read_request
from app.vroom.reply import Writer
from app.vroom.schemas import VroomOptionsInput, VroomRequest
from app.vroom.timing import TimedRoute
from model.planner import Listener, Planner, PlanOptions, PlanResult
from model.problem import Problem
from model.search.improve import Progress
from model.solution import Solution

EXPLORATION_SECONDS = (0.1, 0.25, 0.5, 1.0, 2.0, 5.0)
"""How long to search by `options.x`."""

LEAST_PREPARING = 0.25
"""Seconds that may pass before the search, however short its time limit: on a busy machine a small
request would be refused else."""

SECONDS_PER_JOB = 2e-4
"""Kept back for the last check and the reply."""


def answer(planner: Planner, body: ReceivedBody, settings: Settings,
           should_stop: Callable[[], bool],
           on_plan: Callable[[Mapping[str, Any]], None] = lambda _: None) -> bytes:
    """Return the reply to a VROOM request as JSON; `on_plan` is told it.

    The search ends as soon as `should_stop` says so, with the best plan so far.

    Raises
    ------
    VroomError
        If `body` is no request that can be planned here.
    PlanCheckError
        If the plan found breaks a rule.
    """
    request = read_request(body.content, settings.max_customers, settings.max_customers)
    preparing = preparing_of(request.options, body, settings, should_stop)
    try:
        return _answer(planner, request, body, settings, preparing, on_plan)
    except InvalidRequestError as error:
        raise VroomError(TOO_LARGE, error.errors[0].message) from error


def preparing_of(stated: VroomOptionsInput, body: ReceivedBody, settings: Settings,
                 should_stop: Callable[[], bool]) -> Preparing:
    """Return the work before the search, which is a part of the time limit."""
    seconds = search_seconds(stated, settings)
    return Preparing(
        should_stop, max(LEAST_PREPARING, seconds),
        f"the time limit of {seconds:g} s, which options.l states up to "
        f"{settings.max_plan_seconds:g} s (TANDEM_MAX_PLAN_SECONDS)", began=body.received_at,
        work="Legs and a first plan",
        advice="send fewer jobs, or fewer vehicles that drive unlike each other")


def _answer(planner: Planner, request: VroomRequest, body: ReceivedBody, settings: Settings,
            preparing: Preparing, on_plan: Callable[[Mapping[str, Any]], None]) -> bytes:
    places = find_places(request, settings.vroom_speeds, settings.max_legs, preparing)
    options = PlanOptions(
        planner.policies[0],
        threads=min(request.options.t or settings.search_threads, os.cpu_count() or 1))

    def plan(problem: Problem, options: PlanOptions, start: Solution,
             tell: Callable[[Progress], None]) -> PlanResult:
        return planner.plan(problem, options, listener=Listener(preparing.should_stop, tell),
                            start=start)

    planning = Planning(request, places, plan, options, settings.max_legs, preparing)
    start = stated_routes(request, places, planning.kinds)
    loaded = time.perf_counter()
    seconds = search_seconds(request.options, settings) - SECONDS_PER_JOB * len(request.jobs)
    found = planning.find(body.received_at + seconds, start)
    routes = name_vehicles(request, places, planning.kinds, found.routes)
    solved = time.perf_counter()
    reply = Writer(request, places).reply(
        routes, loading=int(1000 * (loaded - body.received_at)),
        solving=int(1000 * (solved - loaded)))
    on_plan(reply)
    return to_json(reply)


def search_seconds(options: VroomOptionsInput, settings: Settings) -> float:
    """Return the time limit of a request in seconds."""
    seconds = settings.vroom_seconds if options.x is None else EXPLORATION_SECONDS[options.x]
    if options.l is not None:
        seconds = options.l if options.x is None else min(seconds, options.l)
    return min(seconds, settings.max_plan_seconds)


def stated_routes(request: VroomRequest, places: Places, kinds: Sequence[Kind]) -> Routes:
    """Return the routes that `steps` describe, by the index of the vehicle's kind.

    Raises
    ------
    VroomError
        If one breaks a rule.
    """
    index_of = {job.id: index for index, job in enumerate(request.jobs)}
    routes: dict[int, list[list[int]]] = {}
    faults: list[str] = []
    for number, kind in enumerate(kinds):
        for vehicle in kind.vehicles:
            jobs = stated_jobs(request, vehicle, index_of)
            if jobs:
                faults += route_faults(request, places, vehicle, jobs)
                routes.setdefault(number, []).append(jobs)
    if faults:
        raise input_error(faults)
    return routes


def stated_jobs(request: VroomRequest, vehicle: int, index_of: dict[int, int]) -> list[int]:
    """Return the jobs that a vehicle's `steps` name, in order."""
    return [index_of[step.id] for step in request.vehicles[vehicle].steps if step.id is not None]


def name_vehicles(request: VroomRequest, places: Places, kinds: Sequence[Kind],
                  routes: Routes) -> list[TimedRoute]:
    """Return the routes, each with a vehicle of its kind, in the order of vehicles."""
    timed = [drive(request, places, vehicle, jobs)
             for number, its_routes in routes.items()
             for vehicle, jobs in _matched(request, kinds[number], its_routes)]
    return sorted(timed, key=lambda route: route.vehicle)


def _matched(request: VroomRequest, kind: Kind,
             routes: Sequence[Sequence[int]]) -> Iterator[tuple[int, Sequence[int]]]:
    """Yield vehicles that are alike with their routes: the one most like its `steps`, or any."""
    index_of = {job.id: index for index, job in enumerate(request.jobs)}
    left = list(routes)
    others = []
    for vehicle in kind.vehicles:
        stated = set(stated_jobs(request, vehicle, index_of))
        alike = max(left, key=lambda jobs: len(stated.intersection(jobs)), default=())
        if stated.intersection(alike):
            left.remove(alike)
            yield vehicle, alike
        else:
            others.append(vehicle)
    yield from zip(others, left, strict=False)
