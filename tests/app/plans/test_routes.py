"""The API over HTTP: plans, health, documentation and the errors it documents."""

import json
from typing import Any

import httpx
import pytest

from app.plans import replies
from app.schemas.response import PlanReply

Request = dict[str, Any]


def errors_of(client: httpx.Client, request: Request) -> set[tuple[str, str]]:
    """Return the codes and paths of a refused request."""
    response = client.post("/plan", json=request)
    assert response.status_code == 422, response.text
    assert response.headers["content-type"] == "application/problem+json"
    body = response.json()
    assert body["status"] == 422
    assert all(error["message"].endswith(".") or ":" in error["message"]
               for error in body["errors"])
    return {(error["code"], error["path"]) for error in body["errors"]}


def test_smallest_request_gets_a_plan(client: httpx.Client, smallest: Request) -> None:
    response = client.post("/plan", json=smallest)
    assert response.status_code == 200, response.text
    assert response.headers["content-type"] == "application/json"
    plan = response.json()
    PlanReply.model_validate(plan)
    assert plan["status"] == "complete"
    assert plan["summary"]["served"] == 2
    assert plan["routes"][0]["vehicle"] == "truck-1"
    assert plan["routes"][0]["trips"][0]["load"] == [15.0]


def test_drone_example_reply_fits_its_schema(client: httpx.Client, with_drones: Request) -> None:
    plan = client.post("/plan", json=with_drones).json()
    PlanReply.model_validate(plan)
    assert plan["summary"]["sorties"] == 1
    elapsed = plan["solver"]["elapsed"]
    assert elapsed["total"] >= elapsed["validate"] > 0


def test_solver_tells_how_the_plan_was_made(client: httpx.Client, smallest: Request) -> None:
    smallest["options"] = {"seed": 4, "threads": 1, "search_iterations": 10, "time_limit": 60}
    nobody: Request = smallest | {"customers": []}
    for request in (smallest, nobody):
        solver = client.post("/plan", json=request).json()["solver"]
        assert solver["start"] == "policy"
        assert (solver["seed"], solver["threads"]) == (4, 1)
        assert solver["deterministic"] is True


def test_no_customers_give_an_empty_complete_plan(client: httpx.Client, smallest: Request) -> None:
    plan = client.post("/plan", json=smallest | {"customers": []}).json()
    PlanReply.model_validate(plan)
    assert plan["status"] == "complete"
    assert plan["routes"] == plan["unassigned"] == []
    assert plan["cost"]["total"] == 0


def test_customer_that_nobody_can_serve_is_unassigned_with_reasons(
        client: httpx.Client, smallest: Request) -> None:
    smallest["customers"][0]["skills"] = ["crane"]
    smallest["unassigned_cost"] = 77
    plan = client.post("/plan", json=smallest).json()
    PlanReply.model_validate(plan)
    assert plan["status"] == "partial"
    assert plan["cost"]["unassigned"] == 77
    (left_out,) = plan["unassigned"]
    assert left_out["id"] == "A"
    assert left_out["reasons"][0]["vehicle_type"] == "truck"


