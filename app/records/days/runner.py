"""Plans days, each as soon as something was told of it, whichever process it was told to."""

import logging
import threading
import time
import uuid
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime
from functools import partial
from http import HTTPStatus

from pydantic_core import from_json, to_json
from sqlalchemy import Connection, Engine
from sqlalchemy.exc import SQLAlchemyError

from app.maps.roads.roads import Roads
from app.plans.flights.answering import flights_by_vehicle
from app.records.clock import now_ms
from app.records.days.departures import Departures
from app.records.days.fold import ToldDay
from app.records.days.memory import DayMemory
from app.records.days.news import names_of, news_of
from app.records.days.planning import asked, too_late, waited_for
from app.records.days.remedies import Quote, remedy_of
from app.records.days.rows import Begun
from app.records.days.sighting import are_in_time
from app.records.days.spreads import observed
from app.records.days.store import DayStore
from app.records.dispatches.instants import PlanStart, instant, milliseconds
from app.records.dispatches.rows import DayRow, ToldRow
from app.records.dispatches.service import work_by
from app.records.dispatches.store import DispatchStore
from app.records.dispatches.validation import require_drivable
from app.requests.conversion.locating import at_addresses
from app.requests.plan_reading import parse_plan
from app.schemas.check import PlannedProblem
from app.schemas.errors import InvalidRequestError, RequestError
from app.schemas.plan import PlanInput
from app.schemas.request import PlanRequest
from app.schemas.times import read_body
from app.serving.children.errors import EndedUnexpectedlyError
from app.serving.settings import Settings

logger = logging.getLogger(__name__)

LOOK = 0.2
"""Seconds between two looks for days that were told of elsewhere."""

AT_ONCE = 2
"""Days that one process plans at once."""

LEASE, RENEWAL = 4.0, 1.0
"""Seconds for which a day is one process's, which says so anew while it plans: then another's."""

MAX_DEATHS = 3
"""How often processes may die of one plan before it is given up until something else is told."""

BESIDE = 6e-4
"""Seconds, for each order, that a plan is held to take beside its search where another process made
the one before."""

MENDING = 0.5
"""Share of the time to a plan after which no remedy for an order at risk is looked for."""

DUE = 1.0
"""Seconds between two looks for days of which a departure has come due."""

RETRY = 1.0
"""Seconds between two looks while the database can't be reached."""

Plan = Callable[[bytes, Callable[[], bool]], bytes]
"""Answers a request of `POST /plan`, unless it is told to stop."""


