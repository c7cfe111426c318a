"""Sides of streets and roads that are avoided, in a town made for it and over HTTP."""

import json
import shutil
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import polyline
import pytest

from app.maps.roads.building import NOTES, build_roads, find_build
from app.maps.roads.embedded import EmbeddedRoads
from app.maps.roads.engine import Driving
from app.maps.roads.setting import Extract, Vehicle
from app.maps.roads.tools import Tools
from app.serving.settings import Settings
from model.travel.matrices import great_circle_distances
from tests.app.conftest import FirstFitPlanner, ready
from tests.app.maps.roads.conftest import served
from tests.app.maps.roads.town import place, write_town
from tests.conftest import made_once

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

Data = dict[str, Any]
Serve = Callable[..., httpx.Client]

DIRECT, AROUND = 600, 2200
"""Metres from the depot to the middle of the block's northern street, eastward and westward."""

OVER = {"motorways": 2000, "tolls": 2154, "ferries": 2828, "streets": 3774}
"""Metres of each way from the block to the far end."""

NORTH, SOUTH, FAR = (500, 12), (500, -12), (3100, -5)


@pytest.fixture(scope="session")
def town(tools: Tools, shared_folder: Path) -> Extract:
    """Return the town as `tandem roads build` prepares it for trucks, once for all."""
    folder, name = shared_folder / "town", "town.osm.pbf"
    with made_once(folder) as unfinished:
        if unfinished is not None:
            unfinished.mkdir()
            write_town(unfinished / name)
            build_roads(Extract(unfinished / name, "truck"), tools)
    return Extract(folder / name, "truck")


@pytest.fixture(scope="module")
def settings(town: Extract, osrm_folder: Path,
             tmp_path_factory: pytest.TempPathFactory) -> Iterator[Settings]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PATH", f"{osrm_folder / 'bin'}:/usr/bin:/bin")
        yield Settings(roads=f"truck={town.path}", data_dir=tmp_path_factory.mktemp("data"))


@pytest.fixture
def client(serve: Serve, settings: Settings) -> httpx.Client:
    return ready(serve(FirstFitPlanner(), settings))


def customer(number: int, at: tuple[float, float], **more: Any) -> Data:
    return {"id": str(number), "demand": [1], "location": place(*at), **more}


def request(*customers: Data, avoid: list[str] | None = None, **changes: Any) -> Data:
    kind = {"id": "truck", "count": 1, "capacity": [9]}
    return {
        "coordinate_system": "geographic",
        "depots": [{"id": "depot", "location": place(-100, 0)}], "customers": list(customers),
        "fleet": [kind if avoid is None else kind | {"avoid": avoid}],
        "options": {"time_limit": 30, "search_iterations": 0, "geometry": True}, **changes}


def replied(client: httpx.Client, body: Data, path: str = "/plan") -> Data:
    reply = client.post(path, json=body)
    assert reply.status_code == 200, reply.text
    return reply.json()


def refused(client: httpx.Client, body: Data) -> list[tuple[str, str]]:
    reply = client.post("/plan", json=body)
    assert reply.status_code == 422, reply.text
    return [(error["code"], error["path"]) for error in reply.json()["errors"]]


def driven(reply: Data) -> list[float]:
    """Return the metres of each drive, having compared them with the lines that are drawn."""
    metres = []
    for trip in (trip for route in reply["routes"] for trip in route["trips"]):
        drawn = [length(stop["geometry"]) for stop in trip["stops"][1:]]
        assert sum(drawn) == pytest.approx(trip["distance"], rel=0.01, abs=60)
        metres += drawn
    return metres


def length(line: str) -> float:
    points = np.array(polyline.decode(line, 6))[:, ::-1]
    return float(np.diag(great_circle_distances(points), 1).sum())


def about(*metres: float) -> Any:
    return pytest.approx(list(metres), rel=0.02, abs=40)


