"""What is shown while a planner is warmed."""

import json
import logging
import subprocess
import sys
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from app.plans.warming import LINE_SECONDS, Lines, showing
from model.kernel.warming import Warmth

ROOT = Path(__file__).parents[3]

FLIGHTS_SCRIPT = """
import sys
from app.plans.task import task_of
from app.requests.reading import read_request
from model.travel.airspace import compile_ways
from model.travel.detours import fly_around
from model.travel.visibility import mark_dead_ends, mark_hidden

functions = (fly_around, mark_dead_ends, mark_hidden)
compile_ways()
warm = [list(function.signatures) for function in functions]
assert all(warm), "not all are compiled"
for line in sys.stdin.buffer:
    task_of(read_request(line, policies=None))
assert warm == [list(function.signatures) for function in functions], "more had to be compiled"
"""

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


def with_area(request: dict[str, Any], system: str, wind: float) -> dict[str, Any]:
    """Return a request whose flights go around an area."""
    ends = [[0, 0], [0.003, 0]]
    moved = {name: [place | {"location": ends[index % 2]}
                    for index, place in enumerate(request[name], first)]
             for name, first in (("depots", 0), ("customers", 1))}
    return {"fleet": request["fleet"], "coordinate_system": system, **moved,
            **({"planar_unit": 100_000} if system == "planar" else {}),
            "airspace": {"no_fly": [[[0.001, -0.001], [0.002, -0.001], [0.0015, 0.001]]],
                         "wind": {"speed_kmh": wind, "direction_deg": 90}}}


def test_requests_with_areas_find_all_of_their_flights_compiled(
        with_drones: dict[str, Any]) -> None:
    requests = [with_area(with_drones, system, wind)
                for system in ("planar", "geographic") for wind in (0, 20)]
    lines = b"\n".join(json.dumps(request).encode() for request in requests)
    subprocess.run([sys.executable, "-c", FLIGHTS_SCRIPT], cwd=ROOT, check=True, input=lines)
