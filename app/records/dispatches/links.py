"""Links for drivers: their tokens, their addresses, and these as QR codes."""

import segno

from app.records.dispatches.errors import UnknownVehicleLinkError
from app.records.dispatches.rows import DayRow, VehicleLinkRow
from app.records.dispatches.store import DispatchStore
from app.serving.access.tokens import NO_DIGEST, TokenKind, is_token

DRIVER_TOKENS = TokenKind("drive")

PAGE = "drive/"
"""Where drivers' page is, below the service's own address."""


def address_of(base: str, token: str) -> str:
    """Return a link.

    The token stands behind `#`, which browsers keep to themselves: it comes into no log, and no
    other site is told of it.
    """
    return f"{base.rstrip('/')}/{PAGE}#{token}"


def qr_of(address: str) -> str:
    """Return an address as a QR code: an image as `data:` URL, with the margin it needs."""
    return segno.make(address, error="m", micro=False).svg_data_uri(border=4)


def find_link(store: DispatchStore, presented: str) -> tuple[VehicleLinkRow, DayRow]:
    """Return the link whose token was presented, valid or not any more, and its dispatch.

    Raises
    ------
    UnknownLinkError
        If there is none.
    """
    found = store.link(DRIVER_TOKENS.id_of(presented))
    if not is_token(presented, found[0].digest if found else NO_DIGEST) or found is None:
        raise UnknownVehicleLinkError
    return found
