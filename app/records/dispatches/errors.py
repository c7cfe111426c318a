"""Requests about dispatches that can't be answered."""

from app.schemas.errors import RequestError


class UnknownDispatchError(RequestError):
    """There is no such dispatch or link, or it is another's."""

    status = 404
    name = "unknown-dispatch"
    title = "There is no such dispatch"

    def __init__(self) -> None:
        super().__init__("No dispatch of yours has this id, or it has no such link: it may have "
                         "expired.")


class DispatchOverError(RequestError):
    """The dispatch has ended."""

    status = 409
    name = "dispatch-over"
    title = "The day has ended"

    def __init__(self) -> None:
        super().__init__("The links of this dispatch have ended: send the plan out anew.")


class TooManyDispatchesError(RequestError):
    """As many dispatches of one client are under way as may."""

    status = 429
    name = "too-many-dispatches"
    title = "Too many of your plans are on the road"
    refusal = "rate_limit"

    def __init__(self, most: int) -> None:
        super().__init__(f"{most} of your plans are on the road, and no more may be "
                         "(TANDEM_MAX_DISPATCHES_PER_CLIENT): end some of them.")
        self.headers = {"Retry-After": "60"}


class UnknownLinkError(RequestError):
    """No link has this token; which of all reasons it is, isn't told."""

    status = 401
    name = "unknown-driver-link"
    title = "The link is not valid"
    refusal = "access"

    def __init__(self) -> None:
        super().__init__("Open the link that you were sent once more, as a whole, or ask for "
                         "another.")
        self.headers = {"WWW-Authenticate": 'Bearer realm="drive"'}


class LinkOverError(RequestError):
    """The link was revoked, or its day is over."""

    status = 410
    name = "link-over"
    title = "The link is no longer valid"
    refusal = "access"

    def __init__(self, was_revoked: bool) -> None:
        super().__init__("The link was revoked: ask for another." if was_revoked
                         else "The day of this link is over.")


class TooManyEventsError(RequestError):
    """A link has told as much as it may."""

    status = 409
    name = "too-many-events"
    title = "Too much was told on this link"

    def __init__(self, most: int) -> None:
        super().__init__(f"A link may tell {most} events: ask for another link.")
