"""`tandem settings`: all settings as a table for people."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

import typer
from pydantic.fields import FieldInfo
from pydantic_core import to_json

from app.serving.settings import Settings

ROOT = Path(__file__).resolve().parents[2]

HEADING = """# Settings

Environment variables, read when the service starts. Each is optional. Lists are JSON. This page is
made by `tandem settings`.

| variable | default | allowed | meaning |
| --- | --- | --- | --- |
"""


def list_settings() -> None:
    """List all settings, the environment variables that they are read from, as Markdown."""
    typer.echo(settings_page(), nl=False)


def settings_page() -> str:
    """Return the page in Markdown."""
    prefix = Settings.model_config.get("env_prefix", "")
    rows = ("| " + " | ".join((f"`{prefix}{name.upper()}`", *_cells(field))) + " |\n"
            for name, field in Settings.model_fields.items())
    return HEADING + "".join(rows)


def _cells(field: FieldInfo) -> Iterator[str]:
    yield _default(field)
    yield ", ".join([*_choices(field.annotation), *_limits(field)])
    yield " ".join((field.description or "").split()).replace("|", "\\|")


def _default(field: FieldInfo) -> str:
    if field.default_factory is not None:
        return "computed"
    value = field.default
    if value is None or value == "":
        return "none"
    if isinstance(value, Path):
        # Where the package lies differs from machine to machine.
        value = value.relative_to(ROOT) if value.is_relative_to(ROOT) else value
    text = str(value) if isinstance(value, str | Path) else to_json(value).decode()
    return f"`{text}`"


def _choices(annotation: Any) -> Iterator[str]:
    for part in (annotation, *get_args(annotation)):
        if get_origin(part) is Literal:
            yield ", ".join(f"`{choice}`" for choice in get_args(part))


def _limits(field: FieldInfo) -> Iterator[str]:
    for name, words in (("ge", "at least"), ("gt", "above"), ("le", "at most"), ("lt", "below")):
        for limit in field.metadata:
            if hasattr(limit, name):
                yield f"{words} {getattr(limit, name):g}"
