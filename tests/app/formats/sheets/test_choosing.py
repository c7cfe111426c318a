"""Rows of several sheets are put together by their headings."""

from typing import Any

from app.formats.sheets.choosing import with_rows_of
from app.formats.sheets.layout import Table
from app.formats.sheets.table import Sheet


def table(name: str, headings: tuple[str, ...], row: list[Any]) -> Table:
    """Return a table of one row below its headings."""
    return Table(Sheet(name, [list(headings), row]), (0,), headings, (1,), 0)


def test_columns_of_one_heading_stand_below_each_other_in_their_order() -> None:
    both = with_rows_of(table("a", ("Name", "Phone", "", "phone"), ["A", "1", "x", "2"]),
                        table("b", ("PHONE", "", "Phone", "Phone", "Name"),
                              ["3", "y", "4", "5", "B"]))
    assert both.headings == ("Name", "Phone", "", "phone", "", "Phone")
    assert both.sheet.rows[both.rows[-1]] == ["B", "3", None, "4", "y", "5"]
