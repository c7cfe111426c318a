"""What several limits would have to be together for a trip that breaks more than one."""

from collections.abc import Callable
from typing import NamedTuple

from model.counsel.diagnoses import DIAGNOSES
from model.counsel.diagnosis import Diagnosis
from model.counsel.remedy import Part, Remedy
from model.counsel.rest_remedies import rest_remedy
from model.counsel.trial import Attempt
from model.judge.check import check

MOST_LIMITS = 4
"""At most so many are named: whoever has to change more won't."""

Diagnose = Callable[[Attempt], Diagnosis | None]


class _Step(NamedTuple):
    """An attempt as limits have been changed so far, and how."""

    attempt: Attempt
    parts: tuple[Part, ...] = ()


def combined_remedy(attempt: Attempt, diagnose: Diagnose) -> Remedy | None:
    """Return changes of several limits that suffice together; None: none are known.

    Each rule that the trip breaks is diagnosed once those before it are kept; `check` judges the
    trip by all changes.
    """
    step = _Step(attempt)
    while len(step.parts) < MOST_LIMITS:
        diagnosis = diagnose(step.attempt)
        if diagnosis is None or not diagnosis.remedy or diagnosis.problem is None:
            last = rest_remedy(step.attempt)
            return Remedy((*step.parts, last)) if last else None
        if diagnosis.remedy in step.parts:
            return None
        changed, solution = diagnosis.problem, attempt.solution
        step = _Step(Attempt(changed, solution, check(changed, solution)),
                     (*step.parts, diagnosis.remedy))
        if not step.attempt.codes:
            return Remedy(step.parts)
    return None


def customer_broken(attempt: Attempt) -> Diagnosis | None:
    """Return the rule that is hardest to change of those that a customer's trip breaks."""
    code = next((code for code in DIAGNOSES if code in attempt.codes), None)
    return None if code is None else DIAGNOSES[code](attempt)
