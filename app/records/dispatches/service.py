"""Dispatches as their owners see them: send out, follow, revoke; methods wait for the database."""

import uuid
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime, timedelta

from app.maps.roads.roads import Roads
from app.plans.flights.answering import flights_by_vehicle
from app.records.clock import now_ms
from app.records.dispatches.doubts import Answers
from app.records.dispatches.errors import (
    DispatchOverError, TooManyDispatchesError, UnknownDispatchError,
)
from app.records.dispatches.going_on import OnTheRoad, going_on
from app.records.dispatches.instants import PlanStart, instant
from app.records.dispatches.links import DRIVER_TOKENS
from app.records.dispatches.rows import DayRow, VehicleLinkRow
from app.records.dispatches.schemas import DispatchRequest, GoingOnReply, StepReply
from app.records.dispatches.standing import Standing, standing_of
from app.records.dispatches.steps import StepMaker
from app.records.dispatches.store import DispatchStore, Flown, VehicleWork
from app.records.dispatches.validation import require_drivable
from app.requests.conversion.locating import at_addresses
from app.requests.conversion.names import called
from app.schemas.check import PlannedProblem
from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.plan import MAX_INSTANT
from app.serving.access.tokens import NewToken
from app.serving.settings import Settings

FARTHEST = timedelta(days=366)
"""How far ahead a plan's day may end."""

LONGEST = timedelta(seconds=MAX_INSTANT)
"""How long a plan may take."""


@dataclass(frozen=True)
class LinkStanding:
    """A vehicle's link, its steps and how they stand."""

    link: VehicleLinkRow
    steps: list[StepReply]
    standing: Standing
    told_at: int | None  # milliseconds since 1970
    seen_at: int | None = None


@dataclass(frozen=True)
class Followed:
    """A dispatch and how far its vehicles are; tokens that were just made, by link."""

    dispatch: DayRow
    links: list[LinkStanding]
    tokens: Mapping[str, NewToken]


