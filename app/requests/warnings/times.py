"""Warnings about times: minutes or hours where seconds are meant, windows nobody works in."""

from typing import NamedTuple

import numpy as np

from app.requests.warnings.survey import SLOWEST_KMH, Survey
from app.requests.warnings.warning import Path, Warnings, amount_text, customers_text, warning_at
from app.schemas.vehicle import VehicleTypeInput
from app.schemas.written import moved_end
from model.problem import BoolArray, FloatArray

MOST_HOURS, MOST_MINUTES = 48.0, 2880.0
"""Two days: what is later is no hour or minute of a plan's day."""

FOUR_OCLOCK = 4.0
"""Hours; windows of a working day open later."""

LATE_SHARE, MENDED_SHARE = 0.5, 0.1
"""Share of customers with windows who can't be reached in time as it is stated, at least; and in
another unit, at most."""

DAY = 86_400.0

SHORT_SERVICE, SHORTEST_SERVICES = 60.0, 20.0
"""Seconds that no service exceeds, and its median, if they look like minutes."""

LONG_SERVICE = 6 * 3600.0
"""Median of services, in seconds, that looks like milliseconds."""

LEAST_SERVICES = 3

SHORT_ENDURANCE, SHORTEST_ENDURANCE = 120.0, 2.0
"""Seconds of flight that look like minutes, and like hours."""

LEAST_MILLISECONDS, MOST_MILLISECONDS = 1e7, 2 * DAY * 1000
"""Seconds in which windows end, half of them, that look like milliseconds."""


class MistakenUnit(NamedTuple):
    """What seconds may be mistaken for."""

    name: str
    seconds: float
    step: float  # what times of day are multiples of


HOURS = MistakenUnit("hours", 3600.0, 0.25)
MINUTES = MistakenUnit("minutes", 60.0, 5.0)


def time_warnings(survey: Survey) -> Warnings:
    """Yield warnings about windows, services, shifts and flights."""
    if not survey.customers:
        return
    unit = _windows_unit(survey)
    shifts = [warning for index, kind in enumerate(survey.request.fleet)
              for warning in _shift(survey, index, kind)]
    if unit is not None:
        yield from _windows(survey, unit)
    elif not shifts:
        yield from _outside_shifts(survey)
    yield from _nights(survey)
    yield from _services(survey)
    yield from shifts
    for index, kind in enumerate(survey.request.fleet):
        yield from _working(survey, index, kind)
        yield from _endurance(index, kind)


def _windows_unit(survey: Survey) -> MistakenUnit | None:
    """Return what windows are stated in, if hardly in seconds."""
    has_end = survey.has_end
    if not has_end.any():
        return None
    latest, earliest = survey.latest[has_end], survey.earliest[has_end]
    unit = _unit_of(float(latest.max()))
    if unit is None:
        return None
    start = min((kind.shift.earliest for kind in survey.request.fleet), default=0.0)
    late = start + survey.seconds[has_end] > latest
    mended = survey.seconds[has_end] > latest * unit.seconds
    if late.mean() >= LATE_SHARE and mended.mean() <= MENDED_SHARE:
        return unit
    opens = earliest * unit.seconds >= FOUR_OCLOCK * 3600
    round_times = bool((_round(earliest, unit) & _round(latest, unit)).all())
    is_day = latest.max() * unit.seconds <= DAY
    return unit if survey.is_lifelike and round_times and is_day and opens.mean() >= 0.5 else None


def _unit_of(longest: float) -> MistakenUnit | None:
    if longest <= MOST_HOURS:
        return HOURS
    return MINUTES if longest <= MOST_MINUTES else None


def _round(times: FloatArray, unit: MistakenUnit) -> BoolArray:
    return np.abs(times / unit.step - np.round(times / unit.step)) < 1e-9


