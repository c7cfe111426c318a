"""Where places are to be expected: by a request's time zone, currency and telephone numbers."""

import re
from collections.abc import Iterable
from functools import cache
from importlib.resources import files

import numpy as np

from app.schemas.request import PlanRequest
from model.problem import BoolArray, FloatArray

EUROPE = ((-11.0, 41.0), (34.0, 72.0))
"""Longitudes and latitudes; where they are one another's, nothing that pays in euros overseas."""

EUROPEAN = frozenset((
    "ALL", "BAM", "BGN", "CHF", "CZK", "DKK", "EUR", "GBP", "HUF", "ISK", "MDL", "MKD", "NOK",
    "PLN", "RON", "RSD", "SEK", "UAH"))
"""Currencies of Europe."""

ZONE_REACH_DEG = 30.0
"""Degrees of arc from the town that a time zone is named after to its farthest places, about."""

_EUROPEAN_PHONE = re.compile(r"\s*(?:\+|00)\s*[34][\d\s()/.-]{6,}")
"""Numbers of countries whose codes begin with 3 or 4: all of them in Europe."""

_FOREIGN_PHONE = re.compile(r"\s*(?:\+|00)\s*[1-9]")

_TOWN = re.compile(r"([+-])(\d{2,3})(\d{2})(\d{2})?(?=[+-]|$)")


def far_from_home(request: PlanRequest, points: FloatArray) -> BoolArray:
    """Tell which points are not where the request's zone, currency or phones say that it is."""
    far = np.zeros(len(points), bool)
    town = _towns().get(request.time_zone or "")
    if town is not None:
        far |= _degrees_between(town, points) > ZONE_REACH_DEG
    if request.currency in EUROPEAN or _are_european(
            customer.info.get("phone", "") for customer in request.customers):
        (west, east), (south, north) = EUROPE
        lon, lat = points.T
        far |= ~((west <= lon) & (lon <= east) & (south <= lat) & (lat <= north))
    return far


def _are_european(phones: Iterable[str]) -> bool:
    """Tell whether most of the numbers that state a country are of Europe."""
    stated = [phone for phone in phones if _FOREIGN_PHONE.match(phone)]
    return sum(map(bool, map(_EUROPEAN_PHONE.match, stated))) > len(stated) / 2


def _degrees_between(town: tuple[float, float], points: FloatArray) -> FloatArray:
    (lon, lat), (lons, lats) = np.radians(town), np.radians(points).T
    cosine = np.sin(lat) * np.sin(lats) + np.cos(lat) * np.cos(lats) * np.cos(lons - lon)
    angle: FloatArray = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    return angle


@cache
def _towns() -> dict[str, tuple[float, float]]:
    """Return longitude and latitude of the town that each time zone is named after."""
    table = (files("tzdata") / "zoneinfo" / "zone.tab").read_text("utf-8")
    rows = (line.split("\t") for line in table.splitlines() if line and line[0] != "#")
    found = {}
    for _, place, name, *_ in rows:
        lat, lon = (_degrees(*match.groups()) for match in _TOWN.finditer(place))
        found[name] = lon, lat
    return found


def _degrees(sign: str, whole: str, minutes: str, seconds: str | None) -> float:
    size = int(whole) + int(minutes) / 60 + int(seconds or 0) / 3600
    return -size if sign == "-" else size
