import fcntl
import json
import os
import shutil
from pathlib import Path

import pytest
from typer.testing import CliRunner

from app.cli.commands import cli
from app.maps.roads.building import NOTES, UNFINISHED, BuildError, build_roads, find_build
from app.maps.roads.setting import Extract
from app.maps.roads.stages import CONTRACTING, StageProgress
from app.maps.roads.tools import Tools, ToolsMissingError, find_tools
from tests.app.maps.roads.conftest import HELSINKI

pytestmark = pytest.mark.slow


@pytest.fixture
def extract(tmp_path: Path) -> Extract:
    return Extract(Path(shutil.copy2(HELSINKI, tmp_path / "town.osm.pbf")), "truck")


@pytest.fixture
def built(prepared: Extract, tmp_path: Path) -> Extract:
    """Prepared, and free to be changed."""
    shutil.copytree(prepared.path.parent, tmp_path, dirs_exist_ok=True)
    return Extract(tmp_path / prepared.path.name, prepared.vehicle)


def test_a_build_is_made_once_and_found(extract: Extract, tools: Tools) -> None:
    shares: list[float] = []
    build = build_roads(extract, tools, lambda doing, share: shares.append(share))
    assert shares == sorted(shares)
    assert (shares[0], shares[-1]) == (0.0, 1.0)
    assert len(set(shares)) > 20
    made = (build.folder / NOTES).stat().st_mtime_ns
    assert build_roads(extract, tools) == build == find_build(extract, tools)
    assert (build.folder / NOTES).stat().st_mtime_ns == made
    assert [path.name for path in build.folder.parent.iterdir()] == [build.key]


@pytest.mark.thorough
def test_an_extract_that_changed_has_no_build(built: Extract, tools: Tools) -> None:
    build = find_build(built, tools)  # which was copied since: another time, the same content
    assert build == build_roads(built, tools)
    with built.path.open("ab") as file:
        file.write(b"more")
    with pytest.raises(BuildError, match=r"tandem roads build .*helsinki\.osm\.pbf --profile car"):
        find_build(built, tools)


def test_an_extract_has_a_build_for_each_vehicle(built: Extract, tools: Tools) -> None:
    with pytest.raises(BuildError, match="--profile truck"):
        find_build(Extract(built.path, "truck"), tools)


def test_builds_of_another_version_of_osrm_are_not_used(built: Extract, tools: Tools) -> None:
    build = find_build(built, tools)
    notes = json.loads((build.folder / NOTES).read_text())
    (build.folder / NOTES).write_text(json.dumps(notes | {"osrm": "v5.27.1"}))
    with pytest.raises(BuildError, match="tandem roads build"):
        find_build(built, tools)


@pytest.mark.thorough
def test_vans_have_roads_of_their_own(extract: Extract, tools: Tools) -> None:
    assert build_roads(Extract(extract.path, "van"), tools).key.startswith("van-")


def test_what_is_no_whole_extract_leaves_nothing(tmp_path: Path, tools: Tools) -> None:
    cut = tmp_path / "cut.osm.pbf"
    cut.write_bytes(HELSINKI.read_bytes()[:300_000])
    with pytest.raises(BuildError, match=r"cut\.osm\.pbf can't be prepared.*unexpected EOF"):
        build_roads(Extract(cut, "car"), tools)
    assert list((tmp_path / "cut.roads").iterdir()) == []


def test_an_extract_that_is_missing_is_named(tmp_path: Path, tools: Tools) -> None:
    with pytest.raises(BuildError, match=r"none\.osm\.pbf isn't there"):
        build_roads(Extract(tmp_path / "none.osm.pbf", "car"), tools)


def test_progress_follows_what_a_tool_writes() -> None:
    progress = StageProgress(CONTRACTING)
    lines = ("[info] Loading edge-expanded graph representation", " 50% ",
             "[info] initializing node priorities...", " 50% ", " 10% ",
             "[info] initializing node priorities...", "[info] Contraction took 0.5 sec")
    assert [progress.after(line) for line in lines] == pytest.approx(
        [0.0, 0.025, 0.05, 0.5, 0.5, 0.5, 0.95])


@pytest.mark.thorough
@pytest.mark.usefixtures("osrm_on_path")
def test_the_command_prepares_an_extract(extract: Extract) -> None:
    done = CliRunner().invoke(cli, ["roads", "build", str(extract.path), "--profile", "bicycle"])
    assert done.exit_code == 0, done.output
    assert f"TANDEM_ROADS=bicycle={extract.path}" in done.stdout
    assert "making a graph of the roads" in done.stderr
    assert len(list(extract.path.parent.glob("*.roads/*.streets"))) == 1


def test_without_osrm_the_command_says_what_to_install(extract: Extract,
                                                       monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.maps.roads.tools.importlib.util.find_spec", lambda name: None)
    done = CliRunner().invoke(cli, ["roads", "build", str(extract.path)], env={"PATH": ""})
    assert done.exit_code == 2
    assert "pip install 'tandem-planner[roads]'" in done.stderr


@pytest.mark.parametrize("version", [(3, 11), (3, 13)])
def test_what_to_install_depends_on_this_python(version: tuple[int, int],
                                                monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.maps.roads.tools.importlib.util.find_spec", lambda name: None)
    monkeypatch.setattr("app.maps.roads.tools.sys.version_info", version)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(ToolsMissingError) as raised:
        find_tools()
    assert ("3.12 or later" in str(raised.value)) == (version < (3, 12))


@pytest.mark.usefixtures("osrm_on_path")
def test_osrm_is_found_on_the_path(tools: Tools, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.maps.roads.tools.importlib.util.find_spec", lambda name: None)
    assert find_tools() == tools


def test_what_a_killed_build_left_is_removed(built: Extract, tools: Tools) -> None:
    folder = find_build(built, tools).folder.parent
    left, held, new = (folder / f"{UNFINISHED}{name}" for name in ("left", "held", "new"))
    for each in (left, held, new):
        each.mkdir()
        (each / "roads.osrm.ebg").write_bytes(b"graph")
    for each in (left, held):
        os.utime(each, (0, 0))
    descriptor = os.open(held, os.O_RDONLY)
    fcntl.flock(descriptor, fcntl.LOCK_EX)
    find_build(built, tools)
    assert [each.exists() for each in (left, held, new)] == [False, True, True]
    os.close(descriptor)
    build_roads(built, tools)
    find_build(built, tools)
    assert [each.exists() for each in (left, held, new)] == [False, False, True]
