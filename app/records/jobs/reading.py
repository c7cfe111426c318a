"""Bodies of jobs -> valid requests, when they come and again when a process takes them."""

from collections.abc import Callable, Sequence

from app.maps.roads.roads import NO_ROADS, Roads
from app.records.jobs.errors import TooManyScenariosError
from app.records.jobs.rows import JobRow
from app.records.jobs.scenarios import Scenarios, Sweep, apply, check_replan, read_study, validate
from app.records.jobs.schemas import Kind
from app.records.jobs.store import JobStore
from app.requests.bounds import Bounds
from app.requests.conversion.preparing import Preparing
from app.requests.reading import read_request
from app.schemas.request import PlanRequest
from app.serving.settings import Settings


MAX_WRITES = 100_000
"""Most values that a sweep puts into its scenarios: each scenario is validated as it comes."""


VALIDATION_SECONDS = 10.0
"""Longest time to check a request, all scenarios together: few can be checked at once."""


class JobReader:
    """Reads the requests of jobs.

    Parameters
    ----------
    policies
        Those that may be asked for.
    settings
        How large requests may be.
    roads
        Those that plans are made on.
    """

    def __init__(self, policies: Sequence[str], settings: Settings,
                 roads: Roads = NO_ROADS) -> None:
        self._policies = policies
        self._roads = roads
        self._most_scenarios = settings.max_scenarios
        self._bounds = Bounds(settings.max_customers, settings.max_num_samples,
                              settings.max_job_seconds, "TANDEM_MAX_JOB_SECONDS",
                              settings.max_legs, settings.roads is not None)

    def validate(self, kind: Kind, body: bytes,
                 should_stop: Callable[[], bool] = lambda: False) -> int:
        """Check a request that came, and return how many plans it asks for.

        Raises
        ------
        RequestError
            If it is not valid, or the work on it is to end.
        """
        preparing = Preparing(should_stop, VALIDATION_SECONDS, f"the {VALIDATION_SECONDS:g} s that "
                              "a job's request may be checked for")
        if kind == "plan":
            check_replan(read_request(body, self._policies, self._bounds), preparing,
                         roads=self._roads)
            return 1
        base, scenarios = read_study(kind, body, self._policies, self._bounds)
        count = len(scenarios)
        if count > self._most_scenarios:
            raise TooManyScenariosError(
                "$.fleets" if kind == "compare" else "$.grid",
                f"There are {count} scenarios, and this service takes {self._most_scenarios} at "
                "most (TANDEM_MAX_SCENARIOS)", "leave some out")
        if isinstance(scenarios, Sweep) and scenarios.writes > MAX_WRITES:
            raise TooManyScenariosError(
                "$.grid", f"{scenarios.writes} values would be put into all scenarios together, "
                f"{MAX_WRITES} at most may be", "vary fewer places or leave values out")
        validate(base, scenarios, self._policies, self._bounds, preparing, self._roads)
        return count

    def plan_request(self, store: JobStore, row: JobRow) -> PlanRequest:
        """Return the request of a plan job, or of a scenario.

        Raises
        ------
        RequestError
            If it is not valid any more.
        KeyError
            If it is not there.
        """
        return request_of(*stated(store, row), self._policies)

    def scenarios(self, store: JobStore, row: JobRow) -> Scenarios:
        """Return the scenarios of a comparison or sweep; raises as `plan_request` does."""
        return read_study(row.kind, store.request(row.id), self._policies)[1]


def stated(store: JobStore, row: JobRow) -> tuple[bytes, str | None, int]:
    """Return what states a plan job's request: a body, of which study it is, and the place there.

    Raises
    ------
    KeyError
        If it is not there.
    """
    if row.parent is None or row.position is None:
        return store.request(row.id), None, 0
    parent = store.find(row.parent)
    if parent is None:
        raise KeyError(row.parent)
    return store.request(parent.id), parent.kind, row.position


def request_of(body: bytes, study: str | None, position: int,
               policies: Sequence[str]) -> PlanRequest:
    """Return a plan job's request by what states it.

    Raises
    ------
    RequestError
        If it is not valid any more.
    """
    if study is None:
        return read_request(body, policies)
    base, scenarios = read_study(study, body, policies)
    return apply(base, scenarios.scenario(position), policies)
