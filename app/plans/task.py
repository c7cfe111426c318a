"""What a request asks for: a plan from nothing, or one that goes on from another."""

import re
import time
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property, partial

from pydantic_core import to_json

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.carried import Info, carry, info_of, names_left_out
from app.plans.changes import Changing, Stated
from app.plans.closures import Closures
from app.plans.far_plans import FarPlans
from app.plans.geometry import Geometry
from app.plans.lateness import LatenessRisk
from app.plans.permits import Permits
from app.plans.remedies import remedy_reply
from app.plans.replan_replies import on_the_wire, replan_reply
from app.plans.replies import Data, plan_reply, route_reply
from app.plans.risking import RiskSearch, further
from app.plans.rulebook import laws_named, rules_named
from app.plans.steps import step
from app.plans.storms import Storms
from app.plans.telling import IN_SECONDS, Telling
from app.plans.terms import terms_of
from app.plans.waves import Waves
from app.requests.conversion.ground import Ground
from app.requests.conversion.leg_origins import LegOrigin
from app.requests.conversion.locating import Located, located
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.preparing import UNHURRIED, Preparing
from app.requests.conversion.problem import problem_of
from app.requests.conversion.travels import Travels
from app.requests.conversion.work import replanning_seconds
from app.requests.plan_departed import with_what_is_there
from app.requests.plan_reading import plan_to_solution
from app.requests.warnings.addresses import address_warnings
from app.requests.warnings.finding import warnings_of
from app.requests.warnings.warning import RequestWarning
from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.request import PlanRequest
from app.schemas.response import PlanReply
from model.counsel.bench import Setting
from model.counsel.binding import Limit
from model.counsel.explain import Reason, explain
from model.counsel.more_trips import with_another_trip
from model.counsel.remedy import Remedy
from model.judge.check import Evaluation, JudgedRoute, check
from model.judge.rules import Violation
from model.planner import ALONE, Elapsed, Listener, Planner, PlanOptions, PlanResult
from model.problem import Problem
from model.problem.altered import differ_in_last
from model.replanning.refusing import SettledPartError
from model.replanning.replan import Replanning, Terms
from model.replanning.workers import TooManyTypesError
from model.solution import Solution


EXPLAINING, EXPLAINING_SHARE = 0.05, 0.02
"""Seconds, and besides a share of the time limit, in which reasons are looked for why customers are
left out: some hundred are found in the first of them."""

GEOMETRY_PER_CUSTOMER, MOST_GEOMETRY, LEAST_GEOMETRY = 5e-5, 0.1, 0.5
"""Seconds per customer kept back for the lines of legs, but no more than a share of the time limit;
and how long, besides that share, they may take at most."""


