"""Rows with named fields, as compiled code and Python alike read and write them."""

from collections import namedtuple
from functools import cache
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

Record = Any
"""One row, whose fields are attributes."""
Records = NDArray[np.record]


def record(*names: str, **others: int | type | tuple[int, ...]) -> np.dtype[np.record]:
    """Return the type of a row, whose fields lie in memory as they are listed.

    Parameters
    ----------
    names
        Integers.
    others
        By name, how many integers, or another type than that, or the shape of an array of bytes.
    """
    fields: list[Any] = [(name, np.int64) for name in names]
    for name, other in others.items():
        if isinstance(other, tuple):
            fields.append((name, np.int8, other))
        else:
            fields.append((name, np.int64, (other,)) if isinstance(other, int) else (name, other))
    return cast("np.dtype[np.record]", np.dtype((np.record, np.dtype(fields, align=True))))


def row_of_floats(*fields: str | tuple[str, int]) -> np.dtype[np.record]:
    """Return the type of a row of 32-bit floats, which is an array of them as well.

    Parameters
    ----------
    fields
        Names, with a number where there are several floats.
    """
    row: list[Any] = [(field, np.float32) if isinstance(field, str)
                      else (field[0], np.float32, field[1:]) for field in fields]
    return cast("np.dtype[np.record]", np.dtype((np.record, np.dtype(row))))


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
