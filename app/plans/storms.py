"""When it blows too much for drones to fly: said of customers who are left out for that."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from app.plans.replies import Data
from app.requests.conversion.winds import Winds
from app.schemas.customer import CustomerInput, TimeWindowInput
from app.schemas.request import PlanRequest
from app.schemas.vehicle import VehicleTypeInput
from model.problem import UNLIMITED

CODE = "WIND"

HELD_BACK = ("SHIFT", "TIME_WINDOW")
"""Codes that may be due to the wind, since flights are held back for it."""

THERE_AND_BACK = 3600.0
"""Seconds before and after a window in which storms are told that may keep a flight from it."""


@dataclass(frozen=True)
class Storms:
    """The times of a request in which drones may not fly."""

    by_type: Mapping[str, list[Data]] = field(default_factory=dict)  # by id of vehicle type
    flying: frozenset[str] = frozenset()  # types of vehicles that fly by themselves
    customers: Mapping[str, CustomerInput] = field(default_factory=dict)  # by id

    @classmethod
    def of(cls, request: PlanRequest) -> "Storms":
        """Return those on the shifts of a valid request."""
        winds = Winds(request)
        by_type = {kind.id: found for kind in request.fleet if (found := _storms(winds, kind))}
        if not by_type:
            return cls()
        return cls(by_type, frozenset([kind.id for kind in request.fleet if kind.flies]),
                   {customer.id: customer for customer in request.customers})

    def name(self, customer: str, reasons: Iterable[Data]) -> None:
        """Have reasons that are due to the wind tell how strong it is, and when. In place."""
        for reason in reasons:
            storms = self._hindering(customer, reason["vehicle_type"], reason["code"])
            if storms and "wind" not in reason:
                reason["wind"] = storms
                reason["message"] = f"{reason['message']} {_words(storms)}"

    def _hindering(self, customer: str, kind: str, code: str) -> list[Data]:
        """Return the storms that a reason may be due to."""
        storms, stated = self.by_type.get(kind, []), self.customers.get(customer)
        if code == CODE:
            return storms
        if code not in HELD_BACK or stated is None:
            return []
        if kind not in self.flying and stated.served_by != "drone":
            return []
        return [storm for storm in storms if any(
            _overlap(storm, window) for window in stated.windows)]

    @property
    def all(self) -> list[Data]:
        """Those of all vehicle types."""
        return [storm for storms in self.by_type.values() for storm in storms]


def _overlap(storm: Data, window: TimeWindowInput) -> bool:
    begin, end = window.earliest - THERE_AND_BACK, window.latest
    return (storm["end"] is None or begin < storm["end"]) and (
        end is None or storm["begin"] < end + THERE_AND_BACK)


def _storms(winds: Winds, kind: VehicleTypeInput) -> list[Data]:
    return [{
        "vehicle_type": kind.id,
        "drone_type": None if kind.flies else getattr(flyer, "id", None),
        "max_wind_kmh": flyer.max_wind_kmh,
        "strongest_kmh": storm.strongest_kmh,
        "begin": storm.begin / 1000,
        "end": None if storm.end >= UNLIMITED else storm.end / 1000,
    } for flyer in kind.flyers for storm in winds.storms(kind, flyer)]


def _words(storms: Iterable[Data]) -> str:
    """Return how strong the wind is, and when."""
    told = [f"{storm['strongest_kmh']:g} km/h from {storm['begin']:g} s"
            + ("" if storm["end"] is None else f" until {storm['end']:g} s") for storm in storms]
    return f"It blows up to {', '.join(dict.fromkeys(told))}."

