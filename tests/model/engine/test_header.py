"""Rows are laid out in NumPy as C has them."""

import sys
from pathlib import Path

import numpy as np
import pytest

from model.engine import header
from model.engine.header import dtype_of, interface, is_laid_out_as, is_row

SETUP = np.dtype([("site", np.int64), ("setup_duration", np.int64)])


def test_rows_are_read_as_they_are_declared() -> None:
    assert is_laid_out_as(SETUP, dtype_of("tandem_setup"))
    assert dtype_of("tandem_setup").type is np.record
    node = dtype_of("tandem_node")
    assert node.itemsize == 64  # a line of the processor's cache
    assert node["demand"].shape == (3,)
    assert dtype_of("tandem_price")["lateness"] == np.float64
    assert dtype_of("int64_t") == np.int64


def test_all_rows_can_be_read() -> None:
    ffi = interface()
    names = [name for name in ffi.list_types()[0] if is_row(ffi.typeof(name))]
    assert {"tandem_node", "tandem_vehicle_type", "tandem_rate"} <= set(names)
    for name in names:
        assert dtype_of(name).itemsize == ffi.sizeof(name)


def test_rows_with_other_fields_are_told_apart() -> None:
    other = np.dtype([("site", np.int64), ("duration", np.int64)])
    assert not is_laid_out_as(other, dtype_of("tandem_setup"))
    assert not is_laid_out_as(SETUP, dtype_of("tandem_outlook"))


def test_what_points_to_others_is_no_row() -> None:
    with pytest.raises(TypeError, match="tandem_cells is no row of numbers"):
        dtype_of("tandem_cells")


def test_what_was_read_is_kept_until_the_header_changes(tmp_path: Path,
                                                        monkeypatch: pytest.MonkeyPatch) -> None:
    changed = tmp_path / "tandem.h"
    changed.write_text(header.header().read_text())
    monkeypatch.setattr(sys, "pycache_prefix", str(tmp_path))
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    monkeypatch.setattr(header, "header", lambda: changed)
    read, compiled = interface.__wrapped__, header._compiled
    assert read().list_types() == interface().list_types()
    monkeypatch.setattr(header, "_compiled", lambda: pytest.fail("it is read again"))
    assert read().list_types() == interface().list_types()
    with changed.open("a") as more:
        more.write("typedef struct tandem_new { int one; } tandem_new;\n")
    monkeypatch.setattr(header, "_compiled", compiled)
    assert "tandem_new" in read().list_types()[0]
    assert read().sizeof("tandem_new") == 4