class DispatchService:
    """Sends plans out and tells how far they are.

    Parameters
    ----------
    store
        Where they are kept.
    settings
        How long, and how many.
    roads
        Those that the service has, and its zones.
    """

    def __init__(self, store: DispatchStore, settings: Settings, roads: Roads) -> None:
        self._store = store
        self._settings = settings
        self._roads = roads

    def create(self, request: DispatchRequest, owner: str, client: str) -> Followed:
        """Keep a plan and make a link for each of its vehicles. In place.

        Raises
        ------
        InvalidRequestError
            If the plan can't be driven, or its day is over.
        TooManyDispatchesError
            If the client has too many on the road.
        """
        require_drivable(request.problem, request.plan)
        row = self._row(request, owner, client)
        maker = StepMaker(at_addresses(request.problem, request.plan))
        tokens = [DRIVER_TOKENS.make() for _ in request.plan.routes]
        fleet = request.problem.fleet
        links = [(VehicleLinkRow(token.id, row.id, position, route.vehicle, token.digest,
                                 called(fleet, route.vehicle)),
                  maker.steps(route))
                 for position, (route, token) in enumerate(
                     zip(request.plan.routes, tokens, strict=True))]
        self._store.add(row, request.plan, links, self._flown(request, row), self._refuse_more)
        return Followed(row, [LinkStanding(link, steps, {}, None) for link, steps in links],
                        {token.id: token for token in tokens})

    def find(self, dispatch: str, owner: str) -> DayRow:
        """Return a dispatch.

        Raises
        ------
        UnknownDispatchError
            If `owner` has none with that id.
        """
        row = self._store.find(dispatch) if is_id(dispatch) else None
        if row is None or row.owner != owner:
            raise UnknownDispatchError
        return row

    def page(self, owner: str, limit: int) -> list[DayRow]:
        """Return an owner's dispatches, the youngest first."""
        return self._store.page(owner, limit)

    def follow(self, dispatch: str, owner: str) -> Followed:
        """Return how far a dispatch is; raises as `find` does."""
        return self._followed(self.find(dispatch, owner), {})

    def change(self, dispatch: str, request: PlannedProblem, owner: str) -> Followed:
        """Put another plan of the day in a dispatch's place: links stay. In place.

        A vehicle that had none gets a link, one that does nothing any more keeps its own.

        Raises
        ------
        UnknownDispatchError
            If `owner` has none with that id.
        DispatchOverError
            If it has ended.
        InvalidRequestError
            If the plan can't be driven.
        """
        row = self._open(dispatch, owner)
        require_drivable(request.problem, request.plan)
        work, tokens = work_by(request, self._store.links(row.id), row.id,
                               self._flown(request, row))
        self._store.change(row.id, request.plan, work)
        return self._followed(row, {token.id: token for token in tokens})

    def end(self, dispatch: str, owner: str) -> Followed:
        """Let all links of a dispatch open nothing any more; raises as `find` does. In place."""
        self._store.end(self.find(dispatch, owner).id)
        return self.follow(dispatch, owner)

    def revoke(self, dispatch: str, link: str, owner: str) -> Followed:
        """Let a link open nothing any more. In place.

        Raises
        ------
        UnknownDispatchError
            If `owner` has no such dispatch, or that no such link.
        """
        row = self.find(dispatch, owner)
        self._store.revoke([self._link(row, link).id])
        return self._followed(row, {})

    def renew(self, dispatch: str, link: str, owner: str) -> Followed:
        """Make another link for a vehicle in place of one, which is revoked. In place.

        Raises
        ------
        UnknownDispatchError
            If `owner` has no such dispatch, or that no such link.
        DispatchOverError
            If the dispatch has ended.
        """
        row = self._open(dispatch, owner)
        former = self._link(row, link)
        token = DRIVER_TOKENS.make()
        self._store.replace_link(former, VehicleLinkRow(token.id, row.id, former.position,
                                                        former.vehicle, token.digest,
                                                        former.name))
        return self._followed(row, {token.id: token})

    def going_on(self, dispatch: str, owner: str, now: float | None,
                 answers: Answers) -> GoingOnReply:
        """Return how to plan on at an instant, in seconds since plan start; None: this one.

        Raises as `find` does.
        """
        row = self.find(dispatch, owner)
        if now is None:
            now = max(0.0, (now_ms() - row.plan_start) / 1000)
        vehicles = {followed.link.vehicle: OnTheRoad(followed.steps, followed.standing)
                    for followed in self._followed(row, {}).links}
        return going_on(self._store.plan(row.id), vehicles, now, answers).reply

    def _flown(self, request: PlannedProblem, row: DayRow) -> Flown:
        """Return the flights of a plan."""
        return flights_by_vehicle(request.problem, request.plan, self._roads,
                                  instant(row.plan_start))

    def _open(self, dispatch: str, owner: str) -> DayRow:
        row = self.find(dispatch, owner)
        if row.ends_at <= now_ms():
            raise DispatchOverError
        return row

    def _row(self, request: DispatchRequest, owner: str, client: str) -> DayRow:
        now = datetime.now(UTC)
        plan_start, time_zone = _day_of(request)
        if plan_start is not None and not -LONGEST < plan_start - now < FARTHEST:
            raise _not_today()
        day = PlanStart.stated(plan_start, time_zone, now)
        ends_at = (now + timedelta(hours=self._settings.dispatch_hours)
                   if plan_start is None else day.end(request.plan))
        if not now < ends_at < now + FARTHEST:
            raise _not_today()
        return DayRow.begun((owner, client), day, ends_at, self._settings.dispatch_expiry_hours)

    def _refuse_more(self, there: int) -> None:
        most = self._settings.max_dispatches_per_client
        if there >= most:
            raise TooManyDispatchesError(most)

    def _link(self, row: DayRow, link: str) -> VehicleLinkRow:
        found = [other for other in self._store.links(row.id) if other.id == link]
        if not found:
            raise UnknownDispatchError
        return found[0]

    def _followed(self, row: DayRow, tokens: Mapping[str, NewToken]) -> Followed:
        events, seen = self._store.events(row.id), self._store.seen(row.id)
        links = []
        for link in self._store.links(row.id):
            told = events.get(link.vehicle, [])
            links.append(LinkStanding(
                link, self._store.steps(link.id), standing_of(told, row.plan_start),
                max((event.time for event in told), default=None), seen.get(link.vehicle)))
        return Followed(row, links, tokens)


def work_by(request: PlannedProblem, there: Sequence[VehicleLinkRow], dispatch: str,
            flown: Flown) -> tuple[VehicleWork, list[NewToken]]:
    """Return what vehicles do by a plan, and the tokens of links that it makes.

    `there` are the links that there are: a vehicle that does nothing any more keeps its own.
    """
    maker = StepMaker(request.problem)
    steps = {route.vehicle: maker.steps(route) for route in request.plan.routes}
    known = {link.vehicle for link in there}
    tokens = {name: DRIVER_TOKENS.make() for name in steps if name not in known}
    first = 1 + max((link.position for link in there), default=-1)
    fleet = request.problem.fleet
    links = [(VehicleLinkRow(token.id, dispatch, position, name, token.digest,
                             called(fleet, name)), steps[name])
             for position, (name, token) in enumerate(tokens.items(), first)]
    kept = [(replace(link, name=called(fleet, link.vehicle)), steps.get(link.vehicle, []))
            for link in there]
    return VehicleWork(kept, links, flown), list(tokens.values())


def is_id(text: str) -> bool:
    """Tell whether a text looks like the id of a dispatch."""
    try:
        return str(uuid.UUID(text)) == text
    except ValueError:
        return False


def _not_today() -> InvalidRequestError:
    """Return the error of a day that is over, or too far ahead."""
    message = "The day of the plan is over, or a year ahead: correct its start."
    return InvalidRequestError([
        InputError(code="OUT_OF_RANGE", path="$.plan_start", message=message)])


def _day_of(request: DispatchRequest) -> tuple[datetime | None, str | None]:
    """Return when the plan starts and in which zone, by the problem where that isn't stated."""
    problem = request.problem
    if request.plan_start is not None or problem.day is None:
        return request.plan_start, request.time_zone
    return problem.day.start, request.time_zone or problem.time_zone
