"""Tables of the pages on the search and on times of routes, as the tests read them."""

from itertools import takewhile
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[3] / "docs/develop"


def table(page: str, column: str) -> dict[str, dict[str, str]]:
    """Return a page's one table with such a column: the cells of each row, by what is first."""
    lines = [[cell.strip() for cell in line[1:-1].split("|")] if line.startswith("|") else []
             for line in (FOLDER / page).read_text("utf-8").splitlines()]
    begin = next(number for number, cells in enumerate(lines) if column in cells[1:])
    names = lines[begin][1:]
    return {row[0]: dict(zip(names, row[1:], strict=True))
            for row in takewhile(bool, lines[begin + 2:])}
