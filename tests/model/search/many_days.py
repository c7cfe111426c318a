"""Compares the search with brute force on tiny days: `python -m tests.model.search.many_days`.

What came of each problem stands in a file, and the next run goes on from there. Problems that take
too long to enumerate aren't counted.
"""

import json
import signal
import time
from collections import Counter
from dataclasses import asdict, dataclass
from pathlib import Path
from types import FrameType
from typing import Annotated

import numpy as np
import typer

from model.engine.instance import pack
from model.judge.check import check
from model.search.improve import SearchConfig, improve
from model.solution import Solution
from tests.model.search.exhaustive import cheapest_cost
from tests.model.search.mixed_days import mixed_day, stated_in

TURNS = 300, 6_000


@dataclass(frozen=True)
class Day:
    """What came of one problem."""

    seed: int
    stated: tuple[str, ...]
    cheapest: float | None = None  # None: not enumerated in time
    found: float = 0.0
    broken: tuple[str, ...] = ()

    @property
    def gap(self) -> float:
        """By which share the plan found is dearer than the cheapest."""
        assert self.cheapest is not None
        return (self.found - self.cheapest) / max(1e-9, abs(self.cheapest))


def day_of(seed: int, patience: int) -> Day:
    """Return what comes of a seed's problem, enumerated for some seconds at most."""
    problem = mixed_day(np.random.default_rng(seed))
    stated = tuple(sorted(stated_in(problem)))
    try:
        signal.alarm(patience)
        cheapest = cheapest_cost(problem)
    except TimeoutError:
        return Day(seed, stated)
    finally:
        signal.alarm(0)
    found, broken = float("inf"), set[str]()
    for turns in TURNS:
        if found <= cheapest * (1 + 1e-9):
            break
        plan = improve(problem, pack([problem]), Solution((), problem.left_out(())),
                       SearchConfig(turns=turns)).solution
        judged = check(problem, plan)
        broken |= {violation.code for violation in judged.violations}
        found = min(found, judged.cost.total)
    return Day(seed, stated, cheapest, found, tuple(sorted(broken)))


def days_in(log: Path) -> list[Day]:
    """Return what is known so far."""
    log.touch()
    return [Day(**json.loads(line)) for line in log.read_text("utf-8").splitlines()]


def told(days: list[Day]) -> str:
    """Return what came of all problems, in lines."""
    counted = [day for day in days if day.cheapest is not None]
    missed = [day for day in counted if day.gap > 1e-9]
    below = [day for day in counted if day.gap < -1e-9]
    rules = Counter(name for day in counted for name in day.stated)
    return "\n".join([
        f"{len(counted)} days enumerated, {len(days) - len(counted)} took too long; "
        f"{len(missed)} missed, by {sum(day.gap for day in missed) / max(1, len(missed)):.2%} in "
        f"the mean and {max((day.gap for day in missed), default=0.0):.2%} at most; "
        f"{len(below)} cheaper than enumerated; {sum(bool(day.broken) for day in counted)} broken",
        f"stated: {', '.join(f'{name} {times}' for name, times in rules.most_common())}",
        *(f"seed {day.seed}: {day.cheapest:.3f}, found {day.found:.3f} {' '.join(day.broken)} "
          f"({', '.join(day.stated)})" for day in (*missed, *below))])


def main(
    days: Annotated[int, typer.Option(help="Problems to enumerate.")] = 2_000,
    log: Annotated[Path, typer.Option(help="File of what came of each, to go on from.")]
    = Path("build/days.jsonl"),
    seconds: Annotated[float, typer.Option(help="When to stop, to be gone on from.")] = 1e9,
    patience: Annotated[int, typer.Option(help="Seconds for one problem.")] = 3,
) -> None:
    """Compare the search with brute force."""
    def ring(_: int, __: FrameType | None) -> None:
        raise TimeoutError

    signal.signal(signal.SIGALRM, ring)
    known, end = days_in(log), time.monotonic() + seconds
    left = days - sum(day.cheapest is not None for day in known)
    seed = max([day.seed + 1 for day in known], default=0)
    with log.open("a", encoding="utf-8") as lines:
        while left > 0 and time.monotonic() < end:
            day = day_of(seed, patience)
            lines.write(json.dumps(asdict(day)) + "\n")
            lines.flush()
            left -= day.cheapest is not None
            seed += 1
    typer.echo(told(days_in(log)))


if __name__ == "__main__":
    typer.run(main)
