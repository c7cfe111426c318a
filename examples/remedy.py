"""What a client does with a remedy: change the request as it says, to plan it anew."""

import re
from collections.abc import Iterable
from copy import deepcopy
from typing import Any

Data = dict[str, Any]


def applied(request: Data, changes: Iterable[Data]) -> Data:
    """Return a request as a remedy's `changes` make it."""
    changed: Data = deepcopy(request)
    for change in changes:
        *holder, last = [int(index) if index else name
                         for name, index in re.findall(r"\.(\w+)|\[(\d+)]", change["path"])]
        part: Any = changed
        for key in holder:
            part = part[key]
        part[last] = part[last] + change["by"] if "by" in change else change["to"]
    return changed
