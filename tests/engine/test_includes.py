"""A file of the engine includes what its other includes don't bring."""

import re
from functools import cache
from pathlib import Path

ENGINE = Path(__file__).parents[2] / "engine"

FILES = sorted(path.relative_to(ENGINE).as_posix() for path in (*ENGINE.rglob("*.h"),
                                                                *ENGINE.rglob("*.cpp"))
               if path.relative_to(ENGINE).parts[0] not in ("include", "tests"))


@cache
def included(name: str) -> tuple[str, ...]:
    """Return what a file includes by itself, if it is the engine's."""
    path = ENGINE / name
    return tuple(re.findall(r'^#include ["<]([^">]+)[">]', path.read_text(), re.MULTILINE)
                 ) if path.exists() else ()


@cache
def brought(name: str) -> frozenset[str]:
    """Return all that including a file brings."""
    own = included(name)
    return frozenset(own).union(*map(brought, own))


def test_nothing_is_included_twice() -> None:
    assert [(name, each) for name in FILES for each in included(name)
            if any(each in brought(other) for other in included(name))] == []


def test_what_an_include_brings_is_known() -> None:
    assert "rules/window.h" in brought("rules/segment.h")
    assert "rules/segment.h" not in brought("rules/window.h")
