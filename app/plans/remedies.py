"""Remedies as replies have them: whom they are about, as changes of the request, and in words."""

from collections.abc import Callable, Sequence

from app.plans.changes import Changing, Data
from model.counsel.explain import Reason
from model.counsel.remedy import Remedy

SEVERAL = "SEVERAL"
"""Code of a remedy that changes several limits, which its parts tell one by one."""

Remedies = Callable[[int, Reason, Remedy], Data]
"""Tells a remedy for who is left out at a node."""


def remedies_reply(remedies: Sequence[Data]) -> Data:
    """Return what a reason has of remedies; words and changes of two by names of their own, too."""
    reply: Data = {"remedy": None, "changes": [], "remedies": remedies}
    names = (("remedy", "changes"), ("other_remedy", "other_changes"))
    for (words, changes), remedy in zip(names, remedies, strict=False):
        reply |= {words: remedy["text"], changes: remedy["changes"]}
    return reply


def remedy_reply(remedy: Remedy, of: Changing | None, is_judged: bool = True) -> Data:
    """Return a remedy; without changes for a problem of no request.

    `is_judged` says whether all rules are kept then.
    """
    first, *others = remedy.changes
    changes = [] if of is None else of.changes(remedy)
    whole: Data = {
        "code": SEVERAL if others else first.limit.upper(),
        "who": None if others or of is None else of.who(first),
        "changes": changes,
        "suffices": is_judged and bool(changes),
        "text": str(remedy),
    }
    if others:
        whole["parts"] = [remedy_reply(Remedy(((change,),)), of, is_judged=False)
                          for change in remedy.changes]
    return whole


def of_no_request(_node: int, _reason: Reason, remedy: Remedy) -> Data:
    """Return a remedy for a problem of no request."""
    return remedy_reply(remedy, None)
