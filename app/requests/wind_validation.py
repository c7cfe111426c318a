"""What the schema can't tell of the wind."""

from itertools import pairwise

from app.requests.conversion.winds import hour_of
from app.requests.draft import Draft, Errors, Path, error_at
from app.schemas.day import Day
from app.schemas.wind import ForecastInput, OpenMeteoInput

WIND: Path = ("airspace", "wind")


def wind_errors(draft: Draft) -> Errors:
    """Say what is wrong with wind by the hour."""
    wind = None if draft.airspace is None else draft.airspace.wind
    if isinstance(wind, ForecastInput):
        if draft.day is None:
            yield error_at("MISSING_PLAN_START", (*WIND, "open_meteo"),
                           "A forecast tells instants, which mean something only with plan_start: "
                           "add it.")
        else:
            yield from _forecast_errors(wind.open_meteo, draft.day)
    elif isinstance(wind, list):
        for index, (earlier, later) in enumerate(pairwise(wind), 1):
            # Hours that begin before the plan are told from its start on, several maybe.
            if later.from_time < earlier.from_time or later.from_time == earlier.from_time > 0:
                yield error_at("WIND_ORDER", (*WIND, index, "from"),
                               "The hour begins no later than the one before it: sort the hours by "
                               "from, each time once.")


def _forecast_errors(stated: OpenMeteoInput, day: Day) -> Errors:
    path, hourly = (*WIND, "open_meteo", "hourly"), stated.hourly
    lists = {"wind_speed_10m": hourly.wind_speed_10m,
             "wind_direction_10m": hourly.wind_direction_10m,
             **({"wind_gusts_10m": hourly.gusts} if hourly.gusts else {})}
    if not hourly.time:
        yield error_at("WIND_HOURS", (*path, "time"), "There is no hour: ask for some days more.")
    for name, values in lists.items():
        if len(values) != len(hourly.time):
            yield error_at("WIND_HOURS", (*path, name),
                           f"There are {len(values)} values for {len(hourly.time)} hours: state "
                           "one each.")
            return
        unknown = [index for index, value in enumerate(values) if value is None]
        if unknown:
            yield error_at("WIND_HOURS", (*path, name, unknown[0]),
                           "Nothing is known of this hour: leave it out, with its time, or ask for "
                           "fewer days." if name != "wind_gusts_10m" else
                           "Gusts are known of other hours, and not of this one: leave the hour "
                           "out of all lists, or wind_gusts_10m as a whole.")
    last = None
    for index, time in enumerate(hourly.time):
        try:
            begin = hour_of(time, stated.utc_offset_seconds, day)
        except (ValueError, OverflowError, OSError):
            yield error_at("WIND_HOURS", (*path, "time", index),
                           "This is no hour: state a date and time such as 2026-03-29T07:00, or "
                           "Unix time.")
            return
        if last is not None and begin <= last:
            yield error_at("WIND_ORDER", (*path, "time", index),
                           "The hour begins no later than the one before it: sort the hours by "
                           "time, each once.")
            return
        last = begin
