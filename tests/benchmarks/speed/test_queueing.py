"""The simulation of planning by regions keeps to what can be reckoned without it."""

import pytest

from benchmarks.speed.queueing import FIRST, LOOKING, ROUNDS, SECONDS, Night
from benchmarks.speed.service_times import REGION, DatabaseTimes, JobTimes

pytestmark = pytest.mark.slow

NOTHING = JobTimes(4 * REGION, convert=0.0, divide=0.0, take=0.0, merge=0.0, reply=0.0)
FREE = DatabaseTimes(waiting=0.0, region=0.0)


def finished(job: JobTimes, database: DatabaseTimes, workers: int, jobs: int = 1) -> Night:
    night = Night(job, database, workers, cores=1)
    night.run(jobs)
    return night


@pytest.mark.parametrize(("workers", "waves"), [(1, 4), (2, 2), (3, 2), (4, 1), (9, 1)])
def test_rounds_take_as_many_waves_as_workers_need(workers: int, waves: int) -> None:
    night = finished(NOTHING, FREE, workers)
    assert night.env.now == pytest.approx(
        FIRST + LOOKING + ROUNDS * waves * (SECONDS + LOOKING))
    assert night.searched == pytest.approx(FIRST + ROUNDS * 4 * SECONDS)


def test_each_worker_reads_a_job_once() -> None:
    reading = JobTimes(4 * REGION, convert=1.0, divide=0.0, take=0.0, merge=0.0, reply=0.0)
    assert (finished(reading, FREE, 1, jobs=3).env.now
            == pytest.approx(finished(NOTHING, FREE, 1, jobs=3).env.now + 3.0))


def test_a_keeper_merges_one_region_after_another() -> None:
    merging = JobTimes(4 * REGION, convert=0.0, divide=0.0, take=0.0, merge=2.0, reply=0.0)
    longer = finished(merging, FREE, 4).env.now - finished(NOTHING, FREE, 4).env.now
    assert longer == pytest.approx(ROUNDS * 4 * 2.0)


def test_workers_that_wait_slow_the_database_down_until_it_does_nothing_else() -> None:
    quick, slow = (finished(NOTHING, DatabaseTimes(waiting, 0.1), 4)
                   for waiting in (0.0, 0.2))
    assert slow.env.now > quick.env.now
    assert slow.asked == pytest.approx(quick.asked)
    with pytest.raises(ValueError, match="wait"):
        finished(NOTHING, DatabaseTimes(0.25, 0.1), 4)
