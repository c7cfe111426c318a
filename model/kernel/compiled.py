"""Compilation to machine code, kept on disk under a name that changes with the source.

Numba keeps compiled functions beside a hash of the one file that defines them, and so misses a
change in a function or constant that was imported from another file and compiled in. Here one
fingerprint over all files that take part names the folder, so no stale code is ever run; and what
is there is found wherever the source lies.
"""

import fcntl
import hashlib
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import cache
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any, TypeVar, cast

from numba import config, njit, types
from numba.core import codegen, event
from numba.core.caching import UserProvidedCacheLocator
from numba.core.compiler import Compiler
from numba.extending import overload

SOURCES = (
    *(f"problem/{part}" for part in (
        "customer", "distances", "energy", "fleet", "overtime", "problem", "quantities")),
    *(f"kernel/{part}" for part in (
        "compiled", "records", "plain", "alarm", "copying", "instance", "start", "shift", "stop",
        "energy", "flight", "load", "clock", "leg", "drone_types", "cells",
        "sparse")),
    *(f"travel/{part}" for part in ("visibility", "detours")),
    *(f"simulation/{part}" for part in (
        "vehicle_log", "cost", "meeting", "aboard", "transition", "trial", "simulator")),
    *(f"policy/{part}" for part in (
        "tokens", "observation", "lookahead", "features", "resampling", "rollouts")),
    *(f"search/route/{part}" for part in (
        "layout", "rarer", "craft", "ends", "randomness", "goods", "batteries", "block", "routes",
        "freshness", "vehicles", "halts", "lean", "refresh", "edit", "state")),
    *(f"search/insertion/{part}" for part in (
        "evaluate", "cheapest_stop", "passing", "new_trips", "offers", "places")),
    *(f"search/moves/{part}" for part in (
        "ruin", "recreate", "exchange", "retype", "split", "resplit", "anneal")),
    *(f"search/beginning/{part}" for part in ("construct", "savings", "either_way", "translate")),
    *(f"search/linked/{part}" for part in (
        "layout", "retype", "chain", "strings", "insertion", "tails", "anneal", "tying")),
    "search/ground/tables", "search/sharing",
)
"""Files with compiled functions, and those whose constants are compiled into them."""

SOURCE = Path(__file__).parents[1]
"""Folder of `SOURCES`."""

_PATHS = frozenset(SOURCE / f"{name}.py" for name in SOURCES)

LITTLE = type(config.OPT)(1)  # type: ignore[attr-defined]
"""Level of optimisation for what is optimised again."""


class ScalarCompiler(Compiler):
    """Leaves loops over numbers as they are: to look for those that processors run at once takes a
    fifth of the time, and the search has none.
    """

    optimisation: Any = config.OPT  # type: ignore[attr-defined]

    def compile_extra(self, func: Callable[..., Any]) -> Any:
        """Compile a Python function. Numba lets one thread at a time do so."""
        before = config.OPT, config.LOOP_VECTORIZE  # type: ignore[attr-defined]
        config.OPT, config.LOOP_VECTORIZE = self.optimisation, 0  # type: ignore[attr-defined]
        try:
            return super().compile_extra(func)  # type: ignore[no-untyped-call]
        finally:
            config.OPT, config.LOOP_VECTORIZE = before  # type: ignore[attr-defined]


class PartCompiler(ScalarCompiler):
    """Optimises a part but a little, since that is done again in each function it is put into."""

    optimisation = LITTLE


PART: dict[str, Any] = {
    "nogil": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True, "_nrt": False,
    "pipeline_class": PartCompiler}
"""Options of functions that exist only within others."""

PASTED: dict[str, Any] = {"nogil": True, "_nrt": False, "inline": "always"}
"""Options of functions whose source becomes a part of others'."""

Function = TypeVar("Function", bound=Callable[..., Any])

_TO_COMPILE: set[str] = set()
"""Names of all functions that are compiled for themselves."""


class LocatorByContent(UserProvidedCacheLocator):
    """Finds the machine code of `SOURCES`, whose folder is named by what it was made of."""

    @classmethod
    def from_function(cls, py_func: Callable[..., Any], py_file: str) -> Any:
        """Return a locator; None for functions of other files, of which it says nothing."""
        if Path(py_file) not in _PATHS:
            return None
        return super().from_function(py_func, py_file)  # type: ignore[no-untyped-call]

    @classmethod
    def get_suitable_cache_subpath(cls, py_file: str) -> str:
        """Return the source file's folder, below the one of all."""
        return str(Path(py_file).parent.relative_to(SOURCE))

    def get_source_stamp(self) -> object:
        """Return nothing: the folder's name tells of every change."""
        return None


