"""Requests about jobs that can't be answered."""

from app.errors import InputError, InvalidRequestError, RequestError


class JobsUnavailableError(RequestError):
    """The database with the jobs can't be reached, or isn't prepared yet."""

    status = 503
    name = "jobs-unavailable"
    title = "Jobs can't be reached now"


class TooManyJobsError(RequestError):
    """As many jobs wait as may."""

    status = 503
    name = "too-many-jobs"
    title = "Too many jobs are waiting"
    refusal = "overload"


class UnknownJobError(RequestError):
    """There is no such job, or it is another's."""

    status = 404
    name = "unknown-job"
    title = "There is no such job"

    def __init__(self, job_id: str) -> None:
        super().__init__(f"No job has the id {job_id[:80]!r}: it may have expired.")


class NoPlanError(RequestError):
    """The job has no plan that could be drawn."""

    status = 409
    name = "no-plan"
    title = "The job has no plan"


class KeyReusedError(RequestError):
    """The idempotency key belongs to another request."""

    status = 422
    name = "idempotency-key-reused"
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
