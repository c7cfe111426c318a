"""Published files become requests that are planned as they are."""

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from app.cli import commands, planning
from app.cli.file_errors import EXIT_BAD_INPUT
from app.formats.files import importers
from app.formats.files.importers import FileFormat, convert_file
from app.formats.files.instance import InstanceFileError
from app.requests.conversion.problem import to_problem
from app.requests.reading import read_request
from app.schemas.errors import RequestError
from app.schemas.fields import Rounding
from model.planner import Planner
from model.problem import UNLIMITED, Problem

SOLOMON = """C901

VEHICLE
NUMBER     CAPACITY
  2         20

CUSTOMER
CUST NO.  XCOORD.   YCOORD.    DEMAND   READY TIME  DUE DATE   SERVICE   TIME

    0      0          0          0          1         90          0
    1      3.5        4         10          7         20          2
    2      1          1         12          0         20          3
"""

SECTIONS = {
    "NODE_COORD": "1 0 0\n2 3 4\n3 1 1\n",
    "DEMAND": "1 0\n2 10\n3 12\n",
    "DEPOT": "1\n-1\n",
}


def _vrplib(header: str = "CAPACITY: 12", **sections: str | None) -> str:
    """Return a file of three nodes; a section that is None is left out."""
    lines = ["NAME: tiny", "DIMENSION: 3"]
    if "EDGE_WEIGHT_TYPE" not in header:
        lines.append("EDGE_WEIGHT_TYPE: EUC_2D")
    text = "\n".join([*lines, header]) + "\n"
    for name, content in {**SECTIONS, **sections}.items():
        if content is not None:
            text += f"{name}_SECTION\n{content}"
    return text + "EOF\n"


def _write(folder: Path, text: str) -> Path:
    path = folder / "instance"
    path.write_text(text, "utf-8")
    return path


def _request(folder: Path, text: str, rounding: Rounding = "exact",
             file_format: FileFormat = "auto") -> dict[str, Any]:
    return json.loads(convert_file(_write(folder, text), file_format, rounding))


def _problem(folder: Path, text: str, rounding: Rounding = "exact") -> Problem:
    body = convert_file(_write(folder, text), "auto", rounding)
    return to_problem(read_request(body, policies=None))


def test_request_keeps_the_numbers_of_the_file(tmp_path: Path) -> None:
    assert _request(tmp_path, _vrplib("VEHICLES: 2\nCAPACITY: 12")) == {
        "depots": [{"id": "depot", "location": [0, 0]}],
        "customers": [
            {"id": "1", "location": [3, 4], "demand": [10], "service_duration": 0},
            {"id": "2", "location": [1, 1], "demand": [12], "service_duration": 0}],
        "fleet": [{"id": "truck", "depot": "depot", "count": 2, "capacity": [12],
                   "costs": {"fixed": 0, "per_km": 1000}, "speed_kmh": 3.6}]}


def test_unit_is_a_metre_a_second_and_a_cost(tmp_path: Path) -> None:
    problem = _problem(tmp_path, _vrplib())
    truck, travel = problem.vehicle_types[0], problem.travel[0]
    assert travel.distance[:].item(0, 1) == travel.duration[:].item(0, 1) == 5000
    assert (travel.distance[:].item(0, 2), travel.duration[:].item(0, 2)) == (1414, 1415)
    assert (truck.cost_per_km, truck.fixed_cost, truck.capacity) == (1000.0, 0.0, (12_000,))
    assert (truck.count, truck.max_trips, truck.latest) == (2, 1, UNLIMITED)


@pytest.mark.parametrize(("rounding", "diagonal", "across"), [
    ("round", 1000, 4000), ("trunc", 1000, 3000), ("dimacs", 1400, 3600),
    ("thousandths", 1414, 3606)])
def test_distances_are_rounded_without_matrices(tmp_path: Path, rounding: Rounding, diagonal: int,
                                                across: int) -> None:
    request = _request(tmp_path, _vrplib(), rounding)
    assert request["planar_rounding"] == rounding
    assert "matrices" not in request
    travel = _problem(tmp_path, _vrplib(), rounding).travel[0]
    assert travel.distance[:].tolist() == travel.duration[:].tolist() == [
        [0, 5000, diagonal], [5000, 0, across], [diagonal, across, 0]]


