"""Between the wire's units and the integer thousandths inside `model`."""


def thousandths(value: float) -> int:
    """Return seconds as ms or metres as mm, rounded to the nearest."""
    return round(value * 1000)


def optional_thousandths(value: float | None) -> int | None:
    """Return `thousandths`, or None for no limit."""
    return None if value is None else round(value * 1000)


def whole(value: int) -> float:
    """Return ms as seconds or mm as metres."""
    return value / 1000


MONEY_DECIMALS = 6


def money(cost: float) -> float:
    """Return a cost without the noise that sums of floats have far behind the point."""
    return round(cost, MONEY_DECIMALS)
