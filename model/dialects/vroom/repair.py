"""Routes by looser rules than VROOM's, mended: who can't stay is put elsewhere by true rules."""

import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement

from model.dialects.vroom.models import Routes
from model.dialects.vroom.request import Job

RouteCost = Callable[[int, tuple[int, ...]], int | None]
"""Return what a route of a kind costs, None if it breaks a rule."""

Unit = tuple[int, ...]
"""A job, or the pickup and the delivery of a shipment."""


@dataclass(frozen=True)
class VehicleWork:
    """What one vehicle does."""

    kind: int
    jobs: tuple[int, ...]


def units_of(jobs: Sequence[Job]) -> list[Unit]:
    """Return who is served together, or not at all."""
    return [(index,) if job.mate is None else (index, job.mate) for index, job in enumerate(jobs)
            if job.kind != "delivery"]


class Mending:
    """Mends routes until an instant, on `time.perf_counter`.

    Parameters
    ----------
    units
        All of them, by whom to put first.
    counts
        How many vehicles there are of each kind.
    """

    def __init__(self, units: Sequence[Unit], counts: Sequence[int], cost: RouteCost,
                 until: float) -> None:
        self._units = units
        self._counts = counts
        self._cost = cost
        self._until = until

    def mended(self, routes: Routes) -> Routes:
        """Return routes that break no rule, with as many of all as there is room and time for.

        Each is put where that costs least, and then moved for as long as that saves anything.
        """
        works = [VehicleWork(kind, self._kept(kind, jobs))
                 for kind, its_routes in routes.items() for jobs in its_routes]
        served = {job for work in works for job in work.jobs}
        for unit in self._units:
            if unit[0] not in served:
                _, works = self._with(works, unit) or (0, works)
        is_better = True
        while is_better and not self._is_over():
            before = works
            for unit in self._units:
                works = self._moved(works, unit)
            is_better = works != before
        found: dict[int, list[Sequence[int]]] = {}
        for work in works:
            if work.jobs:
                found.setdefault(work.kind, []).append(work.jobs)
        return found

    def _is_over(self) -> bool:
        return time.perf_counter() >= self._until

    def _price(self, work: VehicleWork) -> int | None:
        """Return what a vehicle's work costs; None if it breaks a rule."""
        return self._cost(work.kind, work.jobs) if work.jobs else 0

    def _kept(self, kind: int, jobs: Sequence[int]) -> tuple[int, ...]:
        """Return those of a route who can stay, one after another."""
        if self._cost(kind, tuple(jobs)) is not None:
            return tuple(jobs)
        stay: tuple[int, ...] = ()
        for unit in self._units:
            if unit[0] in jobs and not self._is_over():
                tried = tuple([job for job in jobs if job in stay or job in unit])
                stay = stay if self._cost(kind, tried) is None else tried
        return stay

    def _with(self, works: list[VehicleWork], unit: Unit) -> tuple[int, list[VehicleWork]] | None:
        """Return works with somebody more, where that costs least, and how much; None if nowhere.
        """
        used = Counter(work.kind for work in works)
        fresh = [VehicleWork(kind, ()) for kind, count in enumerate(self._counts)
                 if used[kind] < count]
        best: tuple[int, int, VehicleWork] | None = None
        for number, work in enumerate([*works, *fresh]):
            before = self._price(work)
            for jobs in _longer(work.jobs, unit):
                if self._is_over():
                    return None
                after = self._cost(work.kind, jobs)
                if before is not None and after is not None and (
                        best is None or after - before < best[0]):
                    best = after - before, number, VehicleWork(work.kind, jobs)
        if best is None:
            return None
        more, number, work = best
        return more, [*works[:number], work, *works[number + 1:]]

    def _moved(self, works: list[VehicleWork], unit: Unit) -> list[VehicleWork]:
        """Return works with somebody at a cheaper place, if there is one."""
        number = next((index for index, work in enumerate(works) if unit[0] in work.jobs), None)
        if number is None:
            return works
        work = works[number]
        less = VehicleWork(work.kind, tuple([job for job in work.jobs if job not in unit]))
        before, after = self._price(work), self._price(less)
        if before is None or after is None:
            return works
        found = self._with([*works[:number], less, *works[number + 1:]], unit)
        return works if found is None or found[0] >= before - after else found[1]


def _longer(jobs: tuple[int, ...], unit: Unit) -> Iterator[tuple[int, ...]]:
    """Yield a route with somebody more at all places."""
    for places in combinations_with_replacement(range(len(jobs) + 1), len(unit)):
        tried = list(jobs)
        for job, place in zip(unit[::-1], places[::-1], strict=True):
            tried.insert(place, job)
        yield tuple(tried)
