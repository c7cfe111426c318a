"""Which zones of the airspace keep drones from a customer."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import partial
from math import ceil, floor
from typing import NamedTuple

from app.maps.airspace.zone import ZoneHeight
from app.plans.changes import Changing, Stated
from app.plans.remedies import remedies_reply, remedy_reply
from app.plans.replies import Data
from app.plans.storms import HELD_BACK
from app.requests.conversion.closings import Times
from app.requests.conversion.ground import Ground
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.zones import ZoneVolume
from app.schemas.request import PlanRequest
from model.counsel.flight_diagnoses import CLOSED, NO_FLIGHT
from model.counsel.remedy import remedy_of
from model.problem import UNLIMITED
from model.travel.zones import WIDER_M

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

BESIDE = {"customer": "It lies", "depot": "The depot lies"}
"""The beginning of how far from a zone it lies whom `airspace.buffer` keeps drones from."""


class Hindrance(NamedTuple):
    """What keeps drones from a customer, and what of the way there it holds."""

    holds: str
    part: ZoneVolume
    metres: float = 0.0  # that lie between, where the buffer alone holds it
    times: Times = ()  # when it is closed, if that isn't always

    def told(self, buffer: float) -> str:
        """Return all of it in words, with the buffer that is kept."""
        zone = words_of(self.part)
        if self.metres:
            return f"{_beside(self.holds, self.metres)} {zone} {_kept(buffer)}"
        kept = f" {_kept(buffer)}" if buffer and self.holds == "way" else ""
        return f"{LEADS[self.holds]}{zone}{kept}"


def _beside(holds: str, metres: float) -> str:
    return f"{BESIDE[holds]} {ceil(metres)} m from"


def _kept(buffer: float) -> str:
    return f"Flights keep {buffer:g} m from it (airspace.buffer)."


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
            if reason["message"] == CLOSED or reason["code"] in HELD_BACK:
                self._name_hours(customer, reason)
            if reason["message"] != NO_FLIGHT:
                continue
            found = self._why(customer, reason["vehicle_type"]) if self.ground.zones else None
            if found is not None:
                reason["code"] = CODE
                reason["message"] = found.told(self.buffer)
                reason["zone"] = zone_reply(found, self.buffer)
                self._add_remedy(reason, found.metres)
            elif self.buffer:
                self._name_area(customer, reason)

    def _name_hours(self, customer: str, reason: Data) -> None:
        """Have a reason why flights are held back too long tell when zones are closed. In place."""
        kind, said = reason["vehicle_type"], dict[str, Hindrance]()
        for holds, node in (("customer", self.nodes[customer]), ("depot", self._depot_of(kind))):
            for altitude in self._altitudes(kind) if self.ground.zones else ():
                for part in self.ground.zones_at(node, altitude):
                    found = self._hindrance(holds, part, node)
                    if found.times:
                        said.setdefault(hours_of(found), found)
        if said and reason["code"] == CODE:
            reason["zone"] = zone_reply(next(iter(said.values())), self.buffer)
        if said:
            reason["message"] = " ".join([reason["message"], *said])

    def _name_area(self, customer: str, reason: Data) -> None:
        """Have a reason name the area that somebody lies too near to. In place."""
        for holds, node in (("customer", self.nodes[customer]),
                            ("depot", self._depot_of(reason["vehicle_type"]))):
            for number, metres in self.ground.areas_near(node).items():
                if metres:
                    reason["code"] = CODE
                    reason["message"] = (f"{_beside(holds, metres)} the area airspace.no_fly"
                                         f"[{number}]. {_kept(self.buffer)}")
                    self._add_remedy(reason, metres)
                    return

    def around(self, customer: str) -> list[Data]:
        """Return the zones in which a customer lies that drones may not fly to."""
        if not self.ground.zones:
            return []
        node = self.nodes[customer]
        parts = [part for altitude in self._altitudes() for part in
                 self.ground.zones_at(node, altitude)]
        return [zone_reply(self._hindrance("customer", part, node), self.buffer)
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
                    return self._hindrance(holds, part, node if holds == "customer" else depot)
        return None

    def _hindrance(self, holds: str, part: ZoneVolume, node: int) -> Hindrance:
        between = 0.0 if holds == "way" else self.ground.metres_between(node, part)
        return Hindrance(holds, part, between, self.ground.times_of(part))

    @property
    def buffer(self) -> float:
        """Metres that flights keep from areas and zones."""
        return self._request.airspace.buffer

    def _add_remedy(self, reason: Data, metres: float) -> None:
        """Add by which buffer somebody so far from an area is far enough away. In place."""
        enough = floor(metres - WIDER_M)
        if enough >= 0:
            changing = Changing(Stated(self._request))
            reason |= remedies_reply([*reason["remedies"], remedy_reply(
                remedy_of("buffer", quantity=enough), changing, is_judged=False)])

    def _depot_of(self, kind: str) -> int:
        stated = next(each for each in self._request.fleet if each.id == kind)
        ids = [depot.id for depot in self._request.depots]
        return 0 if stated.depot is None else ids.index(stated.depot)


def hours_of(found: Hindrance) -> str:
    """Return when a zone is closed, in words."""
    told = [f"from {begin / 1000:g} s" + ("" if end >= UNLIMITED else f" until {end / 1000:g} s")
            for begin, end in found.times]
    return f"The zone {found.part.zone.title} is closed to flights {', '.join(told)}."


def words_of(part: ZoneVolume) -> str:
    """Return which zone it is, what it asks for, where it reaches, and who decides."""
    zone = part.zone
    whose = "." if zone.authority is None else f". Its authority: {zone.authority}."
    return (f"the zone {zone.title}, {ASKS_FOR[zone.restriction]} "
            f"{part.volume.words}{whose}")


def zone_reply(found: Hindrance, buffer: float) -> Data:
    """Return a volume of a zone, and what of the way to a customer it holds."""
    zone, volume = found.part
    told: Data = {"holds": found.holds, "name": zone.name, "identifier": zone.identifier,
            "restriction": zone.restriction, "lower": _height_reply(volume.lower),
            "upper": _height_reply(volume.upper), "authority": zone.authority,
            "message": words_of(found.part)}
    if found.metres:
        told |= {"metres": ceil(found.metres), "buffer": buffer}
    if found.times:
        told["times"] = [{"begin": begin / 1000, "end": None if end >= UNLIMITED else end / 1000}
                         for begin, end in found.times]
    return told


def _height_reply(limit: ZoneHeight | None) -> Data | None:
    if limit is None:
        return None
    return {"value": limit.value, "unit": limit.unit, "reference": limit.reference}