@pytest.mark.parametrize(("kind", "diagonal"), [
    ("FLOOR_2D", 1000), ("CEIL_2D", 2000), ("EXACT_2D", 1_414_000)])
def test_file_may_state_the_rounding(tmp_path: Path, kind: str, diagonal: int) -> None:
    text = _vrplib(f"EDGE_WEIGHT_TYPE: {kind}\nCAPACITY: 12")
    assert _problem(tmp_path, text).travel[0].distance[:].item(0, 2) == diagonal


@pytest.mark.parametrize(("layout", "weights", "expected"), [
    ("LOWER_ROW", "7\n8 9\n", [[0, 7], [8, 9], [9, 0]]),
    ("FULL_MATRIX", "0 7 8.5\n6 0 9\n5 4 0\n", [[0, 7], [8.5, 9], [4, 0]])])
def test_explicit_distances_need_no_locations(tmp_path: Path, layout: str, weights: str,
                                              expected: list[list[float]]) -> None:
    header = f"EDGE_WEIGHT_TYPE: EXPLICIT\nEDGE_WEIGHT_FORMAT: {layout}\nCAPACITY: 12"
    text = _vrplib(header, NODE_COORD=None, EDGE_WEIGHT=weights)
    request = _request(tmp_path, text)
    assert request["customers"][1]["location_index"] == 2
    assert "location" not in request["customers"][1]
    (_, first), (second, third), (fourth, _) = expected
    distance = _problem(tmp_path, text).travel[0].distance[:]
    assert [distance.item(leg) for leg in ((0, 1), (0, 2), (1, 2), (2, 1))] == [
        1000 * first, 1000 * second, 1000 * third, 1000 * fourth]


def test_solomon_files_are_known_by_their_headings(tmp_path: Path) -> None:
    problem = _problem(tmp_path, SOLOMON)
    customer, truck = problem.customers[0], problem.vehicle_types[0]
    assert (customer.id, customer.earliest, customer.latest) == ("1", 7_000, 20_000)
    assert (customer.service_duration, customer.demand) == (2_000, (10_000,))
    assert (truck.earliest, truck.latest) == (1_000, 90_000)
    assert (truck.count, truck.capacity) == (2, (20_000,))
    assert problem.coordinates.tolist()[1] == [3.5, 4.0]
    with pytest.raises(InstanceFileError, match="no VRPLIB file"):
        _request(tmp_path, SOLOMON, file_format="vrplib")
    with pytest.raises(InstanceFileError, match="no Solomon file"):
        _request(tmp_path, _vrplib(), file_format="solomon")


def test_vehicles_that_reload_may_make_any_number_of_trips(tmp_path: Path) -> None:
    header = "TYPE: MTVRPTWR\nVEHICLES: 3\nCAPACITY: 12\nSERVICE_TIME: 5"
    text = _vrplib(header, TIME_WINDOW="1 0 90\n2 5 50\n3 0 50\n", RELEASE_TIME="1 0\n2 0\n3 30\n",
                   VEHICLES_RELOAD_DEPOT="1 1\n2\n3 1\n", VEHICLES_MAX_RELOADS="1 9\n2 9\n3 0\n")
    problem = _problem(tmp_path, text)
    assert [(kind.count, kind.max_trips) for kind in problem.vehicle_types] == [(1, 2), (2, 1)]
    assert [customer.release_time for customer in problem.customers] == [0, 30_000]
    assert [customer.service_duration for customer in problem.customers] == [5_000, 5_000]
    assert {kind.latest for kind in problem.vehicle_types} == {90_000}
    section = text[text.index("VEHICLES_MAX_RELOADS"):text.index("EOF")]
    kinds = _problem(tmp_path, text.replace(section, "")).vehicle_types
    assert [kind.max_trips for kind in kinds] == [2, 1, 2]


