"""Requests about dispatches that can't be answered."""

from types import MappingProxyType

from app.schemas.errors import RequestError


class UnknownDispatchError(RequestError, status=404, name="unknown-dispatch"):
    """There is no such dispatch or link, or it is another's."""

    title = "There is no such dispatch"
    always = "No dispatch of yours has this id, or it has no such link: it may have expired."


class DispatchOverError(RequestError, status=409, name="dispatch-over"):
    """The dispatch has ended."""

    title = "The day has ended"
    always = "The links of this dispatch have ended: send the plan out anew."


class TooManyDispatchesError(RequestError, status=429, name="too-many-dispatches",
                             refusal="rate_limit"):
    """As many dispatches of one client are under way as may."""

    title = "Too many of your plans are on the road"
    headers = MappingProxyType({"Retry-After": "60"})

    def __init__(self, most: int) -> None:
        super().__init__(f"{most} of your plans are on the road, and no more may be "
                         "(TANDEM_MAX_DISPATCHES_PER_CLIENT): end some of them.")


class UnknownVehicleLinkError(RequestError, status=401, name="unknown-driver-link",
                              refusal="access"):
    """No link has this token; which of all reasons it is, isn't told."""

    title = "The link is not valid"
    always = "Open the link that you were sent once more, as a whole, or ask for another."
    headers = MappingProxyType({"WWW-Authenticate": 'Bearer realm="drive"'})


class LinkOverError(RequestError, status=410, name="link-over", refusal="access"):
    """The link was revoked, or its day is over."""

    title = "The link is no longer valid"

    def __init__(self, was_revoked: bool) -> None:
        super().__init__("The link was revoked: ask for another." if was_revoked
                         else "The day of this link is over.")


class UnknownProofError(RequestError, status=404, name="unknown-proof"):
    """There is no such picture."""

    title = "There is no such proof"
    always = "`GET /dispatches/{id}/proofs` has those that there are."


class TooManyProofsError(RequestError, status=409, name="too-many-proofs"):
    """A vehicle has sent as many proofs as it may."""

    title = "Too many proofs were sent"

    def __init__(self, most: int) -> None:
        super().__init__(f"A vehicle may send {most} proofs of its day: keep the others.")


class TooManyEventsError(RequestError, status=409, name="too-many-events"):
    """A link has told as much as it may."""

    title = "Too much was told on this link"

    def __init__(self, most: int) -> None:
        super().__init__(f"A link may tell {most} events: ask for another link.")
