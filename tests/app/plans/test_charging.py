"""Batteries that are charged aboard, over HTTP."""

from typing import Any

import httpx
import pytest
from tests.app.plans.asking import planned

Request = dict[str, Any]


def flying(request: Request, charge_w: float, battery_wh: float) -> Request:
    """Return a request all of whose customers one drone serves, one flight after another."""
    for customer in request["customers"]:
        customer["served_by"] = "drone"
    request["fleet"][0]["count"] = 1
    request["fleet"][0]["drones"] = {
        "count": 1, "capacity": [10], "launch_duration": 20, "recovery_duration": 10,
        "energy": {"battery_wh": battery_wh, "reserve": 0, "power": {"cruise_w": 100}},
        "turnaround": {"charge_w": charge_w}}
    return request


def sorties_of(plan: Request) -> list[Request]:
    """Return the sorties of the only trip, in order."""
    trip, = plan["routes"][0]["trips"]
    return sorted(trip["sorties"], key=lambda sortie: sortie["launch_time"])


def enough_for_each(client: httpx.Client, request: Request) -> float:
    """Return the Wh that suffice for any flight of a plan, and hardly for two."""
    plenty = sorties_of(planned(client, flying(request, 0.0, 100.0)))
    return float(max(sortie["energy_wh"] for sortie in plenty) + 0.01)


def test_a_drone_rests_until_it_has_what_its_next_flight_takes(client: httpx.Client,
                                                               smallest: Request) -> None:
    battery = enough_for_each(client, smallest)
    request = flying(smallest, 50.0, battery)
    plan = planned(client, request)
    first, second = sorties_of(plan)
    assert not plan["unassigned"]
    missing = first["energy_wh"] + second["energy_wh"] - battery
    rested = second["launch_time"] - 20 - first["recovery_time"]
    assert rested == pytest.approx(missing / 50 * 3600, abs=0.002)
    assert first["energy_left_wh"] == pytest.approx(battery - first["energy_wh"])
    assert second["energy_left_wh"] == pytest.approx(0, abs=1e-4)
    check = {"problem": request, "plan": plan}
    assert client.post("/check", json=check).json()["feasible"]
    slower = {"problem": flying(smallest, 49.0, battery), "plan": plan}
    assert "TIME_MISMATCH" in {
        broken["code"] for broken in client.post("/check", json=slower).json()["violations"]}


def test_a_day_under_way_goes_on_with_what_is_charged(client: httpx.Client,
                                                      smallest: Request) -> None:
    battery = enough_for_each(client, smallest)
    request = flying(smallest, 50.0, battery)
    plan = planned(client, request)
    first, second = sorties_of(plan)
    for instant in (first["launch_time"] + 1, first["recovery_time"] + 1,
                    second["launch_time"] - 30):
        replan = {"plan": plan, "freeze_before": instant}
        again = planned(client, request | {"replan": replan})
        assert sorties_of(again) == [first, second]


@pytest.mark.parametrize(("change", "code"), [
    ({"energy": None}, "CHARGE_WITHOUT_ENERGY"),
    ({"turnaround": {"charge_w": 1, "swap_duration": 1}}, "SWAP_OR_CHARGE"),
    ({"turnaround": {"charge_w": 1, "batteries": 3}}, "SWAP_OR_CHARGE")])
def test_batteries_that_are_charged_are_stated_and_not_swapped(
        client: httpx.Client, smallest: Request, change: Request, code: str) -> None:
    request = flying(smallest, 1.0, 100.0)
    request["fleet"][0]["drones"] |= change
    error, = client.post("/plan", json=request).json()["errors"]
    assert (error["code"], error["path"]) == (
        code, "$.fleet[0].drones.turnaround.charge_w")
