"""What is shown while a planner is warmed."""

import logging
import sys
from io import StringIO

import pytest

from app.plans.warming import LINE_SECONDS, Lines, showing
from model.kernel.warming import Warmth

FIRST, SECOND = Warmth("compiling this", 0.2), Warmth("compiling that", 0.6, decodes=True)


class Terminal(StringIO):
    """Standard error that somebody looks at."""

    def isatty(self) -> bool:
        return True


def test_bar_on_a_terminal_moves(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with showing(pytest.fail) as show:
        for warmth in (FIRST, SECOND):
            show(warmth)
    drawn = terminal.getvalue()
    assert drawn.index("compiling this |") < drawn.index(" 20 %") < drawn.index(" 60 %")
    assert "compiling that |" in drawn


def test_log_lines_on_a_terminal_stand_above_the_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    handler = logging.StreamHandler(terminal)
    monkeypatch.setattr(logging.root, "handlers", [handler])
    with showing(pytest.fail) as show:
        show(FIRST)
        logging.getLogger("any").warning("something happened")
        show(SECOND)
    assert "\rsomething happened\n" in terminal.getvalue().replace("\x1b[A", "")
    assert logging.root.handlers == [handler]


def test_elsewhere_there_is_a_line_for_each_stage_and_now_and_then(
        monkeypatch: pytest.MonkeyPatch) -> None:
    now = 0.0
    lines: list[str] = []
    show = Lines(lines.append, lambda: now)
    for now in (0.0, 0.5, LINE_SECONDS):  # noqa: B007 (the clock reads it)
        show(FIRST)
    show(SECOND)
    assert lines == ["compiling this, about 20% done"] * 2 + [
        "compiling that, about 60% done; plans with time_limit 0 are made already"]


def test_where_there_is_no_terminal_lines_are_written() -> None:
    lines: list[str] = []
    with showing(lines.append) as show:
        show(FIRST)
    assert len(lines) == 1
