"""Sheets drawn from a seed, as dispatchers of twelve countries have them, and what they mean."""

import random
import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from datetime import date, datetime, time, timedelta
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any

import xlsxwriter

DAY = date(2026, 11, 23)  # a Monday
MIDNIGHT = datetime.combine(DAY, time())
UNKNOWN = ("Feld 7", "Col4", "XQ", "Kz.", "Attr_b")
"""Headings that say nothing in any language."""

@dataclass
class Drawn:
    """A sheet, and what it means."""

    seed: int
    language: str
    layout: str
    content: bytes
    truth: list[dict[str, Any]]  # customers or shipments, in the order of rows
    headings: list[str]
    roles: list[str]
    is_half: bool = False  # half a pair of coordinates: nothing may be planned unasked


@dataclass
class Sheet:
    """A sheet being drawn: columns of roles, headings and cells."""

    rng: random.Random
    words: dict[str, Any]
    is_book: bool
    columns: list[tuple[str, str, list[Any]]] = field(default_factory=list)

    def add(self, role: str, cells: list[Any], heading: str | None = None) -> None:
        """Add a column. In place."""
        self.columns.append((role, heading or self.rng.choice(self.words[role]), cells))

    def number(self, value: float) -> Any:
        """Return a number as the sheet has it: a cell of a workbook, or a text."""
        text = f"{value:.10g}"
        return value if self.is_book else text.replace(".", ",") if self.words["comma"] else text


@cache
def words() -> dict[str, dict[str, Any]]:
    """Return what headings say, by language."""
    return tomllib.loads(Path(__file__).with_name("sheet_words.toml").read_text("utf-8"))


def drawn(seed: int) -> Drawn:
    """Return a sheet of a seed."""
    rng = random.Random(seed)
    language = rng.choice(list(words()))
    sheet = Sheet(rng, words()[language], rng.random() < 0.4)
    count = rng.randint(5, 14)
    layout = rng.choices(list(LAYOUTS), (60, 15, 15, 10))[0]
    truth = LAYOUTS[layout](sheet, count)
    _fill(sheet, count)
    is_half = rng.random() < 0.02 and _break_pair(sheet)
    if not is_half and rng.random() < 0.04:
        _blur(sheet)
    if rng.random() < 0.3:
        rng.shuffle(sheet.columns)
        sheet.columns = _pairs_in_order(sheet.columns)
    rows = _rows(sheet, count)
    content = _book(rows, sheet) if sheet.is_book else _text(rows, sheet)
    return Drawn(seed, language, layout, content, truth, [column[1] for column in sheet.columns],
                 [column[0] for column in sheet.columns], is_half)


def _places(sheet: Sheet, count: int) -> list[tuple[float, float]]:
    lat, lon = sheet.words["near"]
    return [(round(lat + sheet.rng.uniform(-0.09, 0.09), 5),
             round(lon + sheet.rng.uniform(-0.09, 0.09), 5)) for _ in range(count)]


def _add_places(sheet: Sheet, places: Sequence[tuple[float, float]], side: str = "",
                as_points: bool | None = None) -> None:
    if sheet.rng.random() < 0.3 if as_points is None else as_points:
        sheet.add(f"{side}point", [f"{lat}, {lon}" for lat, lon in places])
        return
    at = sheet.rng.randrange(len(sheet.words[f"{side}lat"]))
    for part, role in enumerate((f"{side}lat", f"{side}lon")):
        sheet.add(role, [sheet.number(place[part]) for place in places],
                  sheet.words[role][min(at, len(sheet.words[role]) - 1)])


def _names(sheet: Sheet, count: int) -> list[str]:
    names = [f"{sheet.rng.choice(sheet.words['names'])} {number + 1}" for number in range(count)]
    sheet.add("name", list(names))
    return names


def _amounts(sheet: Sheet, truth: list[dict[str, Any]], field_name: str = "demand") -> None:
    """Add amounts in one or two columns, or none. In place."""
    for role in sheet.rng.choice((("weight",), ("pieces",), ("pieces", "weight"), ())):
        amounts = [sheet.rng.randint(1, 30) if role == "pieces" else
                   round(sheet.rng.uniform(1, 300), 1) for _ in truth]
        sheet.add(role, [sheet.number(amount) for amount in amounts])
        for entry, amount in zip(truth, amounts, strict=True):
            entry.setdefault(field_name, []).append(amount)
    for entry in truth:
        entry.setdefault(field_name, [1])


