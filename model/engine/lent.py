"""Rows in memory that the engine owns, as arrays."""

from typing import Any

import numpy as np

from model.engine.handle import Handle
from model.engine.header import dtype_of_type, interface
from model.engine.library import call, function
from model.engine.records import Record


class _Lender:
    """Where rows are, and what owns them, which any array of them keeps alive."""

    def __init__(self, owner: Handle, data: Any, shape: tuple[int, ...]) -> None:
        self.owner = owner
        self.__array_interface__ = {
            "version": 3, "data": (int(interface().cast("uintptr_t", data)), False),
            "shape": shape, "typestr": f"|V{interface().sizeof(interface().typeof(data).item)}"}


def lent_fields(name: str, owner: Handle) -> dict[str, Any]:
    """Return what a function of the engine shows of an owner, by the names of its struct's fields.

    Views are lent as arrays, and what pointers show as rows.
    """
    seen = interface().new(interface().typeof(function(name)).args[1])
    call(name, owner, seen)
    return {field: (lent_row if kind.type.kind == "pointer" else lent_rows)(
        getattr(seen, field), owner) for field, kind in interface().typeof(seen).item.fields}


def lent_rows(view: Any, owner: Handle) -> Any:
    """Return the array of what a view shows, of rows that an owner has."""
    return _array(owner, view.data, tuple(view.shape))


def lent_row(pointer: Any, owner: Handle) -> Record:
    """Return the row that a pointer shows, of an owner."""
    return _array(owner, pointer, (1,))[0]


def _array(owner: Handle, data: Any, shape: tuple[int, ...]) -> Any:
    kind = dtype_of_type(interface().typeof(data).item)
    return np.asarray(_Lender(owner, data, shape)).view(kind)
