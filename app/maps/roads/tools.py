"""OSRM's executables and profiles, wherever they are installed."""

import importlib.util
import shutil
import subprocess
import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from app.maps.roads.setting import Vehicle

OWN_PROFILES = Path(__file__).resolve().parent / "profiles"

SHARED = ("avoidable", "goods")
"""Scripts there that those of vehicles are made of."""

_THEIR_PROFILES = ("share/profiles", "share/osrm/profiles", "profiles")
"""Where OSRM's profiles lie beside the folder of its executables."""


class ToolsMissingError(Exception):
    """OSRM isn't installed."""


@dataclass(frozen=True)
class Tools:
    """Where OSRM is installed."""

    folder: Path  # of the executables
    profiles: Path  # OSRM's own

    @property
    def extract(self) -> Path:
        """Makes a graph of a map."""
        return self.folder / "osrm-extract"

    @property
    def contract(self) -> Path:
        """Makes the graph quick to search."""
        return self.folder / "osrm-contract"

    @property
    def routed(self) -> Path:
        """Answers questions about the graph."""
        return self.folder / "osrm-routed"

    @cached_property
    def version(self) -> str:
        """Return OSRM's version, such as `v26.10.0`."""
        shown = subprocess.run([self.routed, "--version"], capture_output=True, text=True,
                               check=False)
        return (shown.stdout or shown.stderr).strip()

    def profile(self, vehicle: Vehicle) -> Path:
        """Return what says where a vehicle may go, and how fast."""
        return OWN_PROFILES / f"tandem_{vehicle}.lua"


def find_tools() -> Tools:
    """Return where OSRM is: in this Python, or on the path.

    Raises
    ------
    ToolsMissingError
        If it is nowhere; says what to install.
    """
    folders = []
    package = importlib.util.find_spec("osrm")
    if package is not None and package.origin is not None:
        folders.append(Path(package.origin).parent / "bin")
    on_path = shutil.which("osrm-routed")
    if on_path is not None:
        folders.append(Path(on_path).resolve().parent)
    for folder in folders:
        profiles = next((folder.parent / inner for inner in _THEIR_PROFILES
                         if (folder.parent / inner / "car.lua").exists()), None)
        if (folder / "osrm-routed").exists() and profiles is not None:
            return Tools(folder, profiles)
    raise ToolsMissingError(_how_to_install())


def _how_to_install() -> str:
    if sys.version_info >= (3, 12):
        return ("Roads of an extract need OSRM, which isn't installed: run "
                "pip install 'tandem-planner[roads]'")
    return ("Roads of an extract need OSRM, which isn't installed, and whose packages need Python "
            "3.12 or later: use such a Python and pip install 'tandem-planner[roads]', or unpack "
            "them by pip install --target osrm --python-version 3.13 --only-binary=:all: "
            "--no-deps osrm-bindings and put osrm/osrm/bin on the PATH")
