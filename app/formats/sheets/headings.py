"""What a heading says its column means, in which unit and language."""

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache, lru_cache

from app.formats.sheets.meanings import (
    CLOCK_UNITS, DURATION_UNITS, MASSES, MEANINGS, MONEY, PRICES, UNITS, VOLUMES, Kind,
)
from app.formats.sheets.words import (
    ACTS, ASIDE, BEGIN, COLUMNS, END, EVENTS, LENGTHS, WHOLE, WINDOW,
)

SURE = 1.0
HEADING = 0.66
"""From this on, a heading counts as known."""

SHORTEST_PART = 5
"""Letters from which on a word is looked for within compounds, such as `adresse` in German."""

LONGEST_HEADING = 60
LONGEST_LOOK, MOST_LOOKED_AT = 200, 12
"""Letters and words of a heading in which its meaning is looked for."""

MOST_WORDS = 6
"""Of a phrase."""

AT_STOP = 0.7
"""Score of a heading whose word is of stops or goods, but in minutes: the time that they take."""

STOP_UNITS = ("minutes", "seconds")
"""What a heading that is no more than a unit of time tells how long a stop takes in."""

OF_STOPS = frozenset({"name", "demand", "address", "order"})

OF_TIME: tuple[Kind, ...] = ("text", "clock", "windows", "duration", "date")
"""What a heading may mean that states a unit of time."""

_SIGNS = str.maketrans({"ß": "ss", "ł": "l", "ø": "o", "æ": "ae", "œ": "oe", "đ": "d", "³": "3",
                        "²": "2", "№": " no ", "\u0131": "i", "#": " no ", "º": " ", "°": " "})
_BRACKETS = str.maketrans(dict.fromkeys("()[]/", " "))
_UNIT = re.compile(r"[(\[{](?P<unit>[^)\]}]{1,20})[)\]}]")
_PLURAL = re.compile(r"(?<=[^\W\d_])\((s|e?n)\)")
"""As in `parcel(s)`, which are no seconds."""
_WORD = re.compile(r"[^\W\d_]{2,20}\.?")
_WORDS = re.compile(r"[a-z0-9]++|[^\W\d_]++", re.ASCII)
_CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])")


@dataclass(frozen=True)
class HeadingGuess:
    """What a heading may mean."""

    meaning: str
    score: float  # 0 to 1
    unit: str | None = None
    language: str = "en"


@lru_cache(2**14)
def simple(text: str) -> str:
    """Return a text in lower case, without accents, a blank between words."""
    text = _CAMEL.sub(" ", text)
    split = unicodedata.normalize("NFKD", text.lower().translate(_SIGNS))
    letters = "".join(sign for sign in split if not unicodedata.combining(sign))
    return " ".join(_WORDS.findall(letters))


def unit_named(text: str) -> str | None:
    """Return the unit that a text is the name of."""
    plain = text.strip().lower().translate(_SIGNS).rstrip(".")
    return UNITS.get(plain) or UNITS.get(simple(text))


def without_unit(heading: str) -> str:
    """Return a heading without the unit that it states in brackets."""
    return _UNIT.sub(" ", heading).strip() or heading


def is_unit(text: str) -> bool:
    """Tell whether a cell below a heading is its unit."""
    return unit_named(text.strip("()[]{} ")) is not None


@lru_cache(4096)
def guesses(heading: str) -> tuple[HeadingGuess, ...]:
    """Return what a heading may mean, the likeliest first."""
    heading = _PLURAL.sub(r"\1", heading[:LONGEST_LOOK])
    stated = _UNIT.search(heading)
    unit = unit_named(stated["unit"]) if stated else None
    words = simple(_UNIT.sub(" ", heading)).split()[:MOST_LOOKED_AT]
    found = dict(_scored(words, unit))
    last = UNITS.get(words[-1]) if unit is None and len(words) > 1 else None
    if last:
        for meaning, guess in _scored(words[:-1], last):
            better = HeadingGuess(meaning, guess.score * 0.97, last, guess.language)
            if _takes(meaning, last) and better.score > found.get(meaning, better).score - 1e-9:
                found[meaning] = better
    spelled = len(words) > 1 and len(words[0]) > 3  # `Minutes at stop`, but no `min. age`
    first = UNITS.get(words[0]) if spelled and unit is last is None else None
    if first in DURATION_UNITS:
        found |= {meaning: replace(guess, unit=first) for meaning, guess in found.items()
                  if guess.unit is None and _takes(meaning, first)}
    _read_as_time(found, unit or last)
    said = unit or (last if last and len(words[-1]) > 1 else None) or _money_in(heading)
    found = {meaning: guess for meaning, guess in found.items() if _agrees(meaning, said)}
    if stated and unit is None and "demand" in found and _WORD.fullmatch(stated["unit"]):
        found["demand"] = replace(found["demand"], unit=stated["unit"])
    # A heading may say no more than a unit; one of masses or volumes is of an amount.
    alone = unit if not words else UNITS.get(words[0]) if len(words) == 1 else None
    if not found and alone in STOP_UNITS:
        found["service"] = HeadingGuess("service", 0.9, alone)
    if not found and (unit or last) in STOP_UNITS and _is_of_stops(words):
        found["service"] = HeadingGuess("service", AT_STOP, unit or last)
    alone = alone or (said if said in MASSES or said in VOLUMES else None)
    if alone and _takes("demand", alone) and (alone != said or not found):
        found.setdefault("demand", HeadingGuess("demand", 0.9, alone))
    return tuple(sorted(found.values(), key=lambda guess: -guess.score))


