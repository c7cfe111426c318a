"""Long files: lines are cut as they are asked for, and bounded; time grows as rows do."""

from collections.abc import Callable
from time import process_time
from typing import Any

import pytest

from app.formats.sheets.choosing import with_rows_of
from app.formats.sheets.clocks import Style
from app.formats.sheets.columns import Column
from app.formats.sheets.dropping import with_kinds, without_hidden, without_sums
from app.formats.sheets.layout import RowOrigin, Table, table_of
from app.formats.sheets.questions import LEAVE_OUT, Questionnaire
from app.formats.sheets.rejoining import rejoined
from app.formats.sheets.rows import Row
from app.formats.sheets.table import MAX_COLUMNS, NotASheetError, Sheet, read_sheets
from app.formats.sheets.text import LONGEST_LINE, PIECE, NoTextError, read_text
from app.formats.sheets.vans import vans_of
from tests.app.formats.sheets.makes import open_document

pytestmark = pytest.mark.slow


def test_a_line_without_end_is_refused() -> None:
    with pytest.raises(NoTextError, match="a line of more than"):
        read_text(b"a,b\n" + b"1," * LONGEST_LINE, None, 100)


@pytest.mark.parametrize("end", [b"\n", b"\r\n", b"\r"])
def test_lines_are_the_same_wherever_they_are_cut(end: bytes) -> None:
    rows = [b"%d;x" % number for number in range(PIECE // 4)]
    found = read_text(end.join(rows), None, len(rows)).rows
    assert [row[0] for row in found] == [str(number) for number in range(len(rows))]


LONG = 20_000
SECONDS = 1.0


def long_table(*origins: RowOrigin) -> Table:
    cells = [["name"], *([f"a{number}"] for number in range(LONG))]
    sheet = Sheet("", cells, hidden_rows=frozenset(range(1, LONG + 1, 2)))  # type: ignore[arg-type]
    return Table(sheet, (0,), ("name",), tuple(range(1, LONG + 1)), 0, origins)


def rows_alike() -> list[Row]:
    return [Row(number, values={"kind": "x"}) for number in range(1, LONG + 1)]


def hidden() -> int:
    return len(without_hidden(long_table(), Questionnaire({})).rows)


def sums() -> int:
    rows = rows_alike()
    return len(without_sums(long_table(), rows, rows[::2], Questionnaire({})))


def kinds() -> int:
    rows = rows_alike()
    for row in rows[::2]:
        row.values["kind"] = "delivery"
    kind = Column(0, "kind", "kind")
    return len(with_kinds(long_table(), rows, [kind], Questionnaire({"order_kind:x": LEAVE_OUT})))


@pytest.mark.parametrize("kept", [hidden, sums, kinds])
def test_rows_are_left_out_in_a_time_that_grows_as_they_do(kept: Callable[[], int]) -> None:
    start = process_time()
    assert kept() == LONG // 2
    assert process_time() - start < SECONDS


def test_rows_of_several_sheets_are_named_in_a_time_that_grows_as_they_do() -> None:
    table = long_table(RowOrigin(LONG // 2, "More", {}))
    start = process_time()
    assert table.rows_named(table.rows).startswith(f"2-{LONG // 2}, More!A1")
    assert process_time() - start < SECONDS


def test_vehicles_are_read_in_a_time_that_grows_as_they_do() -> None:
    cells: list[Any] = [["van", "from", *("capacity kg",) * 8]]
    cells += [[f"v{number}", 8.0, *(5.0,) * 8] for number in range(1000)]
    start = process_time()
    vans, _ = vans_of(Sheet("Vans", cells), Style())
    assert [van.shift for van in vans] == [(8 * 3600, None)] * 1000
    assert process_time() - start < SECONDS


def test_a_wide_table_is_not_put_together() -> None:
    cells: list[Any] = [["lat", "lon"] * 200, *[["48", "1"] * 400 for _ in range(100)]]
    table = table_of(Sheet("", cells))
    start = process_time()
    assert rejoined(table, ",") == (table, [], [])
    assert process_time() - start < SECONDS


@pytest.mark.parametrize(("width", "height"), [(MAX_COLUMNS - 1, 2), (20, 60_000)])
def test_sheets_that_are_too_large_together_are_refused(width: int, height: int) -> None:
    def table(name: str) -> Table:
        heads: list[Any] = [f"{name}{column}" for column in range(width)]
        cells = [heads, *([["1"]] * height)]
        return Table(Sheet(name, cells), (0,), tuple(heads), (1,), 0)

    with pytest.raises(NotASheetError, match="With the rows of b there are more than"):
        with_rows_of(table("a"), table("b"))


def test_rows_and_columns_beyond_a_sheet_are_not_hidden() -> None:
    hidden = 'table:visibility="collapse"/>'
    more = (f'<table:table-column table:number-columns-repeated="5" {hidden}'
            f'<table:table-column table:number-columns-repeated="900" {hidden}'
            + f'<table:table-row table:number-rows-repeated="400000" {hidden}' * 3)
    [sheet] = read_sheets(open_document(more)).sheets
    assert sheet.hidden_rows == frozenset()
    assert sheet.hidden_columns == frozenset(range(6))
