"""Looking addresses up in the file that was made of an extract."""

import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from app.maps.addresses.asked import (
    AddressWords, Number, WordSpan, has_word, names_in, postcodes_in,
)
from app.maps.addresses.distances import metres_between
from app.maps.addresses.geocoder import QUALITIES, Candidate, Candidates, Quality
from app.maps.addresses.likeliest import Ranked, likeliest
from app.maps.addresses.spelling import words_of
from app.maps.streets.filing import reading

NAME = "extract"

MOST_SPELT = 60
"""Streets that are looked at more closely, of those spelt alike."""

WIDEST_GAP, LONGEST_GAP_M = 40, 1000.0
"""Between two houses, by numbers and by metres, so that others between them may be estimated."""


class _Street(NamedTuple):
    key: str
    number: int
    name: str
    town: str
    lon: float | None
    lat: float | None


class _House(NamedTuple):
    number: int
    letter: str
    stated: str
    suburb: str
    postcode: str
    lon: float
    lat: float


@dataclass(frozen=True)
class _Hit:
    """A street whose name stands in an address."""

    street: _Street
    span: WordSpan
    likeness: float  # of 100


def search(file: Path, address: str) -> Candidates:
    """Return what an address may mean, the likeliest first; all of them are equally exact."""
    asked = AddressWords.of(address)
    if not asked.letters:
        return ()
    with closing(reading(file)) as database:
        return _Search(database, asked).candidates()


class _Search:
    """One address, looked for."""

    def __init__(self, database: sqlite3.Connection, asked: AddressWords) -> None:
        self._database = database
        self._asked = asked

    def candidates(self) -> Candidates:
        """Return what `search` does."""
        found = [each for hit in self._exact() for each in self._of(hit)]
        if not any(each.rank[0] == 0 for each in found):
            found += [each for hit in self._spelt() for each in self._of(hit)]
        return likeliest(found or [Ranked((), town) for town in self._towns()])

    def _exact(self) -> Iterator[_Hit]:
        """Yield the streets whose names are in the address as they are."""
        for street in self._streets(list(self._asked.spans)):
            yield _Hit(street, self._asked.spans[street.key], 100.0)

    def _spelt(self) -> Iterator[_Hit]:
        """Yield the streets whose names are in the address, more or less."""
        letters = self._asked.letters
        parts = {letters[place:place + 3] for place in range(len(letters) - 2)}
        if not parts:
            return
        near = self._database.execute(
            "SELECT key FROM spelt WHERE spelt MATCH ? ORDER BY rank LIMIT ?",
            (" OR ".join(f'"{part}"' for part in sorted(parts)), MOST_SPELT))
        alike = {key: best for (key,) in near if (best := self._asked.most_alike(key))}
        for street in self._streets(list(alike)):
            likeness, span = alike[street.key]
            yield _Hit(street, span, likeness)

    def _streets(self, keys: Sequence[str]) -> list[_Street]:
        marks = ", ".join("?" * len(keys))
        return [_Street(*row) for row in self._database.execute(
            "SELECT called.key, street.id, street.name, street.town, street.lon, street.lat "
            f"FROM called JOIN street ON street.id = called.street WHERE called.key IN ({marks})",
            keys)]

    def _of(self, hit: _Hit) -> Iterator[Ranked]:
        """Yield what an address means if it means this street."""
        number = self._asked.number_beside(hit.span)
        rest = self._asked.rest(hit.span, number)
        houses, quality = self._houses(hit.street, number)
        if not houses and hit.street.lon is not None and hit.street.lat is not None:
            houses = [_House(0, "", "", "", "", hit.street.lon, hit.street.lat)]
        postcodes = {house.postcode for house in houses if house.postcode}
        if stated := [code for code in postcodes_in(rest) if code in postcodes]:
            houses = [house for house in houses if house.postcode in stated]
        for house in houses:
            unmatched = self._unmatched(hit.street, house, rest)
            yield Ranked((len(unmatched), QUALITIES.index(quality), -hit.likeness), Candidate(
                house.lon, house.lat, _label(hit.street, house), quality, NAME, unmatched))

    def _houses(self, street: _Street, number: Number | None) -> tuple[list[_House], Quality]:
        if number is None:
            return [], "street"
        same = [_House(*row) for row in self._database.execute(
            "SELECT number, letter, stated, suburb, postcode, lon, lat FROM house "
            "WHERE street = ? AND number = ?", (street.number, number.value))]
        exact = [house for house in same if house.letter == number.letter]
        if not exact and number.is_apart:
            exact = [house for house in same if not house.letter]
        if exact:
            return exact, "house"
        if same:
            return same[:1], "interpolated"
        between = self._between(street, number.value)
        return ([between], "interpolated") if between else ([], "street")

    def _between(self, street: _Street, number: int) -> _House | None:
        """Return where a house is by those with the next numbers on its side of the street."""
        ends = [self._database.execute(
            "SELECT number, letter, stated, suburb, postcode, lon, lat FROM house WHERE street = ? "
            f"AND number {sign} ? AND number % 2 = ? ORDER BY number {order} LIMIT 1",
            (street.number, number, number % 2)).fetchone()
            for sign, order in (("<", "DESC"), (">", "ASC"))]
        if None in ends:
            return None
        low, high = (_House(*row) for row in ends)
        gap = high.number - low.number
        if gap > WIDEST_GAP or metres_between(low.lon, low.lat, high.lon,
                                              high.lat) > LONGEST_GAP_M:
            return None
        share = (number - low.number) / gap
        postcode = low.postcode if low.postcode == high.postcode else ""
        return _House(number, "", f"{number} (between {low.stated} and {high.stated})", "",
                      postcode, low.lon + share * (high.lon - low.lon),
                      low.lat + share * (high.lat - low.lat))

    def _unmatched(self, street: _Street, house: _House, rest: Sequence[str]) -> tuple[str, ...]:
        """Return words of the address that speak against what was found."""
        wrong = [code for code in postcodes_in(rest) if house.postcode and code != house.postcode]
        names = names_in(rest)
        places = [*words_of(street.town), *words_of(house.suburb), *self._called(street.town)]
        # Who names the town may name the country, a firm or a floor as well.
        if not any(has_word(name, places) for name in names):
            wrong += names
        return tuple(wrong)

    def _called(self, town: str) -> list[str]:
        """Return the names of a town in other languages."""
        return [key for (key,) in self._database.execute(
            "SELECT key FROM town WHERE name = ?", (town,))]

    def _towns(self) -> Iterator[Candidate]:
        keys = list(self._asked.spans)
        marks = ", ".join("?" * len(keys))
        for name, lon, lat in self._database.execute(
                f"SELECT DISTINCT name, lon, lat FROM town WHERE key IN ({marks})", keys):
            yield Candidate(lon, lat, name, "town", NAME)


def _label(street: _Street, house: _House) -> str:
    """Return an address as it is written on a letter."""
    town = " ".join(part for part in (house.postcode, street.town) if part)
    return ", ".join(part for part in (f"{street.name} {house.stated}".strip(), town) if part)
