"""Zones with hours: those that hold places, which are flown to and from while they are open."""

from collections.abc import Sequence
from datetime import timedelta
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from app.maps.airspace.applying import NEVER_ENDS, PlannedSpan, closed_times
from app.requests.conversion.zones import Met, ZoneVolume
from app.schemas.day import Day
from model.problem import MAX_CLOSINGS, UNLIMITED, Closings, IntArray

MOST_HOURS = 3
"""Zones whose hours are told apart, by the most places held; others are closed all day. Legs are
looked for once for each set of those that are open."""

Times = tuple[tuple[int, int], ...]
"""From and until when a zone is closed, in ms since plan start, ascending."""


class Hours(NamedTuple):
    """Zones with the same hours that hold some places."""

    times: Times
    parts: frozenset[ZoneVolume]


class Closed(NamedTuple):
    """What drones at an altitude meet, and when they don't."""

    met: Met
    hours: tuple[Hours, ...]
    first_bit: int  # by which the first of the hours is told from all others
    zones: IntArray  # (place,) those of `hours` that hold each, as bits from 0

    def open_to(self, zones: int) -> Met:
        """Return what is met while some of the zones with hours are open."""
        opened = frozenset[ZoneVolume]().union(*[each.parts for bit, each in enumerate(self.hours)
                                                 if zones >> bit & 1])
        return Met(*(tuple(part for part in parts if part not in opened) for parts in self.met))

    def together(self) -> list[int]:
        """Return the sets of zones that both ends of any flight lie in, as bits; 0 among them."""
        held = np.unique(self.zones)
        return np.unique([0, *(held[:, None] | held).ravel()]).tolist()

    def closings(self) -> Closings:
        """Return when nothing may fly to or from zones, told by bits of their own."""
        found = [(each.times, 1 << self.first_bit + bit) for bit, each in enumerate(self.hours)]
        while sum([len(times) for times, _ in found]) > MAX_CLOSINGS:
            _, number, at = min((later[0] - earlier[1], number, at)
                                for number, (times, _) in enumerate(found)
                                for at, (earlier, later) in enumerate(pairwise(times)))
            times, zones = found[number]
            together = (times[at][0], times[at + 1][1])
            found[number] = ((*times[:at], together, *times[at + 2:]), zones)
        return tuple(sorted([(begin, end, zones) for times, zones in found
                             for begin, end in times]))


def times_closed(part: ZoneVolume, day: Day | None, span: PlannedSpan | None) -> Times | None:
    """Return when a zone is closed to flights; None: whenever the plan lasts, and ever after."""
    if day is None or span is None or not part.zone.is_timed:
        return None
    times = tuple([(max(0, _ms(begin - day.start)),
                    UNLIMITED if end == NEVER_ENDS else min(UNLIMITED, -_ms(day.start - end)))
                   for begin, end in closed_times(part.zone.periods, span)])
    begun = max(0, _ms(span.begin - day.start))
    return None if any(begin <= begun and end >= UNLIMITED for begin, end in times) else times


def _ms(length: timedelta) -> int:
    return length // timedelta(milliseconds=1)


def most_holding(found: Sequence[tuple[int, Hours]]) -> tuple[Hours, ...]:
    """Return the hours that hold the most places, each given with their number."""
    return tuple([hours for _, hours in sorted(found, key=lambda each: -each[0])[:MOST_HOURS]])
