"""Between the wire's units and the integer thousandths inside `model`."""

from collections.abc import Callable
from dataclasses import fields
from functools import cache
from typing import Any

from app.schemas.fields import Input
from model.problem.quantities import units_of


def thousandths(value: float) -> int:
    """Return seconds as ms or metres as mm, rounded to the nearest."""
    return round(value * 1000)


def optional_thousandths(value: float | None) -> int | None:
    """Return `thousandths`, or None for no limit."""
    return None if value is None else round(value * 1000)


def by_name(stated: Input, kind: Any, prefix: str = "") -> dict[str, Any]:
    """Return the fields of a data class that a request states by the same names behind a prefix.

    They are numbers that have a unit and flags. Seconds become ms and metres mm; what is null keeps
    the default.
    """
    values = stated.__dict__
    return {field: convert(value) for name, field, convert in _shared(type(stated), kind, prefix)
            if isinstance(value := values[name], NUMBER)}


NUMBER = int, float


@cache
def _shared(stated: type[Input], kind: Any,
            prefix: str) -> tuple[tuple[str, str, Callable[[Any], Any]], ...]:
    """Return the names on the wire, those of fields behind the prefix, and what converts them."""
    conversions: dict[str, Callable[[Any], Any]] = {
        each.name: bool for each in fields(kind) if each.type is bool}
    for name, unit in units_of(kind).items():
        conversions[name] = thousandths if unit.time + unit.length == 1 else _as_it_is
    return tuple([(name, prefix + name, conversions[prefix + name])
                  for name in stated.model_fields if prefix + name in conversions])


def _as_it_is(value: Any) -> Any:
    return value


def whole(value: int) -> float:
    """Return ms as seconds or mm as metres."""
    return value / 1000


MONEY_DECIMALS = 6


def money(cost: float) -> float:
    """Return a cost without the noise that sums of floats have far behind the point."""
    return round(cost, MONEY_DECIMALS)
