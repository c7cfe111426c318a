"""Costs of the cheapest plans of tiny problems: `exhaustive` found them, `optima.txt` keeps them.

Enumerating takes a hundred times what searching does. A problem that isn't kept, since what it
states has changed, is enumerated; in `make fuzz` all are. `NOTE_OPTIMA=1` has new ones noted.
"""

import os
from dataclasses import MISSING, Field, fields, is_dataclass
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from model.problem import Problem
from tests.model.search.exhaustive import cheapest_cost
from tests.seeds import SHARE

KEPT = Path(__file__).with_name("optima.txt")


def cheapest_known(problem: Problem) -> float:
    """Return the cost of the cheapest plan of a problem of a few customers."""
    name = name_of(problem)
    kept = _kept().get(name)
    if kept is not None and SHARE > 1:
        return kept
    cost = cheapest_cost(problem)
    assert kept is None or cost == pytest.approx(kept)
    if kept is None and "NOTE_OPTIMA" in os.environ:
        with KEPT.open("a") as file:
            file.write(f"{name} {cost!r}\n")
    return cost


@cache
def _kept() -> dict[str, float]:
    lines = KEPT.read_text("utf-8").split("\n")
    return {name: float(cost) for name, cost in map(str.split, filter(None, lines))}


def name_of(problem: Problem) -> str:
    """Return what tells problems apart by all that they state, but not by what no longer counts."""
    return blake2b(repr(_stated(problem)).encode(), digest_size=12).hexdigest()


def _stated(value: Any) -> Any:
    """Return a value as Python's own tuples, numbers and texts, without fields left as they are."""
    if is_dataclass(value):
        given = {each.name: (_stated(getattr(value, each.name)), _usual(each))
                 for each in fields(value) if each.init}
        return tuple((name, own) for name, (own, usual) in sorted(given.items()) if own != usual)
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, blake2b(value.tobytes(), digest_size=12).hexdigest()
    if isinstance(value, np.generic):
        return value.item()
    if hasattr(value, "shape"):  # looked up like an array
        return _stated(value[np.arange(len(value))])
    if isinstance(value, dict):
        return tuple((key, _stated(inner)) for key, inner in sorted(value.items()))
    if isinstance(value, tuple | list):
        return tuple(map(_stated, value))
    if isinstance(value, frozenset | set):
        return tuple(sorted(map(_stated, value)))
    assert value is None or isinstance(value, str | int | float), value
    return value


def _usual(each: Field[Any]) -> Any:
    if each.default_factory is not MISSING:
        return _stated(each.default_factory())
    return MISSING if each.default is MISSING else _stated(each.default)
