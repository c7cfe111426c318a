"""Memory that the engine owns, lent to Python by a pointer of its own type."""

from typing import Any

from model.engine.header import interface
from model.engine.library import call, function


class Handle:
    """What the engine has made for later calls, which take it in the place of a pointer.

    `name` says which: `tandem_open_search` makes a "search", and `tandem_close_search` gives it
    back once nobody has it any more.
    """

    __slots__ = ("pointer",)

    def __init__(self, name: str, *given: Any) -> None:
        """Make what `tandem_open_...` makes of what is given."""
        room = interface().new(f"tandem_{name} **")
        call(f"tandem_open_{name}", *given, room)
        self.pointer = interface().gc(room[0], function(f"tandem_close_{name}"))
