"""Plans -> their flights as a file, for whoever asks."""

from collections.abc import Callable
from dataclasses import replace
from datetime import datetime

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.checking import PLAN, illegal_plan, read_about_plan
from app.plans.explaining import preparing_within
from app.plans.flights.courses import flights_of
from app.plans.flights.files import FORMAT_ASKED, FlightFile, flight_file
from app.plans.flights.flight import Flight
from app.plans.task import task_of
from app.plans.workplace import Workplace
from app.requests.bounds import Bounds
from app.requests.conversion.ground import Ground
from app.requests.conversion.locating import at_addresses
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.preparing import UNHURRIED, Preparing
from app.requests.plan_reading import parse_plan, read_plan
from app.schemas.errors import InvalidRequestError
from app.schemas.flights import FlightFormat, FlightsRequest, Per, WpmlInput
from app.schemas.plan import PlanInput
from app.schemas.request import PlanRequest
from app.serving.load.received import ReceivedBody


def flights(place: Workplace, body: ReceivedBody, should_stop: Callable[[], bool]) -> FlightFile:
    """Answer `POST /flights` where plans are made."""
    return answer_flights(body.content, place.bounds, should_stop, place.service.roads)


def fly_planned(place: Workplace, request: PlanRequest, reply: bytes, file_format: FlightFormat,
                per: Per, wpml: WpmlInput, should_stop: Callable[[], bool]) -> FlightFile:
    """Answer what is asked of a job's plan there."""
    written = planned_flights(request, parse_plan(reply),
                              preparing_within(place.bounds, should_stop), place.service.roads)
    return flight_file(written, file_format, per, FORMAT_ASKED, wpml)


def answer_flights(body: bytes, bounds: Bounds, should_stop: Callable[[], bool] = lambda: False,
                   roads: Roads = NO_ROADS) -> FlightFile:
    """Return what a request of `POST /flights` asks for, unless the work is to end.

    Raises
    ------
    RequestError
        If `body` is no valid request, the plan breaks a rule or has no flights that the format can
        tell, or the work is to end.
    """
    request = read_about_plan(body, bounds, FlightsRequest)
    flights = judged_flights(request.problem, request.plan, preparing_within(bounds, should_stop),
                             roads)
    return flight_file(flights, request.format, request.per, "$.format", request.wpml)


def judged_flights(problem: PlanRequest, plan: PlanInput, preparing: Preparing = UNHURRIED,
                   roads: Roads = NO_ROADS) -> list[Flight]:
    """Return the flights of a plan that breaks no rule.

    Raises
    ------
    RequestError
        If it breaks one, or as `flights_of` does.
    """
    task = task_of(problem, preparing, roads=roads)
    evaluation = task.check(read_plan(plan, task.problem, (PLAN,)))
    if evaluation.violations:
        raise illegal_plan(evaluation.violations, "Only flights of a plan without broken rules are "
                           "written: correct it, or plan anew.")
    placed = PlacedRequest(problem) if task.places is None else task.places.placed
    return flights_of(placed, plan, Ground(placed, preparing, roads.zones))


def flights_by_vehicle(problem: PlanRequest, plan: PlanInput, roads: Roads,
                       start: datetime) -> dict[str, list[Flight]]:
    """Return a plan's flights as far as they can be written, with another start of its day."""
    try:
        flights = planned_flights(problem, plan, roads=roads)
    except InvalidRequestError:
        return {}
    found: dict[str, list[Flight]] = {}
    for flight in flights:
        found.setdefault(flight.vehicle, []).append(replace(flight, plan_start=start))
    return found


def planned_flights(problem: PlanRequest, plan: PlanInput, preparing: Preparing = UNHURRIED,
                    roads: Roads = NO_ROADS) -> list[Flight]:
    """Return the flights of a plan that was judged as it was made; raises as `flights_of` does."""
    placed = PlacedRequest(at_addresses(problem, plan))
    return flights_of(placed, plan, Ground(placed, preparing, roads.zones))
