"""Workbooks are read in a process of its own, no more of them than it can hold."""

import pytest
import xlsxwriter

from app.formats.sheets.table import NotASheetError, read_sheets
from app.formats.sheets.workbook import MAX_CELLS
from tests.app.formats.sheets.makes import workbook


def test_cells_are_counted_from_the_first_to_the_last_that_is_filled() -> None:
    height, width = 2000, 1001

    def fill(book: xlsxwriter.Workbook) -> None:
        book.add_worksheet("empty")
        book.add_worksheet("wide").write(height - 1, width - 1, "last")

    assert (height - 1) * (width - 1) < MAX_CELLS < height * width
    with pytest.raises(NotASheetError, match=f"more than {MAX_CELLS} cells"):
        read_sheets(workbook(fill))
