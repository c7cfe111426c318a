"""An extract of OpenStreetMap -> what OSRM answers from, made once per vehicle beside the extract.

Whatever the answers depend on is part of a build's name: the extract, the vehicle's profile and
OSRM's version. So a build is never out of date, and one that is there is whole.
"""

import fcntl
import hashlib
import json
import os
import re
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from operator import itemgetter
from pathlib import Path

from app.maps.roads.setting import Extract, Vehicle
from app.maps.roads.stages import CONTRACTING, EXTRACTING, ToolFailedError, run_tool
from app.maps.roads.tools import OWN_PROFILES, SHARED, Tools
from app.maps.streets.filing import folder_beside

DATA = "roads.osrm"
"""What the files of a build begin with."""

NOTES = "build.json"

UNFINISHED = ".building-"
"""What the names of builds begin with that aren't whole yet."""

FRESH = 60.0
"""Seconds for which a build that nobody holds may be one that has just begun."""

READING_SHARE, EXTRACTING_SHARE = 0.03, 0.57
"""Of the time that a build takes, roughly; contracting is what is left."""

_NO_LARGE_PART = "(0 large"
_ROADS = re.compile(r"Generated (\d+) nodes")

_FORMER: dict[Vehicle, str] = {
    "car": "car",
    "bicycle": "bicycle",
    "van": "08b0f730958843caff92806426b3378335540afb63fa541c2d856a066f9fb48b",
    "truck": "6d814783a47da317317fa3eb153427b06c9681f038a0db920c4e0d69ea118559",
}
"""Profiles of builds that know of nothing to avoid, or not of several at once: they still serve."""

LARGE_SHARE = 10
"""A part of a small extract is large, so that places are put on its roads rather than on a nearer
parking lot that leads nowhere, with one of so many of all roads. Usually OSRM wants a thousand,
which is more than small extracts have."""

Show = Callable[[str, float], None]
"""Is told what is being done, and which share of all is over."""


class BuildError(Exception):
    """An extract can't be prepared, or isn't."""


@dataclass(frozen=True)
class Notes:
    """What a build was made of."""

    extract: str  # hash of the file
    profile: str  # hash of what says where a vehicle may go
    osrm: str  # version
    size: int  # of the extract, in bytes
    changed: int  # when the extract was last written, in ns


@dataclass(frozen=True)
class Build:
    """What OSRM answers from."""

    folder: Path

    @property
    def data(self) -> Path:
        """What OSRM's tools call all the files by."""
        return self.folder / DATA

    @property
    def key(self) -> str:
        """What tells it from all other builds."""
        return self.folder.name

    def notes(self) -> Notes:
        """Return what it was made of."""
        return Notes(**json.loads((self.folder / NOTES).read_text()))


def remove_leftovers(folder: Path) -> None:
    """Delete what builds left that were killed: nobody holds it any more. In place."""
    for left in folder.glob(f"{UNFINISHED}*"):
        with suppress(OSError):
            if time.time() - left.stat().st_mtime > FRESH and not _is_held(left):
                shutil.rmtree(left)


def _is_held(folder: Path) -> bool:
    """Tell whether a process builds in a folder."""
    with _opened(folder) as descriptor:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        return False


@contextmanager
def _opened(folder: Path) -> Iterator[int]:
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        yield descriptor
    finally:
        os.close(descriptor)


def find_build(extract: Extract, tools: Tools) -> Build:
    """Return the build of an extract, having removed what killed builds left beside it.

    Raises
    ------
    BuildError
        If the extract isn't there, or there is no build of it.
    """
    _require_file(extract.path)
    remove_leftovers(folder_beside(extract.path))
    state, known = extract.path.stat(), ""
    profiles = (_profile_hash(extract, tools), _FORMER[extract.vehicle])
    builds = [Build(notes.parent) for notes in sorted(
        folder_beside(extract.path).glob(f"{extract.vehicle}-*/{NOTES}"))]
    of_these = [(profiles.index(notes.profile), notes, build) for build in builds
                if (notes := build.notes()).profile in profiles
                and (notes.osrm, notes.size) == (tools.version, state.st_size)]
    for _, notes, build in sorted(of_these, key=itemgetter(0)):
        if notes.changed == state.st_mtime_ns:
            return build
        known = known or _hash_of(extract.path)
        if notes.extract == known:
            return build
    raise BuildError(f"{extract.path} hasn't been prepared as it is now: run tandem roads build "
                     f"{extract.path} --profile {extract.vehicle}")


