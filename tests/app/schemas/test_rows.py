"""Rows of matrices are held as arrays, and nobody who sends or gets them sees that."""

import json

import numpy as np
import pytest
from pydantic import ValidationError

from app.formats.vroom.schemas import VroomMatricesInput
from app.schemas.request import MatrixInput


def matrix(durations: str) -> MatrixInput:
    return MatrixInput.model_validate_json('{"durations": ' + durations + "}")


@pytest.mark.parametrize(("row", "kind"), [
    ("[0, 1.0, 2e3, -0.0]", np.int32),
    ("[1000000000, -2147483648]", np.int32),
    ("[-2147483649]", np.float64),
    ("[0, -1e300]", np.float64),
    ("[0, 0.1]", np.float64),
    ("[]", np.float64),
])
def test_rows_are_whole_numbers_of_32_bits_where_they_fit(row: str, kind: type) -> None:
    (held,) = matrix(f"[{row}]").durations
    assert held.dtype == kind
    assert held.tolist() == json.loads(row)


def test_rows_are_written_as_they_were_read() -> None:
    stated = [[0, 1.5, 1e9], [2, 3], [], [-0.1]]
    held = matrix(json.dumps(stated))
    assert held.model_dump()["durations"] == stated
    assert json.loads(held.model_dump_json())["durations"] == stated
    assert matrix(json.dumps(held.model_dump(mode="json")["durations"])).model_dump() == (
        held.model_dump())


def test_a_leg_that_is_none_is_written_as_it_was_read() -> None:
    held = matrix("[[0, null], [2.5, 0]]")
    assert np.isnan(held.durations[0][1])
    assert json.loads(held.model_dump_json())["durations"] == [[0, None], [2.5, 0]]


@pytest.mark.parametrize("entry", ["true", '"1"', "[1]", "1e400", "1000000001"])
def test_an_entry_that_is_none_is_told_by_its_place(entry: str) -> None:
    with pytest.raises(ValidationError) as refused:
        matrix(f"[[0, 1], [0, {entry}, {entry}]]")
    assert [error["loc"] for error in refused.value.errors()] == [("durations", 1, 1)]


def test_the_largest_numbers_of_vroom_are_held() -> None:
    held = VroomMatricesInput.model_validate_json('{"durations": [[0, 4294967295], [7, 0]]}')
    assert held.durations is not None
    assert [row.tolist() for row in held.durations] == [[0, 2**32 - 1], [7, 0]]


def test_the_schema_is_that_of_lists() -> None:
    for mode in ("validation", "serialization"):
        rows = MatrixInput.model_json_schema(mode=mode)["properties"]["durations"]["items"]
        assert rows["type"] == "array"
        assert rows["items"] == {
            "anyOf": [{"type": "number", "maximum": 1_000_000_000}, {"type": "null"}]}
