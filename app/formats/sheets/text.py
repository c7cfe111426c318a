"""Bytes of a text file -> rows of cells: its encoding and what stands between cells."""

import csv
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from charset_normalizer import from_bytes

from app.formats.sheets.cells import Raw, tidy
from app.formats.sheets.headings import LONGEST_HEADING, SURE, guesses, is_known
from app.formats.sheets.words import LETTERS

DELIMITERS = (";", "\t", ",", "|")

ENCODINGS = ("cp1252", "cp1250", "iso8859_2", "cp1251", "cp1253", "cp1254", "cp850", "mac_roman")
"""One byte a letter, as programs in Europe write them, the most usual first."""

LOOKED_AT = 200_000
"""Bytes from which the encoding is guessed."""

SAMPLED_ROWS = 100

HEADING_LINES = 10
"""Lines within which headings are looked for, to tell encodings apart."""

USUAL_SIGNS = frozenset("\u20ac\u00b0\u00b2\u00b3\u00a0\u00ab\u00bb"
                        "\u2013\u2014\u2018\u2019\u201c\u201d\u201e\u2026")
"""Of all languages."""

EQUALLY_GOOD = 0.02
"""Difference of `charset_normalizer`'s chaos that tells nothing."""

PIECE = 2**16
"""Characters that are cut into lines at a time."""

LONGEST_LINE = 2**20
LONGEST_CELL = 100_000
MAX_CELLS = 2_000_000

_SIGNS = re.compile(r"[;\t,|]")
_MISFITS = re.compile(r"(?<=[^\W\d_])[^\x00-\x7f\w\s\u2019](?=[^\W\d_])|(?<=[a-z])[\u00c0-\u00de]")
"""Signs within words, and capitals behind small letters: what wrong encodings make of accents."""


@dataclass(frozen=True)
class TextFile:
    """Rows of a text file and how it was read."""

    rows: list[list[Raw]]
    encoding: str
    delimiter: str
    is_guessed: bool  # its encoding, from its letters alone


class NoTextError(ValueError):
    """Bytes that are no text of rows and cells."""


def read_text(content: bytes, encoding: str | None, max_rows: int) -> TextFile:
    """Return the rows of a text file; `encoding` None: guessed."""
    name, is_guessed = (encoding, False) if encoding else _encoding_of(content)
    try:
        text = content.decode(name)
    except (UnicodeDecodeError, LookupError) as error:
        raise NoTextError(f"it is no text in {name}") from error
    if "\0" in text:
        raise NoTextError("it is neither text nor a workbook")
    text = text.removeprefix("\ufeff")
    stated, text = _stated_delimiter(text)
    delimiter = stated or _delimiter_of(text)
    rows, cells_left = [], MAX_CELLS
    for row in _records(text, delimiter, max_rows + 1):
        rows.append(row)
        cells_left -= len(row)
        if len(rows) > max_rows or cells_left < 0:
            raise NoTextError(f"it has more than {max_rows} rows" if len(rows) > max_rows
                              else f"it has more than {MAX_CELLS} cells")
    cells: list[list[Raw]] = [list(map(tidy, row)) for row in rows]
    return TextFile(cells, name, delimiter, is_guessed)


def _encoding_of(content: bytes) -> tuple[str, bool]:
    """Return the encoding, and whether it is a guess."""
    for mark, name in ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"),
                       (b"\xfe\xff", "utf-16")):
        if content.startswith(mark):
            return name, False
    head = content[:LOOKED_AT]
    zeros = head.count(0)
    if zeros * 3 > len(head) > 1:
        return ("utf-16-le" if head[1::2].count(0) * 2 > zeros else "utf-16-be"), True
    try:
        content.decode("utf-8")
        return "utf-8", False
    except UnicodeDecodeError:
        pass
    found = {alike.encoding: match.chaos
             for match in from_bytes(head, cp_isolation=list(ENCODINGS))
             for alike in (match, *match.submatch) if alike.encoding in ENCODINGS}
    least = min(found.values(), default=0.0)

    def rank(name: str) -> tuple[int, float, bool, int]:
        known, strange = _sense_in(head, name)
        return (-known, strange, found.get(name, 1.0) > least + EQUALLY_GOOD,
                ENCODINGS.index(name))

    return min(filter(lambda name: _decodes(head, name), ENCODINGS), key=rank,
               default=ENCODINGS[0]), True


def _decodes(head: bytes, encoding: str) -> bool:
    try:
        head.decode(encoding)
    except UnicodeDecodeError:
        return False
    return True


def _sense_in(head: bytes, encoding: str) -> tuple[int, float]:
    """Return how many cells of the first lines are headings that are known word by word.

    In a short file letters tell little; words that make sense tell more. Beside it, the share of
    letters that the languages of these headings don't have.
    """
    text = head.decode(encoding, errors="replace")
    cells = {cell.strip(' "') for line in text.splitlines()[:HEADING_LINES]
             for cell in _SIGNS.split(line)}
    known = [cell for cell in cells if len(cell) <= LONGEST_HEADING and is_known(cell, SURE)]
    spoken = Counter(guess.language for cell in known for guess in guesses(cell)
                     if guess.score == SURE and guess.language in LETTERS)
    most = max(spoken.values(), default=0)
    usual = {sign for language, count in spoken.items() if count == most
             for sign in LETTERS[language][0]}
    others = [sign for sign in text.lower() if sign >= "\x80" and sign not in USUAL_SIGNS]
    strange = sum(sign not in usual for sign in others) + len(_MISFITS.findall(text))
    return len(known), strange / max(len(others), 1) if usual else 0.0


def _stated_delimiter(text: str) -> tuple[str | None, str]:
    """Return what a first line such as `sep=;` states, for spreadsheets, and the rest."""
    line, _, rest = text.partition("\n")
    line = line.strip().lower()
    if line.startswith("sep=") and len(line) == 5:
        # The line stays as an empty one, so that cells keep their names.
        return line[-1], "\n" + rest
    return None, text


def _delimiter_of(text: str) -> str:
    """Return the delimiter that cuts most rows into the same number of cells, and into many."""
    def worth(delimiter: str) -> tuple[float, int]:
        widths = Counter(len(row) for row in _records(text, delimiter, SAMPLED_ROWS)
                         if any(map(str.strip, row)))
        width, times = max(widths.items(), key=lambda item: (item[0] > 1, item[1]), default=(1, 0))
        return (times / widths.total() if width > 1 else 0.0), width

    return max(DELIMITERS, key=worth)


def _records(text: str, delimiter: str, most: int) -> Iterator[list[str]]:
    """Yield rows; a cell may hold line breaks between quotes."""
    csv.field_size_limit(LONGEST_CELL)
    try:
        for number, row in enumerate(csv.reader(_lines(text), delimiter=delimiter)):
            if number == most:
                return
            yield row
    except csv.Error as error:
        raise NoTextError(f"it can't be cut into cells: {error}") from error


def _lines(text: str) -> Iterator[str]:
    """Yield lines as `splitlines` does, a piece at a time: most are never asked for."""
    begin = 0
    while begin < len(text):
        end = text.find("\n", begin + PIECE) + 1 or len(text)
        for line in text[begin:end].splitlines(keepends=True):
            if len(line) > LONGEST_LINE:
                raise NoTextError(f"it has a line of more than {LONGEST_LINE} characters")
            yield line
        begin = end