class DayRunner:
    """Plans days in threads of this process.

    Parameters
    ----------
    engine
        Connections to the database.
    plan
        Has a plan made.
    settings
        How long days are kept.
    roads
        Those that the service has.
    is_prepared
        Tells whether the database has its tables.
    quote
        Prices slots.
    announce
        Has a webhook told a message by its name, once the transaction of a connection commits.
    """

    def __init__(self, engine: Engine, plan: Plan, settings: Settings, roads: Roads,
                 is_prepared: Callable[[], bool], quote: Quote,
                 announce: Callable[[Connection, str, str], None]) -> None:
        self._store = DayStore(engine)
        self._dispatches = DispatchStore(engine)
        self._plan = plan
        self._settings = settings
        self._roads = roads
        self._is_prepared = is_prepared
        self._quote = quote
        self._announce = announce
        self._stopping = threading.Event()
        self._told = threading.Event()
        self._by = str(uuid.uuid4())
        self._beside: dict[str, float] = {}  # seconds that a day's last plan took unsearched
        self.memory = DayMemory()
        self._making = set[str]()  # days that are being planned
        self._renews_at = 0.0  # on `time.monotonic`
        self._departures = Departures(self._store)
        self._due_at = 0.0  # when it is looked for them, on `time.monotonic`
        self._deaths = Counter[tuple[str, int]]()  # by day and number of the last event
        self._free = threading.Semaphore(AT_ONCE)
        self._pool = ThreadPoolExecutor(AT_ONCE, thread_name_prefix="day")
        self._looking = threading.Thread(target=self._look, name="days", daemon=True)

    def start(self) -> None:
        """Plan days from now on. In place."""
        self._looking.start()

    def stop(self) -> None:
        """Leave days to other processes. In place."""
        self._stopping.set()
        self._told.set()
        if self._looking.is_alive():
            self._looking.join()
        self._pool.shutdown()

    def hurry(self) -> None:
        """Look at once, as something was told. In place."""
        self._told.set()

    def _look(self) -> None:
        while not self._stopping.is_set():
            if not self._free.acquire(timeout=LOOK):
                self._renew()
                continue
            try:
                self._renew()
                day = self._claimed() if self._is_prepared() else None
            except SQLAlchemyError as error:
                logger.warning("days can't be planned: %s", type(error).__name__)
                day = None
                self._stopping.wait(RETRY)
            if day is None:
                self._free.release()
                self._told.wait(LOOK)
                self._told.clear()
            else:
                self._making.add(day.id)
                self._pool.submit(self._planned, day)

    def _renew(self) -> None:
        """Keep others from the days that are being planned. In place."""
        if time.monotonic() < self._renews_at:
            return
        self._renews_at = time.monotonic() + RENEWAL
        for day in tuple(self._making):
            try:
                self._store.renew(day, self._by, LEASE)
            except SQLAlchemyError as error:
                logger.warning("a day can't be held: %s", type(error).__name__)

    def _claimed(self) -> DayRow | None:
        """Return a day to be planned; some are told the time first. In place."""
        if time.monotonic() >= self._due_at:
            self._due_at = time.monotonic() + DUE
            self._departures.tell(now_ms())
        day = self._store.claim(self._by, LEASE)
        # It may have been away from the database for longer than it held a day.
        return None if day is None or day.id in self._making else day

    def _planned(self, day: DayRow) -> None:
        """Plan a day that is this process's. In place."""
        try:
            self._make(day)
        except RequestError as error:
            # What others don't answer now they may later: the day is taken up again.
            if not self._may_do_later(day, error):
                details = "; ".join(each.message for each in error.errors)
                self._store.keep_plan(day, self._by, details or str(error))
        except SQLAlchemyError as error:
            logger.warning("a day's plan can't be kept: %s", type(error).__name__)
        except Exception:
            logger.exception("a day can't be planned")
            self._store.keep_plan(day, self._by, "The plan could not be made.")
        finally:
            self._making.discard(day.id)
            self._free.release()
            self._told.set()

    def _may_do_later(self, day: DayRow, error: RequestError) -> bool:
        """Tell whether a day may be planned later that can't be now.

        Not if processes keep dying of it.
        """
        if isinstance(error, EndedUnexpectedlyError):
            self._deaths[day.id, day.asked] += 1
        return (error.status == HTTPStatus.SERVICE_UNAVAILABLE
                and self._deaths[day.id, day.asked] < MAX_DEATHS)

    def _make(self, day: DayRow) -> None:
        began = time.monotonic()
        begun = self.memory.begun(self._store, day.id)
        log, told = self.memory.stood(self._store, day, begun)
        waited = waited_for(log, day.planned, now_ms())
        until = began + MENDING * begun.terms.plan_within - waited
        before = self.memory.plan(self._store, day)
        if before and not day.failure and are_in_time(begun, told, before, log, day.planned):
            self._store.keep_plan(day, self._by)
            return
        now = max(0.0, day.seconds(now_of(told)))
        wanted, reply = self._replied(day, begun, told, before, now, waited)
        if self._stopping.is_set():
            return
        plan = parse_plan(reply)
        problem = read_body(PlanRequest, wanted)
        request = PlannedProblem.model_construct(problem=at_addresses(problem, plan), plan=plan)
        require_drivable(request.problem, plan)
        work, _ = work_by(request, self._dispatches.links(day.id), day.id,
                          flights_by_vehicle(request.problem, plan, self._roads,
                                             instant(day.plan_start)))
        rows = news_of(day.plan_number + 1, day.asked, round(day.plan_start + 1000 * now), told,
                       before, plan, from_json(reply), problem, begun.terms,
                       observed(before, told, log, day.planned),
                       lambda order: None if time.monotonic() > until else remedy_of(
                           order, from_json(wanted), from_json(reply), now, self._quote))
        if self._store.publish(self._with_end(day, plan), self._by, reply, work, rows,
                               partial(self._announced, day, begun.terms.webhook, rows)):
            self.memory.keep(day.id, day.plan_number + 1, plan)
        self._beside[day.id] = time.monotonic() - began - problem.options.time_limit

    def _announced(self, day: DayRow, webhook: str | None, news: Sequence[ToldRow],
                   connection: Connection) -> None:
        """Have a day's webhook told of a plan, if it has one. In place."""
        if webhook is not None:
            for name in names_of(day.id, day.plan_number + 1, news):
                self._announce(connection, name, webhook)

    def _replied(self, day: DayRow, begun: Begun, told: ToldDay, before: PlanInput | None,
                 now: float, waited: float) -> tuple[bytes, bytes]:
        """Return what is asked for a day's next plan, told of which was seconds ago; the reply."""
        steps = self._dispatches.steps_by_vehicle(day.id)
        kept: set[str] = set()
        orders = 0 if before is None else len(told.customers) + len(told.shipments)
        beside = self._beside.get(day.id, BESIDE * orders) + waited
        while True:
            wanted = asked(begun, told, before, steps, now, day.planned, kept, beside)
            body = to_json(wanted)
            try:
                return body, self._plan(body, self._stopping.is_set)
            except InvalidRequestError as error:
                more = too_late(error.errors, wanted, told) - kept
                if not more:
                    raise
                kept |= more

    def _with_end(self, day: DayRow, plan: PlanInput) -> DayRow:
        """Return a day that lasts until its plan is over."""
        start = PlanStart.stated(instant(day.plan_start, day.zone_offset), day.time_zone,
                                 datetime.now(UTC))
        return day.until(max(day.ends_at, milliseconds(start.end(plan))),
                         self._settings.dispatch_expiry_hours)


def now_of(told: ToldDay) -> int:
    """Return what time it is on a day, in milliseconds since 1970."""
    return now_ms() if told.clock is None else told.clock


def memory_of(runner: DayRunner | None) -> DayMemory:
    """Return how days stood last where they are planned; nothing where they aren't."""
    return DayMemory() if runner is None else runner.memory
