"""Drivers who go on with their day: breaks that are left of it, and how long they have worked."""

from dataclasses import replace

from model.judge.breaks import begin_of, window_of
from model.judge.driving import driver_after
from model.problem import UNLIMITED, Break, DrivingRules, VehicleType
from model.solution import Route


def has_clock(kind: VehicleType) -> bool:
    """Tell whether it counts since when a driver has worked."""
    return bool(kind.breaks) or kind.driving is not None


def with_clock(kind: VehicleType, own: VehicleType, done: Route, home: int) -> VehicleType | None:
    """Return a vehicle that has worked until it was at `home`; None if it can't drive any more.

    `own` is what it is from then on, and `kind` what it was.
    """
    if not has_clock(kind):
        return own
    driving = None if kind.driving is None else _driving_left(kind, kind.driving, done, home)
    if kind.driving is not None and driving is None:
        return None
    return replace(own, works_since=home, breaks=_breaks_left(kind, done, home), driving=driving)


def _breaks_left(kind: VehicleType, done: Route, home: int) -> tuple[Break, ...]:
    """Return a driver's breaks, those that are taken, or can't be any more, without a length.

    What is over before a route begins isn't due on it, and numbers stay.
    """
    begin = begin_of(kind, done.trips[0])
    last = max([taken.number for trip in done.trips for taken in trip.breaks], default=-1)
    left = []
    for number, each in enumerate(kind.breaks):
        earliest, latest = window_of(each, begin)
        is_over = number <= last or latest < home or earliest + each.duration <= begin
        left.append(replace(
            each, after_departure=False, duration=0 if is_over else each.duration,
            earliest=0 if is_over else min(UNLIMITED, max(earliest, home)),
            latest=0 if is_over else min(UNLIMITED, latest)))
    return tuple(left)


def _driving_left(kind: VehicleType, rules: DrivingRules, done: Route,
                  home: int) -> DrivingRules | None:
    driver = driver_after(rules, kind, done.trips)
    day = rules.max_driving_per_day
    driven = driver.driven_by(home)
    if day < UNLIMITED:
        day -= driver.day - driven
    if day < driven:
        return None
    return replace(rules, max_driving_per_day=day, driven_before=driven,
                   worked_before=max(0, driver.worked(home)),
                   half_rested_before=driver.is_half_rested)
