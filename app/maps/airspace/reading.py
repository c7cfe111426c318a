"""Zones from what was published, and what of it can't be read."""

from collections.abc import Iterable, Sequence

from app.maps.airspace.applying import (
    ALL_DAYS, ALWAYS, EVER, NEVER_ENDS, WEEKDAYS, Period, WeeklyHours, read_clock, read_instant,
)
from app.maps.airspace.faults import Fault, Path, Reading
from app.maps.airspace.kml import KmlError, kml_areas
from app.maps.airspace.volumes import ed269_volumes, geojson_volumes, kml_volumes
from app.maps.airspace.zone import Volume, Zone
from app.schemas.zones.ed269 import UasZone
from app.schemas.zones.geojson import (
    Ed318Feature, Ed318Properties, PlainFeature, PlainProperties,
)
from app.schemas.zones.parts import Authority, DailyPeriod, TimePeriod
from app.schemas.airspace import Ed269Zones, KmlZones, Zones


def read_zones(stated: Zones) -> Reading:
    """Return what stated zones hold."""
    reading = Reading()
    if isinstance(stated, KmlZones):
        _read_kml(stated.data, reading)
    elif isinstance(stated, Ed269Zones):
        for index, zone in enumerate(stated.data.features):
            path = ("features", index)
            _add_zone(zone, ed269_volumes(zone, path, reading), path, reading)
    else:
        features: Sequence[Ed318Feature | PlainFeature] = stated.data.features
        for index, feature in enumerate(features):
            path = ("features", index)
            known = feature.properties or PlainProperties()
            if known.identifier is None and isinstance(feature, PlainFeature):
                known = known.model_copy(update={"identifier": feature.id})
            _add_zone(known, geojson_volumes(feature, path, reading), path, reading)
    return reading


def _add_zone(known: UasZone | Ed318Properties | PlainProperties, volumes: Iterable[Volume],
              path: Path, reading: Reading) -> None:
    found = tuple(volumes)
    if found:
        periods = tuple(_period(period, path, reading) for period in known.applicability)
        reading.zones.append(Zone(
            known.identifier, known.name, known.restriction, found, known.country, known.message,
            authority_of(known.authorities), periods))


def authority_of(stated: Iterable[Authority]) -> str | None:
    """Return who decides, by name, and where they can be asked."""
    told = []
    for each in stated:
        name = each.name or each.service or each.contact_name
        where = next(filter(None, (each.email, each.phone, each.site_url)), None)
        told.append(", ".join(filter(None, (name, where))))
    return " / ".join(dict.fromkeys(filter(None, told))) or None


def _period(stated: TimePeriod, path: Path, reading: Reading) -> Period:
    """Return when a zone applies: always, if that can't be read."""
    if (stated.permanent or "").strip().upper() == "YES":
        return ALWAYS
    try:
        return Period(
            EVER if stated.start is None else read_instant(stated.start),
            NEVER_ENDS if stated.end is None else read_instant(stated.end),
            tuple(_hours(daily) for daily in stated.schedule or ()))
    except (ValueError, OverflowError):
        reading.doubts.append(Fault(path, "Its times can't be read, so it applies always."))
        return ALWAYS


def _hours(stated: DailyPeriod) -> WeeklyHours:
    days = ALL_DAYS if not stated.day or "ANY" in stated.day else frozenset(
        WEEKDAYS.index(day) for day in stated.day)
    begin = None if stated.start_time is None else read_clock(stated.start_time)
    end = None if stated.end_time is None else read_clock(stated.end_time)
    # Where daylight begins or ends it, from or to midnight.
    return WeeklyHours(days, begin or WeeklyHours().begin, end)


def _read_kml(text: str, reading: Reading) -> None:
    try:
        marks = kml_areas(text)
    except KmlError as error:
        reading.faults.append(Fault((), str(error)))
        return
    for mark in marks:
        volumes = tuple(kml_volumes(mark, reading))
        if volumes:
            reading.zones.append(Zone(mark.identifier, mark.name, "PROHIBITED", volumes))