MACHINE_CODE = "object"
"""What Numba calls it where it keeps compiled functions."""


class LinkedIfNeeded(codegen.JITCodeLibrary):
    """Machine code of a function, and what it is linked from into others: read if it ever is.

    Numba reads both at once. Where all is compiled nobody needs the second, which takes half of
    the time to load the search and a third of the memory.
    """

    linkable: bytes | None = None

    @classmethod
    def _unserialize(cls, loading: Any, state: Any) -> Any:
        name, kind, data = state
        if kind != MACHINE_CODE:
            return super()._unserialize(loading, state)  # type: ignore[no-untyped-call]
        library = loading.create_library(name)
        code, library.linkable = data
        library.enable_object_caching()
        library._set_compiled_object(code)
        library._finalize_final_module()
        return library

    def get_pointer_to_function(self, name: str) -> int:
        """Return where the function of a name begins, 0 if there is none."""
        self._ensure_finalized()  # type: ignore[no-untyped-call]
        # Numba looks among names first that it has read of what can be linked.
        return int(self._codegen._engine.get_function_address(name))

    def _get_module_for_linking(self) -> Any:
        if self.linkable is not None:
            self._shared_module = codegen.ll.parse_bitcode(  # type: ignore[attr-defined]
                self.linkable)
            self._codegen._engine._load_defined_symbols(  # type: ignore[no-untyped-call]
                self._shared_module)
            self.linkable = None
        return super()._get_module_for_linking()  # type: ignore[no-untyped-call]


_LOCATORS = f"{__name__}.{LocatorByContent.__name__},{UserProvidedCacheLocator.__name__}"


def compiled(function: Function) -> Function:
    """Compile a function at its first call, or load it if that was done before."""
    return _kept(function)


def compiled_on_arrays(function: Function) -> Function:
    """Compile like `compiled` what is given all its arrays and makes none.

    References to them need not be counted then, in this function and all parts of it.
    """
    return _kept(function, _nrt=False, pipeline_class=ScalarCompiler)


def inlined(function: Function) -> Function:
    """Compile a function that only compiled functions call, as a part of these.

    It has no entry from Python and counts no references, so it may not make arrays.
    """
    return _part(function)


def spliced(function: Function) -> Function:
    """Compile like `inlined`, always into the body of the caller.

    For what is called often, in few places, with arrays by the dozen: a call copies what describes
    each, two hundred words for a `World` and a `Fleet`.
    """
    return _part(function, forceinline=True)


def pasted(function: Function) -> Function:
    """Put a function's source into its caller's, to the same end as `spliced`.

    It takes less time where much is called from there, and more where there are many branches.
    """
    return cast(Function, njit(**PASTED)(function))


def inlined_arithmetic(function: Function) -> Function:
    """Compile like `inlined`, and let sums of floats be taken in any order.

    Only for what need not be the same to the last bit on every processor.
    """
    return _part(function, fastmath={"reassoc", "contract", "nsz", "arcp"})


Result = TypeVar("Result")


def chosen_by_type(kind: type, of_kind: Callable[..., Result], of_others: Callable[..., Result],
                   paste: bool = False) -> Callable[..., Result]:
    """Return what is one function if its first argument is a named tuple of a kind, else another.

    Its type tells which, so that nothing is paid for the choice. It is compiled like `inlined`, or
    like `pasted` if `paste`.
    """
    def either(first: Any, *others: Any) -> Result:
        return (of_kind if isinstance(first, kind) else of_others)(first, *others)

    def chosen(first: Any, *others: Any) -> Callable[..., Result]:
        is_kind = isinstance(first, types.NamedTuple) and first.instance_class is kind
        return of_kind if is_kind else of_others

    if not config.DISABLE_JIT:  # type: ignore[attr-defined]
        overload(either, jit_options=PART, strict=False,  # type: ignore[arg-type]
                 inline="always" if paste else "never")(chosen)
    return either


def _part(function: Function, **options: Any) -> Function:
    _TO_COMPILE.add(_name_of(function))
    return cast(Function, njit(**PART, **options)(function))


