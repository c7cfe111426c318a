"""A second judge of hours at the wheel, written from the regulations alone.

Regulation (EC) 561/2006, articles 4, 6 and 7: after four and a half hours at the wheel a break of
45 minutes, or one of 15 and, later, one of 30 within them; nine hours a day. Directive 2002/15/EC,
article 5: no more than six hours of work in a row, of which pauses of less than 15 minutes are a
part. 49 CFR 395.3: eleven hours at the wheel, within fourteen hours, and after eight half an hour
in which nobody drives, whatever else is done.

It shares nothing with the judge of plans but what a plan is.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from model.solution import Route

Activity = tuple[Literal["drive", "work", "rest"], int, int]


@dataclass(frozen=True)
class Law:
    """Lengths in ms; `None` where the law says nothing."""

    wheel: int  # accumulated at the wheel
    pause: int
    parts: tuple[int, int] | None = None
    day: int | None = None  # at the wheel in all
    labour: int | None = None  # in a row
    stands: bool = False  # whether not to drive for as long as a pause is as good as one


def record_of(route: Route) -> list[Activity]:
    """Return what a tachograph writes down."""
    found: list[Activity] = []
    now = route.trips[0].stops[0].arrival
    for trip in route.trips:
        for number, stop in enumerate(trip.stops):
            if number:
                for pause in [each for each in trip.breaks if each.stop == number - 1]:
                    found += [("drive", now, pause.arrival), ("work", pause.arrival, pause.start),
                              ("rest", pause.start, pause.end)]
                    now = pause.end
                found.append(("drive", now, stop.arrival))
                now = stop.arrival
            found.append(("work", now, stop.departure))
            now = stop.departure
    return [each for each in found if each[2] > each[1]]


def offences(route: Route, law: Law, driven: int = 0, worked: int = 0,
             begun: bool = False) -> Iterator[str]:
    """Yield what is against the law on a route, as far as a driver had driven and worked before.

    A pause may have `begun` with its first part.
    """
    yield from broken_laws(record_of(route), law, driven, worked, begun)


def broken_laws(record: Sequence[Activity], law: Law, driven: int = 0,
                worked: int = 0, begun: bool = False) -> Iterator[str]:
    """Yield what is against the law of what was written down."""
    wheel = sum([end - begin for what, begin, end in record if what == "drive"])
    if law.day is not None and driven + wheel > law.day:
        yield "day"
    # Where all that was driven before is over: behind each rest, or pair of them, in turn.
    period, labour, first_part, stood = driven, worked, begun, 0
    for what, begin, end in record:
        length = end - begin
        if what == "drive":
            period, stood = 0 if law.stands and stood >= law.pause else period, 0
        else:
            stood += length
        if what != "rest":
            labour += length
            period += length if what == "drive" else 0
            if period > law.wheel:
                yield "wheel"
            if law.labour is not None and labour > law.labour:
                yield "labour"
        elif length >= min(law.pause, law.parts[1] if law.parts and first_part else law.pause):
            period, labour, first_part = 0, 0, False
        elif law.parts is not None and length >= law.parts[0]:
            first_part = True
        else:
            labour += length
