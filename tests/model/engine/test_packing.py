"""What Python has becomes what the engine takes, or an error that names the field."""

from typing import Any, NamedTuple

import numpy as np
import pytest

from model.engine.header import declared, dtype_of, interface
from model.engine.leg import ComputedLegs
from model.engine.nearest import cells_of
from model.engine.packing import Packed, packed, struct_name
from model.travel.ways import Sights

CELLS = cells_of(np.random.default_rng(0).random((100, 2)))


class ProblemData(NamedTuple):
    """None of the search's."""

    num_depots: int


def address(array: Any) -> int:
    """Return where an array begins."""
    return int(array.__array_interface__["data"][0])


def test_arrays_are_where_they_were() -> None:
    cells = packed(CELLS).pointer
    for name, array in CELLS._asdict().items():
        view = getattr(cells, name)
        assert int(interface().cast("uintptr_t", view.data)) == address(array)
        assert list(view.shape) == list(array.shape)


def test_a_class_is_named_as_its_struct() -> None:
    class StepWeights(NamedTuple):
        """Any."""

    assert struct_name(StepWeights) == "tandem_step_weights"


def test_what_is_packed_keeps_its_arrays() -> None:
    sights = packed(Sights(np.arange(3), np.arange(2), np.full(2, 0.25), np.full(2, 0.5)))
    np.full(2, 7.0)
    assert [sights.pointer.duration.data[entry] for entry in range(2)] == [0.5, 0.5]


@pytest.mark.parametrize(("field", "array", "found"), [
    ("low", CELLS.low.astype(np.float32), "float32"),
    ("low", CELLS.low[0], r"shape \(2,\)"),
    ("half", CELLS.half[:, ::-1], "not row by row"),
    ("first", CELLS.first.tolist(), r"\[0,"),
    ("number", None, "None"),
])
def test_other_arrays_are_refused(field: str, array: Any, found: str) -> None:
    with pytest.raises(TypeError, match=rf"tandem_cells\.{field}: an array .*{found}"):
        packed(CELLS._replace(**{field: array}))


def test_other_fields_are_refused() -> None:
    with pytest.raises(TypeError, match="not a ProblemData of num_depots"):
        packed(ProblemData(1), "tandem_cells")
    with pytest.raises(TypeError, match="not a ndarray"):
        packed(CELLS.low, "tandem_cells")


def legs_of(value: Any) -> Any:
    """Return legs as C has them."""
    return packed(value, "tandem_legs").pointer


def test_legs_that_are_stated_come_alone() -> None:
    stated = np.zeros((1, 3, 3, 2), np.int32)
    legs = legs_of(stated)
    assert int(interface().cast("uintptr_t", legs.stated.data)) == address(stated)
    assert list(legs.stated.shape) == [1, 3, 3, 2]
    assert not legs.table.data
    assert list(legs.law.shape) == [0]


def test_legs_that_are_computed_come_without_stated_ones() -> None:
    legs = legs_of(ComputedLegs(np.zeros((1, 1, 3, 0, 2), np.int64),
                                np.zeros(3, dtype_of("tandem_point")),
                                np.zeros(2, dtype_of("tandem_leg_law"))))
    assert not legs.stated.data
    assert list(legs.stated.shape) == [0] * 4
    assert list(legs.point.shape) == [3]
    assert list(legs.law.shape) == [2]


def test_computed_legs_of_other_rows_are_refused() -> None:
    with pytest.raises(TypeError, match=r"tandem_legs\.law: an array of rows \(table,"):
        legs_of(ComputedLegs(np.zeros((1, 1, 3, 0, 2), np.int64),
                             np.zeros(3, dtype_of("tandem_point")),
                             np.zeros(2, dtype_of("tandem_point"))))


@pytest.fixture(scope="module")
def made_up() -> Any:
    """Return pointers to a struct with gaps, numbers and an array."""
    ffi = declared()
    ffi.cdef("typedef struct made_up { bool flag; int64_t count; bool other; double share;"
             " bool last; tandem_i64_1d numbers; bool end; } made_up;")
    return ffi.typeof("made_up *")


class MadeUp(NamedTuple):
    """What is packed as that; in another order."""

    count: Any
    flag: Any
    other: Any
    share: Any
    last: Any
    end: Any
    numbers: Any


def test_fields_are_packed_by_name_and_as_the_compiler_lays_them_out(made_up: Any) -> None:
    value = Packed(MadeUp(count=np.int64(-7), flag=True, other=False, share=np.float32(0.5),
                          last=np.True_, end=True, numbers=np.arange(5)), made_up)
    struct = value.pointer
    assert (struct.flag, struct.count, struct.other, struct.share, struct.last, struct.end) == (
        True, -7, False, 0.5, True, True)
    assert [struct.numbers.data[index] for index in range(5)] == list(range(5))


@pytest.mark.parametrize(("field", "other"), [
    ("count", 1.5), ("count", None), ("share", "much"),
])
def test_other_numbers_are_refused(made_up: Any, field: str, other: Any) -> None:
    value = MadeUp(1, True, True, 0.0, True, True, np.arange(1))._replace(**{field: other})
    with pytest.raises(TypeError, match=rf"made_up\.{field}: "):
        Packed(value, made_up)
