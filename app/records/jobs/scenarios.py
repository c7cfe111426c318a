"""Comparisons and sweeps: one request, several scenarios, each a valid request of its own."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import combinations
from math import prod
from typing import Any

from pydantic import ValidationError
from pydantic_core import from_json, to_json

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.task import task_of
from app.records.jobs.grid import GridPath, Place, places, put, read_path
from app.records.jobs.schemas import CompareRequest, SweepRequest
from app.requests.bounds import UNBOUNDED, Bounds
from app.requests.conversion.ground import Ground
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.preparing import UNHURRIED, Preparing
from app.requests.reading import read_json, read_request, request_errors
from app.requests.refusal import require_readable
from app.schemas.customer import place_name
from app.schemas.day import DayOfBody
from app.schemas.errors import (
    MAX_LISTED_ERRORS, InputError, InvalidRequestError, NoRoadsError, json_path, schema_errors,
)
from app.schemas.hints import with_hints
from app.schemas.request import PlanRequest
from app.schemas.times import read_body

Sections = Mapping[str, Any]
"""Fields of a request as JSON."""


@dataclass(frozen=True)
class Scenario:
    """What distinguishes a request from the base."""

    name: str
    path: Place  # where it is stated, in the comparison's or sweep's request
    sections: Sections  # fields of the request that differ


@dataclass(frozen=True)
class Axis:
    """A field that a sweep varies."""

    path: GridPath
    values: Sequence[Any]
    places: Sequence[Place]


class Comparison:
    """Several fleets for one request."""

    def __init__(self, fleets: Mapping[str, Any]) -> None:
        self.names = tuple(fleets)
        self._fleets = fleets

    def __len__(self) -> int:
        return len(self.names)

    def scenario(self, position: int) -> Scenario:
        """Return the scenario at a position."""
        name = self.names[position]
        return Scenario(f"fleet {name!r}", ("fleets", name), {"fleet": self._fleets[name]})


class Sweep:
    """The grid of some fields' values for one request."""

    def __init__(self, base: PlanRequest, grid: Mapping[str, Sequence[Any]]) -> None:
        """Find the places that `grid` means.

        Raises
        ------
        InvalidRequestError
            If a path leads nowhere, or two to the same place.
        """
        sections = _sections(base, grid)
        self.axes, errors = _axes(sections, grid)
        errors += _overlaps(self.axes)
        if errors:
            raise InvalidRequestError(errors)
        self._sections = {name: to_json(value) for name, value in sections.items()}

    def __len__(self) -> int:
        return prod(len(axis.values) for axis in self.axes)

    @property
    def writes(self) -> int:
        """Values put into all requests together."""
        return len(self) * sum(len(axis.places) for axis in self.axes)

    def values(self, position: int) -> list[Any]:
        """Return the values at a position, one for each axis; the last runs fastest."""
        values = []
        for axis in reversed(self.axes):
            position, index = divmod(position, len(axis.values))
            values.append(axis.values[index])
        return values[::-1]

    def scenario(self, position: int) -> Scenario:
        """Return the scenario at a position."""
        sections = {name: from_json(value) for name, value in self._sections.items()}
        values = self.values(position)
        for axis, value in zip(self.axes, values, strict=True):
            for place in axis.places:
                put(sections, place, value)
        name = ", ".join(f"{axis.path.text} = {to_json(value).decode()[:80]}"
                         for axis, value in zip(self.axes, values, strict=True))
        return Scenario(name, ("grid",), sections)


Scenarios = Comparison | Sweep


def read_study(kind: str, body: bytes, policies: Collection[str] | None,
               bounds: Bounds = UNBOUNDED) -> tuple[PlanRequest, Scenarios]:
    """Return the base and the scenarios of a request; the scenarios are not validated yet.

    Raises
    ------
    NotJsonError
        If `body` is not JSON.
    InvalidRequestError
        With the errors found, if it is not a valid request.
    """
    schema = CompareRequest if kind == "compare" else SweepRequest
    require_readable(body, schema)
    raw = read_json(body)
    errors: list[InputError] = []
    if isinstance(raw, dict) and "base" in raw:
        try:
            base = read_request(to_json(raw["base"]), policies, bounds)
        except InvalidRequestError as error:
            errors = [_moved(item, "$", "$.base") for item in error.errors]
    try:
        # The base is checked above, with more than the schema.
        small = raw | {"base": _SMALLEST} if isinstance(raw, dict) and "base" in raw else raw
        read_body(schema, to_json(small), DayOfBody(body))
    except ValidationError as error:
        errors += with_hints(schema_errors(error.errors(include_url=False)), schema)
    if errors:
        raise InvalidRequestError(errors)
    return base, Comparison(raw["fleets"]) if kind == "compare" else Sweep(base, raw["grid"])


