"""Which rows and columns of a workbook its reader doesn't see: hidden, or left out by a filter."""

import re
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO
from xml.etree.ElementTree import ParseError, fromstring
from zipfile import BadZipFile, ZipFile

MAX_ROWS = 100_000
MAX_COLUMNS = 1000
"""Up to which rows and columns are kept; a repeated one of LibreOffice may go on far beyond."""

CHUNK = 2**20
TAIL = 4096
"""Bytes kept of a chunk, in which a tag may begin that ends in the next."""

_TAG = re.compile(rb"<(?:\w{1,20}:)?(row|col|c|autoFilter|table|table-row|table-column)"
                  rb"((?:[\s/][^<>]*+)?)>")
_ATTRIBUTE = re.compile(rb"(?<![^\s])(?:\w{1,20}:)?([\w-]{1,40})=\"([^\"]*+)\"")
_NUMBER = re.compile(rb"\d{1,7}")


class TooManyCellsError(ValueError):
    """A sheet that is larger than what is read."""


@dataclass
class Hidden:
    """What isn't shown of a sheet; rows and columns are counted from 0."""

    rows: list[range] = field(default_factory=list)
    columns: list[range] = field(default_factory=list)
    has_filter: bool = False


def places_in(spans: list[range], size: int) -> list[int]:
    """Return the rows or columns of spans that a sheet of this height or width has."""
    return sorted({place for span in spans for place in range(span.start, min(span.stop, size))})


def hidden_in(content: bytes, max_cells: int) -> dict[str, Hidden]:
    """Return what isn't shown, by the names of sheets; none where the format doesn't say.

    Raises
    ------
    TooManyCellsError
        If there are more cells than `max_cells`.
    """
    try:
        with ZipFile(BytesIO(content)) as archive:
            names = archive.namelist()
            if "content.xml" in names:
                return _open_document(_tags(archive, "content.xml"))
            if "xl/workbook.xml" in names:
                return _excel(archive, max_cells)
    except (BadZipFile, KeyError, ParseError, ValueError, zlib.error, NotImplementedError) as error:
        if isinstance(error, TooManyCellsError):
            raise
    return {}


def _excel(archive: ZipFile, max_cells: int) -> dict[str, Hidden]:
    parts = {part.get("Id"): part.get("Target", "")
             for part in fromstring(archive.read("xl/_rels/workbook.xml.rels"))}
    found, cells = {}, 0
    for sheet in fromstring(archive.read("xl/workbook.xml")).iter():
        if not sheet.tag.endswith("}sheet"):
            continue
        part = next((value for name, value in sheet.attrib.items() if name.endswith("}id")), None)
        target = parts.get(part, "").removeprefix("/xl/")
        if f"xl/{target}" not in archive.namelist():
            continue
        hidden, count = _of_sheet(_tags(archive, f"xl/{target}"), max_cells - cells)
        cells += count
        found[sheet.get("name", "")] = hidden
    return found


def _of_sheet(tags: Iterator[tuple[bytes, dict[bytes, bytes]]], most: int) -> tuple[Hidden, int]:
    hidden, cells, row = Hidden(), 0, -1
    for tag, stated in tags:
        if tag == b"c":
            cells += 1
            if cells > most:
                raise TooManyCellsError("it has too many cells")
        elif tag == b"row":
            row = int(stated[b"r"]) - 1 if _is_number(stated.get(b"r")) else row + 1
            if stated.get(b"hidden") in (b"1", b"true"):
                hidden.rows.append(_span(row, 1, MAX_ROWS))
        elif tag == b"col" and stated.get(b"hidden") in (b"1", b"true"):
            first, last = (int(stated[name]) for name in (b"min", b"max"))
            hidden.columns.append(_span(first - 1, last + 1 - first, MAX_COLUMNS))
        elif tag == b"autoFilter":
            hidden.has_filter = True
    return hidden, cells


def _open_document(tags: Iterator[tuple[bytes, dict[bytes, bytes]]]) -> dict[str, Hidden]:
    found: dict[str, Hidden] = {}
    hidden, row, column = Hidden(), 0, 0
    for tag, stated in tags:
        if tag == b"table":
            hidden, row, column = Hidden(), 0, 0
            found[stated.get(b"name", b"").decode(errors="replace")] = hidden
        if tag not in (b"table-row", b"table-column"):
            continue
        name = b"number-rows-repeated" if tag == b"table-row" else b"number-columns-repeated"
        count = int(stated[name]) if _is_number(stated.get(name)) else 1
        is_hidden = stated.get(b"visibility") in (b"collapse", b"filter")
        hidden.has_filter |= stated.get(b"visibility") == b"filter"
        if tag == b"table-row":
            hidden.rows += [_span(row, count, MAX_ROWS)] if is_hidden else ()
            row += count
        else:
            hidden.columns += [_span(column, count, MAX_COLUMNS)] if is_hidden else ()
            column += count
    return found


def _span(first: int, count: int, most: int) -> range:
    return range(max(first, 0), min(first + count, most))


def _tags(archive: ZipFile, name: str) -> Iterator[tuple[bytes, dict[bytes, bytes]]]:
    """Yield the tags that matter, with their attributes."""
    with archive.open(name) as part:
        text = b""
        while chunk := part.read(CHUNK):
            text += chunk
            end = text.rfind(b">") + 1
            for found in _TAG.finditer(text, 0, end):
                yield found[1], ({} if found[1] == b"c" else dict(_ATTRIBUTE.findall(found[2])))
            text = text[max(end, len(text) - TAIL):]


def _is_number(text: bytes | None) -> bool:
    return text is not None and _NUMBER.fullmatch(text) is not None
