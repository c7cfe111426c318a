"""Why a customer is served where he is, over HTTP."""

import time
from typing import Any

import httpx
import pytest

from app.schemas.explain import ExplainReply
from tests.app.plans.asking import documented, planned, refused

Request = dict[str, Any]


@pytest.fixture
def asked() -> Request:
    """Return the documented example: two trucks, one with a sortie from B to C and back."""
    return documented("explain")


def explained(client: httpx.Client, body: Request) -> dict[str, Any]:
    """Return the service's reply, for which a busy machine has time, too."""
    reply = client.post("/explain", json={"options": {"time_limit": 30}} | body)
    assert reply.status_code == 200, reply.text
    ExplainReply.model_validate(reply.json())
    return reply.json()


def test_every_other_way_to_serve_a_customer_is_priced(client: httpx.Client,
                                                       asked: Request) -> None:
    asked["drones"] = False
    told = explained(client, asked)
    assert (told["customer"], told["drones"], told["complete"]) == ("B", None, True)
    assert told["cost"]["total"] == pytest.approx(5 + 12 + 4 * 0.25 + 5 + 8)
    here = told["here"]
    assert (here["vehicle"], here["by"], here["service_start"]) == ("truck-1", "truck", 660)
    assert here["position"] == {"trip": 0, "own_trip": False, "stop": 2, "after": "A",
                                "recovery_stop": None, "recovered_at": None}
    found = {item["kind"]: item for item in told["alternatives"]}
    assert set(found) == {"place", "by", "vehicle", "unassigned"}
    # By the other truck there is no way past B within its window but a long one.
    assert found["by"]["by"] == "drone"
    assert not found["by"]["feasible"]
    assert "PAYLOAD" in {reason["code"] for reason in found["by"]["reasons"]}
    assert found["vehicle"]["vehicle"] == "truck-2"
    assert found["unassigned"]["cost"]["unassigned"] == 50
    assert found["unassigned"]["position"] is None
    for item in told["alternatives"]:
        terms = {term: value for term, value in item["cost"].items() if term != "total"}
        assert item["cost"]["total"] == pytest.approx(sum(terms.values()))


def test_customer_flown_to_is_priced_by_truck(client: httpx.Client, asked: Request) -> None:
    told = explained(client, asked | {"customer": "C", "drones": False})
    assert told["here"]["by"] == "drone"
    assert told["here"]["position"]["recovered_at"] == "B"
    assert told["here"]["saving"]["total"] == pytest.approx(4 * 0.25)
    found = {item["kind"]: item for item in told["alternatives"]}
    assert (found["by"]["by"], found["by"]["vehicle"]) == ("truck", "truck-1")
    # From B to C and home from there, by truck.
    assert found["by"]["cost"]["total"] == pytest.approx(2 + 40 ** 0.5 - 6 - 1)


@pytest.mark.parametrize("vehicles", [{"allowed": ["truck-2"]}, {"forbidden": ["truck-1"]}])
def test_customer_of_a_single_vehicle_is_told_what_that_costs(
        client: httpx.Client, asked: Request, vehicles: dict[str, list[str]]) -> None:
    asked["problem"]["fleet"][0]["capacity"] = [20]
    free = explained(client, asked | {"customer": "D", "drones": False})
    (there,) = [item for item in free["alternatives"] if item["kind"] == "vehicle"]
    assert (there["vehicle"], there["feasible"]) == ("truck-1", True)
    assert there["cost"]["total"] < 0
    asked["problem"]["customers"][3]["vehicles"] = vehicles
    told = explained(client, asked | {"customer": "D", "drones": False})
    (there,) = [item for item in told["alternatives"] if item["kind"] == "vehicle"]
    assert {reason["code"] for reason in there["reasons"]} == {"VEHICLE"}
    (bound,) = [item for item in told["binding"] if item["rule"] == "vehicles"]
    assert (bound["at"], bound["unit"], bound["slack"]) == ("D", "rule", None)
    assert bound["saves_per_unit"] == pytest.approx(-there["cost"]["total"])


def test_sorties_and_drones_in_sum_are_told_on_demand(client: httpx.Client,
                                                      asked: Request) -> None:
    told = explained(client, asked | {"customer": None})
    assert (told["customer"], told["here"], told["alternatives"]) == (None, None, [])
    (sortie,) = told["drones"]["sorties"]
    assert (sortie["vehicle"], sortie["customers"], sortie["tried"]) == ("truck-1", ["C"], True)
    assert sortie["saves"] == pytest.approx(2 + 40 ** 0.5 - 6 - 1)
    drones = told["drones"]
    assert drones["saves"] == pytest.approx(drones["trucks_alone"]["cost"]["total"]
                                            - drones["with_drones"]["cost"]["total"])
    assert drones["saves_at_most"] == pytest.approx(drones["trucks_alone"]["cost"]["total"]
                                                    - told["cost"]["total"])