def test_a_reply_gives_as_many_reasons_as_can_be_read(
        client: httpx.Client, smallest: Request, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(replies, "MOST_REASONS", 3)
    for customer in smallest["customers"]:
        customer["skills"] = ["crane"]
    smallest["customers"] += [smallest["customers"][0] | {"id": f"more-{number}"}
                              for number in range(3)]
    smallest["unassigned_cost"] = 77
    plan = client.post("/plan", json=smallest).json()
    PlanReply.model_validate(plan)
    assert [len(each["reasons"]) for each in plan["unassigned"]] == [1, 1, 1, 0, 0]
    assert plan["unexplained"] == 2


def test_health(client: httpx.Client) -> None:
    assert client.get("/health/live").json() == {"status": "live"}
    assert client.get("/health/ready").json() == {"status": "ready", "detail": "ready"}


def test_documentation_needs_no_other_host(client: httpx.Client) -> None:
    for path in ("/", "/docs", "/redoc"):
        page = client.get(path)
        assert page.status_code == 200
        assert "http://" not in page.text
        assert "https://" not in page.text
    assert client.get("/static-offline-docs/swagger-ui-bundle.js").status_code == 200


def test_every_documented_example_runs_as_it_stands(client: httpx.Client) -> None:
    description = client.get("/openapi.json").json()
    body = description["paths"]["/plan"]["post"]["requestBody"]["content"]["application/json"]
    assert body["schema"]["$ref"].rpartition("/")[2] in description["components"]["schemas"]
    assert len(body["examples"]) >= 2
    for example in body["examples"].values():
        assert client.post("/plan", json=example["value"]).status_code == 200


def test_every_request_and_reply_field_is_described(client: httpx.Client) -> None:
    schemas = client.get("/openapi.json").json()["components"]["schemas"]
    for name, schema in schemas.items():
        assert "description" in schema, name
        for field, properties in schema.get("properties", {}).items():
            assert "description" in properties or "$ref" in properties, (name, field)


@pytest.mark.parametrize("body", [
    b"", b"{", b"\xff\xfe", b'{"depots": NaN}', b'{"planar_unit": Infinity}',
    b'{"planar_unit": -Infinity}', b"[" * 500_000, b'{"a":' * 100_000, b'{"planar_unit": 01}',
    b'{"id": "\\ud800"}', b"1" * 10_000])
def test_what_is_not_json_is_refused(client: httpx.Client, body: bytes) -> None:
    response = client.post("/plan", content=body)
    assert response.status_code == 400
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["type"] == "urn:tandem:error:not-json"


@pytest.mark.parametrize("body", ["[]", "null", '"text"', "3", "{}"])
def test_json_that_is_no_request_is_refused(client: httpx.Client, body: str) -> None:
    assert client.post("/plan", content=body).status_code == 422


def test_body_above_the_limit_is_refused_by_its_stated_length(client: httpx.Client) -> None:
    response = client.post("/plan", content=b" " * (2**20 + 1))
    assert response.status_code == 413
    assert response.json()["title"] == "The body is too large"


def test_body_above_the_limit_is_refused_while_it_streams(client: httpx.Client) -> None:
    response = client.post("/plan", content=iter([b" " * 2**19] * 3))
    assert response.status_code == 413


def test_unknown_paths_and_methods_get_problem_documents(client: httpx.Client) -> None:
    for response, status in ((client.get("/nothing"), 404), (client.get("/plan"), 405)):
        assert response.status_code == status == response.json()["status"]
        assert response.headers["content-type"] == "application/problem+json"


def _set(request: Request, path: str, value: Any) -> None:
    """Set a field named by a path such as `customers.0.id`. In place."""
    *parents, last = path.split(".")
    target: Any = request
    for key in parents:
        target = target[int(key) if key.isdigit() else key]
    target[int(last) if last.isdigit() else last] = value


@pytest.mark.parametrize(("path", "value", "code", "where"), [
    ("customers.0.id", 7, "WRONG_TYPE", "$.customers[0].id"),
    ("customers.0.demand", ["10"], "WRONG_TYPE", "$.customers[0].demand[0]"),
    ("customers.0.demand", [True], "WRONG_TYPE", "$.customers[0].demand[0]"),
    ("customers.0.demand", [-1], "OUT_OF_RANGE", "$.customers[0].demand[0]"),
    ("customers.0.demand", [1e400], "OUT_OF_RANGE", "$.customers[0].demand[0]"),
    ("customers.0.demand", [1e10], "OUT_OF_RANGE", "$.customers[0].demand[0]"),
    ("customers.0.demand", [], "WRONG_LENGTH", "$.customers[0].demand"),
    ("customers.0.demand", [1, 1], "DIMENSION_MISMATCH", "$.customers[0].demand"),
    ("customers.0.pickup", [1, 1], "DIMENSION_MISMATCH", "$.customers[0].pickup"),
    ("customers.0.pickup", [0.1 + 1e-10], "TOO_FINE", "$.customers[0].pickup[0]"),
    ("fleet.0.pickups", "first", "UNKNOWN_VALUE", "$.fleet[0].pickups"),
    ("customers.0.colour", "red", "UNKNOWN_FIELD", "$.customers[0].colour"),
    ("customers.0.a b", 1, "UNKNOWN_FIELD", "$.customers[0]['a b']"),
    ("customers.0.served_by", "bike", "UNKNOWN_VALUE", "$.customers[0].served_by"),
    ("customers.0.time_window", {"earliest": 5, "latest": 4}, "WINDOW_ENDS_BEFORE_START",
     "$.customers[0].time_window.latest"),
    ("planar_rounding", "up", "UNKNOWN_VALUE", "$.planar_rounding"),
    ("customers.0.vehicles", {"allowed": []}, "WRONG_LENGTH", "$.customers[0].vehicles.allowed"),
    ("customers.0.vehicles", {"allowed": ["truck"], "forbidden": ["truck-1"]},
     "TWO_LISTS_OF_VEHICLES", "$.customers[0].vehicles"),
    ("customers.0.vehicles", {"forbidden": ["truck-1", "truck-2"]}, "UNKNOWN_VEHICLE",
     "$.customers[0].vehicles.forbidden[1]"),
    ("customers.0.vehicles", {"allowed": ["lorry"]}, "UNKNOWN_VEHICLE",
     "$.customers[0].vehicles.allowed[0]"),
    ("customers.0.time_windows", [], "WRONG_LENGTH", "$.customers[0].time_windows"),
    ("customers.0.time_windows", [{"latest": 1}] * 9, "WRONG_LENGTH",
     "$.customers[0].time_windows"),
    ("customers.0.time_windows", [{"earliest": 5, "latest": 4}, {"earliest": 6}],
     "WINDOW_ENDS_BEFORE_START", "$.customers[0].time_windows[0].latest"),
    ("customers.0.time_windows", [{"latest": 4}, {"earliest": 4}], "WINDOWS_OVERLAP",
     "$.customers[0].time_windows[1].earliest"),
    ("customers.0.time_windows", [{}, {"earliest": 4}], "WINDOW_WITHOUT_END",
     "$.customers[0].time_windows[0].latest"),
    ("customers.0.time_windows", [{"latest": 4, "late_cost_per_hour": 0}, {"earliest": 5}],
     "SOFT_WINDOW_BEFORE_ANOTHER", "$.customers[0].time_windows[0].late_cost_per_hour"),
    ("customers.0.time_window", {"latest": 4, "late_cost": 5},
     "LATE_COST_OF_HARD_WINDOW", "$.customers[0].time_window.late_cost"),
    ("customers.0.time_windows", [{"latest": 4}, {"earliest": 5, "early_cost_per_hour": 1}],
     "EARLY_COSTS_DIFFER", "$.customers[0].time_windows[1].early_cost_per_hour"),
    ("customers.0.location", None, "MISSING_LOCATION", "$.customers[0].location"),
    ("customers.0.location", [1e9, 0], "LOCATION_TOO_FAR", "$.customers[0].location"),
    ("customers.0.location", [1], "MISSING_FIELD", "$.customers[0].location[1]"),
    ("customers.1.id", "A", "DUPLICATE_ID", "$.customers[1].id"),
    ("customers.0.service_duration_by_type", {"moon": 60}, "UNKNOWN_VEHICLE_TYPE",
     "$.customers[0].service_duration_by_type.moon"),
    ("incompatible_goods", [{"goods": ["food"]}], "WRONG_LENGTH", "$.incompatible_goods[0].goods"),
    ("incompatible_goods", [{"goods": [str(i), f"{i}x"]} for i in range(32)], "WRONG_LENGTH",
     "$.incompatible_goods"),
    ("customers", None, "WRONG_TYPE", "$.customers"),
    ("depots", [], "NO_DEPOT", "$.depots"),
    ("fleet", [], "EMPTY_FLEET", "$.fleet"),
    ("fleet.0.depot", "moon", "UNKNOWN_DEPOT", "$.fleet[0].depot"),
    ("fleet.0.count", 1.5, "WRONG_TYPE", "$.fleet[0].count"),
    ("fleet.0.count", 0, "OUT_OF_RANGE", "$.fleet[0].count"),
    ("fleet.0.shift", {"earliest": 9, "latest": 8}, "SHIFT_ENDS_BEFORE_START",
     "$.fleet[0].shift.latest"),
    ("depots.0.time_window", {"earliest": 9, "latest": 8}, "WINDOW_ENDS_BEFORE_START",
     "$.depots[0].time_window.latest"),
    ("fleet.0.speed_kmh", 0, "OUT_OF_RANGE", "$.fleet[0].speed_kmh"),
    ("fleet.0.speed_profile", [{"from": 9, "speed_kmh": 8}, {"from": 9, "speed_kmh": 7}],
     "SPEED_PROFILE_ORDER", "$.fleet[0].speed_profile[1].from"),
    ("fleet.0.speed_profile", [{"from": 9}], "MISSING_SPEED", "$.fleet[0].speed_profile[0]"),
    ("fleet.0.speed_profile", [{"from": 9, "speed_kmh": 8, "factor": 1}], "TWO_SPEEDS",
     "$.fleet[0].speed_profile[0]"),
    ("fleet.0.drones", {"count": 1, "capacity": [1, 2]}, "DIMENSION_MISMATCH",
     "$.fleet[0].drones.capacity"),
    ("airspace", {"no_fly": [[[0, 0], [1, 1], [1, 0], [0, 1]]]}, "POLYGON_CROSSES_ITSELF",
     "$.airspace.no_fly[0]"),
    ("airspace", {"no_fly": [[[0, 0], [1, 1], [2, 2]]]}, "POLYGON_WITHOUT_AREA",
     "$.airspace.no_fly[0]"),
    ("airspace", {"no_fly": [[[0, 0], [1, 1]]]}, "WRONG_LENGTH", "$.airspace.no_fly[0]"),
    ("options", {"policy": "oracle"}, "UNKNOWN_POLICY", "$.options.policy"),
    ("options", {"seed": -1}, "OUT_OF_RANGE", "$.options.seed"),
    ("options", {"threads": 0}, "OUT_OF_RANGE", "$.options.threads"),
    ("options", {"threads": 65}, "OUT_OF_RANGE", "$.options.threads"),
    ("options", {"threads": 1.5}, "WRONG_TYPE", "$.options.threads"),
    ("options", {"search_iterations": -1}, "OUT_OF_RANGE", "$.options.search_iterations"),
    ("options", {"time_limit": "1"}, "WRONG_TYPE", "$.options.time_limit"),
    ("matrices", {"truck": 7}, "WRONG_TYPE", "$.matrices.truck"),
])
def test_each_error_has_a_code_and_a_path(client: httpx.Client, smallest: Request, path: str,
                                          value: Any, code: str, where: str) -> None:
    _set(smallest, path, value)
    content = json.dumps(smallest).replace("Infinity", "1e400")
    errors = client.post("/plan", content=content).json()["errors"]
    assert (code, where) in [(error["code"], error["path"]) for error in errors]
    assert len(errors) == 1 or path == "matrices"


def test_geographic_locations_must_lie_on_the_globe(client: httpx.Client,
                                                    smallest: Request) -> None:
    smallest["coordinate_system"] = "geographic"
    smallest["customers"][0]["location"] = [47.4, 190.0]
    smallest["airspace"] = {"no_fly": [[[0, 0], [1, 0], [0, 91]]]}
    assert errors_of(client, smallest) == {
        ("LOCATION_OFF_GLOBE", "$.customers[0].location"),
        ("LOCATION_OFF_GLOBE", "$.airspace.no_fly[0][2]"),
    }


def _with_matrix(request: Request, durations: Any) -> Request:
    for index, place in enumerate([*request["depots"], *request["customers"]]):
        del place["location"]
        place["location_index"] = index
    return request | {"matrices": {"truck": {"durations": durations, "distances": durations}}}


@pytest.mark.parametrize(("durations", "errors"), [
    ([[0, 1, 2], [1, 0], [2, 1, 0]], {("MATRIX_SIZE", "$.matrices.truck.durations[1]"),
                                      ("MATRIX_SIZE", "$.matrices.truck.distances[1]")}),
    ([[0, 1], [1, 0]], {("MATRIX_SIZE", "$.customers[1].location_index")}),
    ([[0, -1, 2], [1, 0, 1], [2, 1, -3]],
     {("MATRIX_NEGATIVE", f"$.matrices.truck.{table}{entry}")
      for table in ("durations", "distances") for entry in ("[0][1]", "[2][2]")}),
    ([[0, "far", 2], [1, 0, 1], [2, 1, 0]], {("MATRIX_VALUE", "$.matrices.truck.durations[0][1]"),
                                             ("MATRIX_VALUE", "$.matrices.truck.distances[0][1]")}),
    ([[0, None, -2], [1, 0, 1], [2, 1, 0]],
     {("MATRIX_NEGATIVE", f"$.matrices.truck.{table}[0][2]")
      for table in ("durations", "distances")}),
])
def test_matrices_are_checked(client: httpx.Client, smallest: Request, durations: Any,
                              errors: set[tuple[str, str]]) -> None:
    assert errors_of(client, _with_matrix(smallest, durations)) == errors


def test_it_is_told_how_a_leg_is_stated_that_is_not_there(client: httpx.Client,
                                                          smallest: Request) -> None:
    request = _with_matrix(smallest, [[0, 2_147_483_647, 2], [1, 0, 1], [2, 1, 0]])
    reply = client.post("/plan", json=request)
    assert "A leg that isn't there is stated as null" in reply.json()["errors"][0]["message"]
    request["matrices"]["truck"]["durations"][0][1] = None
    assert client.post("/plan", json=request).status_code == 200


def test_places_need_an_index_with_matrices(client: httpx.Client, smallest: Request) -> None:
    request = _with_matrix(smallest, [[0, 1, 2], [1, 0, 1], [2, 1, 0]])
    del request["customers"][1]["location_index"]
    request["fleet"][0]["drones"] = {"count": 1, "capacity": [1]}
    assert errors_of(client, request) == {
        ("MISSING_LOCATION_INDEX", "$.customers[1].location_index"),
        ("MISSING_LOCATION", "$.depots[0].location"),
        ("MISSING_LOCATION", "$.customers[0].location"),
        ("MISSING_LOCATION", "$.customers[1].location"),
    }


def test_matrix_speed_profiles_scale(client: httpx.Client, smallest: Request) -> None:
    request = _with_matrix(smallest, [[0, 1, 2], [1, 0, 1], [2, 1, 0]])
    request["fleet"][0]["speed_profile"] = [{"from": 0, "speed_kmh": 30}]
    assert errors_of(client, request) == {
        ("MISSING_SPEED", "$.fleet[0].speed_profile[0].speed_kmh")}
    request["fleet"][0]["speed_kmh"] = 60
    assert client.post("/plan", json=request).status_code == 200


def test_all_errors_come_at_once(client: httpx.Client, smallest: Request) -> None:
    _set(smallest, "customers.0.demand", ["10"])
    _set(smallest, "customers.0.colour", "red")
    _set(smallest, "customers.1.time_window", {"earliest": 5, "latest": 4})
    _set(smallest, "fleet.0.depot", "moon")
    _set(smallest, "options", {"policy": "oracle"})
    _set(smallest, "airspace", {"no_fly": 3})
    assert errors_of(client, smallest) == {
        ("WRONG_TYPE", "$.customers[0].demand[0]"),
        ("UNKNOWN_FIELD", "$.customers[0].colour"),
        ("WINDOW_ENDS_BEFORE_START", "$.customers[1].time_window.latest"),
        ("UNKNOWN_DEPOT", "$.fleet[0].depot"),
        ("UNKNOWN_POLICY", "$.options.policy"),
        ("WRONG_TYPE", "$.airspace.no_fly"),
    }


def test_number_of_listed_errors_is_limited(client: httpx.Client, smallest: Request) -> None:
    _set(smallest, "customers", [{}] * 2000)
    body = client.post("/plan", json=smallest).json()
    assert len(body["errors"]) == 1000
    assert "4000 errors" in body["detail"]
    _set(smallest, "customers.0", {f"x{i}": 0 for i in range(30_000)})
    # Of long bodies, what is wrong first is told alone.
    assert [(error["code"], error["path"])
            for error in client.post("/plan", json=smallest).json()["errors"]] == [
        ("UNKNOWN_FIELD", "$.customers[0].x0")]


NIGHT = {"earliest": "22:00", "latest": "02:00"}


@pytest.mark.parametrize(("path", "value"), [
    ("customers", {"time_window": NIGHT}), ("customers", {"time_windows": [NIGHT]}),
    ("fleet", {"shift": NIGHT})])
@pytest.mark.parametrize("also_wrong", [False, True])
def test_nights_in_clocks_are_refused_with_how_the_next_day_is_written(
        client: httpx.Client, smallest: Request, path: str, value: Request,
        also_wrong: bool) -> None:
    smallest |= {"plan_start": "2026-05-04T00:00:00+02:00", "time_zone": "Europe/Berlin"}
    smallest[path][0] |= value
    if also_wrong:
        smallest["colour"] = "red"
    (message,) = (error["message"] for error in client.post("/plan", json=smallest).json()["errors"]
                  if "ENDS_BEFORE_START" in error["code"])
    assert "ends at 2:00 (7200 s), before it starts at 22:00 (79200 s)" in message
    assert "if it ends on the next day, state +1 02:00, else" in message
    smallest.pop("colour", None)
    (kind,) = value
    smallest[path][0] |= {kind: [NIGHT | {"latest": "+1 02:00"}] if kind == "time_windows"
                          else NIGHT | {"latest": "+1 02:00"}}
    assert client.post("/plan", json=smallest).status_code == 200


def test_nights_in_seconds_are_refused_with_those_of_the_next_day(
        client: httpx.Client, smallest: Request) -> None:
    smallest["customers"][0]["time_window"] = {"earliest": 79200, "latest": 7200}
    (error,) = client.post("/plan", json=smallest).json()["errors"]
    assert "if it ends on the next day, state 93600 (+1 and a time" in error["message"]
    smallest["customers"][0]["time_window"] = {"earliest": 5, "latest": 4}
    (error,) = client.post("/plan", json=smallest).json()["errors"]
    assert "next day" not in error["message"]