def _windows(survey: Survey, unit: MistakenUnit) -> Warnings:
    index = int(survey.has_end.argmax())
    earliest, latest = float(survey.earliest[index]), float(survey.latest[index])
    count = customers_text(int(survey.has_end.sum()), len(survey.customers), "have", "has")
    yield warning_at(
        f"WINDOWS_LOOK_LIKE_{unit.name.upper()}", _window_path(survey, index),
        f"{count} windows, which all end within "
        f"{amount_text(float(survey.latest[survey.has_end].max()))} s of plan start, such as "
        f"{survey.customers[index].id!r}: {earliest:g} to {latest:g}. Times are seconds since plan "
        f"start: if these are {unit.name}, write "
        f"{earliest * unit.seconds:.0f} and {latest * unit.seconds:.0f}.")


def _window_path(survey: Survey, index: int) -> Path:
    several = survey.customers[index].time_windows is not None
    return ("customers", index, "time_windows" if several else "time_window")


def _nights(survey: Survey) -> Warnings:
    """Yield a warning if times of day were read as of the day after."""
    moved = [(index, end) for index, windows in enumerate(survey.windows)
             for end in map(moved_end, windows) if end is not None]
    if moved:
        (index, end), count = moved[0], len({index for index, _ in moved})
        yield warning_at(
            "WINDOWS_OF_NEXT_DAY", _window_path(survey, index),
            f"{customers_text(count, len(survey.customers), 'have', 'has')} windows that end "
            "before any shift begins, and are read as of the day after, such as "
            f"{survey.customers[index].id!r}: until {end.text}. Write +1 {end.text} to say so.")


def _outside_shifts(survey: Survey) -> Warnings:
    """Yield a warning if half of all windows are when nobody works, or in milliseconds."""
    ends = survey.latest[survey.has_end]
    if len(ends) and survey.is_lifelike and (
            LEAST_MILLISECONDS <= float(np.median(ends)) <= MOST_MILLISECONDS):
        index = int(survey.has_end.argmax())
        yield warning_at(
            "WINDOWS_LOOK_LIKE_MILLISECONDS", _window_path(survey, index),
            f"Half of all windows end more than {LEAST_MILLISECONDS / DAY:.0f} days after plan "
            f"start, such as {survey.customers[index].id!r}: {survey.latest[index]:.0f}. Times are "
            "seconds since plan start: divide milliseconds by 1000.")
        return
    is_open = np.zeros(len(survey.customers), bool)
    for kind in survey.request.fleet:
        end = kind.shift.latest
        latest = np.inf if end is None or kind.overtime is not None else end
        is_open |= (survey.earliest <= latest) & (survey.latest >= kind.shift.earliest)
    is_stated = survey.has_end | (survey.earliest > 0)
    closed = ~is_open & is_stated
    if closed.sum() > LATE_SHARE * is_stated.sum():
        index = int(closed.argmax())
        yield warning_at(
            "WINDOWS_OUTSIDE_SHIFTS", _window_path(survey, index),
            f"{customers_text(int(closed.sum()), len(closed), 'have', 'has')} windows in which no "
            f"vehicle works, such as {survey.customers[index].id!r}: {_span(survey, index)}. "
            "Windows and shifts count seconds from the same plan start: state both so.")


def _span(survey: Survey, index: int) -> str:
    latest = survey.latest[index]
    return f"{survey.earliest[index]:g} to {latest:g}" if np.isfinite(latest) else (
        f"from {survey.earliest[index]:g} on")


