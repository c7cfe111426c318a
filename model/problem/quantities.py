"""Quantities of problems: their types, limits and checks.

Inside `model`, times are integer milliseconds since plan start, distances integer millimetres,
amounts integer thousandths or smaller parts, so that simulator, search and checker agree exactly.
Costs are floats.
"""

import numpy as np
from numpy.typing import NDArray

IntArray = NDArray[np.int64]
Int32Array = NDArray[np.int32]
FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
UIntArray = NDArray[np.uint64]

UNLIMITED = 2**42
"""Stands for "no limit" on a time (ms) or a distance (mm)."""

UNREACHABLE = 2**50
"""Duration and distance of a flight that can't be flown."""

NO_LEG = 2**31 - 1
"""Stands for `UNREACHABLE` where legs are held in 32 bits."""

LONGEST_NARROW = NO_LEG - 1
"""Longest leg that is held there: 24 days, or 2,147 km."""

MAX_QUANTITY = 10**12
"""Largest time (ms), distance (mm) or amount (parts) that a problem may state."""

MAX_MONEY = 1e12
"""Largest price that a request states."""

USUAL_DECIMALS = 3
"""Decimals of amounts, unless a problem states others."""

MAX_DIMENSIONS = 8
"""Most dimensions of load."""

MOST_INCOMPATIBLE = 62
"""Most goods that may be named as incompatible with others."""

FULL_SPEED = 1_000_000
"""Factor of a speed profile at which a leg takes its matrix duration."""

MS_PER_HOUR = 3_600_000
MM_PER_KM = 1_000_000


def require(condition: bool, name: str, value: object) -> None:
    """Raise `ValueError` naming the field and its value unless `condition` holds."""
    if not condition:
        raise ValueError(f"{name}: {value!r} is not allowed")


def require_quantity(name: str, value: int, limit: int = MAX_QUANTITY) -> None:
    """Raise `ValueError` unless a quantity is between 0 and its limit."""
    require(0 <= value <= limit, name, value)


def require_rate(name: str, value: float) -> None:
    """Raise `ValueError` unless a price is finite and not negative."""
    require(0 <= value < float("inf"), name, value)
