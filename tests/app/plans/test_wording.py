"""Messages of the judge in clocks, hours and minutes."""

import pytest

from app.plans.telling import length, wording


def clock(seconds: float) -> str:
    return f"{int(seconds) // 3600}:{int(seconds) // 60 % 60:02}"


@pytest.mark.parametrize(("said", "told"), [
    ("begins at 28800 s, before 30600 s", "begins at 8:00, before 8:30"),
    ("customer A is reached at 36000 s, after 35000.5 s", "customer A is reached at 10:00, after "
                                                         "9:43"),
    ("does nothing more from 3600 s on", "does nothing more from 1:00 on"),
    ("arrival is 3600 s, computed 7200 s", "arrival is 1:00, computed 2:00"),
    ("duration is 3600 s, computed 3660 s", "duration is 1 h, computed 1 h 1 min"),
    ("works 36000 s, at most 28800 s are allowed", "works 10 h, at most 8 h are allowed"),
    ("600 s in the air, endurance is 570 s", "10 min in the air, endurance is 9 min 30 s"),
    ("The earliest arrival is 7332.8 minutes after its window closes.",
     "The earliest arrival is 122 h 13 min after its window closes."),
    ("fits if its window closed 1 minute later", "fits if its window closed 1 min later"),
    ("fits if truck-2 had crane", "fits if truck-2 had crane"),
])
def test_instants_become_clocks_and_lengths_hours_and_minutes(said: str, told: str) -> None:
    assert wording(clock)(said) == told


@pytest.mark.parametrize(("seconds", "told"), [
    (0, "0 s"), (40, "40 s"), (90, "1 min 30 s"), (0.25, "0.25 s"), (3600, "1 h"),
    (3601, "1 h 1 min"), (7200.0, "2 h"), (90000, "25 h"), (180.0 * 20.1, "1 h 1 min")])
def test_lengths_suffice(seconds: float, told: str) -> None:
    assert length(seconds) == told
