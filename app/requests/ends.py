"""Where a request states the ends of shipments, which count as customers behind its own."""

import re

from app.schemas.request import PlanRequest
from app.schemas.shipment import ENDS

_CUSTOMER = re.compile(r"\$\.customers\[(\d+)\](.*)", re.DOTALL)


def stated_path(request: PlanRequest, path: str) -> str:
    """Return the path of what a request states, by that among all who count as customers."""
    match = _CUSTOMER.fullmatch(path)
    ends = len(ENDS) * len(request.shipments)
    if match is None or not ends:
        return path
    # Customers that were added since come last.
    names = [end.id for end in request.shipments[0].ends()]
    first = next(index for index, customer in enumerate(request.customers)
                 if customer.id == names[0])
    index, inner = int(match[1]) - first, match[2]
    if not 0 <= index < ends:
        return path
    shipment, end = divmod(index, len(ENDS))
    if inner.startswith(".demand"):
        return f"$.shipments[{shipment}].amount{inner.removeprefix('.demand')}"
    own = inner.split("[")[0].split(".")[1:2] in (["id"], ["skills"], ["goods"], ["vehicles"],
                                               ["vehicle_costs"])
    return f"$.shipments[{shipment}]{'' if own else f'.{ENDS[end]}'}{inner}"
