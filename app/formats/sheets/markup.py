"""HTML, KML, GPX, GeoJSON and Excel's XML of 2003 -> sheets of rows, as JSON holds them."""

import json
import zipfile
from collections.abc import Iterable, Iterator
from datetime import datetime
from io import BytesIO
from math import isfinite
from typing import Any

from lxml import etree, html

OTHER_SHAPES = "Lines and areas"
"""Name of the sheet of what is no point, each at its middle."""

LATITUDE, LONGITUDE = "latitude", "longitude"

MOST_SPANNED = 1000
DEEPEST = 20

Rows = list[list[Any]]
Place = tuple[float, float]


def sheets_of(content: bytes, max_cells: int) -> list[dict[str, Any]]:
    """Return the sheets of a text with marks, as those of a workbook are returned.

    Raises
    ------
    ValueError
        If it holds no rows, or more than `max_cells` cells.
    """
    head = content.lstrip(b"\xef\xbb\xbf \r\n\t")
    if content.startswith(b"PK"):
        head = content = _unzipped(content)
    found = (_of_json(_loaded(content)) if head.startswith((b"{", b"[")) else _of_markup(content))
    cells = 0
    sheets = []
    for name, rows, hidden in found:
        cells += sum(map(len, rows))
        if cells > max_cells:
            raise ValueError(f"it has more than {max_cells} cells")
        if rows:
            sheets.append({"name": name, "rows": rows, "is_hidden": False, "merged": [],
                           "hidden_rows": hidden, "hidden_columns": [], "has_filter": False})
    if not sheets:
        raise ValueError("it holds no rows")
    return sheets


def _unzipped(content: bytes) -> bytes:
    with zipfile.ZipFile(BytesIO(content)) as archive:
        name = next(name for name in archive.namelist() if name.lower().endswith(".kml"))
        return archive.read(name)


def _of_markup(content: bytes) -> Iterable[tuple[str, Rows, list[int]]]:
    parser = etree.XMLParser(resolve_entities=False, no_network=True, recover=True)
    root = etree.fromstring(content, parser) if b"<?xml" in content[:200] or b"<kml" in content[
        :1000] or b"<gpx" in content[:1000] else None
    name = "" if root is None or not isinstance(root.tag, str) else etree.QName(root).localname
    if name == "kml":
        return _points(_placemarks(root))
    if name == "gpx":
        return _points(_waypoints(root))
    if name == "Workbook":
        return _excel_2003(root)
    return _tables(content)


