"""Tests of what flying takes in the engine against the judge's."""

import numpy as np
import pytest

from model.judge.energy import hover_energy, leg_energy
from model.engine.instance import FAR, pack
from model.engine.records import Record
from model.problem import UNREACHABLE, Energy
from tests.engine.rules.asking import asked
from tests.model.tiny import draw_tiny, with_energy
from tests.seeds import often, seeds

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

EMPTY = -1
"""What is left of a battery once more was asked of it than it held."""


def taken(kind: Record, weight: int, duration: int) -> tuple[int, ...]:
    return asked("energy_taken", 3, kind, weight, duration)


def limits(kind: Record) -> tuple[int, ...]:
    return asked("battery_limits", 2, kind)


def test_legs_and_hovering_take_what_the_judge_says() -> None:
    empty = whole = 0
    for seed in seeds(200):
        rng = np.random.default_rng(seed)
        problem = with_energy(rng, draw_tiny(rng, drone_share=1.0))
        kind, drones = pack([problem]).type[0, 0], problem.vehicle_types[0].drones
        assert drones is not None
        assert isinstance(drones.energy, Energy)
        energy, weight = drones.energy, int(rng.integers(0, 6))
        duration = int(rng.integers(0, 30 * 60_000))
        leg, hover, longest = taken(kind, weight, duration)
        for left, needed in ((leg, leg_energy(energy, duration, weight)),
                             (hover, hover_energy(energy, duration, weight))):
            assert left == (EMPTY if needed > energy.available else energy.available - needed)
            empty, whole = empty + (left == EMPTY), whole + (left != EMPTY)
        if longest < FAR:
            assert hover_energy(energy, longest, weight) <= energy.available
            assert hover_energy(energy, longest + 1, weight) > energy.available
        assert limits(kind) == (True, not energy.lands)
    assert min(empty, whole) > often(50)


def test_no_battery_limits_nothing() -> None:
    kind = pack([draw_tiny(np.random.default_rng(2), drone_share=1.0)]).type[0, 0]
    assert limits(kind) == (False, False)


def test_what_no_battery_holds_leaves_it_empty_however_much_it_is() -> None:
    rng = np.random.default_rng(3)
    kind = pack([with_energy(rng, draw_tiny(rng, drone_share=1.0))]).type[0, 0]
    assert taken(kind, 0, UNREACHABLE)[0] == EMPTY
