"""Real engines for roads, unpacked once, and a graph of Helsinki's centre that they serve."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.request import urlopen

import numpy as np
import pytest

from app.maps.roads.building import Build, build_roads
from app.maps.roads.setting import Extract
from app.maps.roads.tools import Tools
from model.problem import FloatArray
from tests.app.maps.roads.wheels import ROOT, VALHALLA, WHEELS, pinned, unpacked
from tests.conftest import eventually, free_port, made_once

HELSINKI = ROOT / "examples" / "helsinki.osm.pbf"
HELSINKI_BOX = (24.9352, 60.1642, 24.9534, 60.1791)

Places = Callable[[int, int], FloatArray]


@pytest.fixture(scope="session")
def osrm_folder() -> Path:
    """Return the folder of OSRM's package, with its `bin` and `share/profiles`."""
    unpacked(pinned("osrm-bindings"))
    return WHEELS / "osrm"


@pytest.fixture(scope="session")
def helsinki_graph(osrm_folder: Path, shared_folder: Path) -> Path:
    """Return Helsinki's centre as OSRM's own files for cars, by the name that they share.

    Made once for all.
    """
    folder, name = shared_folder / "osrm", "helsinki.osrm"
    binaries, profiles = osrm_folder / "bin", osrm_folder / "share" / "profiles"
    with made_once(folder) as unfinished:
        if unfinished is not None:
            unfinished.mkdir()
            extract = unfinished / "helsinki.osm.pbf"
            extract.symlink_to(HELSINKI)
            for command in ([binaries / "osrm-extract", "-p", profiles / "car.lua", extract],
                            [binaries / "osrm-contract", unfinished / name]):
                subprocess.run(command, check=True, stdout=subprocess.DEVNULL,
                               stderr=subprocess.STDOUT)
    return folder / name


@contextmanager
def served(osrm_folder: Path, graph: Path, *options: str) -> Iterator[str]:
    """Have `osrm-routed` serve a graph meanwhile; give its address."""
    port = str(free_port())
    command = [osrm_folder / "bin" / "osrm-routed", graph, "-i", "127.0.0.1", "-p", port, "-t", "2",
               *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True) as process:
        assert process.stdout is not None
        try:
            said = []
            for line in process.stdout:
                said.append(line)
                if "waiting for requests" in line:
                    break
            else:
                raise AssertionError("".join(said))
            # Each request is logged: a pipe that nobody reads would stop the server in the end.
            threading.Thread(target=process.stdout.read, daemon=True).start()
            yield f"http://127.0.0.1:{port}"
        finally:
            process.terminate()


@pytest.fixture(scope="session")
def helsinki_osrm(osrm_folder: Path, helsinki_graph: Path) -> Iterator[str]:
    """Serve Helsinki as OSRM does by default: tables of 100 places at most."""
    with served(osrm_folder, helsinki_graph) as url:
        yield url


@pytest.fixture(scope="session")
def helsinki_tiles(shared_folder: Path) -> Path:
    """Return Helsinki's centre as Valhalla's tiles, made once for all."""
    unpacked(VALHALLA)
    tiles, binaries = shared_folder / "tiles", WHEELS / "valhalla" / "bin"
    with (made_once(tiles) as unfinished, tempfile.TemporaryDirectory(prefix="valhalla") as name):
        if unfinished is not None:
            unfinished.mkdir()
            configuration = valhalla_configuration(Path(name), unfinished, free_port())
            subprocess.run([binaries / "valhalla_build_tiles", "-c", configuration, HELSINKI],
                           check=True, stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT)
    return tiles


@pytest.fixture(scope="session")
def helsinki_valhalla(helsinki_tiles: Path) -> Iterator[str]:
    """Serve Helsinki as Valhalla does by default: 50 origins and destinations, routes of 20."""
    port = free_port()
    # Names of Unix sockets are short, and folders of tests aren't.
    with tempfile.TemporaryDirectory(prefix="valhalla") as name:
        folder, binaries = Path(name), WHEELS / "valhalla" / "bin"
        configuration = valhalla_configuration(folder, helsinki_tiles, port)
        with (folder / "log").open("wb") as log, subprocess.Popen(
                [binaries / "valhalla_service", configuration, "2"], stdout=log,
                stderr=log) as process:
            url = f"http://127.0.0.1:{port}"
            try:
                eventually(lambda: process.poll() is not None or answers(f"{url}/status"))
                yield url
            finally:
                process.kill()


def valhalla_configuration(folder: Path, tiles: Path, port: int) -> Path:
    """Write what Valhalla needs, with its sockets in a folder, to make tiles or to serve them."""
    build = WHEELS / "valhalla" / "valhalla_build_config.py"
    stated = json.loads(subprocess.run([sys.executable, build], check=True,
                                       stdout=subprocess.PIPE).stdout)
    stated["mjolnir"].update(dict.fromkeys((
        "admin", "landmarks", "tile_extract", "timezone", "traffic_extract", "transit_dir",
        "transit_feeds_dir"), ""), tile_dir=str(tiles), concurrency=1)
    for part in ("loki", "meili", "odin", "thor"):
        stated[part]["service"]["proxy"] = f"ipc://{folder}/{part}"
    stated["httpd"]["service"].update(
        listen=f"tcp://127.0.0.1:{port}", loopback=f"ipc://{folder}/loopback",
        interrupt=f"ipc://{folder}/interrupt")
    path = folder / "valhalla.json"
    path.write_text(json.dumps(stated))
    return path


def answers(url: str) -> bool:
    """Tell whether something serves this."""
    try:
        with urlopen(url, timeout=60):
            return True
    except OSError:
        return False


@pytest.fixture(scope="session")
def helsinki_places() -> Places:
    """Scatter so many places over Helsinki's centre, by a seed."""
    west, south, east, north = HELSINKI_BOX

    def scattered(count: int, seed: int) -> FloatArray:
        rng = np.random.default_rng(seed)
        return np.round(rng.uniform((west, south), (east, north), (count, 2)), 6)

    return scattered


@pytest.fixture(scope="session")
def tools(osrm_folder: Path) -> Tools:
    """Return OSRM as the tests unpack it, whatever else is installed."""
    return Tools(osrm_folder / "bin", osrm_folder / "share" / "profiles")


@pytest.fixture
def osrm_on_path(osrm_folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Have OSRM found on the path."""
    monkeypatch.setenv("PATH", f"{osrm_folder / 'bin'}{os.pathsep}{os.environ['PATH']}")


@pytest.fixture(scope="session")
def prepared(tools: Tools, shared_folder: Path) -> Extract:
    """Return what `prepared_once` does."""
    return prepared_once(tools, shared_folder)


def prepared_once(tools: Tools, shared_folder: Path) -> Extract:
    """Return Helsinki's centre as `tandem roads build` prepares it for cars, once for all."""
    folder, name = shared_folder / "prepared", "helsinki.osm.pbf"
    with made_once(folder) as unfinished:
        if unfinished is not None:
            unfinished.mkdir()
            shutil.copy(HELSINKI, unfinished / name)
            build_roads(Extract(unfinished / name, "car"), tools)
    return Extract(folder / name, "car")


@pytest.fixture(scope="session")
def prepared_build(prepared: Extract, tools: Tools) -> Build:
    """Return what cars' roads are answered from."""
    return build_roads(prepared, tools)
