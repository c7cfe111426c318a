"""Where customers are: degrees or a plane, and latitudes that are longitudes."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median

from app.formats.sheets.cells import Doubt
from app.formats.sheets.clocks import Style
from app.formats.sheets.meanings import PLACES
from app.formats.sheets.readers import read
from app.formats.sheets.rows import Row

EUROPE = ((34.0, 72.0), (-25.0, 45.0))
"""Latitudes and longitudes; where headings are in a language of Europe, its customers are there."""

POLAR = 73.0
"""Degrees of latitude beyond which hardly anybody lives."""

FAR_KM = 1000.0
MOST_NAMED = 5

Pair = tuple[float, float]


@dataclass(frozen=True)
class TableGeography:
    """How a table states places."""

    columns: tuple[str, ...]  # meanings: ("latitude", "longitude"), ("point",), ("x", "y") or ()
    is_geographic: bool = True
    is_swapped: bool = False  # first and second against what the columns are taken for
    doubts: tuple[Doubt, ...] = ()
    looks_up: bool = False  # addresses, of rows that state no coordinates
    found: Mapping[int, Pair] = field(default_factory=dict)  # longitude and latitude, by row
    unplaced: Mapping[int, str] = field(default_factory=dict)  # addresses kept as such, by row
    pending: frozenset[int] = frozenset()  # rows whose addresses aren't looked up yet

    def pair(self, row: Row) -> Pair | None:
        """Return longitude and latitude, or x and y, of a row."""
        stated = _stated(row, self.columns)
        if stated is None:
            return self.found.get(row.number)
        first, second = stated
        # Latitude comes first where people write both.
        turned = (self.columns != ("x", "y")) != self.is_swapped
        return (second, first) if turned else (first, second)


def ground_of(rows: Sequence[Row], is_european: bool, depot: Pair | None) -> TableGeography:
    """Return how rows state places.

    Parameters
    ----------
    is_european
        Whether the file is written in a language of Europe other than English.
    depot
        Latitude and longitude, as far as stated.
    """
    meanings = {meaning for row in rows for meaning in row.cells}
    order = (("latitude", "longitude"), ("point",), ("x", "y"))
    columns = next((names for names in order
                    if set(names) in PLACES and set(names) <= meanings), ())
    pairs = [pair for row in rows if (pair := _stated(row, columns)) is not None]
    if not columns or not pairs:
        return TableGeography(columns)
    if columns == ("x", "y"):
        if not _look_like_degrees(pairs):
            return TableGeography(columns, is_geographic=False)
        told = Doubt("DEGREES_GUESSED", "x and y look like degrees: x is taken for the longitude, "
                     "y for the latitude.")
        swapped, more = _swapped([(second, first) for first, second in pairs], is_european, depot)
        return TableGeography(columns, True, swapped, (told, *more))
    swapped, doubts = _swapped(pairs, is_european, depot)
    return TableGeography(columns, True, swapped, doubts)


def depot_pair(text: str) -> Pair:
    """Return the two numbers of a depot, in their order.

    Raises
    ------
    MisreadError
        If there aren't two.
    """
    first, second = read(text, "point", None, Style())
    return first, second


def far_off(places: Sequence[tuple[Row, Pair]]) -> list[Doubt]:
    """Return a doubt about each of the first places that lie very far from the others."""
    if len(places) < 3:
        return []
    middle = (median(pair[0] for _, pair in places), median(pair[1] for _, pair in places))
    far = [(row, kilometres) for row, pair in places
           if (kilometres := _kilometres(_turned(pair), _turned(middle))) > FAR_KM]
    return [Doubt("FAR_OFF", f"{row.cell('latitude', 'point', 'y')} lies {kilometres:,.0f} km from "
                  "the middle of the customers: check its coordinates.",
                  cell=row.cell("latitude", "point", "y"), values={"kilometres": round(kilometres)})
            for row, kilometres in far[:MOST_NAMED]]


def on_globe(pair: Pair) -> bool:
    """Tell whether longitude and latitude are any."""
    return abs(pair[0]) <= 180 and abs(pair[1]) <= 90


def _stated(row: Row, columns: Sequence[str]) -> Pair | None:
    """Return the two numbers of a row's place, in the order of its columns."""
    if not columns:
        return None
    if len(columns) == 1:
        pair: Pair | None = row.get(columns[0])
        return pair
    first, second = (row.get(meaning) for meaning in columns)
    return None if first is None or second is None else (first, second)


def _swapped(pairs: Sequence[Pair], is_european: bool,
             depot: Pair | None) -> tuple[bool, tuple[Doubt, ...]]:
    """Return whether latitudes are longitudes, and how that is known."""
    first, second = pairs[0]
    shown = f"({first:.6g}, {second:.6g})"
    wrong = sum(abs(latitude) > 90 for latitude, _ in pairs)
    if wrong > len(pairs) / 2 and all(abs(longitude) <= 90 for _, longitude in pairs):
        return True, (Doubt("SWAPPED", "Latitude and longitude are taken for one another: what "
                            f"should be latitudes reach beyond 90 degrees {shown}."),)
    here = (median(pair[0] for pair in pairs), median(pair[1] for pair in pairs))
    there = (here[1], here[0])
    if depot is not None and abs(depot[0]) <= 90:
        if _kilometres(there, depot) < FAR_KM < _kilometres(here, depot) / 2:
            return True, (Doubt("SWAPPED", "Latitude and longitude are taken for one another: so "
                                f"the customers are near the depot, else far from it {shown}."),)
        return False, ()
    if abs(here[0]) > POLAR > abs(there[0]):
        return True, (Doubt("SWAPPED", "Latitude and longitude are taken for one another: as "
                            f"stated the customers are near a pole {shown}."),)
    if _in_europe(there) and not _in_europe(here):
        message = (f"Swapped, the places would be in Europe; as stated {shown}, they are not")
        if is_european:
            return True, (Doubt("SWAPPED", "Latitude and longitude are taken for one another: "
                                f"{message[0].lower()}{message[1:]}, and the headings are in a "
                                "language of Europe."),)
        return False, (Doubt("MAYBE_SWAPPED", f"{message}: check latitude and longitude."),)
    return False, ()


def _look_like_degrees(pairs: Sequence[Pair]) -> bool:
    fine = sum(round(number, 2) != number for pair in pairs for number in pair)
    return all(abs(first) <= 180 and abs(second) <= 180 for first, second in pairs) and (
        fine > len(pairs))


def _in_europe(pair: Pair) -> bool:
    return all(least <= number <= most
               for number, (least, most) in zip(pair, EUROPE, strict=True))


def _turned(pair: Pair) -> Pair:
    return pair[1], pair[0]


def _kilometres(first: Pair, second: Pair) -> float:
    """Return the distance of two places, latitude first, about as the crow flies."""
    if max(abs(first[0]), abs(second[0])) > 90:
        return math.inf
    (lat, lon), (other_lat, other_lon) = ((math.radians(first[0]), math.radians(first[1])),
                                          (math.radians(second[0]), math.radians(second[1])))
    cosine = (math.sin(lat) * math.sin(other_lat)
              + math.cos(lat) * math.cos(other_lat) * math.cos(lon - other_lon))
    return 6371 * math.acos(min(1.0, max(-1.0, cosine)))


