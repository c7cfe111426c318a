"""Requests about kept plans that can't be answered."""

from app.schemas.errors import RequestError


class KeptUnavailableError(RequestError):
    """The database with the plans can't be reached, or its tables don't fit."""

    status = 503
    name = "kept-plans-unavailable"
    title = "Kept plans can't be reached now"


class UnknownPlanError(RequestError):
    """There is no such plan, or it is another's."""

    status = 404
    name = "unknown-plan"
    title = "There is no such plan"

    def __init__(self, plan_id: str) -> None:
        super().__init__(f"No plan is kept by the id {plan_id[:80]!r}: it may have been deleted.")


class UnknownLinkError(RequestError):
    """There is no such link; whether there ever was one isn't told."""

    status = 404
    name = "unknown-link"
    title = "There is no such link"

    def __init__(self) -> None:
        super().__init__("No plan is shared by this link: it may have been ended, or its plan "
                         "deleted. Ask for another.")


class ChangedError(RequestError):
    """The plan isn't as the client knows it."""

    status = 412
    name = "plan-changed"
    title = "The plan was changed meanwhile"


class VersionNeededError(RequestError):
    """The plan is there, and the client doesn't say that it knows what it would overwrite."""

    status = 428
    name = "version-needed"
    title = "Say which version is to be changed"

    def __init__(self) -> None:
        super().__init__("A plan of this id is kept already: send the ETag it was read with as "
                         "'If-Match', or 'If-Match: *' to change it whatever it is.")


class NoRoomError(RequestError):
    """As much is kept as may be."""

    status = 409
    name = "no-room"
    title = "No more plans can be kept"