def test_customer_left_out_is_told_prices_and_reasons(client: httpx.Client,
                                                      asked: Request) -> None:
    asked["plan"]["routes"].pop()
    asked["plan"]["unassigned"] = [{"id": "D"}]
    told = explained(client, asked | {"customer": "D", "drones": False})
    assert told["here"] is None
    assert {item["kind"] for item in told["alternatives"]} == {"vehicle"}
    assert [reason["vehicle_type"] for reason in told["reasons"]] == ["truck"]


def test_replies_of_plan_are_taken_as_they_are(client: httpx.Client, with_drones: Request) -> None:
    plan = planned(client, with_drones)
    for customer in with_drones["customers"]:
        told = explained(client, {"problem": with_drones, "plan": plan,
                                  "customer": customer["id"]})
        assert told["cost"] == plan["cost"]
        assert (told["here"] is None) == (customer["id"] in {
            item["id"] for item in plan["unassigned"]})


def test_what_has_happened_stays(client: httpx.Client, with_drones: Request) -> None:
    plan = planned(client, with_drones)
    first = plan["routes"][0]["trips"][0]["stops"][1]
    problem = with_drones | {"replan": {"plan": plan, "freeze_before": first["departure"]}}
    plan = planned(client, problem)
    told = explained(client, {"problem": problem, "plan": plan, "customer": first["id"]})
    assert told["alternatives"]
    assert not any(item["feasible"] for item in told["alternatives"])
    reasons = [{reason["code"] for reason in item["reasons"]} for item in told["alternatives"]]
    assert all("FROZEN" in codes and "TIME_MISMATCH" not in codes for codes in reasons)


def test_plan_that_breaks_a_rule_is_refused_with_what_it_breaks(client: httpx.Client,
                                                                asked: Request) -> None:
    asked["problem"]["customers"][1]["time_window"]["latest"] = 600
    assert refused(client, asked, "/explain") == [
        ("ILLEGAL_PLAN", "$.plan.routes[0].trips[0].stops[2]")]
    asked["problem"]["customers"].append({"id": "E", "location": [1, 1], "demand": [1]})
    assert ("ILLEGAL_PLAN", "$.problem.customers[4]") in refused(client, asked, "/explain")


def test_what_is_not_there_is_refused(client: httpx.Client, asked: Request) -> None:
    assert refused(client, asked | {"customer": "nobody"}, "/explain") == [
        ("UNKNOWN_CUSTOMER", "$.customer")]
    assert refused(client, asked | {"options": {"time_limit": 1e5}}, "/explain") == [
        ("OUT_OF_RANGE", "$.options.time_limit")]
    assert refused(client, asked | {"colour": 1}, "/explain") == [("UNKNOWN_FIELD", "$.colour")]
    assert refused(client, {"problem": asked["problem"]}, "/explain") == [
        ("MISSING_FIELD", "$.plan")]
    asked["plan"]["routes"][0]["type"] = "boat"
    assert ("UNKNOWN_VEHICLE_TYPE", "$.plan.routes[0].type") in refused(client, asked, "/explain")


@pytest.mark.by_clock
def test_little_time_brings_less_and_says_so(client: httpx.Client, asked: Request) -> None:
    began = time.perf_counter()
    told = explained(client, asked | {"options": {"time_limit": 1e-6}})
    assert time.perf_counter() - began < 0.5
    assert not told["complete"]
    assert told["here"]["vehicle"] == "truck-1"
    assert [item["kind"] for item in told["alternatives"]] == ["unassigned"]


def test_it_is_documented_with_an_example(client: httpx.Client) -> None:
    operation = client.get("/openapi.json").json()["paths"]["/explain"]["post"]
    content = operation["requestBody"]["content"]["application/json"]
    (example,) = content["examples"].values()
    assert explained(client, example["value"])["complete"]


def test_drones_that_fly_nothing_say_why(client: httpx.Client, asked: Request) -> None:
    asked |= {"customer": None, "drones": False, "idle_drones": True}
    (idle,) = explained(client, asked)["idle_drones"]
    # C is the only light order: 2 km from B, where it is flown to, and 40 ** 0.5 km from the hub.
    assert (idle["vehicle"], idle["code"], idle["customer"]) == ("truck-2", "COSTS_MORE", "C")
    assert idle["cost"] == pytest.approx(2 * (40 ** 0.5 - 2) * 0.25)
    asked["problem"]["customers"][2]["served_by"] = "drone"
    asked["problem"]["fleet"][0]["drones"]["endurance"] = 350
    (idle,) = explained(client, asked)["idle_drones"]
    assert (idle["code"], idle["customer"], idle["cost"]) == ("RANGE", None, None)


def test_why_drones_fly_nothing_is_told_only_if_asked(client: httpx.Client,
                                                      asked: Request) -> None:
    assert explained(client, asked | {"drones": False})["idle_drones"] is None
