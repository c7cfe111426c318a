"""Rows of matrices: lists of numbers as they are read, arrays from then on."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

Row = NDArray[np.int32] | NDArray[np.float64]
"""Of 32 bits where all numbers are whole and fit: a list takes four times as much, or eight.
What is null is not a number."""

_LEAST, _MOST = np.iinfo(np.int32).min, np.iinfo(np.int32).max


@dataclass(frozen=True)
class HeldAsArray:
    """Has what is read as a list of numbers held as a `Row`, and written as a list again.

    The list of each row is let go before the next is read.
    """

    numbers: Any  # the list, as pydantic reads it

    def __get_pydantic_core_schema__(self, source: Any,
                                     handler: GetCoreSchemaHandler) -> CoreSchema:
        numbers = handler.generate_schema(self.numbers)
        written = core_schema.plain_serializer_function_ser_schema(
            numbers_of, return_schema=numbers)
        return core_schema.no_info_after_validator_function(row_of, numbers, serialization=written)


def numbers_of(row: Row) -> list[float | None]:
    """Return a row as it was read."""
    numbers: list[float | None] = row.tolist()
    if np.isnan(row).any():
        return [None if number != number else number for number in numbers]
    return numbers


def row_of(numbers: list[float | None]) -> Row:
    """Return numbers as an array, to the last bit."""
    row = np.array(numbers, np.float64)
    if not len(row) or np.isnan(row).any() or row.min() < _LEAST or row.max() > _MOST:
        return row
    whole = row.astype(np.int32)
    return whole if bool((whole == row).all()) else row
