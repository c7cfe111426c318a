"""Plans on the roads of Helsinki's centre, asked for over HTTP."""

import json
import os
import random
import signal
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import polyline
import pytest
from pydantic import SecretStr
from typer.testing import CliRunner

from app.cli.commands import cli
from app.main import create_app
from app.maps.roads.building import Build
from app.maps.roads.setting import Extract, SettingError
from app.maps.roads.tools import Tools
from app.serving.settings import Settings
from model.travel.matrices import great_circle_distances
from tests.app.conftest import FirstFitPlanner, ready
from tests.app.maps.roads.conftest import HELSINKI_BOX, served
from tests.conftest import PATIENCE, complete

pytestmark = pytest.mark.slow

DEPOT = [24.9425, 60.1705]
TALLINN = [24.7536, 59.4370]

Data = dict[str, Any]
Serve = Callable[..., httpx.Client]


def helsinki_request(count: int = 20, **changes: Any) -> Data:
    """Return customers in Helsinki's centre whom two cars serve."""
    west, south, east, north = HELSINKI_BOX
    rng = random.Random(22)
    places = [[round(rng.uniform(west, east), 6), round(rng.uniform(south, north), 6)]
              for _ in range(count)]
    customers = [{"id": str(number), "demand": [1], "location": place}
                 for number, place in enumerate(places)]
    return {
        "coordinate_system": "geographic", "depots": [{"id": "depot", "location": DEPOT}],
        "customers": customers,
        "fleet": [{"id": "car", "profile": "car", "count": 2, "capacity": [count]}],
        "options": {"time_limit": 30, "search_iterations": 0}, **changes}


@pytest.fixture(scope="module")
def settings(prepared: Extract, osrm_folder: Path,
             tmp_path_factory: pytest.TempPathFactory) -> Iterator[Settings]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PATH", f"{osrm_folder / 'bin'}{os.pathsep}{os.environ['PATH']}")
        yield Settings(roads=f"car={prepared.path}", data_dir=tmp_path_factory.mktemp("data"))


@pytest.fixture
def helsinki(serve: Serve, settings: Settings) -> httpx.Client:
    return ready(serve(FirstFitPlanner(), settings))


def replied(client: httpx.Client, request: Data, path: str = "/plan") -> Data:
    reply = client.post(path, json=request)
    assert reply.status_code == 200, reply.text
    return reply.json()


def without_solver(reply: Data) -> Data:
    return {name: value for name, value in reply.items() if name not in ("solver", "legs")}


def with_matrices(request: Data, url: str, metres_walked_in_a_second: float) -> Data:
    """Return a request that brings what a server tells, as a client would make it."""
    places = [*request["depots"], *request["customers"]]
    line = ";".join("{:.6f},{:.6f}".format(*place["location"]) for place in places)
    told = httpx.get(f"{url}/table/v1/driving/{line}?annotations=duration,distance",
                     timeout=PATIENCE).json()
    walks = np.array([
        great_circle_distances(np.array([place["location"], source["location"]]))[0, 1]
        for place, source in zip(places, told["sources"], strict=True)])
    walks /= metres_walked_in_a_second
    durations = np.array(told["durations"]) + walks[:, None] + walks[None, :]
    np.fill_diagonal(durations, 0.0)
    matrix = {"durations": durations.tolist(), "distances": told["distances"]}
    rows = iter(range(len(places)))
    return request | {
        "matrices": {"car": matrix},
        "depots": [place | {"location_index": next(rows)} for place in request["depots"]],
        "customers": [place | {"location_index": next(rows)} for place in request["customers"]]}


def test_a_plan_on_roads_is_that_of_matrices_by_a_server(helsinki: httpx.Client, tools: Tools,
                                                         prepared_build: Build) -> None:
    request = helsinki_request()
    on_roads = replied(helsinki, request)
    assert on_roads["legs"] == [{
        "profile": "car", "by": "roads", "avoid": [], "engine": "osrm", "estimated": 0,
        "detour": None, "farthest_from_road_m": pytest.approx(250, abs=200), "note": None}]
    with served(tools.folder.parent, prepared_build.data) as url:
        by_matrices = with_matrices(request, url, 5 / 3.6)
    by_client = replied(helsinki, by_matrices)
    assert by_client["legs"][0]["by"] == "matrix"
    assert without_solver(on_roads)["routes"]
    assert without_solver(by_client) == without_solver(on_roads)
    straight = replied(helsinki, request | {"roads": "none"})
    assert straight["legs"][0]["by"] == "great_circle"
    assert straight["summary"]["distance"] < 0.8 * on_roads["summary"]["distance"]