def build_roads(extract: Extract, tools: Tools, show: Show = lambda doing, share: None) -> Build:
    """Prepare an extract, unless it is prepared.

    Raises
    ------
    BuildError
        If it can't be.
    """
    _require_file(extract.path)
    state, show = extract.path.stat(), _never_back(show)
    show("reading the extract", 0.0)
    notes = Notes(_hash_of(extract.path), _profile_hash(extract, tools), tools.version,
                  state.st_size, state.st_mtime_ns)
    folder = folder_beside(extract.path)
    key = hashlib.sha256("".join((notes.extract, notes.profile, notes.osrm)).encode()).hexdigest()
    build = Build(folder / f"{extract.vehicle}-{key[:16]}")
    if (build.folder / NOTES).exists():
        return build
    try:
        folder.mkdir(exist_ok=True)
        remove_leftovers(folder)
        with (tempfile.TemporaryDirectory(dir=folder, prefix=UNFINISHED,
                                          ignore_cleanup_errors=True) as unfinished,
              _opened(Path(unfinished)) as descriptor):
            # Held until it is done or its process ends, however that does.
            fcntl.flock(descriptor, fcntl.LOCK_EX)
            _make(extract, tools, Path(unfinished), show)
            (Path(unfinished) / NOTES).write_text(json.dumps(asdict(notes)))
            _put_in_place(Path(unfinished), build)
    except OSError as error:
        raise BuildError(f"{folder} can't be written: {error}") from error
    show("ready", 1.0)
    return build


def _make(extract: Extract, tools: Tools, folder: Path, show: Show) -> None:
    """Run OSRM's tools. In place."""
    # A name of our own, as the tools derive those of their files from it.
    (folder / "roads.osm.pbf").symlink_to(extract.path.resolve())
    script = tools.profile(extract.vehicle)
    environment = os.environ | {"LUA_PATH": f"{OWN_PROFILES}/?.lua;{tools.profiles}/?.lua;;"}
    until = READING_SHARE + EXTRACTING_SHARE
    command: list[str | Path] = [tools.extract, "--profile", script, folder / "roads.osm.pbf"]

    def extract_map(more: Sequence[str] = ()) -> list[str]:
        return _run([*command, *more], environment, extract, lambda share: show(
            "making a graph of the roads", READING_SHARE + EXTRACTING_SHARE * share), EXTRACTING)

    told = "\n".join(extract_map())
    roads = _ROADS.search(told)
    if _NO_LARGE_PART in told and roads is not None:
        extract_map(("--small-component-size", str(max(1, int(roads[1]) // LARGE_SHARE))))
    _run([tools.contract, folder / DATA], environment, extract,
         lambda share: show("making the graph quick to search", until + (1.0 - until) * share),
         CONTRACTING)
    (folder / "roads.osm.pbf").unlink()


def _never_back(show: Show) -> Show:
    """Return what shows how far a build is, and never less than before."""
    furthest = 0.0

    def shown(doing: str, share: float) -> None:
        nonlocal furthest
        furthest = max(furthest, share)
        show(doing, furthest)

    return shown


def _run(command: list[str | Path], environment: dict[str, str], extract: Extract,
         show: Callable[[float], None], stages: tuple[tuple[str, float], ...]) -> list[str]:
    try:
        return run_tool(command, environment, show, stages)
    except ToolFailedError as error:
        raise BuildError(f"{extract.path} can't be prepared. Is it an extract of OpenStreetMap "
                         f"with roads, and whole? {error}") from error


def _put_in_place(unfinished: Path, build: Build) -> None:
    """Give a build its name at once; one that came to be meanwhile is as good. In place."""
    unfinished.chmod(0o755)
    try:
        unfinished.rename(build.folder)
    except OSError:
        if not (build.folder / NOTES).exists():
            raise


def _require_file(path: Path) -> None:
    if not path.is_file():
        raise BuildError(f"{path} isn't there: put an extract of OpenStreetMap (.osm.pbf) there, "
                         "or correct the name")


def _hash_of(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _profile_hash(extract: Extract, tools: Tools) -> str:
    """Return what tells a profile from another; what it has of OSRM's is known by the version."""
    scripts = (tools.profile(extract.vehicle), *(OWN_PROFILES / f"{name}.lua" for name in SHARED))
    return hashlib.sha256("".join(map(_hash_of, scripts)).encode()).hexdigest()