def test_equal_vehicles_are_one_type(tmp_path: Path) -> None:
    text = _vrplib("TYPE: HFVRP", CAPACITY="1 4\n2 4\n3 12\n",
                   VEHICLES_FIXED_COST="1 15\n2 15\n3 20\n",
                   VEHICLES_UNIT_DISTANCE_COST="1 0.5\n2 0.5\n3 1.25\n")
    kinds = _problem(tmp_path, text).vehicle_types
    assert [(kind.id, kind.count, kind.capacity, kind.fixed_cost, kind.cost_per_km)
            for kind in kinds] == [("type-1", 2, (4_000,), 15.0, 500.0),
                                   ("type-2", 1, (12_000,), 20.0, 1250.0)]


def test_depots_have_vehicles_hours_and_limits_of_their_own(tmp_path: Path) -> None:
    text = _vrplib("TYPE: MDVRPTW\nVEHICLES: 2\nCAPACITY: 12\nVEHICLES_MAX_DISTANCE: 40",
                   DEMAND="1 0\n2 0\n3 12\n", DEPOT="1\n2\n-1\n", VEHICLES_DEPOT="1 1\n2 2\n",
                   VEHICLES_MAX_DURATION="1 50\n2 60\n", TIME_WINDOW="1 0 70\n2 5 80\n3 0 90\n")
    problem = _problem(tmp_path, text)
    assert [depot.id for depot in problem.depots] == ["depot-1", "depot-2"]
    assert [customer.id for customer in problem.customers] == ["2"]
    assert [(kind.depot, kind.earliest, kind.latest, kind.max_working_duration,
             kind.max_distance) for kind in problem.vehicle_types] == [
        (0, 0, 70_000, 50_000, 40_000), (1, 5_000, 80_000, 60_000, 40_000)]


def test_vehicles_drive_no_farther_on_all_their_trips(tmp_path: Path) -> None:
    text = _vrplib("CAPACITY: 12\nVEHICLES_MAX_DISTANCE: 40", VEHICLES_RELOAD_DEPOT="1 1\n")
    (kind,) = _problem(tmp_path, text).vehicle_types
    assert (kind.max_distance, kind.max_trip_distance) == (40_000, None)
    assert kind.max_trips > 1


def test_distance_limits_the_route_with_its_service(tmp_path: Path) -> None:
    problem = _problem(tmp_path, _vrplib("CAPACITY: 12\nDISTANCE: 30\nSERVICE_TIME: 10"))
    assert problem.vehicle_types[0].max_working_duration == 30_000
    assert problem.customers[1].service_duration == 10_000


def test_capacity_left_out_is_no_limit(tmp_path: Path) -> None:
    assert _problem(tmp_path, _vrplib("TYPE: CVRP")).vehicle_types[0].capacity == (22_000,)


