"""Several windows, and such as end on the day after, as shifts may."""

import pytest

from tests.app.formats.sheets.test_importing import codes, read

pytestmark = pytest.mark.slow


def test_a_window_over_midnight_ends_on_the_day_after() -> None:
    reply = read("A,1,1,22:00,6:00", "B,2,2,17:00,+1 02:00", head="name,x,y,from,to")
    assert reply.request is not None
    ends = [customer["time_window"]["latest"] for customer in reply.request["customers"]]
    assert ends == [30 * 3600, 26 * 3600]
    assert "PAST_MIDNIGHT" in codes(reply)


def test_a_window_that_ends_before_it_begins_is_refused_with_what_to_write() -> None:
    reply = read("A,1,1,8:00,7:00", "B,2,2,8:00,4:00", head="name,x,y,from,to")
    assert [(error.cell, error.message.split("write ")[1]) for error in reply.errors] == [
        ("E2", "19:00 if that is meant."), ("E3", "16:00 if that is meant.")]


@pytest.mark.parametrize(("shift", "latest"), [
    ("21:00-6:00", 30), ("22-5", 29), ("18:00-0:30", 24.5), ("21:00-30:00", 30),
    ("21:00 - +1 06:00", 30)])
def test_a_shift_of_a_night_ends_on_the_day_after(shift: str, latest: float) -> None:
    reply = read(shift=shift)
    assert reply.request is not None
    assert reply.request["fleet"][0]["shift"]["latest"] == latest * 3600
    [doubt] = [doubt for doubt in reply.doubts if doubt.code == "SHIFT_OVERNIGHT"]
    assert "+1 0" in doubt.message


def test_a_shift_that_can_be_no_night_is_refused_in_clock_times() -> None:
    reply = read(shift="17:00-8:00")
    [error] = reply.errors
    assert error.code == "SHIFT_ENDS_BEFORE_START"
    assert "32:00" in error.message
    assert "+1 08:00" in error.message


def test_customers_have_several_windows_in_columns_of_their_own() -> None:
    reply = read("A,1,1,8:00,10:00,14:00,16:00", "B,2,2,9:00,12:00,,",
                 head="name,x,y,open 1,close 1,open 2,close 2")
    assert reply.request is not None
    first, second = reply.request["customers"]
    assert first["time_windows"] == [{"earliest": 28800, "latest": 36000},
                                     {"earliest": 50400, "latest": 57600}]
    assert second["time_window"] == {"earliest": 32400, "latest": 43200}


def test_a_window_of_the_small_hours_is_on_the_day_after_in_a_shift_of_the_night() -> None:
    reply = read("A,1,1,3:00,5:30,", "B,2,2,22:00,23:00,", "C,3,3,3:00,6:30,",
                 "D,4,4,0:30,1:30,5", head="name,x,y,from,to,late cost", shift="21:00-6:00")
    assert reply.request is not None
    windows = [customer["time_window"] for customer in reply.request["customers"]]
    assert windows[0] == {"earliest": 27 * 3600, "latest": 29.5 * 3600}
    assert windows[1] == {"earliest": 22 * 3600, "latest": 23 * 3600}
    # Half of it is after the shift: which day is meant can't be told.
    assert windows[2] == {"earliest": 3 * 3600, "latest": 6.5 * 3600}
    assert windows[3] == {"earliest": 24.5 * 3600, "latest": 25.5 * 3600,
                          "late_cost_per_hour": 5}
    [doubt] = [doubt for doubt in reply.doubts if doubt.code == "NEXT_NIGHT"]
    assert doubt.cell == "D2"
    assert doubt.message == ("2 windows are taken for the day after, since nobody works before "
                             "21:00: such as D2 from +1 03:00.")


def test_windows_of_both_sides_of_midnight_stay_in_order() -> None:
    reply = read("A,1,1,1:00,2:00,22:00,23:00", "B,1,1,22:00,24:00,0:00,2:00",
                 head="name,x,y,open 1,close 1,open 2,close 2", shift="21:00-6:00")
    assert reply.request is not None
    first, second = reply.request["customers"]
    assert first["time_windows"] == [{"earliest": 22 * 3600, "latest": 23 * 3600},
                                     {"earliest": 25 * 3600, "latest": 26 * 3600}]
    assert second["time_window"] == {"earliest": 22 * 3600, "latest": 26 * 3600}


@pytest.mark.parametrize("shift", ["8:00-17:00", "2:00-12:00"])
def test_windows_before_a_shift_of_the_day_stay(shift: str) -> None:
    reply = read("A,1,1,0:30,1:30", head="name,x,y,from,to", shift=shift)
    assert reply.request is not None
    assert reply.request["customers"][0]["time_window"]["latest"] == 5400
    assert "NEXT_NIGHT" not in codes(reply)


@pytest.mark.parametrize("cells", [
    ("22:00,2:00", "1:00,5:00", "23:00,4:00"), ("20:00,23:30", "1:00,5:00", "22:00,24:00")])
def test_windows_of_one_night_follow_each_other_where_no_shift_is_stated(
        cells: tuple[str, ...]) -> None:
    reply = read(*(f"{name},1,1,{cell}" for name, cell in zip("ABC", cells, strict=True)),
                 head="name,x,y,from,to")
    assert reply.request is not None
    windows = [customer["time_window"] for customer in reply.request["customers"]]
    assert windows[1] == {"earliest": 25 * 3600, "latest": 29 * 3600}
    assert "NEXT_NIGHT" in codes(reply)


def test_a_morning_among_windows_of_the_day_stays_in_the_morning() -> None:
    reply = read("A,1,1,22:00,2:00", "B,1,1,1:00,5:00", "C,1,1,9:00,12:00",
                 head="name,x,y,from,to")
    assert reply.request is not None
    assert reply.request["customers"][1]["time_window"] == {"earliest": 3600, "latest": 18000}


@pytest.mark.parametrize("cell", [
    "2026-06-10 09:00 - 10:00", "2026-06-10 09:00-10:00", "2026-06-10 09:00-2026-06-10 10:00",
    "10.06.2026 9-10", "10.06.2026, 9-10 Uhr", "Mi 10.06.2026 9:00-10:00",
    "Wed, 2026-06-10 9:00 to 10:00", "06/10/2026 9:00 AM-10:00 AM"])
def test_a_window_has_its_date_inside_its_cell(cell: str) -> None:
    reply = read(f'A,1,1,"{cell}"', f'B,2,2,"{cell}"', head="name,x,y,window")
    assert reply.request is not None, reply.errors
    assert reply.request["customers"][0]["time_window"] == {"earliest": 32400, "latest": 36000}
    assert reply.day == "2026-06-10"
    assert "ZONE_NOT_READ" not in codes(reply)


def test_a_window_of_the_day_after_counts_from_the_day_that_is_planned() -> None:
    reply = read("A,1,1,2026-06-10 09:00-10:00", "B,2,2,2026-06-11 01:00-02:00",
                 head="name,x,y,window")
    assert reply.request is not None, reply.errors
    assert reply.request["customers"][1]["time_window"] == {"earliest": 90000, "latest": 93600}