@dataclass(frozen=True)
class Task:
    """A problem to plan, and the plan to go on from if there is one."""

    problem: Problem
    replanning: Replanning | None = None
    info: Info = field(default_factory=dict)
    legs: tuple[LegOrigin, ...] = ()
    geometry: Geometry | None = None
    warnings: tuple[RequestWarning, ...] = ()
    telling: Telling = IN_SECONDS
    far: FarPlans | None = None  # where legs are estimated until a plan drives them
    places: Located | None = None
    permits: Permits = field(default_factory=Permits)
    closures: Closures | None = None
    storms: Storms = field(default_factory=Storms)
    rules: list[Data] = field(default_factory=list)  # that drones name
    laws: list[Data] = field(default_factory=list)  # that drivers keep
    doubtful: Sequence[str] = ()  # customers of whom nobody told whether they were served
    risk: LatenessRisk | None = None
    terms: Terms | None = None  # of the plan to go on from
    waves: Waves | None = None  # where it is decided who waits

    def plan(self, planner: Planner, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        """Plan; arguments and errors are those of `Planner.plan`, but nobody to serve is allowed.

        `start` may be any earlier result of the same task.
        """
        options = self._with_time_for_geometry(options)
        began = time.perf_counter() if received_at is None else received_at
        if self.waves is not None and self.problem.customers:
            return self.waves.plan(self.problem, self.replanning, planner, options, began, listener)
        plan = partial(self._plan, planner, began, start)
        risk, searches = self.risk, 0 not in (options.time_limit, options.search_iterations)
        if risk is None or not risk.cost_per_hour or not searches or self.far is not None:
            return plan(options, listener)
        search = RiskSearch(self.problem, self.judged_problem, risk.spread, risk.cost_per_hour,
                            self.setting.past.now, self.check)
        return search.find(options, listener, plan, further(planner, began, self.terms))

    def _plan(self, planner: Planner, received_at: float, start: Solution | None,
              options: PlanOptions, listener: Listener) -> PlanResult:
        """Plan by the costs alone."""
        if self.replanning is not None:
            return self.replanning.plan(planner, options, received_at, listener, start)
        if not self.problem.customers:
            return _no_plan(self.problem, options)
        if self.far is not None:
            return self.far.plan(planner, options, received_at, listener, start)
        return planner.plan(self.problem, options, received_at, listener, start)

    def _with_time_for_geometry(self, options: PlanOptions) -> PlanOptions:
        """Return the options with a part of the time limit kept back."""
        if self.geometry is None:
            return options
        kept_back = min(GEOMETRY_PER_CUSTOMER * self.problem.num_customers,
                        MOST_GEOMETRY * options.time_limit)
        return replace(options, time_limit=options.time_limit - kept_back)

    def learn_legs(self, solution: Solution) -> None:
        """Have the legs of a plan be true. In place.

        Raises
        ------
        NoRoadsError
            If the roads don't tell them.
        """
        if self.far is not None:
            self.far.learn(solution)

    def check(self, solution: Solution) -> Evaluation:
        """Judge a plan, and whether it goes on from the one given."""
        if self.replanning is not None:
            return self.replanning.check(solution)
        self.learn_legs(solution)
        return check(self.problem, solution)

    def judge_routes(self, solution: Solution) -> dict[int, JudgedRoute]:
        """Judge each route of a plan alone, by its index, as `Setting.judge` takes them."""
        self.learn_legs(solution)
        return self.setting.judge_routes(self.judged_problem, solution)

    @property
    def judged_problem(self) -> Problem:
        """The problem that a plan is judged by: parcels that were loaded are there."""
        return self.problem if self.replanning is None else self.replanning.problem

    @property
    def setting(self) -> Setting:
        """What a plan is judged by beside the problem."""
        replanning = self.replanning
        return Setting() if replanning is None else Setting(replanning.past, replanning.excused)

    def reasons(self, solution: Solution, node: int, until: float) -> tuple[Reason, ...]:
        """Return why a plan leaves a customer out, as far as is found until an instant."""
        why = partial(explain, self.problem) if self.replanning is None else (
            self.replanning.reasons)
        found = with_another_trip(self.judged_problem, solution, node,
                                  why(solution, node, until), self.setting.past, until)
        if not self.permits.choosy:
            return found
        name, kinds = self.problem.customer_at(node).id, self.problem.vehicle_types
        return tuple([self.permits.named(name, kinds[reason.vehicle_type].type_id, reason)
                      for reason in found])

    def remedy(self, node: int, reason: Reason, remedy: Remedy) -> Data:
        """Return a remedy for who is left out at a node."""
        if self.stated is None:
            return remedy_reply(remedy, None)
        shipment = self.problem.shipment_at.get(node)
        name = (self.problem.customer_at(self.problem.first_place(node)).id if shipment is None
                else shipment.id)
        kind = self.problem.vehicle_types[reason.vehicle_type].type_id
        changing = Changing.of(self.stated, kind, name, shipment is not None)
        return remedy_reply(remedy, changing)

    def step(self, limit: Limit, at: str, is_shipment: bool) -> list[Data]:
        """Return what a unit more of a limit changes of the request; `at` is whose it is."""
        return [] if self.stated is None else step(self.stated, limit, at, is_shipment)

    @cached_property
    def stated(self) -> Stated | None:
        """Where the request states whom; None: there is no request."""
        return None if self.places is None else Stated(self.places.placed.request)

    def reply(self, options: PlanOptions, result: PlanResult) -> Data:
        """Return the reply to a plan, as `plan_reply` does, with reasons while there is time."""
        allowed = EXPLAINING + EXPLAINING_SHARE * options.time_limit
        until = time.perf_counter() + allowed
        reply = plan_reply(self.problem, options, result, self.reasons, until, self.remedy)
        for left in reply["unassigned"]:
            self.name_hindrances(names_left_out(left), left["reasons"])
        self.tell_lateness(result.solution, reply["routes"], reply)
        reply["legs"] = [asdict(origin) for origin in self.legs]
        reply["warnings"] = warning_replies(self.warnings)
        if self.closures is not None and self.closures.buffer:
            reply["airspace"] = {"buffer": self.closures.buffer}
        if self.rules:
            reply["rules"] = self.rules
        if self.laws:
            reply["driving_rules"] = self.laws
        if self.places is not None and self.places.found:
            reply["addresses"] = self.places.replies()
        self._complete(reply, LEAST_GEOMETRY + MOST_GEOMETRY * options.time_limit)
        if self.replanning is not None:
            reply["replan"] = replan_reply(self.problem, self.replanning, result.solution,
                                           self.doubtful)
        if self.waves is not None:
            reply["outlook"] = self.waves.replies(self.problem, result.solution,
                                                  self.setting.past.now)
        self.telling.tell(PlanReply, reply)
        return {**self.telling.stated, **reply}

    def name_hindrances(self, customers: Sequence[str], reasons: Iterable[Data]) -> None:
        """Have reasons why somebody is left out name winds and zones. In place.

        `customers` are all ends of a shipment; else one customer.
        """
        for customer in customers:
            self.storms.name(customer, reasons)
            if self.closures is not None:
                self.closures.name(customer, reasons)

    def read(self, reply: Data) -> Solution:
        """Return the plan of an earlier reply to this task."""
        return plan_to_solution(to_json(reply), self.problem)

    def routes_reply(self, solution: Solution, evaluation: Evaluation) -> list[Data | None]:
        """Return a judged plan's routes as `plan_reply` does; None for those that can't be read."""
        routes = [route_reply(self.problem, route, metrics) if metrics.trips else None
                  for route, metrics in zip(solution.routes, evaluation.routes, strict=True)]
        self._complete({"routes": [route for route in routes if route is not None]},
                       LEAST_GEOMETRY)
        return routes

    def tell_lateness(self, solution: Solution, routes: Sequence[Data | None],
                      reply: Data) -> None:
        """Put chances of being late into routes' replies and the whole, if asked for. In place."""
        if self.risk is not None:
            hours = self.risk.tell(self.judged_problem, solution.routes, routes,
                                   self.setting.past.now)
            self.risk.add(reply, hours)

    def _complete(self, reply: Data, seconds: float) -> None:
        """Add what the request says of customers, and within some time lines. In place."""
        carry(self.info, reply)
        if self.geometry is not None:
            self.geometry.add(reply, time.perf_counter() + seconds)


def task_of(request: PlanRequest, preparing: Preparing = UNHURRIED,
            ground: Ground | None = None, roads: Roads = NO_ROADS,
            known: Task | None = None) -> Task:
    """Return what a valid request asks for, unless the work on it is to end.

    `ground` is that of the request, if it is known already; `roads` are those that the service has.
    `known` is what a request asked for whose last customer may have been another.

    Raises
    ------
    InvalidRequestError
        If what has happened by the plan to go on from doesn't fit the problem, or the work takes
        too long, or places are off the roads, or addresses aren't found.
    NoRoadsError, NoGeocoderError
        If the roads, or the geocoder, don't answer.
    StoppedError
        If it is stopped.
    """
    places = located(PlacedRequest(request), roads.addresses, preparing)
    placed, request = places.placed, places.placed.request
    if ground is None or places.found:
        ground = Ground(placed, preparing, roads.zones)
    travels = Travels(placed, preparing, ground, roads)
    problem, legs = problem_of(placed, travels), travels.origins()
    geometry = Geometry(placed, ground, roads, legs) if request.options.geometry else None
    warnings = (*warnings_of(request, roads.profiles), *address_warnings(places.found))
    beside = (info_of(request), legs, geometry, warnings, Telling.of(request))
    replan, permits, closures = request.replan, Permits.of(request), Closures(placed, ground)
    risk = LatenessRisk.of(request.options.lateness_risk)
    rules, laws, storms = rules_named(request), laws_named(request), Storms.of(request)
    task = partial(Task, problem, places=places, permits=permits, closures=closures, storms=storms,
                   rules=rules, laws=laws, risk=risk, waves=Waves.of(placed, preparing, roads))
    if replan is None:
        estimates = travels.estimates()
        return task(None, *beside, None if estimates is None else FarPlans(problem, estimates))
    replan, places_stated = with_what_is_there(replan, request.fleet)
    if known and known.replanning and differ_in_last(known.problem, problem):
        return task(known.replanning.with_last(problem), *beside, doubtful=replan.doubtful,
                    terms=known.terms)
    terms = terms_of(replan, request.options, problem)
    going_on = replace(preparing, work="Legs and the plan to go on from",
                       advice="send fewer customers or vehicles at once")
    going_on.expect(replanning_seconds(problem, terms.plan))
    try:
        return task(Replanning(problem, terms), *beside, doubtful=replan.doubtful, terms=terms)
    except SettledPartError as error:
        raise InvalidRequestError([
            InputError(code="SETTLED_PART",
                       path=f"$.replan.plan.{_stated(violation.path, places_stated)}",
                       message=f"By replan.freeze_before this has happened, and can't have: "
                       f"{violation.message}. Correct the plan, or the rest of the request.")
            for violation in error.violations]) from error
    except TooManyTypesError as error:
        raise InvalidRequestError([InputError(
            code="TOO_MANY_VEHICLES", path="$.replan.plan.routes",
            message=f"By the plan, {error}: plan for fewer vehicles at a time.")]) from error
    except ValueError as error:
        raise _not_left_to_plan(error) from error


def _not_left_to_plan(error: ValueError) -> InvalidRequestError:
    """Return why what is left of a day, which is a problem of its own, is none."""
    return InvalidRequestError([InputError(
        code="SETTLED_PART", path="$.replan",
        message=f"What is left of the day can't be planned ({error}): plan without what has "
                "happened, or send fewer rules.")])


def warning_replies(warnings: Iterable[RequestWarning]) -> list[Data]:
    """Return warnings as replies have them."""
    return [warning._asdict() for warning in warnings]


def telling(violations: Sequence[Violation]) -> list[Violation]:
    """Return broken rules without those that follow from others.

    What differs from what has happened has times that nobody has computed.
    """
    frozen = any(item.code == "FROZEN" for item in violations)
    return [item for item in violations if not (frozen and item.code == "TIME_MISMATCH")]


def _stated(path: str, routes: Sequence[int]) -> str:
    """Return where the plan given states what is at a path, by where its routes are stated."""
    return on_the_wire(re.sub(r"^routes\[(\d+)\]",
                              lambda match: f"routes[{routes[int(match[1])]}]", path))


def _no_plan(problem: Problem, options: PlanOptions) -> PlanResult:
    """Return the empty plan of a problem without customers."""
    solution = Solution(())
    return PlanResult(
        solution=solution,
        evaluation=check(problem, solution),
        start="policy",
        decoded_cost=0.0,
        final_cost=0.0,
        search_iterations=0,
        threads=options.threads,
        deterministic=True,
        elapsed=Elapsed(decode=0.0, search=0.0, check=0.0),
    )
