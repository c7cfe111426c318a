"""What flights take of batteries, over HTTP."""

from typing import Any

import httpx
import pytest

from tests.app.plans.asking import planned

Request = dict[str, Any]


def flying(request: Request, **energy: Any) -> Request:
    """Return a request whose second customer a drone serves."""
    request["customers"][1]["served_by"] = "drone"
    request["fleet"][0]["drones"] = {
        "count": 1, "capacity": [10], "energy": {"battery_wh": 100.0, "reserve": 0} | energy}
    return request


def test_a_reply_tells_what_flights_take(client: httpx.Client, smallest: Request) -> None:
    request = flying(smallest, power={"cruise_w": 100, "cruise_w_per_kg": 20})
    plan = planned(client, request)
    trip, = plan["routes"][0]["trips"]
    sortie, = trip["sorties"]
    # Legs at 60 km/h: out with 5 kg, back with nothing.
    hours = sortie["distance"] / 1000 / 60 / 2
    assert sortie["energy_wh"] == pytest.approx(hours * 200 + hours * 100, rel=1e-5)
    assert trip["energy_wh"] == plan["summary"]["energy_wh"] == sortie["energy_wh"]
    assert "energy_models" not in plan
    again = client.post("/check", json={"problem": request, "plan": plan}).json()
    assert (again["feasible"], again["summary"]["energy_wh"]) == (True, sortie["energy_wh"])


def test_a_reply_tells_what_is_left_at_each_point(client: httpx.Client,
                                                  smallest: Request) -> None:
    request = flying(smallest, power={"cruise_w": 100, "cruise_w_per_kg": 20, "hover_w": 300},
                     reserve=0.25, lands=False)
    plan = planned(client, request)
    trip, = plan["routes"][0]["trips"]
    sortie, = trip["sorties"]
    visit, = sortie["customers"]
    flown, hovered = visit["arrival"] - sortie["launch_time"], visit["departure"] - visit["arrival"]
    assert visit["energy_left_wh"] == pytest.approx(100 - (200 * flown + 300 * hovered) / 3600,
                                                    rel=1e-5)
    assert sortie["energy_left_wh"] == pytest.approx(100 - sortie["energy_wh"])
    assert not any("energy_left_wh" in stop for stop in trip["stops"])
    again = client.post("/check", json={"problem": request, "plan": plan}).json()
    assert again["feasible"]


def test_what_a_drone_picks_up_weighs_on_its_way_home(client: httpx.Client,
                                                      smallest: Request) -> None:
    request = flying(smallest, power={"cruise_w": 100, "cruise_w_per_kg": 20}, weight_dimension=3)
    for asking in (*request["customers"], *request["fleet"], request["fleet"][0]["drones"]):
        name = "capacity" if "capacity" in asking else "demand"
        asking[name] = [10 if name == "capacity" else 1] * 3 + [*asking[name]]
    request["customers"][1]["pickup"] = [0, 0, 0, 8]
    trip, = planned(client, request)["routes"][0]["trips"]
    sortie, = trip["sorties"]
    hours = sortie["distance"] / 1000 / 60 / 2
    assert sortie["energy_wh"] == pytest.approx(hours * 200 + hours * 260, rel=1e-5)


def test_co2_is_that_of_kilometres_and_of_what_flights_take(client: httpx.Client,
                                                            smallest: Request) -> None:
    request = flying(smallest, power={"cruise_w": 100, "cruise_w_per_kg": 20})
    request["fleet"][0] |= {"co2_kg_per_km": 0.25, "co2_kg_per_kwh": 0.4}
    summary = planned(client, request)["summary"]
    assert summary["energy_wh"] > 0
    assert summary["co2_kg"] == pytest.approx(
        summary["distance"] / 1000 * 0.25 + summary["energy_wh"] / 1000 * 0.4)
    del request["fleet"][0]["co2_kg_per_km"]
    assert planned(client, request)["summary"]["co2_kg"] == pytest.approx(
        summary["energy_wh"] / 1000 * 0.4)


