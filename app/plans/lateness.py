"""Chances of being late, in replies that ask for them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from app.plans.replies import Data
from app.requests.conversion.units import money
from app.schemas.lateness import LatenessRiskInput
from model.counsel.lateness.drawn import Spread
from model.counsel.lateness.outlook import Expectation, TripOutlook, outlook
from model.problem import MS_PER_HOUR, Problem
from model.solution import Route

CUSTOMERS = frozenset({"customer", "pickup", "delivery"})


@dataclass(frozen=True)
class LatenessRisk:
    """What a request states of how times spread."""

    spread: Spread
    cost_per_hour: float

    @classmethod
    def of(cls, stated: LatenessRiskInput | None) -> "LatenessRisk | None":
        """Return what a request states; None: nothing."""
        if stated is None:
            return None
        return cls(Spread(stated.spread.travel, stated.spread.service),
                   stated.cost_per_expected_late_hour)

    def tell(self, problem: Problem, routes: Sequence[Route], told: Sequence[Data | None],
             now: int) -> float:
        """Put chances at the stops of routes' replies; return the hours late expected. In place.

        `now` is when what has happened ends, in ms; None stands for routes that can't be read.
        """
        expected = 0.0
        for number, (route, reply) in enumerate(zip(routes, told, strict=True)):
            if reply is not None:
                trips = outlook(problem, route, self.spread, now, number)
                for visit, each in _visits(reply, trips):
                    visit["lateness"] = _lateness(visit["lateness"], each)
                    expected += each.expected
        return expected / MS_PER_HOUR

    def add(self, reply: Data, hours: float) -> None:
        """Put what is to be expected of all into a reply, and its price. In place."""
        reply["lateness"] = {
            "spread": {"travel": self.spread.travel, "service": self.spread.service},
            "expected_hours": hours}
        price = money(hours * self.cost_per_hour)
        reply["cost"] |= {"total": reply["cost"]["total"] + price, "lateness_risk": price}


def _lateness(seconds: float, each: Expectation) -> dict[str, Any]:
    return {"seconds": seconds, "chance": each.chance, "earliest": each.early / 1000,
            "latest": each.late / 1000}


def _visits(reply: Data, trips: Sequence[TripOutlook]) -> Iterator[tuple[Data, Expectation]]:
    """Yield the customers of a route's reply, each with what is to be expected there."""
    for trip, met in zip(reply["trips"], trips, strict=True):
        yield from zip([stop for stop in trip["stops"] if stop["kind"] in CUSTOMERS], met.stops,
                       strict=True)
        for sortie, visits in zip(trip["sorties"], met.sorties, strict=True):
            yield from zip(sortie["customers"], visits, strict=True)
