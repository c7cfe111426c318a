"""What may come, drawn from past days or from rates by area and hour."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from model.problem import MS_PER_HOUR, UNLIMITED, Customer
from model.search.waves.future import Coming, Forecast


@dataclass(frozen=True, slots=True)
class PastOrder:
    """An order of a past day, in times since that day's start."""

    node: int  # of its place in the problem
    placed_at: int  # ms
    customer: Customer


@dataclass(frozen=True)
class AreaRate:
    """How many orders an area places, in part of a day."""

    since: int  # ms
    until: int
    per_hour: float
    like: tuple[tuple[int, Customer], ...]
    """Nodes and orders of which each is like one, windows and release in ms since it is placed."""


def by_past_days(days: Sequence[Sequence[PastOrder]], now: int, until: int) -> Forecast:
    """Return a forecast that one of some past days comes again, from `now` on.

    Raises
    ------
    ValueError
        If there is no past day.
    """
    if not days:
        raise ValueError("days: none is not allowed")

    def draw(rng: np.random.Generator) -> list[Coming]:
        day = days[int(rng.integers(len(days)))]
        return [Coming(each.node, each.customer, max(each.placed_at, each.customer.release_time))
                for each in day if now < each.placed_at <= until]

    return draw


def by_rates(rates: Sequence[AreaRate], now: int, until: int) -> Forecast:
    """Return a forecast by which orders come by chance, as often as rates say."""
    def draw(rng: np.random.Generator) -> list[Coming]:
        return [each for rate in rates for each in _drawn(rate, now, until, rng)]

    return draw


def _drawn(rate: AreaRate, now: int, until: int, rng: np.random.Generator) -> Iterator[Coming]:
    begin, end = max(rate.since, now), min(rate.until, until)
    number = rng.poisson(rate.per_hour * max(0, end - begin) / MS_PER_HOUR)
    for placed_at in sorted(rng.integers(begin, end, number).tolist() if number else ()):
        node, like = rate.like[int(rng.integers(len(rate.like)))]
        latest = like.latest if like.latest >= UNLIMITED else placed_at + like.latest
        gaps = tuple([(placed_at + closes, placed_at + opens) for closes, opens in like.gaps])
        order = replace(like, earliest=placed_at + like.earliest, latest=latest, gaps=gaps)
        yield Coming(node, order, placed_at + like.release_time)
