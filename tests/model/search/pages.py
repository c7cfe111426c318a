"""Tables of the page on the search, as the tests read them."""

from pathlib import Path

PAGE = Path(__file__).resolve().parents[3] / "docs/develop/search.md"


def table(column: str) -> dict[str, dict[str, str]]:
    """Return the page's one table with such a column: the cells of each row, by what is first."""
    lines = [[cell.strip() for cell in line[1:-1].split("|")] if line.startswith("|") else []
             for line in PAGE.read_text("utf-8").splitlines()]
    begin = next(number for number, cells in enumerate(lines) if column in cells[1:])
    rows = lines[begin + 2:]
    names, end = lines[begin][1:], rows.index([])
    return {row[0]: dict(zip(names, row[1:], strict=True)) for row in rows[:end]}
