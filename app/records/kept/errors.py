"""Requests about kept plans that can't be answered."""

from app.schemas.errors import RequestError


class KeptUnavailableError(RequestError, status=503, name="kept-plans-unavailable"):
    """The database with the plans can't be reached, or its tables don't fit."""

    title = "Kept plans can't be reached now"


class UnknownPlanError(RequestError, status=404, name="unknown-plan"):
    """There is no such plan, or it is another's."""

    title = "There is no such plan"

    def __init__(self, plan_id: str) -> None:
        super().__init__(f"No plan is kept by the id {plan_id[:80]!r}: it may have been deleted.")


class UnknownLinkError(RequestError, status=404, name="unknown-link"):
    """There is no such link; whether there ever was one isn't told."""

    title = "There is no such link"
    always = ("No plan is shared by this link: it may have been ended, or its plan deleted. Ask "
              "for another.")


class ChangedError(RequestError, status=412, name="plan-changed"):
    """The plan isn't as the client knows it."""

    title = "The plan was changed meanwhile"


class VersionNeededError(RequestError, status=428, name="version-needed"):
    """The plan is there, and the client doesn't say that it knows what it would overwrite."""

    title = "Say which version is to be changed"
    always = ("A plan of this id is kept already: send the ETag it was read with as 'If-Match', or "
              "'If-Match: *' to change it whatever it is.")


class NoRoomError(RequestError, status=409, name="no-room"):
    """As much is kept as may be."""

    title = "No more plans can be kept"
