"""Between the wire's units and the integer thousandths inside `model`."""

from collections.abc import Iterable


def thousandths(value: float) -> int:
    """Return seconds as ms, metres as mm or an amount as thousandths, rounded to the nearest."""
    return round(value * 1000)


def optional_thousandths(value: float | None) -> int | None:
    """Return `thousandths`, or None for no limit."""
    return None if value is None else round(value * 1000)


def all_thousandths(values: Iterable[float]) -> tuple[int, ...]:
    """Return the `thousandths` of several amounts."""
    return tuple([round(value * 1000) for value in values])


def whole(value: int) -> float:
    """Return ms as seconds, mm as metres or thousandths as an amount."""
    return value / 1000


def all_whole(values: Iterable[int]) -> list[float]:
    """Return the `whole` of several amounts."""
    return [value / 1000 for value in values]
