"""The modules that need no browser, by the test runner of node."""

import json
import subprocess
from pathlib import Path

import pytest


pytestmark = pytest.mark.slow

STATIC = Path(__file__).parents[2] / "app" / "console" / "static"
MODULES = sorted((STATIC / "js").rglob("*.js"))
MAX_FILE_LINES = 400
MAX_LINE = 100


def test_modules_pass_their_own_tests() -> None:
    tests = sorted((Path(__file__).parent / "modules").glob("*.test.mjs"))
    # In one process: one for each file takes ten times as long.
    script = "\n".join(f"await import({json.dumps(path.as_uri())});" for path in tests)
    done = subprocess.run(["node", "--test-reporter=spec", "--input-type=module", "--eval", script],
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout[-4000:]
    assert "fail 0\n" in done.stdout


def test_modules_are_short() -> None:
    lines = {path.name: path.read_text("utf-8").splitlines() for path in MODULES}
    assert {name for name, each in lines.items() if len(each) > MAX_FILE_LINES} == set()
    assert [line for each in lines.values() for line in each if len(line) > MAX_LINE] == []


def test_every_library_has_its_licence() -> None:
    folders = [path for path in (STATIC / "vendor").iterdir() if path.is_dir()]
    assert len(folders) == 10
    assert [path.name for path in folders if not list(path.glob("LICENSE*"))] == []


def test_nothing_is_loaded_from_another_host() -> None:
    sources = [*MODULES, *STATIC.glob("*.html"), *(STATIC / "css").glob("*.css")]
    named = {line.strip() for path in sources for line in path.read_text("utf-8").splitlines()
             if "://" in line}
    # Names of formats, which nothing is fetched from.
    assert all("xmlns" in line for line in named)
