"""Tests of the engine's legs by speeds that change with the time of day against the judge's."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge import clock
from model.engine.instance import pack
from model.engine.records import Record
from model.problem import FULL_SPEED, IntArray, SpeedProfile
from tests.engine.rules.asking import asked
from tests.model.tiny import MINUTE, RUSH_HOUR

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

PROFILES = (None, RUSH_HOUR, SpeedProfile((), (FULL_SPEED // 7,)),
            SpeedProfile((MINUTE, 2 * MINUTE, 9 * MINUTE), (999_983, 1, 123_457, FULL_SPEED)))


def both(kind: Record, times: IntArray, factors: IntArray, duration: int,
         time: int) -> tuple[int, ...]:
    return asked("clocked", 3, kind, times, len(times), factors, duration, time)


@pytest.mark.parametrize("profile", PROFILES)
def test_legs_end_and_begin_when_the_judge_says(tiny_problem, customers, truck, profile) -> None:
    instance = pack([tiny_problem(*customers, truck=replace(truck, speed_profile=profile))])
    kind = instance.type[0, 0]
    times, factors = instance.profile_time[0, 0], instance.profile_factor[0, 0]
    rng = np.random.default_rng(3)
    changes = () if profile is None else profile.times
    for time in [0, *changes, *rng.integers(0, 20 * MINUTE, 300).tolist()]:
        duration = int(rng.integers(0, 15 * MINUTE))
        end, start, steady = both(kind, times, factors, duration, time)
        assert end == clock.leg_end(time, duration, profile)
        assert start == clock.leg_start(time, duration, profile)
        assert steady == (profile is None)
        assert clock.leg_end(start, duration, profile) <= time
