"""Which zones of the airspace keep drones from a customer, in words."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from app.plans.replies import Data
from app.requests.conversion.ground import Ground
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.zones import Part
from app.schemas.request import PlanRequest
from model.judge.flight_diagnoses import NO_FLIGHT

CODE = "AIRSPACE"

ASKS_FOR = {
    "PROHIBITED": "where flying is prohibited",
    "REQ_AUTHORISATION": "where flying takes an authorisation",
    "CONDITIONAL": "where flying takes conditions",
    "NO_RESTRICTION": "where flying is free",
}


@dataclass(frozen=True)
class Closures:
    """The zones that drones of a request meet."""

    placed: PlacedRequest
    ground: Ground
    nodes: dict[str, int] = field(init=False)  # of customers, among the places

    def __post_init__(self) -> None:
        nodes = {name: node for node, (kind, name) in enumerate(self.placed.names)
                 if kind == "customer"}
        object.__setattr__(self, "nodes", nodes)

    def name(self, customer: str, reasons: Iterable[Data]) -> None:
        """Have reasons that no flight leads to a customer name the zone. In place."""
        for reason in reasons:
            if self.ground.zones and reason["message"] == NO_FLIGHT:
                words = self._why(customer, reason["vehicle_type"])
                if words is not None:
                    reason["code"], reason["message"] = CODE, words

    def around(self, customer: str) -> list[str]:
        """Return the zones in which a customer lies that drones may not fly to, in words."""
        if not self.ground.zones:
            return []
        node = self.nodes[customer]
        parts = [part for altitude in self._altitudes() for part in
                 self.ground.zones_at(node, altitude)]
        return list(dict.fromkeys(map(words_of, parts)))

    def _altitudes(self, kind: str | None = None) -> list[float]:
        return sorted({flyer.altitude for stated in self._request.fleet
                       for flyer in stated.flyers if kind in (None, stated.id)})

    @property
    def _request(self) -> PlanRequest:
        return self.placed.request

    def _why(self, customer: str, kind: str) -> str | None:
        node, depot = self.nodes[customer], self._depot_of(kind)
        for altitude in self._altitudes(kind):
            for at, whose in ((node, "It"), (depot, "The depot")):
                parts = self.ground.zones_at(at, altitude)
                if parts:
                    return f"{whose} lies in {words_of(parts[0])}"
            parts = self.ground.zones_between(depot, node, altitude)
            if parts:
                return f"No flight leads there from the depot around {words_of(parts[0])}"
        return None

    def _depot_of(self, kind: str) -> int:
        stated = next(each for each in self._request.fleet if each.id == kind)
        ids = [depot.id for depot in self._request.depots]
        return 0 if stated.depot is None else ids.index(stated.depot)


def words_of(part: Part) -> str:
    """Return which zone it is, what it asks for, where it reaches, and who decides."""
    zone = part.zone
    whose = "." if zone.authority is None else f". Its authority: {zone.authority}."
    return (f"the zone {zone.title}, {ASKS_FOR[zone.restriction]} "
            f"{part.volume.words}{whose}")
