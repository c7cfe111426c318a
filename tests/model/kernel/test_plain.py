"""Rows whose type says that no rarer rule is stated."""

import numpy as np
import pytest

from model.kernel.compiled import compiled
from model.kernel.instance import NODE, TYPE
from model.kernel.plain import as_plain, is_plain
from model.kernel.records import Record
from model.search.route.layout import ROUTE


@compiled
def told(row: Record) -> bool:
    """Tell, in compiled code, whether a row is plain."""
    return is_plain(row)


@pytest.mark.parametrize("kind", [NODE, TYPE, ROUTE])
def test_rows_tell_by_their_type_and_are_the_same_in_memory(kind: np.dtype[np.record]) -> None:
    rows = np.zeros(2, kind)
    plain = as_plain(rows)
    assert (told(rows[1]), told(plain[1])) == (False, True)
    assert (is_plain(rows[1]), is_plain(plain[1])) == (False, True)
    name = (kind.names or ())[1]
    rows[name] = [7, 8]
    assert plain[name].tolist() == [7, 8]
    assert plain.tobytes() == rows.tobytes()


def test_a_node_fits_a_line_of_the_processors_cache() -> None:
    assert NODE.itemsize == 64
