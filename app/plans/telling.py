"""Replies in what was asked for: instants as dates and times, beside what the request is in."""

import math
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any, NamedTuple, get_args

from pydantic import BaseModel

from app.plans.replies import Data
from app.schemas.request import PlanRequest
from app.schemas.times import Told, Worded

Words = Callable[[str], str]

_NUMBER = r"(\d+(?:\.\d+)?)"
_INSTANT = re.compile(rf"\b((?:at|before|after|from|until) ){_NUMBER} s\b")
_COMPUTED = re.compile(r"\b(arrival|service_start|departure|launch_time|recovery_time) is "
                       rf"{_NUMBER} s, computed {_NUMBER} s\b")
_LENGTH = re.compile(rf"\b{_NUMBER} (s|minutes?)(?![\w'])")

_SECONDS = {"s": 1.0, "minute": 60.0, "minutes": 60.0}
MINUTE, HOUR = 60, 3600


def wording(clock: Callable[[float], str]) -> Words:
    """Return what puts a message into clocks and lengths; `clock` tells an instant in seconds."""

    def told(message: str) -> str:
        message = _COMPUTED.sub(lambda found: f"{found[1]} is {clock(float(found[2]))}, computed "
                                f"{clock(float(found[3]))}", message)
        message = _INSTANT.sub(lambda found: found[1] + clock(float(found[2])), message)
        return _LENGTH.sub(lambda found: length(float(found[1]) * _SECONDS[found[2]]), message)

    return told


def length(seconds: float) -> str:
    """Return a length of time such as `2 h 5 min`, `2 min 30 s` or `40 s`.

    From an hour on it is rounded up to a minute, so that what is said to suffice does.
    """
    parts: tuple[tuple[float, str], ...]
    if seconds >= HOUR:
        minutes = math.ceil(round(seconds / MINUTE, 6))
        parts = ((minutes // 60, "h"), (minutes % 60, "min"))
    else:
        whole = int(seconds // MINUTE)
        parts = ((whole, "min"), (round(seconds - MINUTE * whole, 3), "s"))
    return " ".join(f"{amount:g} {unit}" for amount, unit in parts if amount) or "0 s"


STATED = {"plan_start", "time_zone", "currency", "load_dimensions"}
"""Fields of a request that its reply repeats."""

Tell = Callable[[float], str | float]


class _Parts(NamedTuple):
    """Fields of a reply that are instants, those that speak of times, and those that hold such."""

    instants: tuple[str, ...]
    words: tuple[str, ...]
    inner: tuple[tuple[str, type[BaseModel]], ...]


@dataclass(frozen=True)
class Telling:
    """How a reply tells instants, None being in seconds, and what it repeats of its request."""

    instant: Tell | None = None
    words: Words | None = None
    stated: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, request: PlanRequest) -> "Telling":
        """Return what a request asks for."""
        stated = request.model_dump(include=STATED, exclude_none=True)
        day = request.day
        if day is None or request.times == "seconds":
            return cls(stated=stated)
        return cls(day.teller(request.times), wording(day.clock), stated)

    def tell(self, model: type[BaseModel], reply: Data) -> None:
        """Put instants as they are told in place of seconds; `model` describes the reply. In place.
        """
        if self.instant is not None and self.words is not None:
            _tell(_parts(model), reply, self.instant, self.words)


IN_SECONDS = Telling()


@cache
def _parts(model: type[BaseModel]) -> _Parts:
    marked: dict[type, list[str]] = {Told: [], Worded: []}
    inner = []
    for name, described in model.model_fields.items():
        notes = list(map(type, _notes(described.annotation, described.metadata)))
        for kind, names in marked.items():
            if kind in notes:
                names.append(name)
        inner += [(name, kind) for kind in _models(described.annotation) if any(_parts(kind))]
    return _Parts(tuple(marked[Told]), tuple(marked[Worded]), tuple(inner))


def _notes(annotation: Any, notes: list[Any]) -> Iterator[Any]:
    """Yield what is noted of a field's type, or of a part of it that may be null."""
    yield from notes
    for part in get_args(annotation):
        yield from getattr(part, "__metadata__", ())


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    """Yield the models that a type is made of, as those of a list."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _models(part)


def _tell(parts: _Parts, reply: Data, tell: Tell, words: Words) -> None:
    for name in parts.instants:
        if reply.get(name) is not None:
            reply[name] = tell(reply[name])
    for name in parts.words:
        if reply.get(name) is not None:
            reply[name] = words(reply[name])
    for name, kind in parts.inner:
        value = reply.get(name)
        for entry in value if isinstance(value, list) else [value]:
            if isinstance(entry, dict):
                _tell(_parts(kind), entry, tell, words)
