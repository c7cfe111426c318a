"""Runs a tool of OSRM and tells how far it is, by the lines that it writes."""

import re
import subprocess
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

EXTRACTING = (
    ("Parsing in progress", 0.0), ("Parsing finished", 0.45), ("extraction finished", 0.55),
    ("Generating edge expanded nodes", 0.6), ("Generating edge-expanded edges", 0.65),
    ("Generating guidance turns", 0.75), ("Computing strictly connected components", 0.92),
    ("Building r-tree", 0.95),
)
CONTRACTING = (
    ("Loading edge-expanded graph", 0.0), ("initializing node priorities", 0.05),
    ("Contraction took", 0.95),
)
"""What the tools' lines say at which share of their time, roughly."""

_PERCENT = re.compile(r"(\d+)% *$")

KEPT_LINES = 2000
TOLD_LINES = 4


class ToolFailedError(Exception):
    """A tool ended without success; says why in its words."""


def run_tool(command: Sequence[str | Path], environment: Mapping[str, str],
             show: Callable[[float], None],
             stages: Sequence[tuple[str, float]]) -> list[str]:
    """Run a tool to its end; return what it wrote.

    Raises
    ------
    ToolFailedError
        If it fails.
    """
    lines: deque[str] = deque(maxlen=KEPT_LINES)
    progress = StageProgress(stages)
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", env=dict(environment)) as process:
        try:
            for line in process.stdout or ():
                lines.append(line.rstrip())
                show(progress.after(line))
        except BaseException:
            process.kill()
            raise
    if process.returncode != 0:
        raise ToolFailedError(_last_words(lines, process.returncode))
    return list(lines)


class StageProgress:
    """Which share of a tool's work is over."""

    def __init__(self, stages: Sequence[tuple[str, float]]) -> None:
        self._stages = stages
        self._begin, self._end = 0.0, stages[0][1]
        self._share = 0.0

    def after(self, line: str) -> float:
        """Return the share that is over after a line; it never shrinks. In place."""
        ends = [begin for _, begin in self._stages[1:]] + [1.0]
        for (words, begin), end in zip(self._stages, ends, strict=True):
            if words in line and begin >= self._begin:
                self._begin, self._end = begin, end
                self._share = max(self._share, begin)
        percent = _PERCENT.search(line)
        if percent is not None:
            within = self._begin + (self._end - self._begin) * int(percent[1]) / 100
            self._share = max(self._share, min(within, self._end))
        return self._share


def _last_words(lines: Sequence[str], code: int) -> str:
    wrong = [line for line in lines if "[error]" in line] or list(lines)
    told = " ".join(line.rpartition("] ")[2] for line in wrong[-TOLD_LINES:])
    return f"OSRM says: {told or f'it ended with {code}'}"
