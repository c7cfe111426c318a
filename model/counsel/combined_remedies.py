"""What several limits would have to be together for a trip that breaks more than one."""

from collections.abc import Callable

from model.counsel.diagnoses import DIAGNOSES
from model.counsel.diagnosis import Diagnosis
from model.counsel.remedy import Part, Remedy
from model.counsel.rest_remedies import rest_remedy
from model.counsel.trial import Attempt
from model.judge.check import check

MOST_LIMITS = 4
"""At most so many are named: whoever has to change more won't."""

Diagnose = Callable[[Attempt], Diagnosis | None]


def combined_remedy(attempt: Attempt, diagnose: Diagnose) -> Remedy | None:
    """Return changes of several limits that suffice together; None: none are known.

    Each rule that the trip breaks is diagnosed once those before it are kept; `check` judges the
    trip by all changes.
    """
    tried, parts = attempt, tuple[Part, ...]()
    while len(parts) < MOST_LIMITS:
        diagnosis = diagnose(tried)
        if diagnosis is None or not diagnosis.remedy or diagnosis.problem is None:
            last = rest_remedy(tried)
            return Remedy((*parts, last)) if last else None
        if diagnosis.remedy in parts:
            return None
        changed, parts = diagnosis.problem, (*parts, diagnosis.remedy)
        tried = Attempt(changed, attempt.solution, check(changed, attempt.solution))
        if not tried.codes:
            return Remedy(parts)
    return None


def customer_broken(attempt: Attempt) -> Diagnosis | None:
    """Return the rule that is hardest to change of those that a customer's trip breaks."""
    code = next((code for code in DIAGNOSES if code in attempt.codes), None)
    return None if code is None else DIAGNOSES[code](attempt)
