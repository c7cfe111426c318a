"""Rows with named fields, as the engine and Python alike read and write them."""

from collections import namedtuple
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

Record = Any
"""One row, whose fields are attributes."""
Records = NDArray[np.record]


def one(kind: np.dtype[np.record]) -> Record:
    """Return a row of zeros that stands alone."""
    return np.zeros(1, kind)[0]


def read_rows(records: Records) -> list[Any]:
    """Return records as tuples of Python's own numbers, with the same names."""
    row = _row(records.dtype.names or ())
    return [row._make(values) for values in records.tolist()]


@cache
def _row(names: tuple[str, ...]) -> Any:
    return namedtuple("Row", names)
