"""Requests about jobs that can't be answered."""

from app.schemas.errors import InputError, InvalidRequestError, RequestError

RETRY_SECONDS = 5
"""When to try again where a client's jobs have to end first."""


class JobsUnavailableError(RequestError, status=503, name="jobs-unavailable"):
    """The database with the jobs can't be reached, or isn't prepared yet."""

    title = "Jobs can't be reached now"


class TooManyJobsError(RequestError, status=503, name="too-many-jobs", refusal="overload"):
    """As many jobs wait as may."""

    title = "Too many jobs are waiting"


class JobShareError(RequestError, status=429, name="job-share-used-up", refusal="rate_limit"):
    """As many jobs of one client wait as may."""

    title = "Too many of your jobs are waiting"

    def __init__(self, share: int, there: int) -> None:
        super().__init__(f"{there} plans of yours wait or run, and {share} at most may "
                         "(TANDEM_MAX_OPEN_JOBS_PER_CLIENT): try again when some have ended, or "
                         "send fewer scenarios.")
        self.headers = {"Retry-After": str(RETRY_SECONDS)}


class UnknownJobError(RequestError, status=404, name="unknown-job"):
    """There is no such job, or it is another's."""

    title = "There is no such job"

    def __init__(self, job_id: str) -> None:
        super().__init__(f"No job has the id {job_id[:80]!r}: it may have expired.")


class NoPlanError(RequestError, status=409, name="no-plan"):
    """The job has no plan that could be drawn."""

    title = "The job has no plan"


class KeyReusedError(RequestError, status=422, name="idempotency-key-reused"):
    """The idempotency key belongs to another request."""

    title = "The idempotency key was used for another request"

    def __init__(self) -> None:
        message = "This key came with another body, endpoint or webhook before: use a new one."
        super().__init__("The key belongs to another request.", [
            InputError(code="IDEMPOTENCY_KEY_REUSED", path="header.Idempotency-Key",
                       message=message)])


class TooManyScenariosError(InvalidRequestError):
    """A comparison or sweep asks for more than the service takes."""

    def __init__(self, path: str, what: str, remedy: str) -> None:
        super().__init__([InputError(code="TOO_MANY_SCENARIOS", path=path,
                                     message=f"{what}: {remedy}.")])