@pytest.mark.parametrize(("text", "message"), [
    (_vrplib("TYPE: OVRP"), "TYPE OVRP is not supported"),
    (_vrplib(BACKHAUL="1 0\n2 1\n3 0\n", PRIZE="1 0\n2 1\n3 0\n"),
     "doesn't know what BACKHAUL, PRIZE asks for"),
    (_vrplib("EDGE_WEIGHT_TYPE: GEO"), "EDGE_WEIGHT_TYPE GEO is not supported"),
    (_vrplib(NODE_COORD=None), "NODE_COORD is missing"),
    (_vrplib(DEMAND=None), "DEMAND is missing"),
    (_vrplib(DEMAND="1 0\n3 12\n2 10\n"), "DEMAND_SECTION has '3 12' as its line 2"),
    (_vrplib(DEMAND="1 0\n2 10\n"), r"DEMAND has the shape \(2,\), not \(3,\)"),
    (_vrplib(DEMAND="1 0\n2 ten\n3 2\n"), "DEMAND is not made of numbers"),
    (_vrplib(DEMAND="1 0\n2 nan\n3 2\n"), "DEMAND has an entry that is negative or not finite"),
    (_vrplib(DEMAND="1 3\n2 4\n3 2\n"), "A depot has a demand other than 0"),
    (_vrplib("SERVICE_TIME: -1"), "SERVICE_TIME has an entry that is negative"),
    (_vrplib(DEPOT="4\n-1\n"), "DEPOT_SECTION must list nodes of the file"),
    (_vrplib("VEHICLES: 0"), "VEHICLES is 0"),
    (_vrplib("VEHICLES: 2", VEHICLES_DEPOT="1 1\n2 3\n"), "VEHICLES_DEPOT names 3"),
    (_vrplib("VEHICLES: 1", VEHICLES_RELOAD_DEPOT="1 2\n"), "VEHICLES_RELOAD_DEPOT names"),
    (_vrplib("VEHICLES: 2", VEHICLES_RELOAD_DEPOT="1 1\n"), "has 1 lines for 2 vehicles"),
    (_vrplib("DISTANCE: 9", VEHICLES_RELOAD_DEPOT="1 1\n"), "DISTANCE is not supported"),
    (_vrplib().replace("DIMENSION: 3\n", ""), "DIMENSION is missing"),
    ("once upon a time\n", "This is no VRPLIB file"),
    (SOLOMON.replace("    2      1  ", "    3      1  "), "Customer 3 stands where 2"),
    (SOLOMON.replace("         10          7", "          7"), "must hold 7 finite numbers"),
    (SOLOMON.replace("  2         20\n", "  two       20\n"), "is not made of numbers"),
    (SOLOMON.replace("  2         20\n", "  0         20\n"), "how many vehicles"),
    (SOLOMON.replace("0          1         90", "5          1         90"), "The depot, line 0"),
])
def test_what_no_request_can_state_is_refused_by_name(tmp_path: Path, text: str,
                                                      message: str) -> None:
    with pytest.raises(InstanceFileError, match=message):
        _request(tmp_path, text)


def test_too_many_customers_are_refused_before_distances_are_computed(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importers, "MAX_CUSTOMERS", 1)
    with pytest.raises(InstanceFileError, match="2 customers and at most 1 are allowed"):
        _request(tmp_path, _vrplib())


def test_request_that_breaks_a_limit_is_told_with_its_path(tmp_path: Path) -> None:
    late = SOLOMON.replace("7         20", "21        20")
    with pytest.raises(RequestError) as told:
        _request(tmp_path, late)
    assert [item.path for item in told.value.errors] == ["$.customers[0].time_window.latest"]


def test_command_writes_what_plan_takes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                        planner: Planner) -> None:
    monkeypatch.setattr(planning, "load_planner", lambda weights_dir, names: planner)
    instance, request = str(_write(tmp_path, SOLOMON)), tmp_path / "request.json"
    done = CliRunner().invoke(
        commands.cli, ["convert", instance, "--rounding", "dimacs", "--output", str(request)])
    assert (done.exit_code, done.output) == (0, "")
    planned = CliRunner().invoke(commands.cli, ["plan", str(request)])
    assert planned.exit_code == 0, planned.output
    plan = json.loads(planned.stdout)
    assert plan["status"] == "complete"
    assert plan["cost"]["total"] == pytest.approx(2 * 5.3 + 2 * 1.4)
    shown = CliRunner().invoke(commands.cli, ["convert", instance, "--format", "solomon"])
    assert json.loads(shown.stdout)["fleet"][0]["speed_kmh"] == 3.6


def test_command_names_the_file_and_what_is_wrong(tmp_path: Path) -> None:
    for text, message in ((_vrplib("TYPE: OVRP"), "TYPE OVRP is not supported"),
                          (SOLOMON.replace("7         20", "21        20"),
                           "WINDOW_ENDS_BEFORE_START $.customers[0].time_window.latest: ")):
        path = _write(tmp_path, text)
        told = CliRunner().invoke(commands.cli, ["convert", str(path)])
        assert told.exit_code == EXIT_BAD_INPUT
        assert told.stderr.startswith(f"{path}: ")
        assert message in told.stderr
        assert told.stdout == ""