def test_lines_of_legs_are_the_roads_that_are_driven(helsinki: httpx.Client) -> None:
    request = helsinki_request()
    reply = replied(helsinki, request | {"options": request["options"] | {"geometry": True}})
    locations = {place["id"]: place["location"]
                 for place in (*request["depots"], *request["customers"])}
    bends = 0
    for trip in (trip for route in reply["routes"] for trip in route["trips"]):
        length = 0.0
        for before, stop in pairwise(trip["stops"]):
            line = np.array(polyline.decode(stop["geometry"], 6))[:, ::-1]
            assert line[[0, -1]].tolist() == [locations[before["id"]], locations[stop["id"]]]
            length += float(np.diag(great_circle_distances(line), 1).sum())
            bends += len(line) - 2
        walks = 2 * len(trip["stops"]) * reply["legs"][0]["farthest_from_road_m"]
        assert 0.99 * trip["distance"] < length < 1.01 * trip["distance"] + walks
    assert bends > 100
    assert "geometry" not in str(replied(helsinki, request)["routes"])


def test_plans_on_roads_are_judged_and_explained_on_them(helsinki: httpx.Client) -> None:
    request = helsinki_request(6)
    plan = replied(helsinki, request)
    judged = replied(helsinki, {"problem": request, "plan": plan}, "/check")
    assert judged["feasible"]
    assert judged["cost"] == plan["cost"]
    elsewhere = replied(helsinki, {"problem": request | {"roads": "none"}, "plan": plan}, "/check")
    assert elsewhere["cost"] != plan["cost"]
    question = {"problem": request, "plan": plan, "customer": "3", "options": {"time_limit": 30}}
    assert replied(helsinki, question, "/explain")["complete"]


def test_a_plan_goes_on_on_roads(helsinki: httpx.Client) -> None:
    request = helsinki_request(6)
    plan = replied(helsinki, request)
    again = replied(helsinki, request | {"replan": {"plan": plan, "freeze_before": 1}})
    assert again["summary"]["served"] == 6
    assert again["legs"] == plan["legs"]


def test_places_off_the_map_are_named(helsinki: httpx.Client) -> None:
    request = helsinki_request(5)
    for number in (1, 4):
        request["customers"][number]["location"] = TALLINN
    reply = helsinki.post("/plan", json=request)
    assert reply.status_code == 422
    assert [(error["code"], error["path"]) for error in reply.json()["errors"]] == [
        ("PLACE_OFF_ROADS", "$.customers[1].location"),
        ("PLACE_OFF_ROADS", "$.customers[4].location")]
    assert "m away" in reply.json()["errors"][0]["message"]
    estimated = replied(helsinki, request | {"roads": {"fallback": "great_circle"}})
    assert estimated["legs"][0]["estimated"] == 6 * 5 - 4 * 3
    assert estimated["legs"][0]["detour"] == 1.3
    assert "2 places off the roads" in estimated["legs"][0]["note"]


def test_a_child_killed_is_not_noticed(helsinki: httpx.Client) -> None:
    assert replied(helsinki, helsinki_request(7))["legs"][0]["by"] == "roads"
    mine = [int(path.parent.name) for path in Path("/proc").glob("[0-9]*/stat")
            if _is_of_a_service_here(path)]
    assert mine
    for pid in mine:
        os.kill(pid, signal.SIGKILL)
    assert replied(helsinki, helsinki_request(8))["legs"][0]["by"] == "roads"


def _is_of_a_service_here(stat: Path) -> bool:
    """Tell whether a process is one that a service in this one has started, not a test itself."""
    try:
        name, _, rest = stat.read_text().partition(")")
        command = stat.with_name("cmdline").read_bytes()
    except OSError:
        return False
    return (name.endswith("(osrm-routed") and b"--mmap" in command
            and int(rest.split()[1]) == os.getpid())


