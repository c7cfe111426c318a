"""Structs of arrays and numbers, which `tandem.h` describes field by field."""

from typing import TYPE_CHECKING, Any, ClassVar, Self

from model.engine.header import interface
from model.engine.packing import struct_name


class Struct:
    """What the struct of `tandem.h` that belongs to a class holds, by the names of its fields."""

    _fields: ClassVar[tuple[str, ...]]

    def __init_subclass__(cls) -> None:
        """Note the names."""
        kind = interface().typeof(struct_name(cls))
        cls._fields = tuple([name for name, _ in kind.fields])

    def __init__(self, **fields: Any) -> None:
        self.__dict__.update(fields)

    if TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any:
            """Return what is held."""

    def _replace(self, **changes: Any) -> Self:
        """Return the same with other values of some fields."""
        return type(self)(**{**vars(self), **changes})
