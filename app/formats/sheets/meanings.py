"""What a column may mean, and the units its cells may be in."""

from dataclasses import dataclass, replace
from typing import Literal

from app.formats.sheets.words import UNIT_WORDS, meant

Kind = Literal["text", "number", "amount", "clock", "windows", "duration", "names", "server",
               "side", "date", "degrees", "point", "kind", "prices"]

CLOCK_UNITS = ("clock", "hours", "h.mm", "hhmm", "minutes", "seconds", "days")
"""How bare numbers in a column of clock times are meant; `8:30` is 8:30 in any.

clock: there are none; hours: 8.5 is 8:30; h.mm: 8.30 is; hhmm: 830 is; minutes and seconds: since
midnight; days: shares of a day, as Excel holds times.
"""

DURATION_UNITS = ("minutes", "seconds", "hours", "days")

PLANAR_UNITS = ("m", "km")

MASSES = {"kg": 1.0, "g": 0.001, "t": 1000.0, "lb": 0.45359237, "oz": 0.028349523125}
VOLUMES = {"l": 1.0, "ml": 0.001, "m³": 1000.0, "cm³": 0.001, "ft³": 28.316846592}
MONEY = "money"
FAMILIES = (MASSES, VOLUMES)
"""Units of amounts by their size in the first of each; any other unit is a word."""


@dataclass(frozen=True)
class Meaning:
    """What the cells of a column are for."""

    title: str  # for people
    kind: Kind
    units: tuple[str, ...] = ()
    repeats: bool = False  # several columns may mean it


MEANINGS = {
    "name": Meaning("Name", "text"),
    "first_name": Meaning("First name", "text"),
    "order": Meaning("Order number", "text"),
    "address": Meaning("Address", "text", repeats=True),
    "street": Meaning("Street", "text", repeats=True),
    "house_number": Meaning("House number", "text"),
    "postcode": Meaning("Postcode", "text"),
    "town": Meaning("Town", "text"),
    "region": Meaning("State or province", "text"),
    "country": Meaning("Country", "text"),
    "latitude": Meaning("Latitude", "degrees"),
    "longitude": Meaning("Longitude", "degrees"),
    "point": Meaning("Latitude and longitude", "point"),
    "x": Meaning("x", "number", PLANAR_UNITS),
    "y": Meaning("y", "number", PLANAR_UNITS),
    "demand": Meaning("Amount to deliver", "amount", repeats=True),
    "pickup": Meaning("Amount to pick up", "amount", repeats=True),
    "earliest": Meaning("Window begins", "clock", CLOCK_UNITS, True),
    "latest": Meaning("Window ends", "clock", CLOCK_UNITS, True),
    "window": Meaning("Window, or several", "windows", CLOCK_UNITS, True),
    "service": Meaning("Time at the stop", "duration", DURATION_UNITS),
    "ready": Meaning("Parcel there from", "clock", CLOCK_UNITS),
    "date": Meaning("Day of delivery", "date"),
    "unassigned_cost": Meaning("Cost of leaving out", "number"),
    "late_cost": Meaning("Cost per hour late", "number"),
    "early_cost": Meaning("Cost per hour early", "number"),
    "served_by": Meaning("Drone allowed", "server"),
    "approach": Meaning("On its own side of the street", "side"),
    "skills": Meaning("Skills needed", "names"),
    "vehicles": Meaning("Only by vehicles", "names"),
    "forbidden_vehicles": Meaning("Not by vehicles", "names"),
    "preferred_vehicles": Meaning("Preferred vehicle or driver", "names"),
    "preference_cost": Meaning("Cost of any other vehicle", "number"),
    "vehicle_costs": Meaning("Costs by vehicle or driver, such as van-1: 5; van-2: 0", "prices"),
    "together": Meaning("On one vehicle with (customer or group)", "names", (), True),
    "apart": Meaning("On no vehicle with (customer or group)", "names", (), True),
    "together_on_trip": Meaning("On one trip with (customer or group)", "names", (), True),
    "apart_on_trip": Meaning("On no trip with (customer or group)", "names", (), True),
    "before": Meaning("Served before (customer)", "names", (), True),
    "after": Meaning("Served after (customer)", "names", (), True),
    "min_lag": Meaning("Least time between the two of an order", "duration", DURATION_UNITS),
    "max_lag": Meaning("Longest time between the two of an order", "duration", DURATION_UNITS),
    "shipment": Meaning("Shipment, named in the rows of both its ends", "text"),
    "max_between": Meaning("Longest time from pickup to delivery", "duration", DURATION_UNITS),
    "max_detour": Meaning("Longest way to delivery, as a multiple of the direct one", "number"),
    "back_from": Meaning("Ride back begins", "clock", CLOCK_UNITS),
    "alternative_to": Meaning("Other place of (customer)", "text"),
    "alternative_cost": Meaning("Cost of the other place", "number"),
    "layer": Meaning("Layer or folder, such as Depot", "text"),
    "kind": Meaning("Delivery, pickup or depot", "kind"),
    "status": Meaning("State of the order, such as cancelled", "text"),
    "phone": Meaning("Phone", "text", repeats=True),
    "email": Meaning("E-mail", "text"),
    "contact": Meaning("Contact", "text"),
    "notes": Meaning("Notes", "text", repeats=True),
    "priority": Meaning("Priority, for the driver alone", "text"),
    "info": Meaning("For the driver, as it is", "text", repeats=True),
    "ignored": Meaning("Not used", "text", repeats=True),
}

PRICES = frozenset(name for name, meaning in MEANINGS.items()
                   if "cost" in name or meaning.kind in ("prices", "text"))
"""What may be in money, or is no more than words."""

SIDES = {"pickup": "Pickup", "alternative": "Other place"}
"""Places that a row may state beside its own: where a shipment is fetched, and `alternatives`."""

OF_SIDES = ("name", "address", "street", "house_number", "postcode", "town", "latitude",
            "longitude", "point", "x", "y", "earliest", "latest", "window", "service")
OF_PICKUPS = (*OF_SIDES, "phone", "contact", "notes")
"""What columns say of such a place as they do of a row's own."""


def meaning_at(side: str, meaning: str) -> str:
    """Return what a column means that says something of another place of its row."""
    return f"{side}_{meaning}"


MEANINGS |= {meaning_at(side, own): replace(MEANINGS[own],
                                            title=f"{title}: {MEANINGS[own].title.lower()}")
             for side, title in SIDES.items()
             for own in (OF_PICKUPS if side == "pickup" else OF_SIDES)}

PLACES = ({"latitude", "longitude"}, {"point"}, {"x", "y"})
"""Columns that tell where customers are."""

_PAIRED = (("latitude", "longitude"), ("x", "y"), ("earliest", "latest"))
PAIRS = {one: other for pair in _PAIRED for one, other in (pair, pair[::-1])}
PAIRS |= {meaning_at(side, one): meaning_at(side, other)
          for side in SIDES for one, other in PAIRS.items()}
PAIRS |= {one: other for place in ("point", "address")
          for one, other in ((place, meaning_at("pickup", place)),
                             (meaning_at("pickup", place), place))}
"""Columns of which one completes the other; coordinates say nothing alone."""

UNITS = meant(UNIT_WORDS)
