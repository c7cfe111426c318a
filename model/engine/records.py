"""Rows with named fields, as the engine and Python alike read and write them."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Record = Any
"""One row, whose fields are attributes."""
Records = NDArray[np.record]


def one(kind: np.dtype[np.record]) -> Record:
    """Return a row of zeros that stands alone."""
    return np.zeros(1, kind)[0]
