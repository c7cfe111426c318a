"""The zones that flights stay out of."""

from collections.abc import Sequence

from app.plans.flights.flight import Flight, Ring


def zones_of(flights: Sequence[Flight]) -> list[Ring]:
    """Return the zones near some flights, each once."""
    return list(dict.fromkeys(ring for flight in flights for ring in flight.zones))
