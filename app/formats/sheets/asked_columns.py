"""What is asked about columns that nothing uses."""

from collections.abc import Sequence

from app.formats.sheets.cells import MisreadError, Raw, letters, shown
from app.formats.sheets.clocks import Style
from app.formats.sheets.columns import Column
from app.formats.sheets.headings import guesses, simple
from app.formats.sheets.layout import Table
from app.formats.sheets.meanings import MEANINGS
from app.formats.sheets.questions import Question, Questionnaire
from app.formats.sheets.readers import read
from app.formats.sheets.schemas import ColumnMapping, Mapping
from app.formats.sheets.words import CELL_WORDS

LIKELY = 0.5
"""Score of a heading's guess from which it is worth a choice."""

MOST_BY_HEADING = 4
SAMPLED = 50

BY_CELLS = ("window", "earliest", "latest", "point", "date", "demand", "service", "order", "phone",
            "notes")
"""Meanings that are offered where all cells can be read so, the most telling first."""

MOST_BY_CELLS = 4

GROUPING = ("together", "apart")
GROUP_WORDS = frozenset(CELL_WORDS["groups"])
"""Words of headings that may say who goes together, or who doesn't."""

IGNORED, INFO = "ignored", "info"


def column_id(table: Table, index: int) -> str:
    """Return what the question about a column is called, the same in the next file like it."""
    heading = simple(table.headings[index])
    repeats = [simple(other) for other in table.headings].count(heading) > 1
    return f"column:{letters(index) if repeats or not heading else heading}"[:500]


def stated_columns(table: Table, mapping: Mapping, asking: Questionnaire) -> list[ColumnMapping]:
    """Return the columns whose meaning is stated, by the mapping or by an answer."""
    answered = [ColumnMapping(heading=heading[:2000], column=letters(index), meaning=answer)
                for index, heading in enumerate(table.headings)
                if (answer := asking.given.get(column_id(table, index))) in MEANINGS]
    told = {(simple(entry.heading), entry.column) for entry in answered}
    headings = {simple(entry.heading) for entry in answered if entry.heading}
    return [*answered, *(entry for entry in mapping.columns
                         if (simple(entry.heading), entry.column) not in told
                         and simple(entry.heading) not in headings)]


def ask_columns(table: Table, columns: Sequence[Column], style: Style,
                asking: Questionnaire) -> None:
    """Ask about the columns that hold anything and mean nothing. In place."""
    for column in columns:
        cells = table.column(column.index)
        name = column_id(table, column.index)
        if not cells or (column.meaning != IGNORED and name not in asking.given):
            continue
        is_stated = column.confidence == 1 and column.meaning == IGNORED
        examples = list(dict.fromkeys(shown(raw)[:60] for _, raw in cells[:SAMPLED]))[:4]
        asking.ask(Question(
            name, "column", f"Column {column.name} is not used: what does it mean?",
            choices_of(column, [raw for _, raw in cells], style), IGNORED,
            {"column": letters(column.index), "heading": column.heading[:200],
             "count": len(cells)},
            column=letters(column.index), cell=table.name(cells[0][0], column.index),
            examples=tuple(examples), also=frozenset(MEANINGS)), IGNORED if is_stated else None)


def choices_of(column: Column, cells: Sequence[Raw], style: Style) -> dict[str, str]:
    """Return what a column may mean, the likeliest first."""
    cells = cells[:SAMPLED]
    by_heading = [guess.meaning for guess in guesses(column.heading)
                  if guess.score >= LIKELY][:MOST_BY_HEADING]
    by_cells = [meaning for meaning in BY_CELLS if _all_say(cells, meaning, style)][:MOST_BY_CELLS]
    groups = GROUPING if GROUP_WORDS & set(simple(column.heading).split()) else ()
    listed = dict.fromkeys([*by_heading, *groups, *by_cells, INFO, IGNORED])
    return {meaning: MEANINGS[meaning].title for meaning in listed}


def _all_say(cells: Sequence[Raw], meaning: str, style: Style) -> bool:
    if MEANINGS[meaning].kind == "text":
        return meaning != "phone" or all(any(map(str.isdigit, shown(raw))) for raw in cells)
    for raw in cells:
        try:
            read(raw, MEANINGS[meaning].kind, None, style)
        except (MisreadError, TypeError):
            return False
    return True
