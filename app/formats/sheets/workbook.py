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
from pathlib import Path
from typing import Any
from zipfile import BadZipFile, ZipFile

from lxml.etree import LxmlError
from python_calamine import (
    CalamineError, CalamineSheet, CalamineWorkbook, SheetTypeEnum, SheetVisibleEnum,
)

# Run as a file of its own, without the package around it.
sys.path.append(str(Path(__file__).parent))
from hidden import Hidden, hidden_in, places_in  # type: ignore[import-not-found]
from markup import sheets_of  # type: ignore[import-not-found]

MEMORY_BYTES = 2**30
CPU_SECONDS = 20

MAX_CELLS = 2_000_000

EXIT_UNREADABLE = 2

BOOKS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")
"""How files of Excel from 2007 on and of LibreOffice begin, and those of older Excel."""


def main() -> None:
    """Answer with a list of sheets and what isn't shown of each, or a word on what is wrong."""
    # macOS may refuse to bound memory; time is bounded there all the same.
    with suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS))
    try:
        content = sys.stdin.buffer.read()
        if content.startswith(BOOKS) and not _is_kmz(content):
            unseen = hidden_in(content, MAX_CELLS)
            sheets = _sheets(CalamineWorkbook.from_filelike(BytesIO(content)), unseen)
        else:
            sheets = sheets_of(content, MAX_CELLS)
    except (CalamineError, LxmlError, OSError, ValueError, RecursionError) as error:
        sys.stdout.write(str(error))
        sys.exit(EXIT_UNREADABLE)
    json.dump(sheets, sys.stdout, ensure_ascii=True)


def _is_kmz(content: bytes) -> bool:
    with suppress(BadZipFile), ZipFile(BytesIO(content)) as archive:
        return any(name.lower().endswith(".kml") for name in archive.namelist()[:1000])
    return False


def _sheets(book: CalamineWorkbook, unseen: dict[str, Any]) -> list[dict[str, Any]]:
    """Return all sheets with cells, those first that a reader of the workbook sees."""
    entries = [entry for entry in book.sheets_metadata if entry.typ == SheetTypeEnum.WorkSheet]
    entries.sort(key=lambda entry: entry.visible != SheetVisibleEnum.Visible)
    sheets, cells = [], 0
    for entry in entries:
        sheet = book.get_sheet_by_name(entry.name)
        is_hidden = entry.visible != SheetVisibleEnum.Visible
        # From the first cell of all to the last that is filled, as they are read.
        cells += 0 if sheet.end is None else (sheet.end[0] + 1) * (sheet.end[1] + 1)
        if cells > MAX_CELLS:
            raise ValueError(f"it has more than {MAX_CELLS} cells")
        hidden = unseen.get(entry.name, Hidden())
        rows = _rows(sheet)
        width = max(map(len, rows), default=0)
        sheets.append({"name": entry.name, "rows": rows, "is_hidden": is_hidden,
                       "merged": sheet.merged_cell_ranges or [], "has_filter": hidden.has_filter,
                       "hidden_rows": places_in(hidden.rows, len(rows)),
                       "hidden_columns": places_in(hidden.columns, width)})
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
