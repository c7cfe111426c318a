"""The endpoint that looks addresses up, as those of a sheet are: behind the door for bodies."""

from collections.abc import Callable
from typing import Annotated

from anyio import CapacityLimiter
from fastapi import APIRouter, Depends, Request, Response

from app.maps.addresses.addresses import Addresses
from app.maps.addresses.schemas import AddressesReply, AddressesRequest, LookedUpReply
from app.maps.streets.routes import ATTRIBUTION
from app.requests.reading import read_model
from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.openapi import ERROR_RESPONSES, json_body
from app.serving.access.guard import Plan
from app.serving.load.abandoned import watching
from app.serving.load.admission import Admission
from app.serving.load.bodies import Body
from app.serving.load.readings import Readings

router = APIRouter()

SLOTS, QUEUE, LONGEST_WAIT = 4, 16, 10.0
"""Requests that ask geocoders at once, those that may wait meanwhile, and for how many seconds."""


def new_lookups() -> Readings:
    """Return turns of one application."""
    return Readings(Admission(SLOTS, QUEUE, LONGEST_WAIT, "addresses are being looked up"),
                    CapacityLimiter(SLOTS))


async def take_place(request: Request) -> Readings:
    """Refuse a request before its body is read, if its turn can't come."""
    lookups: Readings = request.app.state.lookups
    lookups.admission.refuse_if_full()
    return lookups


@router.post("/addresses", operation_id="look_up_addresses", summary="Look addresses up",
             tags=["planning"], response_model=AddressesReply, responses=ERROR_RESPONSES,
             openapi_extra=json_body(AddressesRequest))
async def look_up(request: Request, principal: Plan,
                  lookups: Annotated[Readings, Depends(take_place)], body: Body) -> Response:
    """Return where addresses are, by the geocoder of TANDEM_GEOCODER."""
    addresses: Addresses = request.app.state.addresses
    async with watching(request) as should_stop:
        reply = await lookups.run(
            lambda: answer_addresses(body.content, body.received_at, addresses, should_stop))
    return Response(reply, media_type="application/json")


def answer_addresses(body: bytes, received_at: float, addresses: Addresses,
                     should_stop: Callable[[], bool] = lambda: False) -> bytes:
    """Return the reply to a request as JSON.

    Raises
    ------
    NotJsonError, InvalidRequestError
        If it is not valid, or there is no geocoder.
    """
    asked = read_model(body, AddressesRequest)
    if not addresses.names:
        raise InvalidRequestError([InputError(
            code="NO_GEOCODER", path="$.addresses", message="Addresses are not looked up here: "
            "have the service set up with a geocoder (TANDEM_GEOCODER).")])
    looked_up = addresses.look_up(asked.addresses, received_at + asked.seconds, should_stop)
    replies = [LookedUpReply.of(address, looked_up.candidates.get(address))
               for address in asked.addresses]
    known = sum(reply.is_known for reply in replies)
    return AddressesReply(
        addresses=replies, known=known, attribution=ATTRIBUTION,
        error=None if known == len(replies) else str(looked_up.error)).model_dump_json().encode()
