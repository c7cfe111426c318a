"""The engine's own tests, in C++, pass."""

import subprocess

import pytest

from tests.engine.rules.asking import built

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


def test_cases_of_the_engine_pass() -> None:
    done = subprocess.run([built("engine_tests")], text=True, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
