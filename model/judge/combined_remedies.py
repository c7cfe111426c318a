"""What several limits would have to be together for a trip that breaks more than one."""

from collections.abc import Callable
from typing import NamedTuple

from model.judge.check import check
from model.judge.diagnoses import DIAGNOSES
from model.judge.diagnosis import Diagnosis
from model.judge.rest_remedies import rest_remedy
from model.judge.trial import Attempt

MOST_LIMITS = 4
"""At most so many are named: whoever has to change more won't."""

Diagnose = Callable[[Attempt], Diagnosis | None]

AND = " and "
BEGIN = "fits "


class Remedy(NamedTuple):
    """What suffices, in words, and how many limits that changes; None: nothing is known to."""

    words: str | None
    num_limits: int = 1


class _Step(NamedTuple):
    """An attempt as limits have been changed so far, and in which words."""

    attempt: Attempt
    words: tuple[str, ...] = ()


def combined_remedy(attempt: Attempt, diagnose: Diagnose) -> Remedy | None:
    """Return changes of several limits that suffice together; None: none are known.

    Each rule that the trip breaks is diagnosed once those before it are kept; `check` judges the
    trip by all changes.
    """
    step = _Step(attempt)
    while len(step.words) < MOST_LIMITS:
        diagnosis = diagnose(step.attempt)
        if diagnosis is None or diagnosis.remedy is None or diagnosis.problem is None:
            return _joined(step.words, rest_remedy(step.attempt))
        if diagnosis.remedy in step.words:
            return None
        changed, solution = diagnosis.problem, attempt.solution
        step = _Step(Attempt(changed, solution, check(changed, solution)),
                     (*step.words, diagnosis.remedy))
        if not step.attempt.codes:
            return _joined(step.words[:-1], step.words[-1])
    return None


def _joined(words: tuple[str, ...], last: str | None) -> Remedy | None:
    if last is None:
        return None
    first, *others = (*words, last)
    return Remedy(first + "".join(AND + each.removeprefix(BEGIN) for each in others),
                  1 + len(others))


def customer_broken(attempt: Attempt) -> Diagnosis | None:
    """Return the rule that is hardest to change of those that a customer's trip breaks."""
    code = next((code for code in DIAGNOSES if code in attempt.codes), None)
    return None if code is None else DIAGNOSES[code](attempt)
