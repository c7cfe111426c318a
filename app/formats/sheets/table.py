"""Bytes -> sheets of rows of cells, whatever program wrote them."""

import json
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from app.formats.sheets import workbook
from app.formats.sheets.cells import Raw, raw_of
from app.formats.sheets.text import NoTextError, read_text
from app.schemas.errors import RequestError

MAX_ROWS = 100_000
MAX_COLUMNS = 1000

WORKBOOK_SECONDS = 40

OTHERS = {b"%PDF": "a PDF"}
MARKED = {b"{": "JSON", b"[": "JSON", b"<": "a page of HTML or XML"}
"""How files begin that may hold rows all the same: points of GeoJSON and KML, tables of HTML."""

_LIST = re.compile(rb"\[\s*+(?:[\[{\"]|$)")
"""How a list of JSON begins; a heading such as `[id]` doesn't."""


class NotASheetError(RequestError, status=422, name="not-a-sheet"):
    """Bytes that hold no rows of cells."""

    title = "The file can't be read as a spreadsheet"


@dataclass(frozen=True)
class Sheet:
    """Rows of cells; `merged` are first and last (row, column) of cells shown as one."""

    name: str
    rows: list[list[Raw]]
    merged: tuple[tuple[tuple[int, int], tuple[int, int]], ...] = ()
    is_hidden: bool = False
    hidden_rows: frozenset[int] = frozenset()
    hidden_columns: frozenset[int] = frozenset()
    has_filter: bool = False


@dataclass(frozen=True)
class SheetFile:
    """The sheets of a file and how it was read."""

    sheets: tuple[Sheet, ...]
    encoding: str | None = None  # None: a workbook
    delimiter: str | None = None
    is_guessed: bool = False  # its encoding


def read_sheets(content: bytes, encoding: str | None = None) -> SheetFile:
    """Return the sheets of a file: CSV or other text with delimiters, xlsx, xlsm, xlsb, xls or ods.

    Raises
    ------
    NotASheetError
        If it is none of these, or too large.
    """
    if not content.strip():
        raise NotASheetError("The file is empty.")
    if content.startswith(workbook.BOOKS):
        return SheetFile(tuple(_read_workbook(content)))
    head = content[:1000].lstrip(b"\xef\xbb\xbf \r\n\t")
    for start, name in (OTHERS | MARKED).items():
        if head.startswith(start) and (start != b"[" or _LIST.match(head)):
            wrong = f"The file is {name}: save it as CSV or as a workbook (.xlsx)."
            if start in MARKED:
                return SheetFile(tuple(_read_workbook(content, wrong)))
            raise NotASheetError(wrong)
    try:
        file = read_text(content, encoding, MAX_ROWS)
    except NoTextError as error:
        raise NotASheetError(f"The file can't be read: {error}. Save it as CSV in UTF-8, or as a "
                             "workbook (.xlsx).") from error
    sheet = _bounded(Sheet("", file.rows))
    return SheetFile((sheet,), file.encoding, file.delimiter, file.is_guessed)


def _read_workbook(content: bytes, wrong: str | None = None) -> list[Sheet]:
    """Return the sheets of a workbook, or of a text with marks; `wrong`: what to say of others."""
    try:
        done = subprocess.run([sys.executable, "-I", Path(workbook.__file__)], input=content,
                              capture_output=True, timeout=WORKBOOK_SECONDS, check=False)
    except subprocess.TimeoutExpired as error:
        raise NotASheetError("The workbook takes too long to read: save the sheet with the "
                             "customers alone.") from error
    if done.returncode == workbook.EXIT_UNREADABLE:
        reason = done.stdout.decode(errors="replace")[:200]
        if wrong is not None:
            raise NotASheetError(wrong)
        raise NotASheetError(f"The workbook can't be read ({reason}): open it, take off any "
                             "password, and save it as .xlsx or CSV.")
    if done.returncode:
        raise NotASheetError("The workbook is damaged, or unpacks to more than can be held: save "
                             "the sheet with the customers alone.")
    return [_bounded(Sheet(sheet["name"], [list(map(raw_of, row)) for row in sheet["rows"]],
                           tuple((tuple(first), tuple(last)) for first, last in sheet["merged"]),
                           sheet["is_hidden"], frozenset(sheet["hidden_rows"]),
                           frozenset(sheet["hidden_columns"]), sheet["has_filter"]))
            for sheet in json.loads(done.stdout)]


def _bounded(sheet: Sheet) -> Sheet:
    if len(sheet.rows) > MAX_ROWS:
        raise NotASheetError(f"The sheet {sheet.name} has more than {MAX_ROWS} rows.")
    if any(len(row) > MAX_COLUMNS for row in sheet.rows):
        raise NotASheetError(f"The sheet {sheet.name} has more than {MAX_COLUMNS} columns: it may "
                             "have been cut at the wrong character.")
    return sheet