def _kept(function: Function, **options: Any) -> Function:
    _TO_COMPILE.add(_name_of(function))
    folder = compiled_folder()
    # Numba looks the folder up while it decorates, and nowhere but in its settings.
    config.CACHE_DIR = str(folder or "")  # type: ignore[attr-defined]
    config.CACHE_LOCATOR_CLASSES = _LOCATORS  # type: ignore[attr-defined]
    codegen.JITCPUCodegen._library_class = LinkedIfNeeded
    dispatcher = njit(cache=folder is not None, nogil=True, **options)(function)
    if folder is not None and not config.DISABLE_JIT:  # type: ignore[attr-defined]
        # Compiled for other types by another process at the same time, it might get the same name.
        index = dispatcher._cache._cache_file
        index.save = _one_at_a_time(folder / "saving.lock", index.save)
    return cast(Function, dispatcher)


def _one_at_a_time(lock: Path, save: Callable[..., None]) -> Callable[..., None]:
    """Return what keeps compiled code while no other process does so."""
    def save_alone(*given: Any) -> None:
        with lock.open("w") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            save(*given)
    return save_alone


@cache
def compiled_folder() -> Path | None:
    """Return where compiled code is kept, or None if no folder can be written to.

    It lies in NUMBA_CACHE_DIR if that is set, else beside the source or in the user's cache.
    """
    chosen = os.environ.get("NUMBA_CACHE_DIR")
    user = os.path.expanduser(os.environ.get("XDG_CACHE_HOME") or "~/.cache")
    parents = [Path(chosen)] if chosen else [SOURCE / "__pycache__", Path(user, "tandem-planner")]
    name = f"compiled-{fingerprint(SOURCE)}"
    return next((parent / name for parent in parents if _can_write(parent / name)), None)


def is_cold(parts: Sequence[str]) -> bool:
    """Tell whether compiled code can be kept, and one of these parts is not yet."""
    folder = compiled_folder()
    return folder is not None and not all((folder / part).exists() for part in parts)


@contextmanager
def first_to_compile(parts: Sequence[str]) -> Iterator[bool]:
    """Let one process at a time compile a part that is not there yet; tell if this one has to.

    The others wait until it is done, or has died, and find it compiled.
    """
    folder = compiled_folder()
    if folder is None or not is_cold(parts):
        yield False
        return
    with ExitStack() as locks:
        # In one order, so that no two wait for each other.
        for part in sorted(parts):
            file = locks.enter_context((folder / f"{part}.lock").open("w"))
            fcntl.flock(file, fcntl.LOCK_EX)
        has_to = is_cold(parts)
        if not has_to:
            locks.close()
        yield has_to
        for part in parts:
            (folder / part).touch()


class Count(event.Listener):
    """Counts the functions compiled by this process and by others that share its folder."""

    def __init__(self) -> None:
        folder = compiled_folder()
        self._file = None if folder is None else folder / "functions.txt"
        self._names: set[str] = set()

    def on_start(self, happened: event.Event) -> None:
        """Do nothing: a function counts when it is done."""

    def on_end(self, happened: event.Event) -> None:
        """Count a function. In place."""
        name = _name_of(happened.data["dispatcher"].py_func)
        self._names.add(name)
        if self._file is not None:
            with self._file.open("a") as file:
                file.write(f"{name}\n")

    def share(self) -> float:
        """Return how many there are of all that are ever compiled, from 0 to 1."""
        names = set(self._names)
        if self._file is not None and self._file.exists():
            names.update(self._file.read_text().split())
        return len(names & _TO_COMPILE) / max(1, len(_TO_COMPILE))


@contextmanager
def counting() -> Iterator[Count]:
    """Count what is compiled meanwhile."""
    with event.install_listener("numba:compile", Count()) as count:
        yield count


def _name_of(function: Callable[..., Any]) -> str:
    return f"{function.__module__}.{function.__qualname__}"


def fingerprint(source: Path) -> str:
    """Return a short hash of the files in `source` that take part in compilation."""
    digest = hashlib.sha256()
    for name in SOURCES:
        digest.update((source / f"{name}.py").read_bytes())
    return digest.hexdigest()[:16]


def _can_write(folder: Path) -> bool:
    """Tell whether files can be written in a folder, which is made if missing."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        TemporaryFile(dir=folder).close()
    except OSError:
        return False
    return True
