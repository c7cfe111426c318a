"""The commands of CONTRIBUTING.md run as they stand there, a block after the other.

What `make` and `.ci/run` do isn't done again within itself: of `make` it is looked whether it knows
what to do, and `.ci/run` runs its own scripts. A line that begins with a tool of `OPTIONAL` is left
out where that tool isn't there: bare machines have neither, and tests install none.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
BLOCKS = [re.sub(r" +# .*| *\\\n *", lambda found: " " if "\\" in found[0] else "", block)
          for block in re.findall(r"^```sh\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)]
OPTIONAL = ("gdb", "perf")
SECONDS = 900


def lines(*begins: str) -> list[str]:
    """Return the commands that begin with one of these words."""
    return [line for block in BLOCKS for line in block.splitlines()
            if line.split()[0].startswith(begins)]


def runnable(block: str) -> str:
    """Return a block as it runs here: by this Python, without what others run or isn't there."""
    absent = [tool for tool in OPTIONAL if shutil.which(tool) is None]
    kept = [line for line in block.splitlines()
            if not line.startswith((".ci/", "make ", *absent))]
    return "\n".join(kept).replace(".venv/bin/python", sys.executable)


@pytest.mark.slow
@pytest.mark.parametrize("block", [block for block in BLOCKS if runnable(block)])
def test_commands_run(block: str) -> None:
    path = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", runnable(block)], cwd=ROOT, text=True,
                          capture_output=True, timeout=SECONDS, check=False,
                          env={**os.environ, "PATH": path})
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("command", lines("make"))
def test_make_knows_what_to_make(command: str) -> None:
    done = subprocess.run([*command.split(), "--dry-run"], cwd=ROOT, text=True,
                          capture_output=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("script", lines(".ci/"))
def test_scripts_are_run_before_a_change_lands(script: str) -> None:
    assert script in (ROOT / ".ci" / "run").read_text("utf-8").splitlines()


def test_comments_are_no_part_of_commands() -> None:
    assert len(BLOCKS) >= 7
    assert "#" not in "".join(BLOCKS)
    assert "make test" in lines("make")
