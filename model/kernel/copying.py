"""Copies of rows without temporary arrays."""

from model.kernel.compiled import inlined
from model.kernel.records import Records
from model.problem import IntArray


@inlined
def copy_row(source: IntArray, target: IntArray) -> None:
    """Copy one row of numbers. In place."""
    for column in range(len(target)):
        target[column] = source[column]


@inlined
def copy_records(source: Records, target: Records, count: int) -> None:
    """Copy the first `count` records. In place."""
    for row in range(count):
        target[row] = source[row]


@inlined
def copy_some(source: IntArray, target: IntArray, count: int) -> None:
    """Copy the first `count` numbers. In place."""
    for index in range(count):
        target[index] = source[index]


@inlined
def clear(target: IntArray) -> None:
    """Set a row of numbers to zero. In place."""
    for column in range(len(target)):
        target[column] = 0
