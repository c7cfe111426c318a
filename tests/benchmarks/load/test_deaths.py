"""Processes that die in the engine take nobody along."""

import pytest

from app.records.jobs.slices import POISONOUS
from benchmarks.load.deaths import WRONG, run

pytestmark = pytest.mark.slow


def test_aborts_of_the_engine_are_borne_by_who_asked_for_them() -> None:
    outcome = run(deaths=4, jobs=4, askers=1, seconds=0.5)
    assert {name: outcome[name] for name in WRONG} == dict.fromkeys(WRONG, 0)
    assert outcome["deaths"] >= 4
    assert outcome["other plans"] > 0
    assert set(outcome["own jobs"]) == {POISONOUS}