def _read_as_time(found: dict[str, HeadingGuess], unit: str | None) -> None:
    """Have stops and goods in a unit of time mean how long a stop takes. In place."""
    if unit not in DURATION_UNITS or not OF_STOPS & found.keys():
        return
    language = max((found[meaning] for meaning in OF_STOPS & found.keys()),
                   key=lambda guess: guess.score).language
    for meaning in OF_STOPS & found.keys():
        del found[meaning]
    found.setdefault("service", HeadingGuess("service", AT_STOP, unit, language))


def is_known(heading: str, least: float = HEADING) -> bool:
    """Tell whether a text is likely the heading of a column; `least` is the score it needs."""
    found = guesses(heading) if len(heading) <= LONGEST_HEADING else ()
    return bool(found) and found[0].score >= least


def _is_of_stops(words: list[str]) -> bool:
    """Tell whether unknown words are of a length of time, such as `Aufbauzeit`, not of the way."""
    return (any(word.endswith(tuple(LENGTHS["time"])) for word in words)
            and not any(part in word for word in words for part in LENGTHS["way"]))


def _money_in(heading: str) -> str | None:
    """Return the unit of a heading that names a currency."""
    words = heading.lower()[:LONGEST_LOOK].translate(_BRACKETS).split()
    return MONEY if any(unit_named(word) == MONEY for word in words) else None


def is_aside(heading: str) -> bool:
    """Tell whether a heading is known to be about what no plan goes by, such as a price."""
    words = simple(heading[:LONGEST_LOOK]).split()
    return _money_in(heading) is not None or any(
        " ".join(words[start:end]) in ASIDE for start in range(len(words))
        for end in range(start + 1, len(words) + 1))


def _agrees(meaning: str, unit: str | None) -> bool:
    """Tell whether a column in a unit can mean something: kilograms are no time of day."""
    kind = MEANINGS[meaning].kind
    if unit == MONEY:
        return meaning in PRICES
    if unit in MASSES or unit in VOLUMES:
        return kind == "amount"
    if unit in DURATION_UNITS or unit in CLOCK_UNITS:
        return kind in OF_TIME or meaning in PRICES
    return True


def _takes(meaning: str, unit: str) -> bool:
    """Tell whether cells of a meaning may be in a unit."""
    units = MEANINGS[meaning].units
    is_amount = MEANINGS[meaning].kind == "amount" and unit not in (
        MONEY, *CLOCK_UNITS, *DURATION_UNITS)
    return unit in units if units else is_amount


def _scored(words: list[str], unit: str | None) -> Iterator[tuple[str, HeadingGuess]]:
    """Yield the best guess for each meaning that fits any of the words."""
    best: dict[str, tuple[float, int, str]] = {}
    phrases = _phrases()
    for phrase, score in _fitting(words):
        for place, meaning, language in phrases.get(phrase, ()):
            if score < SURE and " ".join(phrase) in WHOLE.get(meaning, ()):
                continue
            found = (score, -place, language)
            best[meaning] = max(best.get(meaning, found), found)
    for meaning, (score, _, language) in best.items():
        taken = unit if unit and _takes(meaning, unit) else None
        yield meaning, HeadingGuess(meaning, score, taken, language)


def _fitting(words: list[str]) -> Iterator[tuple[tuple[str, ...], float]]:
    """Yield what phrases a heading may hold, and how well each fits: 1 exactly."""
    length = sum(map(len, words))
    yield tuple(words), SURE
    for start, word in enumerate(words):
        for end in range(start + 1, min(len(words), start + MOST_WORDS) + 1):
            if end - start < len(words):
                phrase = tuple(words[start:end])
                yield phrase, 0.62 + 0.3 * sum(map(len, phrase)) / length
        for count in range(SHORTEST_PART, len(word)):
            # German puts the main word of a compound last.
            yield (word[-count:],), 0.62 + 0.2 * count / length
            yield (word[:count],), 0.55 + 0.2 * count / length


@cache
def _phrases() -> dict[tuple[str, ...], list[tuple[int, str, str]]]:
    """Return the meanings and languages of all phrases, as words, each with its place."""
    listed = [(phrase, meaning, language) for meaning, languages in COLUMNS.items()
              for language, phrases in languages.items() for phrase in phrases]
    for meaning, ends in (("latest", BEGIN), ("earliest", END)):
        listed += [(text, meaning, language) for language, events in EVENTS.items()
                   for event in events for word in ends[language]
                   for text in (f"{event} {word}", f"{word} {event}", f"{event} {word} at")]
    for meaning, ends in (("earliest", BEGIN), ("latest", END)):
        for language, phrases in ends.items():
            for word in phrases:
                listed += [(text, meaning, language)
                           for window in (*WINDOW[language], *ACTS.get(language, ()))
                           for text in (f"{window} {word}", f"{word} {window}")]
                listed += [(f"{word} {filler}", meaning, language)
                           for filler in ("time", "uhr", "zeit", "uhrzeit", "heure", "hora", "ora")]
    found: dict[tuple[str, ...], list[tuple[int, str, str]]] = {}
    for place, (phrase, meaning, language) in enumerate(listed):
        found.setdefault(tuple(phrase.split()), []).append((place, meaning, language))
    return found
