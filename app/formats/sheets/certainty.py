"""How sure it is what a column means: what people are to look at before they plan."""

import re
from collections.abc import Sequence

from app.formats.sheets.cells import Raw, shown
from app.formats.sheets.columns import Column
from app.formats.sheets.headings import guesses, is_aside, is_known
from app.formats.sheets.meanings import MEANINGS
from app.formats.sheets.schemas import Certainty

SAMPLED = 50
LONGEST_GROUP = 20

FOR_DRIVERS = frozenset(("phone", "email", "contact", "notes", "priority", "info", "order",
                         "layer"))
"""Meanings that no plan goes by: left out of it, nothing is planned wrongly."""

_TELLING = re.compile(
    r"\A(?:-?\d{1,6}(?:[.,]\d++)?|\d{1,2}[:.h]\d{2}.*+|.*\d{1,2}:\d{2}(?::\d{2})?"
    r"|-?\d{1,3}[.,]\d++[ ,;/]++-?\d{1,3}[.,]\d++|\d++(?:[.,]\d++)? ?[a-z]{1,4}\.?)",
    re.IGNORECASE)
"""Cells that may be amounts, times, coordinates: no phones, nor numbers of orders."""


def certainty_of(column: Column, cells: Sequence[Raw], is_named: bool) -> Certainty:
    """Return how sure the meaning of a column is, by its heading and cells.

    Parameters
    ----------
    is_named
        Whether a column names customers; else any with words may.
    """
    if column.confidence == 1:
        return "stated"
    if column.meaning != "ignored":
        return "doubtful" if column.doubts and column.meaning not in FOR_DRIVERS else "sure"
    return "open" if _may_matter(column, cells[:SAMPLED], is_named) else "unused"


def _may_matter(column: Column, cells: Sequence[Raw], is_named: bool) -> bool:
    """Tell whether a column that isn't used may be for the plan."""
    if not cells or is_aside(column.heading):
        return False
    if is_known(column.heading):
        likely = guesses(column.heading)[0].meaning
        return likely not in FOR_DRIVERS and likely != "name" and MEANINGS[likely].kind != "text"
    if all(any(map(str.isalpha, shown(raw))) for raw in cells) and (
            not is_named or _are_groups(cells)):
        return True
    return all(_TELLING.fullmatch(shown(raw)) for raw in cells)


def _are_groups(cells: Sequence[Raw]) -> bool:
    """Tell whether words divide rows, as crews, areas and skills do."""
    words = {shown(raw) for raw in cells}
    return 1 < len(words) <= len(cells) / 2 and max(map(len, words)) <= LONGEST_GROUP
