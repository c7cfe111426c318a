"""Paths such as `fleet[*].capacity[0]`: the places in a request that a sweep varies."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

Place = tuple[str | int, ...]

_STEP = re.compile(r"\.?([A-Za-z_][A-Za-z0-9_]*)|\[(\*|[0-9]{1,6})\]")


@dataclass(frozen=True)
class GridPath:
    """A path, taken apart: names, indices, and None for every entry of a list."""

    text: str
    steps: tuple[str | int | None, ...]

    @property
    def section(self) -> str:
        """The field of the request that the path begins with."""
        return str(self.steps[0])


def read_path(text: str) -> GridPath:
    """Take a path apart.

    Raises
    ------
    ValueError
        If it is none.
    """
    steps: list[str | int | None] = []
    position = 0
    while position < len(text):
        match = _STEP.match(text, position)
        # Names follow one another with a dot between, and only there.
        if match is None or (match[1] is not None and match[0].startswith(".") != bool(steps)):
            break
        name, index = match[1], match[2]
        steps.append(name if name is not None else None if index == "*" else int(index))
        position = match.end()
    if position < len(text) or not steps or not isinstance(steps[0], str):
        raise ValueError("this is no path: write one such as 'fleet[*].capacity[0]'")
    return GridPath(text, tuple(steps))


def places(data: Any, path: GridPath) -> list[Place]:
    """Return the places that a path means in a request.

    Parameters
    ----------
    data
        The request as JSON, fields left out included with their defaults.
    path
        The path.

    Raises
    ------
    ValueError
        If it leads nowhere.
    """
    found = list(_reach(data, path.steps, ()))
    if not found:
        raise ValueError("it means no place: a list on the way is empty")
    return found


def _reach(data: Any, steps: tuple[str | int | None, ...], place: Place) -> Iterator[Place]:
    if not steps:
        yield place
        return
    step, rest = steps[0], steps[1:]
    if data is None:
        raise ValueError(f"{_text(place)} is null in base: state it there")
    if isinstance(step, str):
        if not isinstance(data, dict) or step not in data:
            raise ValueError(f"{_text(place)} has no field {step!r}: correct the path")
        yield from _reach(data[step], rest, (*place, step))
        return
    if not isinstance(data, list):
        raise ValueError(f"{_text(place)} is no list: leave its index out")
    if step is not None and step >= len(data):
        raise ValueError(f"{_text(place)} has {len(data)} entries, from 0 on: correct the index")
    for index in range(len(data)) if step is None else (step,):
        yield from _reach(data[index], rest, (*place, index))


def put(data: Any, place: Place, value: Any) -> None:
    """Write a value to a place. In place."""
    for step in place[:-1]:
        data = data[step]
    data[place[-1]] = value


def _text(place: Place) -> str:
    if not place:
        return "the request"
    return "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in place)[1:]
