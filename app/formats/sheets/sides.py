"""Which place of a row a heading is about: its own, where a shipment is fetched, or another."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from app.formats.sheets.headings import (
    HEADING, LONGEST_LOOK, MOST_LOOKED_AT, SURE, HeadingGuess, guesses, simple,
)
from app.formats.sheets.meanings import OF_PICKUPS, OF_SIDES, PLACES, meaning_at
from app.formats.sheets.words import (
    BARE_END_WORDS, DESTINATIONS, END_WORDS, PLACE_WORDS, SIDE_STEMS, SIDE_WORDS, meant,
)

OWN, DELIVERY, PICKUP, ALTERNATIVE = "", "delivery", "pickup", "alternative"

ENDS = meant(END_WORDS)
"""What stands before a place's columns, and alone says when windows begin and end."""

BARE_ENDS = meant(BARE_END_WORDS)
"""The same, alone above places."""

FILLERS, WHEN, WHERE, PEOPLE, BARE = (
    frozenset(PLACE_WORDS[name]) for name in ("fillers", "when", "where", "people", "bare"))
"""What stands beside a side; `PEOPLE` and `BARE` say no more than whose place, or which."""

SPLIT = {("pick", "up"): "pickup", ("drop", "off"): "dropoff"}

PLACE = frozenset(("latitude", "longitude", "point", "x", "y", "address", "street", "postcode",
                   "town"))
NAMED = PLACE | {"name", "house_number"}

SAID_ALONE = 0.9
SAID_SO = 0.8


@dataclass(frozen=True)
class Side:
    """Which place a heading is about, and what it says of it."""

    name: str = OWN
    found: tuple[HeadingGuess, ...] = ()


def sides_of(headings: Sequence[str], are_points: Sequence[bool]) -> list[Side]:
    """Return which place each heading is about; all their own where none says a second.

    `are_points` tells below which of them places are.
    """
    sides = [_end(heading) if is_point and simple(heading) in BARE_ENDS else _side(heading)
             for heading, is_point in zip(headings, are_points, strict=True)]
    sides = _with_destinations(headings, sides)
    own = any(_is_place(guess) for heading, side in zip(headings, sides, strict=True)
              for guess in (side.found if side.name == DELIVERY else guesses(heading)[:2])
              if side.name in (OWN, DELIVERY))
    stated = {side.name for side in sides if own and any(map(_is_place, side.found))}
    kept = {PICKUP, DELIVERY} if PICKUP in stated else set()
    kept |= {ALTERNATIVE} & stated
    return [side if side.name in kept else Side() for side in sides]


def guesses_at(heading: str, side: Side) -> tuple[HeadingGuess, ...]:
    """Return what a heading may mean, of the place that it is about."""
    if side.name == OWN:
        return guesses(heading)
    if side.name == DELIVERY:
        return side.found
    return tuple(replace(guess, meaning=meaning_at(side.name, guess.meaning))
                 for guess in side.found)


def _with_destinations(headings: Sequence[str], sides: list[Side]) -> list[Side]:
    """Return sides of which a place that is a school's is the delivery's, and the row's own whence.

    As they are where either isn't a whole place, or the pickup is stated.
    """
    if any(side.name == PICKUP and any(map(_is_place, side.found)) for side in sides):
        return sides
    places: dict[str, dict[int, Side]] = {PICKUP: {}, DELIVERY: {}}
    for index, (heading, side) in enumerate(zip(headings, sides, strict=True)):
        words = _words(heading)
        rest = [word for word in words if word not in DESTINATIONS]
        found = guesses(" ".join(rest))
        name = PICKUP if rest == words else DELIVERY
        if side.name == OWN and found and found[0].score >= HEADING and (
                found[0].meaning in PLACE | {"house_number"}):
            places[name][index] = Side(name, found)
    if not all(_is_whole(sides) for sides in places.values()):
        return sides
    return [places[PICKUP].get(index) or places[DELIVERY].get(index) or side
            for index, side in enumerate(sides)]


def _is_whole(found: dict[int, Side]) -> bool:
    meanings = {side.found[0].meaning for side in found.values()}
    return any(place <= meanings for place in PLACES) or bool(meanings & {"address", "street"})


def _is_place(guess: HeadingGuess) -> bool:
    return guess.meaning in PLACE and guess.score >= HEADING


def _end(heading: str) -> Side:
    """Return which place is below a heading that says no more than from where, or to where."""
    return Side(BARE_ENDS[simple(heading)], (HeadingGuess("point", SURE),))


def _side(heading: str) -> Side:
    known = guesses(heading)
    for name, words, is_weak in _parts(_words(heading)):
        of_side = OF_PICKUPS if name == PICKUP else OF_SIDES
        found = tuple(guess for guess in (*_bare(heading, words), *guesses(" ".join(words)))
                      if guess.meaning in (NAMED if is_weak else of_side))
        is_sure = bool(known) and known[0].score == SURE and (
            name == DELIVERY or known[0].meaning not in of_side or is_weak)
        if found and found[0].score >= HEADING and not is_sure:
            return Side(name, found)
    return Side()


def _words(heading: str) -> list[str]:
    words = simple(heading[:LONGEST_LOOK]).split()[:MOST_LOOKED_AT]
    for first, second in list(pairwise(words)):
        if (first, second) in SPLIT:
            place = words.index(first)
            words[place:place + 2] = [SPLIT[first, second]]
    return words


def _parts(words: Sequence[str]) -> Iterator[tuple[str, list[str], bool]]:
    """Yield which side a heading may be about, what else it says, and if that is a weak word."""
    for place, word in enumerate(words):
        rest = [*words[:place], *words[place + 1:]]
        if place and words[place - 1] in FILLERS:
            rest = [*words[:place - 1], *words[place + 1:]]
        for side, known in SIDE_WORDS.items():
            if word in known:
                yield side, rest, False
        for side, stems in SIDE_STEMS.items():
            yield from ((side, [*words[:place], *filter(None, [word.removeprefix(stem)]),
                                *words[place + 1:]], False)
                        for stem in stems if word.startswith(stem))
        if word in ENDS and rest:
            yield ENDS[word], rest, True


def _bare(heading: str, rest: Sequence[str]) -> Iterator[HeadingGuess]:
    """Yield what a heading means that says hardly more than the place."""
    words = set(_words(heading))
    if not rest and words & PEOPLE:
        yield HeadingGuess("name", SAID_ALONE)
    elif not rest and words & BARE:
        yield HeadingGuess("address", SAID_ALONE)
    elif len(rest) == 1 and rest[0] in WHEN:
        yield HeadingGuess("window", SAID_SO)
    elif len(rest) == 1 and rest[0] in WHERE:
        yield HeadingGuess("address", SAID_SO)
