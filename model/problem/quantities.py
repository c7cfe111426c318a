"""Quantities of problems: their types, limits and checks.

Inside `model`, times are integer milliseconds since plan start, distances integer millimetres,
amounts integer thousandths or smaller parts, so that simulator, search and checker agree exactly.
Costs are floats. A field's type says what its numbers are counted in, by which they are checked,
and converted from requests.
"""

import math
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields
from functools import cache
from typing import Annotated, Any, get_args

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


@dataclass(frozen=True)
class Unit:
    """Powers of the units that a number is counted in, and the largest that is allowed."""

    time: int = 0
    length: int = 0
    amount: int = 0
    money: int = 0
    most: float = MAX_QUANTITY


Milliseconds = Annotated[int, Unit(time=1)]
TimeLimit = Annotated[int, Unit(time=1, most=UNLIMITED)]
"""Milliseconds, `UNLIMITED` if there is no limit."""
Millimetres = Annotated[int, Unit(length=1)]
Parts = Annotated[int, Unit(amount=1)]
"""Of an amount, by `Problem.amount_decimals`."""
Count = Annotated[int, Unit()]
Microjoules = Annotated[int, Unit(time=1, most=math.inf)]
"""Milliwatts times milliseconds. Without a most: a remedy may need what no battery holds."""
Rate = Annotated[float, Unit(most=sys.float_info.max)]
Money = Annotated[float, Unit(money=1, most=sys.float_info.max)]
MoneyPerHour = Annotated[float, Unit(money=1, time=-1, most=sys.float_info.max)]
MoneyPerKm = Annotated[float, Unit(money=1, length=-1, most=sys.float_info.max)]
MoneyPerLoadKm = Annotated[float, Unit(money=1, length=-1, amount=-1, most=sys.float_info.max)]


def unit_of(annotation: Any) -> Unit | None:
    """Return what the numbers of a field are counted in, by its type: one, or several of a kind."""
    if isinstance(annotation, Unit):
        return annotation
    return next(filter(None, map(unit_of, get_args(annotation))), None)


@cache
def units_of(owner: type[Any]) -> Mapping[str, Unit]:
    """Return the units of the fields of a data class that hold numbers with one."""
    found = {field.name: unit_of(field.type) for field in fields(owner)}
    return {name: unit for name, unit in found.items() if unit is not None}


def require_units(owner: object, name: str) -> None:
    """Raise `ValueError` unless all numbers that have a unit are finite and from 0 to its most."""
    kind: Any = type(owner)
    for field, most in _most_of(kind).items():
        value = getattr(owner, field)
        # Of many thousands of customers most fields are nothing, or plain numbers.
        if not value or (isinstance(value, int | float) and 0 <= value <= most):
            continue
        for number in _numbers(value) if isinstance(value, tuple | Mapping) else (value,):
            require(0 <= number <= most, f"{name} {field}", number)


@cache
def _most_of(owner: Any) -> Mapping[str, float]:
    """Return the most of each field of a data class that holds numbers with a unit."""
    return {field: unit.most for field, unit in units_of(owner).items()}


def _numbers(values: Iterable[Any] | Mapping[Any, Any]) -> Iterator[Any]:
    """Yield the numbers in tuples, one within another, or in a mapping."""
    for value in values.values() if isinstance(values, Mapping) else values:
        if isinstance(value, tuple):
            yield from _numbers(value)
        else:
            yield value


def require(condition: bool, name: str, value: object) -> None:
    """Raise `ValueError` naming the field and its value unless `condition` holds."""
    if not condition:
        raise ValueError(f"{name}: {value!r} is not allowed")


def require_rate(name: str, value: float) -> None:
    """Raise `ValueError` unless a price is finite and not negative."""
    require(0 <= value < float("inf"), name, value)