def test_a_place_is_reached_on_its_side_of_the_street(client: httpx.Client) -> None:
    for at, by_curb in ((NORTH, (AROUND, DIRECT)), (SOUTH, (DIRECT, AROUND))):
        anyhow = replied(client, request(customer(1, at)))
        assert driven(anyhow) == about(DIRECT, DIRECT)
        assert driven(replied(client, request(customer(1, at, approach="any")))) == driven(anyhow)
        assert driven(replied(client, request(customer(1, at, approach="curb")))) == about(*by_curb)


def test_nobody_turns_around_at_a_stop(client: httpx.Client) -> None:
    both = (customer(1, NORTH, approach="curb"), customer(2, SOUTH, approach="curb"))
    # They lie opposite one another: it goes on to where the street ends, and around the block.
    assert driven(replied(client, request(*both))) == about(AROUND, 2 * DIRECT, AROUND)


def test_what_a_request_says_of_sides_holds_for_who_says_nothing(client: httpx.Client) -> None:
    curb = {"approach": "curb"}
    assert driven(replied(client, request(customer(1, NORTH), roads=curb))) == about(
        AROUND, DIRECT)
    assert driven(replied(client, request(customer(1, NORTH, approach="any"), roads=curb))) == (
        about(DIRECT, DIRECT))


@pytest.mark.parametrize(("avoid", "by"), [
    ([], "motorways"), (["tolls"], "motorways"), (["ferries"], "motorways"),
    (["tolls", "ferries"], "motorways"), (["motorways"], "tolls"),
    (["motorways", "tolls"], "ferries"), (["ferries", "motorways", "tolls"], "streets"),
])
def test_vehicles_keep_off_what_they_are_to_avoid(client: httpx.Client, avoid: list[str],
                                                  by: str) -> None:
    reply = replied(client, request(customer(1, FAR), avoid=avoid))
    assert driven(reply) == about(1200 + OVER[by], 1200 + OVER[by])
    assert reply["legs"][0]["avoid"] == sorted(avoid)


def test_each_vehicle_type_has_its_own_roads(client: httpx.Client) -> None:
    fleet = [{"id": name, "count": 1, "capacity": [1], "avoid": avoid} for name, avoid in (
        ("usual", []), ("slow", ["motorways"]), ("slowest", ["tolls", "motorways", "ferries"]))]
    customers = [customer(number, FAR, vehicles={"allowed": [kind["id"]]})
                 for number, kind in enumerate(fleet)]
    body = request(*customers) | {"fleet": fleet}
    reply = replied(client, body)
    by_type = {route["type"]: route["trips"][0]["distance"] for route in reply["routes"]}
    assert list(map(by_type.get, ("usual", "slow", "slowest"))) == about(
        *(2 * (1200 + OVER[by]) for by in ("motorways", "tolls", "streets")))
    assert [legs["avoid"] for legs in reply["legs"]] == [
        [], ["motorways"], ["ferries", "motorways", "tolls"]]
    assert replied(client, {"problem": body, "plan": reply}, "/check")["cost"] == reply["cost"]
    again = replied(client, body | {"replan": {"plan": reply, "freeze_before": 1}})
    assert again["summary"]["distance"] == reply["summary"]["distance"]


def test_fits_and_reasons_drive_on_the_same_roads(client: httpx.Client) -> None:
    body = request(customer(1, FAR), avoid=["motorways"])
    plan = replied(client, body)
    joins = customer(2, NORTH, approach="curb")
    enough = {"options": {"time_limit": 30}}
    question = {"problem": body, "plan": plan, "new_customer": joins, "count": 2} | enough
    back, there = replied(client, question, "/fit")["places"]
    # On the way back the northern side is that where one stops, and on the way there it isn't:
    # then one is led around the block, back to the depot's end, and eastward again.
    assert back["cost"]["total"] == pytest.approx(0, abs=0.05)
    assert there["cost"]["total"] > 2
    both = body | {"customers": [*body["customers"], joins]}
    without = plan | {"unassigned": [{"id": "2", "reasons": []}]}
    assert replied(client, {"problem": both, "plan": without, "customer": "2"} | enough,
                   "/explain")["complete"]


