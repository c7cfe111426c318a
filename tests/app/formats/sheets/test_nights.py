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