def test_a_server_of_roads_serves_as_well(serve: Serve, settings: Settings, tools: Tools,
                                          helsinki: httpx.Client, prepared_build: Build) -> None:
    request = helsinki_request(12)
    with served(tools.folder.parent, prepared_build.data) as url:
        asking = settings.model_copy(update={"roads": SecretStr(f"car=osrm:{url}"),
                                             "roads_cache_bytes": 0})
        by_server = replied(ready(serve(FirstFitPlanner(), asking)), request)
    embedded = replied(helsinki, request)
    assert by_server["summary"]["distance"] == embedded["summary"]["distance"]
    assert by_server["summary"]["makespan"] == pytest.approx(embedded["summary"]["makespan"], abs=1)


def test_a_server_that_is_down_is_said_to_be(serve: Serve, settings: Settings) -> None:
    asking = settings.model_copy(update={"roads": SecretStr("car=osrm:http://127.0.0.1:9")})
    client = ready(serve(FirstFitPlanner(), asking))
    reply = client.post("/plan", json=helsinki_request(3))
    assert reply.status_code == 503
    assert reply.json()["type"] == "urn:tandem:error:roads-unavailable"
    assert "127.0.0.1" not in reply.text
    estimated = replied(client, helsinki_request(3, roads={"fallback": "great_circle"}))
    assert estimated["legs"][0]["estimated"] == 12


@pytest.mark.usefixtures("osrm_on_path")
@pytest.mark.parametrize(("roads", "words"), [
    ("car", "write profile=extract"),
    ("truck={prepared}", "tandem roads build {prepared} --profile truck"),
    ("car=/nowhere.osm.pbf", "/nowhere.osm.pbf isn't there"),
    ("car=osrm:http://", "osrm:http://localhost:5000"),
    ("car=ors:http://localhost?key=sesame&colour=red", "no option 'colour'"),
])
def test_a_wrong_setting_stops_the_start_and_says_what_to_write(roads: str, words: str,
                                                                prepared: Extract) -> None:
    stated = Settings(roads=roads.format(prepared=prepared.path))

    async def start() -> None:
        app = create_app(stated, FirstFitPlanner())
        async with app.router.lifespan_context(app):
            pass

    with pytest.raises(SettingError) as raised:
        complete(start())
    assert words.format(prepared=prepared.path) in str(raised.value)
    assert "sesame" not in str(raised.value)


@pytest.mark.usefixtures("osrm_on_path")
def test_the_command_line_names_what_is_wrong_with_the_setting(tmp_path: Path) -> None:
    (tmp_path / "problem.json").write_text(json.dumps(helsinki_request(1)))
    done = CliRunner().invoke(cli, ["check", str(tmp_path / "problem.json"),
                                    str(tmp_path / "problem.json")],
                              env={"TANDEM_ROADS": "car=nowhere.osm.pbf"})
    assert done.exit_code == 2
    assert "TANDEM_ROADS: nowhere.osm.pbf isn't there" in done.stderr


def test_the_command_line_judges_on_roads(helsinki: httpx.Client, prepared: Extract,
                                          tmp_path: Path) -> None:
    request = helsinki_request(4)
    plan = replied(helsinki, request)
    (tmp_path / "problem.json").write_text(json.dumps(request))
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    done = CliRunner().invoke(
        cli, ["check", str(tmp_path / "problem.json"), str(tmp_path / "plan.json")],
        env={"TANDEM_ROADS": f"car={prepared.path}"})
    assert done.exit_code == 0, done.output
    assert f"{plan['cost']['total']:.6f}" in done.stdout


@pytest.mark.parametrize("place", [[-170, -80], [180, 0], [-180, 90], [0, -89.9]])
def test_a_place_far_from_the_map_is_off_the_roads(
        helsinki: httpx.Client, place: list[float]) -> None:
    request = helsinki_request(5)
    request["customers"][2]["location"] = place
    reply = helsinki.post("/plan", json=request)
    assert reply.status_code == 422, reply.text
    assert [(error["code"], error["path"]) for error in reply.json()["errors"]] == [
        ("PLACE_OFF_ROADS", "$.customers[2].location")]
