"""Tables of the page on what is chosen by problem, as the tests read them."""

from itertools import takewhile
from pathlib import Path

PAGE = Path(__file__).resolve().parents[3] / "docs/develop/by-problem.md"

NOTHING = "nothing of these"


def table(column: str) -> dict[str, set[str]]:
    """Return the table whose first column is called so: what it lists, by each kind behind."""
    lines = [[cell.strip() for cell in line[1:-1].split("|")] if line.startswith("|") else []
             for line in PAGE.read_text("utf-8").splitlines()]
    begin = next(number for number, cells in enumerate(lines) if cells[:1] == [column])
    return {kind: set(listed.split(", ")) - {NOTHING}
            for listed, kinds in takewhile(bool, lines[begin + 2:]) for kind in kinds.split("; ")}
