"""Reads a workbook from standard input and writes its sheets as JSON to standard output.

Run in a process of its own: a workbook of a few kilobytes may stand for billions of cells, and what
takes too much memory or time ends this process alone.
"""

import datetime
import json
import resource
import sys
from contextlib import suppress
from io import BytesIO
from typing import Any

from python_calamine import (
    CalamineError, CalamineSheet, CalamineWorkbook, SheetTypeEnum, SheetVisibleEnum,
)

MEMORY_BYTES = 2**30
CPU_SECONDS = 20

MAX_CELLS = 2_000_000

EXIT_UNREADABLE = 2


def main() -> None:
    """Answer with a list of `{"name", "rows", "merged"}`, or a word on what is wrong."""
    # macOS may refuse to bound memory; time is bounded there all the same.
    with suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS))
    try:
        book = CalamineWorkbook.from_filelike(BytesIO(sys.stdin.buffer.read()))
        sheets = _sheets(book)
    except (CalamineError, OSError, ValueError) as error:
        sys.stdout.write(str(error))
        sys.exit(EXIT_UNREADABLE)
    json.dump(sheets, sys.stdout, ensure_ascii=True)


def _sheets(book: CalamineWorkbook) -> list[dict[str, Any]]:
    """Return the sheets that a reader of the workbook sees."""
    shown = [entry.name for entry in book.sheets_metadata
             if entry.typ == SheetTypeEnum.WorkSheet and entry.visible == SheetVisibleEnum.Visible]
    sheets, cells = [], 0
    for name in shown:
        sheet = book.get_sheet_by_name(name)
        cells += sheet.total_height * sheet.total_width
        if cells > MAX_CELLS:
            raise ValueError(f"it has more than {MAX_CELLS} cells")
        sheets.append({"name": name, "rows": _rows(sheet),
                       "merged": sheet.merged_cell_ranges or []})
    return sheets


def _rows(sheet: CalamineSheet) -> list[list[Any]]:
    return [[_plain(cell) for cell in row] for row in sheet.to_python(skip_empty_area=False)]


def _plain(cell: Any) -> Any:
    """Return a cell as JSON can hold it: dates and times are lists of a word and a text."""
    match cell:
        case datetime.datetime():
            return ["datetime", cell.isoformat()]
        case datetime.date():
            return ["date", cell.isoformat()]
        case datetime.time():
            return ["time", cell.isoformat()]
        case datetime.timedelta():
            return ["timedelta", cell.total_seconds()]
        case _:
            return cell


if __name__ == "__main__":
    main()
