"""Addresses as people write them -> words that can be compared."""

import re
import unicodedata
from collections.abc import Iterator
from functools import lru_cache

_SIGNS = str.maketrans({"ø": "o", "æ": "ae", "œ": "oe", "đ": "d", "ł": "l", "ð": "d", "þ": "th",
                        "\u0131": "i", "'": "", "\u2019": ""})
_WORD = re.compile(r"[^\W_]+")

_ENDINGS = (
    ("strasse", "str"), ("straat", "str"), ("katu", "k"), ("gatan", "g"), ("gata", "g"),
    ("tie", "t"), ("vagen", "v"), ("vej", "v"), ("veien", "v"), ("platz", "pl"), ("allee", "al"),
    ("gasse", "g"), ("weg", "w"), ("laan", "ln"), ("kuja", "kj"), ("plein", "pl"),
)
"""Ends of streets' names and how they are cut short: so both are the same."""

_WORDS = {
    "strasse": "str", "straat": "str", "street": "st", "saint": "st", "sankt": "st", "road": "rd",
    "avenue": "av", "ave": "av", "boulevard": "bd", "blvd": "bd", "square": "sq", "lane": "ln",
    "drive": "dr", "place": "pl", "platz": "pl", "plaza": "pl", "piazza": "pl", "court": "ct",
    "allee": "al", "ulica": "ul", "calle": "c", "rue": "r", "route": "rte", "chemin": "ch",
    "doctor": "dr", "doktor": "dr", "professor": "prof", "general": "gen", "north": "n",
    "south": "s", "east": "e", "west": "w",
}

SHORTEST_STEM = 4
"""Letters that stay of a word whose end is cut short."""

_NUMBER = re.compile(r"(\d{1,5})([a-z]?)")
_STATED = re.compile(r"(\d{1,5})\s*+([a-z]?)(?:\s*+(?P<between>[-/\u2013])\s*+(\d{1,5})\s*+"
                     r"([a-z]?))?")
_SEVERAL = re.compile("[;,]")

MOST_IN_RANGE = 100
"""Longest range of house numbers that one house has."""


@lru_cache(2**14)
def words_of(text: str) -> tuple[str, ...]:
    """Return the words of a text: lower case, no accents or signs, usual words cut short."""
    folded = unicodedata.normalize("NFKD", text.casefold().translate(_SIGNS))
    letters = "".join(sign for sign in folded if not unicodedata.combining(sign))
    return tuple(map(_short, _WORD.findall(letters)))


@lru_cache(2**14)
def _short(word: str) -> str:
    if word in _WORDS:
        return _WORDS[word]
    for ending, short in _ENDINGS:
        if word.endswith(ending) and len(word) >= SHORTEST_STEM + len(ending):
            return word[:-len(ending)] + short
    return word


def key_of(text: str) -> str:
    """Return a name as one word: blanks are set in many ways."""
    return "".join(words_of(text))


def is_number(word: str) -> bool:
    """Tell whether a word may be a house number."""
    return _NUMBER.fullmatch(word) is not None


def split_number(number: str) -> tuple[int, str]:
    """Return the number and the letter of a house number such as `12a`."""
    found = _NUMBER.fullmatch(number)
    if found is None:
        raise ValueError(f"{number!r} is no house number")
    return int(found[1]), found[2]


def house_numbers(stated: str) -> Iterator[str]:
    """Yield the single numbers of what a map states, such as `2-6`, `5 A` or `3;5`."""
    for part in _SEVERAL.split(stated.casefold()):
        found = _STATED.fullmatch(part.strip())
        if found is None:
            continue
        yield found[1] + found[2]
        if found["between"] == "/" and found[4]:
            yield found[4] + found[5]
        elif found["between"]:
            first, last = sorted((int(found[1]), int(found[4])))
            if last - first <= MOST_IN_RANGE:
                step = 1 if (last - first) % 2 else 2
                yield from (str(number) for number in range(first, last + 1, step)
                            if str(number) != found[1] + found[2])
