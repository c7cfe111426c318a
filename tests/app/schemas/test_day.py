import pytest

from app.schemas.day import Day, read_date_time

HOUR = 3600.0

SPRING = Day.of("2026-03-29T00:00", "Europe/Berlin")  # 02:00 becomes 03:00
AUTUMN = Day.of("2026-10-25T00:00", "Europe/Berlin")  # 03:00 becomes 02:00
MIDDAY = Day.of("2026-05-04T12:30:00+02:00", "Europe/Berlin")


@pytest.mark.parametrize(("day", "text", "hours"), [
    (SPRING, "01:30", 1.5),
    (SPRING, "07:30", 6.5),
    (SPRING, "02:30", 2.5),  # left out: by the offset before, 03:30
    (SPRING, "03:30", 2.5),
    (SPRING, "24:00", 23),
    (AUTUMN, "02:30", 2.5),  # comes twice: the first
    (AUTUMN, "02:30+01:00", 3.5),
    (AUTUMN, "07:30", 8.5),
    (AUTUMN, "24:00", 25),
    (AUTUMN, "2026-10-25T02:30:00+01:00", 3.5),
    (AUTUMN, "+1 06:00", 31),
    (MIDDAY, "12:30", 0),
    (MIDDAY, "08:00", -4.5),
    (MIDDAY, "+1 06:00", 17.5),
    (MIDDAY, "2026-05-04T18:00", 5.5),
    (MIDDAY, "2026-05-04T16:00Z", 5.5),
    (MIDDAY, "2026-05-04 18:00:00.250", 5.5 + 0.25 / HOUR),
    (Day.of("2026-03-08T05:00:00Z", "America/New_York"), "07:30", 6.5),  # of a day of 23 hours
    (Day.of("2026-11-01T04:00:00Z", "America/New_York"), "07:30", 8.5),
    (Day.of("2026-05-04T00:00", "Asia/Kathmandu"), "2026-05-04T00:00Z", 5.75),
    (Day.of("2026-05-04T23:00:00Z", "Pacific/Kiritimati"), "13:00", 0),  # the next day there
    (Day.of("2026-05-04T05:00:00+02:00", None), "07:30", 2.5),
])
def test_instants_are_seconds_since_plan_start(day: Day, text: str, hours: float) -> None:
    assert day.seconds_at(text) == pytest.approx(hours * HOUR, abs=1e-6)


@pytest.mark.parametrize("day", [SPRING, AUTUMN, MIDDAY])
def test_whatever_is_told_is_read_as_the_same_instant(day: Day) -> None:
    for seconds in [*range(0, 100_000, 599), 0.001, 27000.5, 7199.999]:
        assert day.seconds_at(day.iso(seconds)) == seconds
        assert day.seconds_at(day.clock(seconds)) == seconds


def test_wall_times_are_those_of_the_zone() -> None:
    assert [SPRING.clock(hours * HOUR) for hours in (1.5, 2.5, 23, 29)] == [
        "01:30:00", "03:30:00", "+1 00:00:00", "+1 06:00:00"]
    assert [AUTUMN.clock(hours * HOUR) for hours in (2.5, 3.5)] == [
        "02:30:00", "02:30:00+01:00"]
    assert AUTUMN.iso(3.5 * HOUR) == "2026-10-25T02:30:00+01:00"
    assert MIDDAY.iso(0.25) == "2026-05-04T12:30:00.250+02:00"


@pytest.mark.parametrize("text", ["25:00", "24:01", "7:5", "07:60", "7", "", "noon", "+1 24:30",
                                  "9999-12-31T23:59-12:00", "0001-01-01T00:00+14:00",
                                  "2026-05-04", "2026-13-04T06:00", "1700000000", "07:30 +1"])
def test_what_is_no_instant_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"no hour|no date|month must|the year"):
        MIDDAY.seconds_at(text)


@pytest.mark.parametrize(("plan_start", "time_zone"), [
    ("2026-05-04T06:00", None), ("2026-05-04T06:00Z", "Europe/Berlinn"), ("2026-05-04", "UTC"),
    ("1700000000", "UTC"), ("9999-12-31T23:00Z", "UTC"), ("2026-05-04T06:00Z", "../etc/passwd"),
    ("9999-12-31T23:00-12:00", "UTC"), ("0001-01-01T00:00+14:00", None),
])
def test_what_is_no_day_is_refused(plan_start: str, time_zone: str | None) -> None:
    with pytest.raises(ValueError, match=r"no date|no time zone|start: "):
        Day.of(plan_start, time_zone)


def test_dates_keep_the_offset_that_they_state() -> None:
    assert read_date_time("2026-05-04T06:00").tzinfo is None
    assert read_date_time("2026-05-04T06:00+02:00").isoformat() == "2026-05-04T06:00:00+02:00"
