"""Lines of a text file: cut as they are asked for, and bounded."""

import pytest

from app.sheets.text import LONGEST_LINE, PIECE, NoTextError, read_text


def test_a_line_without_end_is_refused() -> None:
    with pytest.raises(NoTextError, match="a line of more than"):
        read_text(b"a,b\n" + b"1," * LONGEST_LINE, None, 100)


@pytest.mark.parametrize("end", [b"\n", b"\r\n", b"\r"])
def test_lines_are_the_same_wherever_they_are_cut(end: bytes) -> None:
    rows = [b"%d;x" % number for number in range(PIECE // 4)]
    found = read_text(end.join(rows), None, len(rows)).rows
    assert [row[0] for row in found] == [str(number) for number in range(len(rows))]
