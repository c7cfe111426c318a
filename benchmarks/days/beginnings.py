"""Whether `attention` pays as beginning of the futures by which it is decided who waits.

    python -m benchmarks.days.beginnings ../shared/data/dynamic_euro_neurips

Futures of the competition's days are planned from nothing and from the policy's plan, in equal
processor time. Told are customers, and how much dearer plans are that the policy begins.
"""

import statistics
import time
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from app.serving.settings import Settings
from benchmarks.clock import count_processor_time
from benchmarks.days.dispatching import forecast_of, wave_of
from benchmarks.days.waves import published, read_day
from benchmarks.results import gap_percent
from model.engine.alarm import Alarm
from model.engine.instance import pack
from model.judge.check import check
from model.policy.decode import DecodeConfig, Policy, decode, load_policy, prepare
from model.policy.extract import extract
from model.policy.rolling import NOTHING
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.search.waves.future import future_of
from model.solution import Solution

LOOK_AHEAD = 2

SECONDS = 0.03, 0.13
"""Of the processor for a future: the least, and where an epoch has 5 s."""


def begun(problem: Problem, policy: Policy | None, seconds: float) -> tuple[float, float]:
    """Return what a plan costs after some seconds, and those of its policy."""
    began = time.perf_counter()
    instance = pack([problem], legs=policy is not None)
    start = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    if policy is not None:
        setting = Alarm(began + seconds).setting
        found = decode(policy, prepare(problem, instance), DecodeConfig(most_views=1),
                       began + seconds, setting)
        if found is not NOTHING:
            start = extract(problem, instance, found.actions)
    decoded = time.perf_counter() - began
    plan = improve(problem, instance, start, SearchConfig(), began + seconds).solution
    return check(problem, plan).cost.total, decoded


def futures(folder: Path, name: str) -> list[Problem]:
    """Return a future of every other epoch of a day, as of those who came in it."""
    day, rng, found = read_day(folder, name), np.random.default_rng(0), list[Problem]()
    for epoch in day.epochs[:-1:2]:
        wave = wave_of(day, epoch, day.drawn(epoch, rng), LOOK_AHEAD)
        found.append(future_of(wave, forecast_of(day, epoch, LOOK_AHEAD)(rng)).problem)
    return found


def main(folder: Path, days: Annotated[int, typer.Option()] = 5) -> None:
    """Plan futures both ways, and print means."""
    count_processor_time()
    policy = load_policy(Settings().weights_dir / "attention")
    problems = [each for name in list(published(folder))[:days] for each in futures(folder, name)]
    print(f"{len(problems)} futures, {statistics.mean(p.num_customers for p in problems):.0f} "
          "customers on the mean")
    for limit in SECONDS:
        pairs = [(begun(each, None, limit), begun(each, policy, limit)) for each in problems]
        gaps = [gap_percent(other[0], own[0]) for own, other in pairs]
        error = statistics.stdev(gaps) / len(gaps) ** 0.5
        decoding = statistics.median(other[1] for _, other in pairs)
        print(f"{1000 * limit:.0f} ms: begun by attention {statistics.mean(gaps):+.2f} ± "
              f"{error:.2f} % dearer; {1000 * decoding:.0f} ms for its plan", flush=True)


if __name__ == "__main__":
    typer.run(main)
