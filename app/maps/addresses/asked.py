"""An address that is looked for: its words, and which of them a street's name may be."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from rapidfuzz import fuzz

from app.maps.addresses.spelling import is_number, split_number, words_of

MOST_WORDS = 24
LONGEST_NAME = 6
"""Words of a street's name."""

ALIKE = 78.0
"""From which on, of 100, two names are taken for one that is misspelt."""

SAME_WORD = 80.0

BEFORE_NUMBERS = frozenset(("nr", "no", "num", "numero", "number", "n", "nro", "hausnr"))

SHORTEST_POSTCODE = 4


class WordSpan(NamedTuple):
    """Words that follow each other, from the first to before the last."""

    first: int
    last: int


class Number(NamedTuple):
    """The house number that stands beside a street's name."""

    value: int
    letter: str
    is_apart: bool  # the letter is a word of its own: perhaps a stairway
    words: frozenset[int]


@dataclass(frozen=True)
class AddressWords:
    """The words of an address."""

    words: tuple[str, ...]

    @classmethod
    def of(cls, address: str) -> "AddressWords":
        """Return what an address says."""
        return cls(words_of(address)[:MOST_WORDS])

    @cached_property
    def spans(self) -> Mapping[str, WordSpan]:
        """What may be the name of a street or town, by its key."""
        count = len(self.words)
        return {key: WordSpan(first, last) for first in range(count)
                for last in range(first + 1, min(count, first + LONGEST_NAME) + 1)
                if any(map(str.isalpha, key := "".join(self.words[first:last])))}

    @cached_property
    def letters(self) -> str:
        """All words that hold letters, as one."""
        return "".join(word for word in self.words if any(map(str.isalpha, word)))

    def most_alike(self, key: str) -> tuple[float, WordSpan] | None:
        """Return what is most like a name, and how much it is, if anything is."""
        best: tuple[float, WordSpan] | None = None
        for text, span in self.spans.items():
            score = fuzz.ratio(key, text, score_cutoff=ALIKE if best is None else best[0] + 1e-9)
            if score:
                best = score, span
        return best

    def number_beside(self, span: WordSpan) -> Number | None:
        """Return the house number behind a street's name, or before it."""
        after = span.last
        if after < len(self.words) and self.words[after] in BEFORE_NUMBERS:
            after += 1
        for place in (after, span.first - 1):
            if 0 <= place < len(self.words) and is_number(self.words[place]):
                return self._number_at(place)
        return None

    def _number_at(self, place: int) -> Number:
        value, letter = split_number(self.words[place])
        behind = self.words[place + 1] if place + 1 < len(self.words) else ""
        if not letter and len(behind) == 1 and behind.isalpha():
            return Number(value, behind, True, frozenset((place, place + 1)))
        return Number(value, letter, False, frozenset((place,)))

    def rest(self, span: WordSpan, number: Number | None) -> list[str]:
        """Return the other words."""
        used = set(range(*span)) | (number.words if number else set())
        return [word for place, word in enumerate(self.words) if place not in used]


def postcodes_in(words: Sequence[str]) -> list[str]:
    """Return the words that look like postcodes."""
    return [word for word in words if len(word) >= SHORTEST_POSTCODE and word[0].isdigit()]


def names_in(words: Sequence[str]) -> list[str]:
    """Return the words that are names of something."""
    return [word for word in words if len(word) > 2 and word.isalpha()]


def has_word(word: str, words: Iterator[str] | Sequence[str]) -> bool:
    """Tell whether a word, perhaps misspelt, is one of others."""
    return any(fuzz.ratio(word, other) >= SAME_WORD for other in words)