def test_who_can_only_be_reached_by_what_is_avoided_is_named(client: httpx.Client) -> None:
    island = request(customer(1, FAR), customer(2, (2900, 4000)))
    assert driven(replied(client, island))[1] > 4000
    body = island | {"fleet": [island["fleet"][0] | {"avoid": ["ferries"]}]}
    reply = client.post("/plan", json=body)
    assert [(error["code"], error["path"]) for error in reply.json()["errors"]] == [
        ("PLACE_OFF_ROADS", "$.customers[1].location")]
    assert "without ferries" in reply.json()["errors"][0]["message"]


def test_what_is_unknown_or_flies_is_refused(client: httpx.Client) -> None:
    assert refused(client, request(customer(1, FAR), avoid=["hills"])) == [
        ("UNKNOWN_VALUE", "$.fleet[0].avoid[0]")]
    assert refused(client, request(customer(1, FAR, approach="left"))) == [
        ("UNKNOWN_VALUE", "$.customers[0].approach")]
    flying = request(customer(1, FAR), avoid=["tolls"])
    flying["fleet"][0]["flies"] = True
    assert refused(client, flying) == [("NOT_WHERE_IT_FLIES", "$.fleet[0].avoid")]


def test_roads_prepared_before_say_that_they_cannot_avoid_that(
        serve: Serve, settings: Settings, osrm_folder: Path, helsinki_graph: Path) -> None:
    with served(osrm_folder, helsinki_graph) as url:
        asking = Settings(roads=f"truck=osrm:{url}", data_dir=settings.data_dir)
        client = ready(serve(FirstFitPlanner(), asking))
        body = request(avoid=["tolls", "motorways"], customers=[
            {"id": "1", "demand": [1], "location": [24.945, 60.172]}],
            depots=[{"id": "d", "location": [24.94, 60.17]}])
        reply = client.post("/plan", json=body)
    assert [(error["code"], error["path"]) for error in reply.json()["errors"]] == [
        ("ROADS_WITHOUT_THAT", "$.fleet[0].avoid")]
    assert "tandem roads build" in reply.json()["errors"][0]["message"]


@pytest.mark.parametrize("vehicle", ["truck", "bicycle"])
@pytest.mark.parametrize(("origin", "own_side"), [((25.0, 60.0), SOUTH), ((-1.5, 52.5), NORTH)])
def test_traffic_keeps_left_where_it_does(vehicle: Vehicle, origin: tuple[float, float],
                                          own_side: tuple[float, float], tools: Tools,
                                          tmp_path: Path) -> None:
    write_town(tmp_path / "town.osm.pbf", origin)
    roads = EmbeddedRoads(build_roads(Extract(tmp_path / "town.osm.pbf", vehicle), tools), tools)
    places = np.array([place(*at, origin) for at in ((-100, 0), NORTH, SOUTH)])
    table = roads.table(places, time.perf_counter() + 60,
                        driving=Driving((), np.array([False, True, True])))
    roads.close()
    to_both = [DIRECT, AROUND] if own_side == NORTH else [AROUND, DIRECT]
    assert table.distances_m[0, 1:].tolist() == about(*to_both)


def test_builds_of_former_profiles_still_serve(town: Extract, tools: Tools, tmp_path: Path,
                                               ) -> None:
    shutil.copytree(town.path.parent, tmp_path, dirs_exist_ok=True)
    moved = Extract(tmp_path / town.path.name, "truck")
    build = find_build(moved, tools)
    former = "6d814783a47da317317fa3eb153427b06c9681f038a0db920c4e0d69ea118559"
    older = build.folder.with_name("truck-0000")
    shutil.copytree(build.folder, older)
    notes = json.loads((older / NOTES).read_text())
    (older / NOTES).write_text(json.dumps(notes | {"profile": former}))
    assert find_build(moved, tools) == build
    shutil.rmtree(build.folder)
    assert find_build(moved, tools).folder == older
