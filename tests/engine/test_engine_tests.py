"""The engine's own tests, in C++, pass."""

import subprocess

from tests.engine.rules.asking import built


def test_cases_of_the_engine_pass() -> None:
    done = subprocess.run([built("engine_tests")], text=True, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
