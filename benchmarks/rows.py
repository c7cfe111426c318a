"""Measurements as frozen dataclasses, one row each, in a CSV that grows as they come."""

import csv
from collections.abc import Iterable, Iterator
from dataclasses import astuple, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Row = TypeVar("Row", bound="DataclassInstance")


def columns(kind: type["DataclassInstance"]) -> list[str]:
    """Return the names of the columns."""
    return [field.name for field in fields(kind)]


def read_rows(path: Path, kind: type[Row]) -> list[Row]:
    """Return the rows of a CSV; none if there is no file.

    Raises
    ------
    ValueError
        If its columns are others, or a line holds no row.
    """
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        header, *lines = csv.reader(file)
    if header != columns(kind):
        raise ValueError(f"{path}: columns {header} are not {columns(kind)}")
    return [_row(texts, kind, f"{path}, line {line}") for line, texts in enumerate(lines, start=2)]


def _row(texts: list[str], kind: type[Row], place: str) -> Row:
    values: list[Any] = []
    try:
        for field, text in zip(fields(kind), texts, strict=True):
            # Of a `Literal`, too, the text is the value.
            type_: Any = field.type if isinstance(field.type, type) else str
            values.append(text == "True" if type_ is bool else type_(text))
    except ValueError as error:
        raise ValueError(f"{place}: {error}") from error
    return kind(*values)


def appended(path: Path, kind: type[Row], rows: Iterable[Row]) -> Iterator[Row]:
    """Write each row to a CSV as soon as it is there, after those that it has, and yield it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    is_new = not path.exists()
    with path.open("a", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if is_new:
            writer.writerow(columns(kind))
        for row in rows:
            writer.writerow(astuple(row))
            file.flush()
            yield row


def append_rows(path: Path, kind: type[Row], rows: Iterable[Row]) -> None:
    """Write each row to a CSV as soon as it is there, after those that it has."""
    for _ in appended(path, kind, rows):
        pass