def _clock(sheet: Sheet, seconds: int) -> Any:
    """Return a time of day as sheets hold it."""
    hours, minutes = divmod(seconds // 60, 60)
    if sheet.is_book:
        return sheet.rng.choice((time(hours, minutes), time(hours, minutes), seconds / 86400,
                                 f"{hours:02}:{minutes:02}"))
    return f"{hours}:{minutes:02}" if sheet.rng.random() < 0.5 else f"{hours:02}:{minutes:02}"


def _windows(sheet: Sheet, truth: list[dict[str, Any]]) -> None:
    """Add windows in one of their shapes. In place."""
    shape = sheet.rng.choice(("pair", "pair", "cell", "by", "dated", "none"))
    begins = [sheet.rng.randrange(14, 26) * 1800 for _ in truth]
    ends = [begin + sheet.rng.randrange(2, 9) * 1800 for begin in begins]
    if shape in ("pair", "dated"):
        at = sheet.rng.randrange(len(sheet.words["from"]))
        for role, values in (("from", begins), ("to", ends)):
            cells = [_stamp(sheet, value) if shape == "dated" else _clock(sheet, value)
                     for value in values]
            sheet.add(role, cells, sheet.words[role][min(at, len(sheet.words[role]) - 1)])
    elif shape == "cell":
        dash = sheet.rng.choice(("-", " - ", "\u2013") if sheet.is_book else ("-", " - ", "-"))
        sheet.add("window", [f"{_plain(begin)}{dash}{_plain(end)}"
                             for begin, end in zip(begins, ends, strict=True)])
    elif shape == "by":
        sheet.add("by", [_clock(sheet, end) for end in ends])
    for entry, begin, end in zip(truth, begins, ends, strict=True):
        entry["window"] = {"by": (0, end), "none": None}.get(shape, (begin, end))


def _plain(seconds: int) -> str:
    return f"{seconds // 3600:02}:{seconds // 60 % 60:02}"


def _stamp(sheet: Sheet, seconds: int) -> Any:
    moment = MIDNIGHT + timedelta(seconds=seconds)
    return moment if sheet.is_book else moment.strftime(f"{sheet.words['date']} %H:%M")


def _service(sheet: Sheet, truth: list[dict[str, Any]]) -> None:
    if sheet.rng.random() < 0.4:
        for entry in truth:
            entry["service"] = 0
        return
    minutes = [sheet.rng.choice((3, 5, 10, 15, 20, 45)) for _ in truth]
    sheet.add("service", [sheet.number(value) for value in minutes])
    for entry, value in zip(truth, minutes, strict=True):
        entry["service"] = value * 60


def orders(sheet: Sheet, count: int) -> list[dict[str, Any]]:
    """Draw a row an order, and return the customers. In place."""
    names, places = _names(sheet, count), _places(sheet, count)
    truth = [{"name": name, "place": place} for name, place in zip(names, places, strict=True)]
    _add_places(sheet, places)
    _amounts(sheet, truth)
    _windows(sheet, truth)
    _service(sheet, truth)
    if sheet.rng.random() < 0.15:
        crews = [("T-1", "T-2")[row % 2] for row in range(count)]
        sheet.add("crew", list(crews))
        for entry, crew in zip(truth, crews, strict=True):
            entry["crew"] = [crew]
    return truth


def both_ends(sheet: Sheet, count: int) -> list[dict[str, Any]]:
    """Draw a row a shipment, with both its places, and return the shipments. In place."""
    _names(sheet, count)
    fetched, brought = _places(sheet, count), _places(sheet, count)
    truth: list[dict[str, Any]] = [{"pickup": first, "delivery": second}
                                   for first, second in zip(fetched, brought, strict=True)]
    as_points = sheet.rng.random() < 0.4
    _add_places(sheet, fetched, "pick_", as_points)
    _add_places(sheet, brought, "drop_", as_points)
    _amounts(sheet, truth, "amount")
    if sheet.rng.random() < 0.5:
        begins = [sheet.rng.randrange(14, 20) * 1800 for _ in truth]
        sheet.add("pick_from", [_clock(sheet, begin) for begin in begins])
        for entry, begin in zip(truth, begins, strict=True):
            entry["pickup_from"] = begin
    if sheet.rng.random() < 0.5:
        ends = [sheet.rng.randrange(24, 36) * 1800 for _ in truth]
        sheet.add("by", [_clock(sheet, end) for end in ends])
        for entry, end in zip(truth, ends, strict=True):
            entry["delivery_by"] = end
    return truth


def rides(sheet: Sheet, count: int) -> list[dict[str, Any]]:
    """Draw a row a passenger, some of whom ride back, and return the shipments. In place."""
    truth = both_ends(sheet, count)
    backs = [sheet.rng.randrange(24, 34) * 1800 if sheet.rng.random() < 0.7 else None
             for _ in truth]
    sheet.add("back", [None if back is None else _clock(sheet, back) for back in backs])
    return truth + [{"pickup": entry["delivery"], "delivery": entry["pickup"],
                     "amount": entry["amount"], "pickup_from": back}
                    for entry, back in zip(truth, backs, strict=True) if back is not None]


def weekdays(sheet: Sheet, count: int) -> list[dict[str, Any]]:
    """Draw a column of amounts for each working day, and return Monday's customers. In place."""
    names, places = _names(sheet, count), _places(sheet, count)
    _add_places(sheet, places)
    columns = [[sheet.rng.randint(1, 20) if sheet.rng.random() < 0.7 else None for _ in names]
               for _ in sheet.words["days"]]
    columns[0][0] = 4
    for heading, cells in zip(sheet.words["days"], columns, strict=True):
        sheet.add("day", [None if cell is None else sheet.number(cell) for cell in cells], heading)
    return [{"name": name, "place": place, "demand": [amount], "window": None, "service": 0}
            for name, place, amount in zip(names, places, columns[0], strict=True)
            if amount is not None]


LAYOUTS: dict[str, Callable[[Sheet, int], list[dict[str, Any]]]] = {
    "orders": orders, "both ends": both_ends, "rides": rides, "weekdays": weekdays}


def _fill(sheet: Sheet, count: int) -> None:
    """Add columns that plan nothing. In place."""
    rng = sheet.rng
    others: dict[str, Callable[[int], Any]] = {
        "order": lambda row: f"A-{40100 + row}",
        "phone": lambda row: f"0{rng.randint(100, 999)} {rng.randint(10000, 99999)}",
        "notes": lambda row: rng.choice(("", "2x", "OK!", "B 12")) or None,
        "price": lambda row: sheet.number(round(rng.uniform(5, 900), 2)),
        "other": lambda row: rng.choice(("AB", "CD", "EF"))}
    for role, cell in others.items():
        if rng.random() < 0.4:
            sheet.add(role, [cell(row) for row in range(count)])


def _break_pair(sheet: Sheet) -> bool:
    """Take one of two coordinates away; return whether there were two. In place."""
    lost = [column for column in sheet.columns if column[0] in ("lon", "pick_lon", "drop_lon")]
    sheet.columns = [column for column in sheet.columns if column not in lost[-1:]]
    return bool(lost)


def _blur(sheet: Sheet) -> None:
    """Give a column a heading that says nothing. In place."""
    at = sheet.rng.randrange(len(sheet.columns))
    role, _, cells = sheet.columns[at]
    if role != "day":
        sheet.columns[at] = role, sheet.rng.choice(UNKNOWN), cells


def _pairs_in_order(columns: list[tuple[str, str, list[Any]]]) -> list[tuple[str, str, list[Any]]]:
    """Return shuffled columns of which begins stand before ends, as nobody turns these."""
    order = ["from", "to", "pick_lat", "pick_lon", "drop_lat", "drop_lon", "pieces", "weight",
             "pick_point", "drop_point", "lat", "lon"]
    kept = iter(sorted((column for column in columns if column[0] in order),
                       key=lambda column: order.index(column[0])))
    return [next(kept) if column[0] in order else column for column in columns]


def _rows(sheet: Sheet, count: int) -> list[list[Any]]:
    rows = [[cells[row] for _, _, cells in sheet.columns] for row in range(count)]
    rows.insert(0, [heading for _, heading, _ in sheet.columns])
    if sheet.rng.random() < 0.25:
        rows.append(_sums(sheet))
    if sheet.rng.random() < 0.25:
        rows[:0] = [[sheet.rng.choice(sheet.words["title"])], []]
    return rows


def _sums(sheet: Sheet) -> list[Any]:
    """Return a row of sums, with or without a word that says so."""
    sums: list[Any] = []
    for role, _, cells in sheet.columns:
        numbers = [float(str(cell).replace(",", ".")) for cell in cells if cell is not None] if (
            role in ("weight", "pieces", "day")) else []
        sums.append(sheet.number(round(sum(numbers), 1)) if numbers else None)
    if sheet.columns[0][0] == "name" and (not any(sums) or sheet.rng.random() < 0.7):
        sums[0] = sheet.rng.choice(sheet.words["total"])
    return sums if any(cell is not None for cell in sums) else []


def _text(rows: list[list[Any]], sheet: Sheet) -> bytes:
    sign = sheet.rng.choice((";", "\t") if sheet.words["comma"] else (",", ";", "\t"))
    quote = [[f'"{cell}"' if sign in str(cell) else "" if cell is None else str(cell)
              for cell in row] for row in rows]
    text = "\r\n".join(sign.join(row) for row in quote) + "\r\n"
    encoding = sheet.rng.choice(sheet.words["encodings"])
    return text.encode(encoding, errors="replace")


def _book(rows: list[list[Any]], sheet: Sheet) -> bytes:
    content = BytesIO()
    with xlsxwriter.Workbook(content, {"in_memory": True}) as book:
        page = book.add_worksheet("Sheet1")
        formats = {datetime: book.add_format({"num_format": "dd.mm.yyyy hh:mm"}),
                   time: book.add_format({"num_format": "hh:mm"})}
        for at, row in enumerate(rows):
            for column, cell in enumerate(row):
                if cell is not None:
                    page.write(at, column, cell, formats.get(type(cell)))
        if len(rows[0]) == 1 and sheet.rng.random() < 0.5:
            page.merge_range(0, 0, 0, len(sheet.columns) - 1, rows[0][0])
    return content.getvalue()
