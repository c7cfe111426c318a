"""How planning by regions would go on with more workers than there are: a simulation.

    python -m benchmarks.speed.queueing --times runs/service_times.json

A night's customers come at once, in jobs of equal size, each of which has its regions searched for
so many rounds. Workers take regions from the database's queue and read a job's request before its
first one; each job's keeper draws regions and merges what comes back, one after another; the
database has some cores, on which all workers' waiting lies, too. What each takes was measured by
`benchmarks.speed.service_times`. Prints how long the night lasts, which share of the workers' time
goes into search, and how busy the database and the busiest keeper are.
"""

import argparse
import json
from collections.abc import Generator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import simpy

from benchmarks.speed.service_times import REGION, REGION_SECONDS, DatabaseTimes, JobTimes

SECONDS, ROUNDS, FIRST = 10.0, 12, 10.0
"""Of a region's search, how often each region of a plan is searched, and seconds of the first
plan of a whole."""

LOOKING = 0.1
"""Seconds until a worker that waits sees a region, on average."""

NOTED = 0.25
"""Share of merges that are written down as a plan by themselves: keepers do so once a second."""

Process = Generator[Any, Any, None]


@dataclass
class Night:
    """A night under way.

    Parameters
    ----------
    job
        What a job of this size takes.
    database
        What the database takes.
    workers
        How many there are.
    cores
        Of the database.
    """

    job: JobTimes
    database: DatabaseTimes
    workers: int
    cores: int
    env: simpy.Environment = field(default_factory=simpy.Environment)
    searched: float = 0.0  # seconds
    asked: float = 0.0  # processor seconds of the database
    kept: dict[int, float] = field(default_factory=dict)  # seconds that each job's keeper worked

    def __post_init__(self) -> None:
        self._idle = simpy.Store(self.env)
        self._idle.items = [set() for _ in range(self.workers)]  # jobs that each worker knows
        self._database = simpy.Resource(self.env, self.cores)
        # Looking for work goes on whatever else is asked, and takes its share of all cores.
        self.looking = self.workers * self.database.waiting / self.cores

    def run(self, jobs: int) -> None:
        """Plan so many jobs. In place."""
        if self.looking >= 1.0:
            raise ValueError("workers: the database does nothing but tell them to wait")
        for number in range(jobs):
            self.kept[number] = 0.0
            self.env.process(self._plan(number))
        self.env.run()

    def _plan(self, number: int) -> Process:
        keeper = simpy.Resource(self.env)
        yield self.env.process(self._take(number, FIRST, 0.0))
        for _ in range(ROUNDS):
            yield self.env.process(self._keep(number, keeper, self.job.divide))
            regions = max(1, round(self.job.customers / REGION))
            yield self.env.all_of([self.env.process(self._region(number, keeper))
                                   for _ in range(regions)])

    def _region(self, number: int, keeper: simpy.Resource) -> Process:
        yield self.env.process(self._take(number, SECONDS, self.job.take))
        yield self.env.process(self._keep(number, keeper,
                                          self.job.merge + NOTED * self.job.reply))

    def _take(self, number: int, seconds: float, preparing: float) -> Process:
        """Have a worker search, which reads the request if it is new to it."""
        known = yield self._idle.get()
        yield self.env.timeout(LOOKING)
        if number not in known:
            known.add(number)
            yield self.env.timeout(self.job.convert)
        yield self.env.process(self._ask(self.database.region * seconds / REGION_SECONDS))
        yield self.env.timeout(preparing + seconds)
        self.searched += seconds
        yield self._idle.put(known)

    def _keep(self, number: int, keeper: simpy.Resource, seconds: float) -> Process:
        with keeper.request() as turn:
            yield turn
            yield self.env.timeout(seconds)
        self.kept[number] += seconds

    def _ask(self, seconds: float) -> Process:
        """Have the database work."""
        with self._database.request() as turn:
            yield turn
            yield self.env.timeout(seconds / (1.0 - self.looking))
        self.asked += seconds


def main() -> None:
    """Simulate and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=Path, default=Path("runs/service_times.json"))
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2, 10, 100, 300, 1000])
    parser.add_argument("--customers", type=int, default=1_000_000, help="of the night")
    parser.add_argument("--cores", type=int, default=8, help="of the database")
    arguments = parser.parse_args()
    told = json.loads(arguments.times.read_text())
    database = DatabaseTimes(**told["database"])
    for job in (JobTimes(**each) for each in told["jobs"]):
        print(f"\njobs of {job.customers:,}\n")
        print("| workers | hours | searching, % | database, % | busiest keeper, % |")
        print("| ---: | ---: | ---: | ---: | ---: |")
        for workers in arguments.workers:
            night = Night(job, database, workers, arguments.cores)
            if night.looking >= 1.0:
                print(f"| {workers:,} | the database does nothing but tell them to wait |")
                continue
            night.run(max(1, arguments.customers // job.customers))
            print(_row(night))


def _row(night: Night) -> str:
    """Return a night as a row of the table."""
    seconds = night.env.now
    searching = night.searched / seconds / night.workers
    database = night.looking + night.asked / seconds / night.cores
    keeper = max(night.kept.values()) / seconds
    return (f"| {night.workers:,} | {seconds / 3600:.2f} | {100 * searching:.0f} "
            f"| {100 * database:.0f} | {100 * keeper:.0f} |")


if __name__ == "__main__":
    main()
