"""Which zones of the airspace keep drones from a customer."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

from app.maps.airspace.zone import Limit
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

LEADS = {
    "customer": "It lies in ",
    "depot": "The depot lies in ",
    "way": "No flight leads there from the depot around ",
}
"""How it is said that a zone keeps drones away, by what it holds."""


class Hindrance(NamedTuple):
    """What keeps drones from a customer, and what of the way there it holds."""

    holds: str
    part: Part


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
                found = self._why(customer, reason["vehicle_type"])
                if found is not None:
                    reason["code"] = CODE
                    reason["message"] = LEADS[found.holds] + words_of(found.part)
                    reason["zone"] = zone_reply(*found)

    def around(self, customer: str) -> list[Data]:
        """Return the zones in which a customer lies that drones may not fly to."""
        if not self.ground.zones:
            return []
        node = self.nodes[customer]
        parts = [part for altitude in self._altitudes() for part in
                 self.ground.zones_at(node, altitude)]
        return [zone_reply("customer", part)
                for part in {words_of(part): part for part in parts}.values()]

    def _altitudes(self, kind: str | None = None) -> list[float]:
        return sorted({flyer.altitude for stated in self._request.fleet
                       for flyer in stated.flyers if kind in (None, stated.id)})

    @property
    def _request(self) -> PlanRequest:
        return self.placed.request

    def _why(self, customer: str, kind: str) -> Hindrance | None:
        node, depot = self.nodes[customer], self._depot_of(kind)
        for altitude in self._altitudes(kind):
            ways = (("customer", partial(self.ground.zones_at, node)),
                    ("depot", partial(self.ground.zones_at, depot)),
                    ("way", partial(self.ground.zones_between, depot, node)))
            for holds, look in ways:
                for part in look(altitude):
                    return Hindrance(holds, part)
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


def zone_reply(holds: str, part: Part) -> Data:
    """Return a volume of a zone, and what of the way to a customer it holds."""
    zone, volume = part
    return {"holds": holds, "name": zone.name, "identifier": zone.identifier,
            "restriction": zone.restriction, "lower": _height_reply(volume.lower),
            "upper": _height_reply(volume.upper), "authority": zone.authority,
            "message": words_of(part)}


def _height_reply(limit: Limit | None) -> Data | None:
    if limit is None:
        return None
    return {"value": limit.value, "unit": limit.unit, "reference": limit.reference}
