"""What headings and cells say in the main languages of Europe, in simple letters: `words.toml`.

A phrase is simple if `headings.simple` leaves it as it is.
"""

import tomllib
from collections.abc import Mapping
from importlib import resources
from typing import Any

Phrases = list[str]
Listed = dict[str, Phrases]
"""Phrases by what they mean, or by their language."""

_FILE: dict[str, Any] = tomllib.loads(
    resources.files(__package__).joinpath("words.toml").read_text("utf-8"))

ASIDE = frozenset(phrase for phrases in _FILE["aside"].values() for phrase in phrases)
"""Words of headings about what no plan goes by."""

WINDOW: Listed = _FILE["window"]
BEGIN: Listed = _FILE["begin"]
END: Listed = _FILE["end"]
"""Of windows, by language."""
ACTS: Listed = _FILE["acts"]
"""What is done at a stop: with `BEGIN` and `END`, when it may begin and must."""
LENGTHS: Listed = _FILE["lengths"]
EVENTS: Listed = _FILE["events"]
"""With `BEGIN`, when one must be there at the latest; with `END`, when one may leave."""
WHOLE: Listed = _FILE["whole"]
"""Headings, by meaning, that say something else within longer ones."""

COLUMNS: dict[str, Listed] = _FILE["columns"]
"""Headings of customers' columns, by meaning and language."""

VAN_HEADINGS: Listed = _FILE["vehicles"]
PLAN_NAMES: Listed = _FILE["plan"]
MEASURES: Listed = _FILE["measures"]
SIDE_WORDS: Listed = _FILE["sides"]
DESTINATIONS = frozenset(_FILE["destinations"]["words"])
SIDE_STEMS: Listed = _FILE["stems"]
END_WORDS: Listed = _FILE["ends"]
BARE_END_WORDS: Listed = _FILE["bare_ends"]
PLACE_WORDS: Listed = _FILE["places"]
KIND_STEMS: Listed = _FILE["kinds"]
STATE_WORDS: Listed = _FILE["states"]
WINDOW_WORDS: Listed = _FILE["windows"]
WEEKDAYS: Listed = _FILE["weekdays"]
CELL_WORDS: Listed = _FILE["cells"]
LETTERS: Listed = _FILE["letters"]
UNIT_WORDS: Listed = _FILE["units"]


def meant(listed: Mapping[str, Phrases]) -> dict[str, str]:
    """Return what each phrase means."""
    return {phrase: meaning for meaning, phrases in listed.items() for phrase in phrases}
