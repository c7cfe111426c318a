"""A way into what only compiled functions call."""

from collections.abc import Callable
from typing import Any, TypeVar, cast

from numba import njit

Function = TypeVar("Function", bound=Callable[..., Any])


def entry(function: Function) -> Function:
    """Compile a test's function, which calls parts that have no entry from Python."""
    return cast(Function, njit(function))
