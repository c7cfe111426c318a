"""Where a request states who counts as customers behind its own: other places, and ends."""

import re
from collections.abc import Iterable, Iterator

from app.schemas.customer import AlternativeInput, place_name
from app.schemas.errors import InputError
from app.schemas.request import PlanRequest

_CUSTOMER = re.compile(r"\$\.customers\[(\d+)\](.*)", re.DOTALL)
_PART = re.compile(r"\$\.shipments\[(\d+)\]\.pickups\[(\d+)\]\.id")
_NAMED = re.compile(r"(customers\[\d+\])( has the same id)")

OWN = frozenset(AlternativeInput.model_fields)
"""What other places state; all else is said by the customer."""


def stated_errors(request: PlanRequest, errors: Iterable[InputError]) -> list[InputError]:
    """Return errors where a request states them.

    What both ends of a shipment, or all places of a customer, have from it is wrong once.
    """
    stated = {}
    for error in errors:
        path = stated_path(request, error.path)
        message = _NAMED.sub(lambda match: _named(request, match[1]) + match[2], error.message)
        stated[error.code, path] = error.model_copy(
            update={"path": path, "message": message})
    return list(stated.values())


def _named(request: PlanRequest, entry: str) -> str:
    """Return where one is stated of those who count as customers; of a pickup which it is."""
    path = stated_path(request, f"$.{entry}.id")
    part = _PART.fullmatch(path)
    if part is None:
        return path[2:-3]
    shipment = request.shipments[int(part[1])]
    return f"Pickup {shipment.pickups[int(part[2])].id!r} of shipment {shipment.id!r}"


def added_names(request: PlanRequest) -> Iterator[str]:
    """Yield the names of all who count as customers beside those stated."""
    for customer in request.customers:
        for place in customer.alternatives:
            yield place_name(customer.id, place.id)
    for shipment in request.shipments:
        yield from [name for name, _ in shipment.named_ends()]


def named_otherwise(name: str, ends: Iterable[str], for_all: str = "") -> str | None:
    """Say how ends of a shipment are named, if that is what a name is; None if it isn't.

    `ends` are the names of all, and `for_all` says how all of one are named, if they can be.
    """
    own = [end for end in ends if end.startswith(f"{name}/")]
    if not own:
        return None
    names = " or ".join(repr(end) for end in sorted(own, reverse=True))
    what = ("is a shipment, whose ends are" if f"{name}/delivery" in own
            else "is fetched at several places, which are")
    return f"{name!r} {what} named each for itself: write {names}.{for_all}"


def stated_path(request: PlanRequest, path: str) -> str:
    """Return the path of what a request states, by that among all who count as customers."""
    match = _CUSTOMER.fullmatch(path)
    if match is None:
        return path
    others = [(number, place) for number, customer in enumerate(request.customers)
              for place in range(len(customer.alternatives))]
    # Customers that were added since come last.
    added = [*added_names(request)]
    own = len(request.customers) - len(added)
    are_added = [customer.id for customer in request.customers[max(own, 0):]] == added
    index = int(match[1]) - (own if are_added else len(request.customers))
    inner = match[2]
    part = inner.split("[")[0].split(".")[1:2]
    if 0 <= index < len(others):
        customer, place = others[index]
        of_place = f".alternatives[{place}]" if OWN.issuperset(part) else ""
        return f"$.customers[{customer}]{of_place}{inner}"
    ends = [(number, end) for number, shipment in enumerate(request.shipments)
            for _, end in shipment.named_ends()]
    if not 0 <= index - len(others) < len(ends):
        return path
    number, end = ends[index - len(others)]
    in_parts = bool(request.shipments[number].pickups)
    if inner.startswith(".demand"):
        whose = ".amount"
        if in_parts:
            # The sum of all is delivered.
            whose = f".{'pickups[0]' if end == 'delivery' else end}.amount"
        return f"$.shipments[{number}]{whose}{inner.removeprefix('.demand')}"
    own = part in (["skills"], ["goods"], ["vehicles"], ["vehicle_costs"]) or (
        part == ["id"] and (not in_parts or end == "delivery"))
    return f"$.shipments[{number}]{'' if own else f'.{end}'}{inner}"
