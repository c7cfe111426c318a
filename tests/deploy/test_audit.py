"""The audit of dependencies: what fails it, and what doesn't."""

import os
import subprocess
from pathlib import Path

import pytest

AUDIT = Path(__file__).parents[2] / ".ci" / "audit"

PYTHON = """#!/bin/sh
case "$2 $3" in
    "pip check") exit {check} ;;
    "pip install") exit {install} ;;
    pip_audit*) printf '%s\\n' '{told}' >&2; exit {audit} ;;
esac
"""


@pytest.mark.parametrize(("check", "install", "audit", "told", "fails", "says"), [
    (0, 0, 0, "No known vulnerabilities found", False, "; 0 packages unknown"),
    (0, 0, 0, "a could not be audited: a (1)", False, "; 1 packages unknown"),
    (0, 0, 1, "Found 2 known vulnerabilities in 1 package", True, "Found 2"),
    (0, 0, 1, "ERROR: Failed to connect to PyPI", False, "Failed to connect"),
    (0, 1, 0, "", False, "installed here"),
    (1, 0, 0, "", True, "")])
def test_only_what_is_known_to_be_bad_fails(tmp_path: Path, check: int, install: int, audit: int,
                                            told: str, fails: bool, says: str) -> None:
    python = tmp_path / "python"
    python.write_text(PYTHON.format(check=check, install=install, audit=audit, told=told))
    python.chmod(0o755)
    done = subprocess.run([AUDIT], env={**os.environ, "PYTHON": str(python)}, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    assert (done.returncode != 0) == fails, done.stdout
    assert says in done.stdout
