"""Rows that tell by their type alone that no rarer rule is stated. Compiled.

Code is compiled once for rows where any rule may be stated and once for plain ones. To the compiler
`is_plain` is a constant: what stands behind it is no part of the other code, and where nobody
states such a rule, nothing is paid for it.
"""

from typing import cast

import numpy as np

from model.kernel.compiled import pasted
from model.kernel.records import Record, Records

MARK = "rare"
ANY_RULE, PLAIN = (1, 0), (0, 0)
"""The field that marks a row, and its shapes. It takes no room, so that rows of both types are the
same in memory."""

MARKED = 0
"""What is written into it."""


@pasted
def is_plain(row: Record) -> bool:
    """Tell whether a row's type says that no rarer rule is stated."""
    return len(row.rare) == 0


def as_plain(rows: Records) -> Records:
    """Return the same rows of the type that says so."""
    return rows.view(plain_type(rows.dtype))


def plain_type(kind: np.dtype[np.record]) -> np.dtype[np.record]:
    """Return the type of rows that are like others, and plain."""
    names, fields = kind.names or (), dict(kind.fields or {})
    formats = [np.dtype((np.int8, PLAIN)) if name == MARK else fields[name][0] for name in names]
    layout = np.dtype({"names": list(names), "formats": formats,
                       "offsets": [fields[name][1] for name in names],
                       "itemsize": kind.itemsize}, align=True)
    return cast("np.dtype[np.record]", np.dtype((np.record, layout)))
