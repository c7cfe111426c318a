"""Memory that the engine owns, lent to Python by a pointer of its own type."""

from types import TracebackType
from typing import Any, Self

from model.engine.header import interface
from model.engine.library import call


class Handle:
    """What the engine has made for later calls, which take it in the place of a pointer.

    It is there within `with`; `name` says which: `tandem_open_scratch` makes a "scratch", and
    `tandem_close_scratch` gives it back.
    """

    def __init__(self, name: str, *given: Any) -> None:
        """Remember what `tandem_open_...` is given."""
        self._name = name
        self._given = given
        self._pointer: Any = None

    @property
    def pointer(self) -> Any:
        """Return the typed pointer.

        Raises
        ------
        ValueError
            Outside of `with`.
        """
        if self._pointer is None:
            raise ValueError(f"{self._name}: it is not open")
        return self._pointer

    def __enter__(self) -> Self:
        room = interface().new(f"tandem_{self._name} **")
        call(f"tandem_open_{self._name}", *self._given, room)
        self._pointer = room[0]
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        pointer, self._pointer = self.pointer, None
        call(f"tandem_close_{self._name}", pointer)