def _tables(content: bytes) -> Iterator[tuple[str, Rows, list[int]]]:
    """Yield the tables of a page that hold no others."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = ""
    stated = b"charset" in content[:2000].lower()
    page = (html.document_fromstring(text) if text and "<?xml" not in text[:50] and not stated
            else html.document_fromstring(content))
    for mark in page.iter("br"):
        mark.tail = "\n" + (mark.tail or "")
    tables = [table for table in page.iter("table") if table.find(".//table") is None]
    for number, table in enumerate(tables, 1):
        caption = table.find(".//caption")
        name = "" if caption is None else (caption.text_content() or "").strip()
        rows, hidden = _rows_of(table)
        yield name[:100] or f"Table {number}", rows, hidden


def _rows_of(table: Any) -> tuple[Rows, list[int]]:
    rows: Rows = []
    hidden: list[int] = []
    spanned: dict[int, int] = {}  # rows that a cell above still reaches down, by column
    for line in table.iter("tr"):
        if "display:none" in (line.get("style") or "").replace(" ", "").lower():
            hidden.append(len(rows))
        row: list[Any] = []
        for cell in line:
            if cell.tag not in ("td", "th"):
                continue
            _skip_spanned(row, spanned)
            text = (cell.text_content() or "").replace("\xa0", " ").strip()
            for place in range(_span(cell, "colspan")):
                if (down := _span(cell, "rowspan")) > 1:
                    spanned[len(row)] = down - 1
                row.append(text if place == 0 else None)
        _skip_spanned(row, spanned)
        rows.append(row)
    return rows, hidden


def _skip_spanned(row: list[Any], spanned: dict[int, int]) -> None:
    """Leave out the columns that cells above reach into. In place."""
    while spanned.get(len(row), 0):
        spanned[len(row)] -= 1
        row.append(None)


def _span(cell: Any, name: str) -> int:
    stated = str(cell.get(name) or "1")
    return min(int(stated), MOST_SPANNED) if stated.isdecimal() and len(stated) < 6 else 1


def _excel_2003(root: Any) -> Iterator[tuple[str, Rows, list[int]]]:
    for sheet in root.iter("{*}Worksheet"):
        rows: Rows = []
        hidden: list[int] = []
        for line in sheet.iter("{*}Row"):
            start = _stated(line, "Index")
            rows += [[] for _ in range(min(start - 1 - len(rows), MOST_SPANNED) if start else 0)]
            if _attribute(line, "Hidden") == "1":
                hidden.append(len(rows))
            row: list[Any] = []
            for cell in line.iter("{*}Cell"):
                place = _stated(cell, "Index")
                row += [None] * (min(place - 1 - len(row), MOST_SPANNED) if place else 0)
                row.append(_typed(cell.find("{*}Data")))
            rows.append(row)
        yield _attribute(sheet, "Name") or "", rows, hidden


def _typed(data: Any) -> Any:
    if data is None:
        return None
    text = "".join(data.itertext())
    kind = _attribute(data, "Type")
    try:
        if kind == "Number":
            return float(text) if isfinite(float(text)) else text
        if kind == "DateTime":
            return ["datetime", datetime.fromisoformat(text.partition(".")[0]).isoformat()]
    except ValueError:
        pass
    return text


def _attribute(thing: Any, name: str) -> str | None:
    return next((str(value) for key, value in thing.attrib.items()
                 if etree.QName(key).localname == name), None)


def _stated(thing: Any, name: str) -> int:
    text = _attribute(thing, name) or ""
    return int(text) if text.isdecimal() and len(text) < 7 else 0


Named = tuple[dict[str, Any], Place, bool]
"""What is told of a place, its latitude and longitude, and whether it is a point."""


def _points(found: Iterable[Named]) -> Iterator[tuple[str, Rows, list[int]]]:
    """Yield a sheet of the points, and one of all else at its middle."""
    places = list(found)
    for name, is_point in (("Points", True), (OTHER_SHAPES, False)):
        kept = [(told, place) for told, place, kind in places if kind == is_point]
        headings = list(dict.fromkeys(key for told, _ in kept for key in told))
        rows = [[*(told.get(key) for key in headings), *place] for told, place in kept]
        yield name, [[*headings, LATITUDE, LONGITUDE], *rows] if rows else [], []


def _placemarks(root: Any) -> Iterator[Named]:
    for mark in root.iter("{*}Placemark"):
        told = {name: _words(mark.find(f"{{*}}{name}"))
                for name in ("name", "address", "phoneNumber", "description")}
        for data in mark.iter("{*}Data"):
            told[str(data.get("name"))] = _words(data.find("{*}value"))
        for data in mark.iter("{*}SimpleData"):
            told[str(data.get("name"))] = _words(data)
        folder = mark.getparent()
        if folder is not None and etree.QName(folder).localname == "Folder":
            told["folder"] = _words(folder.find("{*}name"))
        texts = ["".join(shape.itertext()) for shape in mark.iter("{*}coordinates")]
        pairs = [pair for text in texts for part in text.split() if (pair := _pair(part))]
        is_point = mark.find(".//{*}Point") is not None and len(pairs) == 1
        if pairs:
            yield {name: text for name, text in told.items() if text}, _middle(pairs), is_point


def _waypoints(root: Any) -> Iterator[Named]:
    for point in root.iter("{*}wpt"):
        pair = _pair(f"{point.get('lon')},{point.get('lat')}")
        told = {name: _words(point.find(f"{{*}}{name}")) for name in ("name", "desc", "cmt")}
        if pair:
            yield {name: text for name, text in told.items() if text}, _middle([pair]), True


def _words(thing: Any) -> str:
    if thing is None:
        return ""
    text = "".join(thing.itertext()).strip()
    if "<" in text and ">" in text:  # HTML within a description
        text = html.fromstring(f"<div>{text}</div>").text_content().strip()
    return text


def _pair(text: str) -> Place | None:
    """Return longitude and latitude of `11.5,48.1,0`."""
    parts = text.split(",")
    return _place(parts[0], parts[1]) if len(parts) > 1 else None


def _place(lon: str | float, lat: str | float) -> Place | None:
    """Return two numbers; None: they are none, or beyond all bounds."""
    try:
        place = float(lon), float(lat)
    except (ValueError, OverflowError):
        return None
    return place if all(map(isfinite, place)) else None


def _middle(pairs: Iterable[Place]) -> Place:
    """Return latitude and longitude amid places given longitude first."""
    lons, lats = zip(*pairs, strict=True)
    return (min(lats) + max(lats)) / 2, (min(lons) + max(lons)) / 2


def _loaded(content: bytes) -> Any:
    def refuse(constant: str) -> None:
        raise ValueError(f"{constant} is no number of JSON")

    return json.loads(content.decode("utf-8-sig"), parse_constant=refuse)


def _of_json(data: Any) -> Iterable[tuple[str, Rows, list[int]]]:
    if isinstance(data, list) and data and all(isinstance(entry, dict) for entry in data):
        headings = list(dict.fromkeys(key for entry in data for key in entry))
        rows = [[_plain(entry.get(key)) for key in headings] for entry in data]
        return [("Entries", [headings, *rows], [])]
    features = data.get("features") if isinstance(data, dict) else None
    if not isinstance(features, list):
        raise ValueError("it is neither GeoJSON nor a list of entries")
    return _points(_features(features))


def _features(features: list[Any]) -> Iterator[Named]:
    for feature in features:
        shape = feature.get("geometry") if isinstance(feature, dict) else None
        if not isinstance(shape, dict):
            continue
        pairs = list(_pairs_in(shape.get("coordinates"), DEEPEST))
        told = feature.get("properties")
        named = {str(key): _plain(value) for key, value in told.items()} if isinstance(
            told, dict) else {}
        if "id" in feature and "id" not in named and "name" not in named:
            named = {"id": _plain(feature["id"])} | named
        if pairs:
            yield named, _middle(pairs), shape.get("type") in ("Point", "MultiPoint") and len(
                pairs) == 1


def _pairs_in(data: Any, depth: int) -> Iterator[Place]:
    if not isinstance(data, list) or not depth:
        return
    if len(data) >= 2 and all(isinstance(number, int | float) for number in data[:2]):
        if place := _place(data[0], data[1]):
            yield place
        return
    for part in data:
        yield from _pairs_in(part, depth - 1)


def _plain(value: Any) -> Any:
    if value is None or isinstance(value, str | bool | float):
        return value
    if isinstance(value, int):
        return float(value) if abs(value) < 2**53 else str(value)
    if isinstance(value, list) and all(isinstance(part, str | int | float) for part in value):
        return ", ".join(map(str, value))
    return json.dumps(value, ensure_ascii=False)
