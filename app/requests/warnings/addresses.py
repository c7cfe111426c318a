"""Addresses that were found, and perhaps elsewhere than they are."""

from collections.abc import Sequence

from app.requests.conversion.locating import FoundAddress
from app.requests.warnings.warning import RequestWarning, Warnings


def address_warnings(found: Sequence[FoundAddress]) -> Warnings:
    """Yield a warning for each kind of doubt about where addresses are."""
    for code in dict.fromkeys(each.code for each in found if each.code is not None):
        first, *others = [each for each in found if each.code == code]
        more = f" The same holds for {len(others)} more: see addresses." if others else ""
        yield RequestWarning(code, f"{first.doubt} Check it on the map, or state "
                             f"[longitude, latitude].{more}", first.path)
