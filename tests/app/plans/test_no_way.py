"""Legs that aren't there, over HTTP."""

from typing import Any

import httpx
import pytest

from app.schemas.fit import FitReply

Request = dict[str, Any]


def _with_matrix(request: Request, table: Any) -> Request:
    """Give all places rows of a matrix."""
    for index, place in enumerate([request["depots"][0], *request["customers"]]):
        place.pop("location", None)
        place["location_index"] = index
    return request | {"matrices": {"truck": {"durations": table, "distances": table}}}


def test_tables_agree_on_legs_that_are_not_there(client: httpx.Client, smallest: Request) -> None:
    request = _with_matrix(smallest, [[None, 1, 2], [1, 0, 1], [2, 1, 0]])
    request["matrices"]["truck"]["distances"] = [[0, 1, 2], [1, 0, None], [2, 1, 0]]
    (error,) = client.post("/plan", json=request).json()["errors"]
    assert (error["code"], error["path"]) == ("MATRIX_NULL", "$.matrices.truck.distances[1][2]")


@pytest.mark.parametrize("costs", [{"per_km": 1}, {"per_hour": 30}])
@pytest.mark.parametrize("overtime", [None, {"cost_per_hour": 1}])
def test_legs_that_are_not_there_are_never_driven(client: httpx.Client, smallest: Request,
                                                  costs: Any, overtime: Any) -> None:
    request = _with_matrix(smallest, [[0, 9, None, None], [9, 0, 9, None], [1, None, 0, None],
                                      [1, 1, 1, 0]])
    for number in (1, 2, 3):
        place = {"id": f"c{number}", "location_index": number, "demand": [1]}
        request["customers"][number - 1:number] = [place]
    request["fleet"][0] |= {"costs": costs, "capacity": [3], "overtime": overtime}
    request["options"] = {"time_limit": 0.1}
    plan = client.post("/plan", json=request).json()
    (trip,) = plan["routes"][0]["trips"]
    assert [stop["id"] for stop in trip["stops"][1:-1]] == ["c1", "c2"]
    fits = client.post("/fit", json={"problem": request, "plan": plan, "customer": "c3"})
    FitReply.model_validate(fits.json())
    assert {(place["feasible"], place["route"]) for place in fits.json()["places"]} == {
        (False, None)}
    (left,) = plan["unassigned"]
    assert [(reason["code"], "no leg to it" in reason["message"])
            for reason in left["reasons"]] == [("UNREACHABLE", True)]


def test_a_leg_that_is_not_there_makes_leaving_out_no_dearer(client: httpx.Client,
                                                            smallest: Request) -> None:
    def planned(table: Any) -> Any:
        reply = client.post("/plan", json=_with_matrix(smallest, table)).json()
        assert len(reply["unassigned"]) == 1
        return reply["cost"]

    smallest["fleet"][0] |= {"capacity": [2], "costs": {"per_km": 1}}
    smallest["customers"][0]["demand"] = [2]
    smallest["customers"][1]["demand"] = [2]
    smallest["options"] = {"time_limit": 0.1}
    smallest["fairness"] = {"makespan_cost_per_hour": 60}
    whole = [[0, 60, 90], [60, 0, 70], [90, 70, 0]]
    lacking = [[0, 60, 90], [60, 0, None], [90, 70, 0]]
    assert planned(lacking) == planned(whole)
