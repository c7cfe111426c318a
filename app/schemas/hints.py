"""What errors at a field say beside: what the field is for, and which one was meant."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import cache
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from app.schemas.errors import MAX_LISTED_ERRORS, InputError

LONGEST_NAME = 40
"""Characters of a name up to which a field is looked for that was meant."""

MOST_LOOKED_UP = 200
"""Different names for which one is looked for, of one request."""

CLOSENESS = 0.7

MOST_NAMES = 12
"""Fields that are listed where none is like what was written."""

EXPLAINED = frozenset({"MISSING_FIELD", "WRONG_TYPE", "OUT_OF_RANGE", "WRONG_LENGTH"})

_STEP = re.compile(r"\.([A-Za-z_]\w*)|\[(\d+)\]|\[(?:'[^']*'|\"[^\"]*\")\]")

SYNONYMS = {
    "lat": "location", "lon": "location", "lng": "location", "latitude": "location",
    "longitude": "location", "coordinates": "location", "coords": "location",
    "position": "location",
    "name": "id", "vehicles": "fleet", "trucks": "fleet", "jobs": "customers",
    "orders": "customers",
    "stops": "customers", "services": "customers", "warehouses": "depots", "depot": "depots",
    "quantity": "demand", "weight": "demand", "amount": "demand", "load": "demand",
    "delivery": "demand", "service": "service_duration", "service_time": "service_duration",
    "duration": "service_duration", "setup": "setup_duration", "setup_time": "setup_duration",
    "window": "time_window", "windows": "time_windows", "priority": "unassigned_cost",
    "prize": "unassigned_cost", "phone": "info", "address": "info", "notes": "info",
    "start": "earliest", "begin": "earliest", "from": "earliest", "end": "latest", "to": "latest",
    "due": "latest", "speed": "speed_kmh", "max_trip": "max_trips", "type": "id",
    "max_tasks": "max_stops", "working_hours": "shift",
    "max_travel_time": "max_travel_duration", "max_duration": "max_working_duration",
    "battery": "energy", "range": "endurance", "timeout": "time_limit", "iterations":
    "search_iterations", "matrix": "matrices", "no_fly": "airspace", "wind": "airspace",
    "per_kilometre": "per_km", "number": "count", "quantity_available": "count",
}
"""Names that other planners and spreadsheets have for fields."""


@dataclass(frozen=True)
class _Place:
    """What a schema has at a place of a request."""

    models: tuple[type[BaseModel], ...]  # that an object there may be
    field: FieldInfo | None = None  # that holds it
    name: str = ""  # of the field

    @property
    def names(self) -> list[str]:
        """Names of the fields of an object there."""
        return sorted({info.alias or name for model in self.models
                       for name, info in model.model_fields.items()})


def with_hints(errors: Sequence[InputError], model: type[BaseModel]) -> list[InputError]:
    """Return errors of what should fit a model, those that are listed with what helps there."""
    looked_up: dict[str, str] = {}

    def hinted(error: InputError) -> InputError:
        if error.code == "UNKNOWN_FIELD":
            if error.path not in looked_up and len(looked_up) < MOST_LOOKED_UP:
                looked_up[error.path] = _spelling(error.path, model)
            hint = looked_up.get(error.path, "")
        else:
            hint = _meaning(error.path, model) if error.code in EXPLAINED else ""
        return error.model_copy(update={"message": f"{error.message} {hint}"}) if hint else error

    return [*map(hinted, errors[:MAX_LISTED_ERRORS]), *errors[MAX_LISTED_ERRORS:]]


def _spelling(path: str, model: type[BaseModel]) -> str:
    """Say which field was meant, or which there are."""
    steps = _steps(path)
    name = steps[-1] if steps else None
    if name is None or len(name) > LONGEST_NAME:
        return ""
    names = _place(model, tuple(steps[:-1])).names
    close = get_close_matches(name.lower(), names, 1, CLOSENESS)
    meant = close[0] if close else SYNONYMS.get(name.lower())
    if meant in names:
        return f"Did you mean {meant}?"
    return f"The fields here are {', '.join(names)}." if 0 < len(names) <= MOST_NAMES else ""


def _meaning(path: str, model: type[BaseModel]) -> str:
    """Say what a field is for."""
    place = _place(model, tuple(_steps(path)))
    text = place.field.description if place.field is not None else None
    told = [f"{place.name}: {_first_sentences(text)}"] if text else []
    if 0 < len(place.names) <= MOST_NAMES:
        told.append(f"Its fields are {', '.join(place.names)}.")
    return " ".join(told)


def _first_sentences(text: str) -> str:
    """Return a description as far as a message has room for."""
    sentences = re.split(r"(?<=[.:]) (?=[A-Z`])", text)
    told = sentences[0]
    for sentence in sentences[1:]:
        if len(told) + len(sentence) > 160:
            break
        told += f" {sentence}"
    return told


def _steps(path: str) -> list[str | None]:
    """Return the names on the way to a place; None stands for an entry of a list or mapping."""
    return [match[1] for match in _STEP.finditer(path)]


@cache
def _place(model: type[BaseModel], steps: tuple[str | None, ...]) -> _Place:
    """Return what a model has at a place."""
    place = _Place((model,))
    annotations: list[Any] = [model]
    for step in steps:
        fields = [info for owner in place.models for name, info in owner.model_fields.items()
                  if step is not None and (info.alias or name) == step]
        annotations = ([info.annotation for info in fields] if fields
                       else [inner for each in annotations for inner in _entries(each)])
        models = tuple(dict.fromkeys(_models(annotations)))
        place = (_Place(models, fields[0], step or "") if fields
                 else replace(place, models=models))
    return place


def _models(annotations: Iterable[Any]) -> Iterator[type[BaseModel]]:
    """Yield the models among alternatives."""
    for annotation in annotations:
        if isinstance(annotation, type) and issubclass(annotation, BaseModel):
            yield annotation
        elif _is_choice(annotation):
            yield from _models(get_args(annotation))


def _entries(annotation: Any) -> Iterator[Any]:
    """Yield what entries of lists, tuples and mappings among alternatives may be."""
    if _is_choice(annotation):
        for inner in get_args(annotation):
            yield from _entries(inner)
    elif get_origin(annotation) in (list, tuple, dict):
        yield get_args(annotation)[-1]


def _is_choice(annotation: Any) -> bool:
    return get_origin(annotation) in (Annotated, Union, UnionType)
