"""Which places of a request are one place, where a vehicle that is there needs no setup."""

from app.requests.conversion.places import Place, nowhere_of, places_of
from app.schemas.request import PlanRequest


def sites_of(request: PlanRequest) -> list[int | None]:
    """Return a number for each node, equal at one place; None where nobody asks, or nowhere."""
    places: list[Place | None] = [*places_of(request)]
    nowhere = nowhere_of(request)
    if nowhere is not None:
        places.insert(nowhere, None)
    if not any(customer.setup_duration for customer in request.customers):
        return [None] * len(places)
    numbers: dict[object, int] = {}
    return [None if place is None else numbers.setdefault(
                place.location_index if request.matrices else place.location, len(numbers))
            for place in places]