def _services(survey: Survey) -> Warnings:
    services = np.array([customer.service_duration for customer in survey.customers], float)
    some = services[services > 0]
    if len(some) < LEAST_SERVICES or not survey.is_lifelike:
        return
    index, middle, longest = int((services > 0).argmax()), float(np.median(some)), some.max()
    path: Path = ("customers", index, "service_duration")
    if longest <= SHORT_SERVICE and middle <= SHORTEST_SERVICES:
        yield warning_at(
            "SERVICE_LOOKS_LIKE_MINUTES", path,
            f"Services take {middle:g} s, half of them, and {longest:g} s at most. "
            f"service_duration is in seconds: if these are minutes, write {middle * 60:g} for "
            f"{middle:g}.")
    elif middle > LONG_SERVICE:
        yield warning_at(
            "SERVICE_LOOKS_LIKE_MILLISECONDS", path,
            f"Half of all services take {amount_text(middle / 3600)} h or longer. "
            "service_duration is in seconds: divide milliseconds by 1000.")


def _shift(survey: Survey, index: int, kind: VehicleTypeInput) -> Warnings:
    earliest, latest = kind.shift.earliest, kind.shift.latest
    if latest is None or not survey.is_lifelike:
        return
    path: Path = ("fleet", index, "shift", "latest")
    unit = _unit_of(latest)
    if unit is not None and (_is_clock(earliest, unit) or _too_short(survey, latest - earliest)):
        yield warning_at(
            f"SHIFT_LOOKS_LIKE_{unit.name.upper()}", path,
            f"Vehicles of type {kind.id!r} work from {earliest:g} to {latest:g} s after plan "
            f"start, {amount_text(latest - earliest)} s in all. If these are {unit.name}, write "
            f"{earliest * unit.seconds:.0f} and {latest * unit.seconds:.0f}.")
    longest = kind.max_working_duration
    if latest - earliest > DAY and (longest is None or longest > DAY):
        yield warning_at(
            "SHIFT_LONGER_THAN_A_DAY", path,
            f"Vehicles of type {kind.id!r} may work {amount_text((latest - earliest) / 3600)} h "
            "without a break: shift is in seconds since plan start. State max_working_duration if "
            "that is meant.")


def _is_clock(earliest: float, unit: MistakenUnit) -> bool:
    """Tell whether a shift begins at an hour when people begin to work, in a unit."""
    return FOUR_OCLOCK * 3600 <= earliest * unit.seconds < DAY and bool(
        _round(np.array([earliest]), unit)[0])


def _too_short(survey: Survey, seconds: float) -> bool:
    """Tell whether half of all customers can't be visited within a time."""
    there_and_back = 2 * survey.seconds[np.isfinite(survey.seconds)]
    return len(there_and_back) > 0 and float(np.median(there_and_back)) > seconds


def _working(survey: Survey, index: int, kind: VehicleTypeInput) -> Warnings:
    longest = kind.max_working_duration
    if longest is None or not survey.is_lifelike:
        return
    unit = _unit_of(longest)
    is_usual = unit is not None and longest * unit.seconds >= FOUR_OCLOCK * 3600 and bool(
        _round(np.array([longest]), unit._replace(step=unit.step * 2))[0])
    if unit is not None and (is_usual or _too_short(survey, longest)):
        yield warning_at(
            f"WORKING_DURATION_LOOKS_LIKE_{unit.name.upper()}",
            ("fleet", index, "max_working_duration"),
            f"Vehicles of type {kind.id!r} work {longest:g} s at most. If these are {unit.name}, "
            f"write {longest * unit.seconds:.0f}.")


def _endurance(index: int, kind: VehicleTypeInput) -> Warnings:
    for inner, drones in kind.flyers_by_path:
        endurance = drones.endurance
        slow = drones.speed_kmh is not None and drones.speed_kmh < SLOWEST_KMH
        if endurance is None or slow or not drones.count or not 0 < endurance <= SHORT_ENDURANCE:
            continue
        unit = HOURS if endurance <= SHORTEST_ENDURANCE else MINUTES
        yield warning_at(
            f"ENDURANCE_LOOKS_LIKE_{unit.name.upper()}", ("fleet", index, *inner, "endurance"),
            f"Drones of {kind.id!r} fly {endurance:g} s at most. endurance is in seconds: if these "
            f"are {unit.name}, write {endurance * unit.seconds:.0f}.")