def validate(base: PlanRequest, scenarios: Scenarios, policies: Collection[str],
             bounds: Bounds, preparing: Preparing = UNHURRIED,
             roads: Roads = NO_ROADS) -> None:
    """Check each scenario as a whole request, unless the work on them is to end.

    Raises
    ------
    InvalidRequestError
        With the errors found; after many, the scenarios left are not looked at.
    StoppedError
        If the work is stopped.
    """
    errors: list[InputError] = []
    ground = Ground(PlacedRequest(base), preparing, roads.zones)
    for position in range(len(scenarios)):
        preparing.pause()
        scenario = scenarios.scenario(position)
        try:
            request = apply(base, scenario, policies, bounds)
            placed = PlacedRequest(request)
            if not ground.is_that_of(placed):
                ground = Ground(placed, preparing, roads.zones)
            check_replan(request, preparing, ground, roads)
        except InvalidRequestError as error:
            errors += [_named(item, scenario) for item in error.errors]
        if len(errors) >= MAX_LISTED_ERRORS:
            break
    if errors:
        raise InvalidRequestError(errors)


def apply(base: PlanRequest, scenario: Scenario, policies: Collection[str] | None,
          bounds: Bounds = UNBOUNDED) -> PlanRequest:
    """Return the request of a scenario.

    Raises
    ------
    InvalidRequestError
        If it is not valid.
    """
    try:
        changed = read_body(
            PlanRequest, to_json({**_SMALLEST, **_day_of(base), **scenario.sections}))
    except ValidationError as error:
        found = schema_errors(error.errors(include_url=False))
        raise InvalidRequestError(with_hints(found, PlanRequest)) from error
    request = base.model_copy(
        update={name: getattr(changed, name) for name in scenario.sections})
    errors = request_errors(request, policies, bounds)
    if errors:
        raise InvalidRequestError(errors)
    return request


_DAY = ("plan_start", "time_zone")
"""Fields by which instants are read."""


def _day_of(base: PlanRequest) -> Sections:
    return {name: getattr(base, name) for name in _DAY}


def check_replan(request: PlanRequest, preparing: Preparing, ground: Ground | None = None,
                 roads: Roads = NO_ROADS) -> None:
    """Check what can be told of a plan to go on from only when the problem is made.

    Roads that don't answer hinder nobody: the job waits for them.

    Raises
    ------
    InvalidRequestError
        If what has happened by then doesn't fit.
    """
    if request.replan is not None:
        with suppress(NoRoadsError):
            task_of(request, preparing, ground, roads)


_SMALLEST: dict[str, Any] = {"depots": [], "customers": [], "fleet": []}
"""Stands for the fields that aren't looked at."""


def _sections(base: PlanRequest, grid: Mapping[str, Sequence[Any]]) -> dict[str, Any]:
    """Return the fields of the base that a grid varies as JSON, defaults included."""
    names = {text.partition(".")[0].partition("[")[0] for text in grid}
    stated = base.model_dump(mode="json", by_alias=True, include=names)
    # Other places are made of what their customers state, once more where a scenario is read.
    places = {place_name(each.id, place.id) for each in base.customers
              for place in each.alternatives}
    if places and "customers" in stated:
        stated["customers"] = [each for each in stated["customers"] if each["id"] not in places]
    return stated


def _axes(sections: Sections, grid: Mapping[str, Sequence[Any]]) -> tuple[list[Axis],
                                                                          list[InputError]]:
    axes, errors = [], []
    for text, values in grid.items():
        try:
            path = read_path(text)
            if path.section in _DAY:
                raise ValueError("other instants are told by it: vary these")
            axes.append(Axis(path, values, places(sections, path)))
        except ValueError as error:
            errors.append(InputError(code="UNKNOWN_PATH", path=json_path(("grid", text)),
                                     message=f"The path leads nowhere: {error}."))
    return axes, errors


def _overlaps(axes: Sequence[Axis]) -> Iterator[InputError]:
    """Yield an error for each two axes of which one would overwrite the other."""
    for axis, other in combinations(axes, 2):
        mine, others = set(axis.places), set(other.places)
        if _within(mine, others) or _within(others, mine):
            yield InputError(code="PATHS_OVERLAP", path=json_path(("grid", other.path.text)),
                             message=f"The path means a place that {axis.path.text!r} means too: "
                             "leave one of them out.")


def _within(inner: set[Place], outer: set[Place]) -> bool:
    return any(place[:length] in outer for place in inner for length in range(1, len(place) + 1))


def _named(error: InputError, scenario: Scenario) -> InputError:
    """Return an error with the scenario that has it."""
    start = json_path(scenario.path)
    section = "$.fleet"
    moved = (start + error.path[len(section):]
             if scenario.path[0] == "fleets" and error.path.startswith(section) else start)
    where = "" if moved != start else f" at {error.path}"
    return error.model_copy(update={
        "path": moved, "message": f"With {scenario.name}{where}: {error.message}"})


def _moved(error: InputError, before: str, after: str) -> InputError:
    return error.model_copy(update={"path": after + error.path[len(before):]})
