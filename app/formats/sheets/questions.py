"""What an import asks: what would else be dropped, or taken for granted, without a word."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from app.formats.sheets.cells import CellError

QuestionKind = Literal["column", "sheet", "hidden_rows", "status", "order_kind", "total_rows",
                       "day", "same_rows", "related", "shipments", "orders"]

LEAVE_OUT, PLAN = "leave_out", "plan"
KEEP_OR_NOT = {LEAVE_OUT: "Leave out", PLAN: "Plan all the same"}


@dataclass(frozen=True)
class Question:
    """Something that only who sends the file can know."""

    id: str  # the same for the next file like it
    kind: QuestionKind
    text: str
    choices: Mapping[str, str]  # answers and what they mean in words
    default: str | None  # None: it must be answered
    values: Mapping[str, str | int] = field(default_factory=dict)  # what `text` is made of
    column: str | None = None  # letters
    cell: str | None = None
    sheet: str | None = None
    examples: tuple[str, ...] = ()
    also: frozenset[str] = frozenset()  # further answers that are taken


@dataclass(frozen=True)
class AnsweredQuestion:
    """A question and how it was answered."""

    question: Question
    answer: str | None
    is_answered: bool


@dataclass
class Questionnaire:
    """The questions of one import, and the answers given to them."""

    given: Mapping[str, str]
    asked: list[AnsweredQuestion] = field(default_factory=list)
    errors: list[CellError] = field(default_factory=list)

    def ask(self, question: Question, stated: str | None = None) -> str | None:
        """Note a question, and return the answer to go by. In place.

        Parameters
        ----------
        stated
            An answer that is stated elsewhere, as a column's meaning in the mapping.
        """
        given = self.given.get(question.id, stated)
        if given is not None and given not in question.choices and given not in question.also:
            if question.id in self.given:
                self.errors.append(CellError(
                    "ANSWER", f"{given[:40]!r} is no answer to {question.id!r}: give one of "
                    f"{', '.join(question.choices)}.", question.cell, {"value": given[:40]}))
            given = None
        answer = question.default if given is None else given
        self.asked.append(AnsweredQuestion(question, answer, given is not None))
        return answer


def rows_named(rows: list[int]) -> str:
    """Return rows, counted from 0, as people name them: 3, 5-7."""
    parts: list[list[int]] = []
    for row in sorted(rows):
        if parts and row == parts[-1][-1] + 1:
            parts[-1].append(row)
        else:
            parts.append([row])
    shown = [f"{part[0] + 1}-{part[-1] + 1}" if len(part) > 1 else str(part[0] + 1)
             for part in parts[:10]]
    return ", ".join(shown) + (", \u2026" if len(parts) > 10 else "")
