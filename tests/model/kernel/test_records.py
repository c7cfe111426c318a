"""Rows with named fields."""

import numpy as np

from model.kernel.compiled import compiled
from model.kernel.records import Record, Records, one, read_rows, record, row_of_floats

PARCEL = record("node", "count", load=3, cost=float)


@compiled
def exchange(parcels: Records, single: Record) -> int:
    """Swap two rows by a third, and name fields of each. In place."""
    single.node = parcels[0].node
    parcels[0] = parcels[1]
    parcels[1].load[2] += 7
    parcels[1].cost = 0.5
    total: int = parcels[0].node + single.node
    return total


def test_compiled_code_and_python_read_the_same_fields() -> None:
    parcels, single = np.zeros(2, PARCEL), one(PARCEL)
    parcels["node"] = (3, 4)
    assert exchange(parcels, single) == 7
    assert (single.node, parcels[0].node, parcels[1].node) == (3, 4, 4)
    assert parcels[1].load.tolist() == [0, 0, 7]
    assert parcels["cost"].tolist() == [0.0, 0.5]


def test_rows_are_read_as_numbers_of_python() -> None:
    parcels = np.zeros(2, PARCEL)
    parcels[1].count = 5
    row = read_rows(parcels)[1]
    assert (row.node, row.count, row.cost) == (0, 5, 0.0)
    assert type(row.count) is int


@compiled
def describe(row: Record) -> None:
    """Write by name. In place."""
    row.kind[1] = row.slack = 0.5


def test_floats_by_name_and_by_number_are_the_same() -> None:
    named = row_of_floats(("kind", 2), "slack")
    table = np.zeros((2, 3), np.float32)
    describe(table.view(named)[1, 0])
    assert table.tolist() == [[0, 0, 0], [0, 0.5, 0.5]]