def test_nothing_is_said_where_nothing_is_known(client: httpx.Client, smallest: Request) -> None:
    plan = planned(client, smallest)
    assert plan["summary"]["co2_kg"] is None
    assert plan["summary"]["energy_wh"] is plan["routes"][0]["trips"][0]["energy_wh"] is None


def test_a_preset_comes_back_with_its_numbers(client: httpx.Client, smallest: Request) -> None:
    plan = planned(client, flying(smallest, preset="dorling-2017"))
    model, = plan["energy_models"]
    assert (model["vehicle_type"], model["preset"]) == ("truck", "dorling-2017")
    assert model["available_wh"] == 100
    empty, full = model["power"]
    assert full["weight"] == 10
    assert full["cruise_w"] - empty["cruise_w"] == pytest.approx(467.0)


def test_a_preset_is_told_once_though_vehicles_of_its_type_differ(client: httpx.Client,
                                                                  smallest: Request) -> None:
    request = flying(smallest, preset="dorling-2017")
    request["fleet"][0]["count"] = 4
    request["customers"][0]["vehicles"] = {"allowed": ["truck-1", "truck-3"]}
    request["customers"][1]["vehicles"] = {"forbidden": ["truck-3"]}
    models = planned(client, request)["energy_models"]
    assert [model["vehicle_type"] for model in models] == ["truck"]


@pytest.mark.parametrize("amount", [0.125, 1.0, 2.375])
def test_energy_is_that_of_the_powers_to_a_milliwatt_and_a_half(
        client: httpx.Client, smallest: Request, amount: float) -> None:
    power = {"cruise_w": 33.3333333, "cruise_w_per_kg": 7.7777777, "hover_w": 20.0000004,
             "hover_w_per_kg": 3.1415926}
    request = flying(smallest, power=power, kg_per_unit=0.3333333, lands=False)
    for customer in request["customers"]:
        customer |= {"demand": [amount], "served_by": "drone", "service_duration": 12.345}
    request["fleet"][0]["drones"]["recovery_duration"] = 0
    sorties = planned(client, request)["routes"][0]["trips"][0]["sorties"]
    assert sorties
    for sortie in sorties:
        out, = sortie["customers"]
        there = out["arrival"] - sortie["launch_time"]
        kg = amount * 0.3333333
        joules = ((33.3333333 + 7.7777777 * kg) * there + 33.3333333 * there
                  + (20.0000004 + 3.1415926 * kg) * (out["departure"] - out["arrival"])
                  + 20.0000004 * (sortie["recovery_time"] - out["departure"] - there))
        assert abs(sortie["energy_wh"] * 3600 - joules) <= 0.0015 * sortie["duration"]


@pytest.mark.parametrize(("powers", "battery"), [
    ({"power": {"cruise_w": 100}}, 5.0), ({"preset": "dorling-2017"}, 0.001)])
def test_who_is_too_far_for_the_battery_is_left_out_with_a_remedy(
        client: httpx.Client, smallest: Request, powers: Request, battery: float) -> None:
    request = flying(smallest, **powers)
    request["fleet"][0]["drones"]["energy"]["battery_wh"] = battery
    request["customers"] = request["customers"][1:]
    plan = planned(client, request)
    reason, = plan["unassigned"][0]["reasons"]
    assert reason["code"] == "RANGE"
    assert reason["remedy"].startswith("fits with a battery of ")
    more = float(reason["remedy"].split()[5])
    request["fleet"][0]["drones"]["energy"]["battery_wh"] += more
    assert planned(client, request)["unassigned"] == []


def test_a_plan_with_energies_can_be_gone_on_from(
        client: httpx.Client, smallest: Request) -> None:
    request = flying(smallest, preset="rodrigues-2022")
    plan = planned(client, request)
    assert plan["energy_models"]
    again = planned(client, request | {"replan": {"plan": plan}})
    assert again["summary"]["energy_wh"] == plan["summary"]["energy_wh"]
