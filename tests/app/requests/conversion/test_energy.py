"""What flying takes: powers by published models, climbs, and energies that others recorded."""

import json
from typing import Any

import numpy as np
import pytest

from app.requests.conversion.powers import Powers, powers_of
from app.requests.conversion.problem import to_problem
from app.requests.reading import read_request
from app.schemas.energy import EnergyInput
from app.schemas.errors import RequestError
from model.judge.energy import hover_energy, leg_energy
from model.problem import MAX_POINTS, Energy, Problem

Request = dict[str, Any]
LB = 0.453592


def problem_of(request: Request) -> Problem:
    return to_problem(read_request(json.dumps(request).encode(), policies=None))


def with_energy(request: Request, energy: dict[str, Any], **drones: Any) -> tuple[Problem, Energy]:
    """Return the problem of a request with such drones, and their energy."""
    request["fleet"][0]["drones"] = {"count": 1, "capacity": [10], "energy": energy} | drones
    problem = problem_of(request)
    found = problem.vehicle_types[0].drones
    assert found is not None
    assert found.energy is not None
    return problem, found.energy


def powers(preset: str, speed_kmh: float = 50.0, **energy: Any) -> Powers:
    return powers_of(EnergyInput(battery_wh=100.0, preset=preset, **energy), speed_kmh)


def test_powers_and_battery_are_held_in_milliwatts_and_microjoules(smallest: Request) -> None:
    _, energy = with_energy(smallest, {
        "battery_wh": 100, "reserve": 0.25, "kg_per_unit": 0.5,
        "power": {"cruise_w": 200, "cruise_w_per_kg": 30, "hover_w": 150, "hover_w_per_kg": 20},
        "climb": {"altitude": 60, "up_w": 400, "up_w_per_kg": 50, "up_seconds": 12,
                  "down_w": 100, "down_seconds": 15}, "lands": False})
    assert energy == Energy(
        available=75 * 3_600_000_000, usable_share=0.75, weights=(0, 10_000),
        cruise=(200_000, 350_000), hover=(150_000, 250_000), climb=(400_000, 650_000),
        descent=(100_000, 100_000), climb_duration=12_000, descent_duration=15_000, dimension=0,
        lands=False)


def test_hovering_takes_what_cruise_does_unless_stated(smallest: Request) -> None:
    _, energy = with_energy(smallest, {
        "battery_wh": 100, "power": {"cruise_w": 200, "cruise_w_per_kg": 30}})
    assert energy.hover == energy.cruise
    assert (energy.available, energy.lands) == (80 * 3_600_000_000, True)


def test_climb_and_descent_make_each_flight_longer_and_no_drive(smallest: Request) -> None:
    energy = {"battery_wh": 100, "power": {"cruise_w": 200}}
    smallest["fleet"][0]["speed_kmh"] = 60
    level, _ = with_energy(smallest, energy)
    problem, _ = with_energy(smallest, energy | {"climb": {"up_seconds": 10, "down_seconds": 5.5}})
    kind, = problem.vehicle_types
    assert kind.drones is not None
    drive, fly = (problem.travel[index].duration[:] for index in (kind.travel, kind.drones.travel))
    assert len(level.travel) == 1
    assert (drive == level.travel[0].duration[:]).all()
    assert (fly - drive == 15_500 * (1 - np.eye(3, dtype=int))).all()


def test_a_matrix_holds_flights_with_their_climbs(smallest: Request) -> None:
    for index, place in enumerate([*smallest["depots"], *smallest["customers"]]):
        place["location_index"] = index
    legs = [[0, 60, 60], [60, 0, 60], [60, 60, 0]]
    smallest["matrices"] = {"drone": {"durations": legs}}
    problem, energy = with_energy(smallest, {
        "battery_wh": 100, "power": {"cruise_w": 100}, "climb": {"up_seconds": 20, "up_w": 300}})
    drones = problem.vehicle_types[0].drones
    assert drones is not None
    assert problem.travel[drones.travel].duration[0, 1] == 60_000
    assert leg_energy(energy, 60_000, 0) == (20 * 300 + 40 * 100) * 1_000_000


@pytest.mark.parametrize(("energy", "code", "path"), [
    ({"battery_wh": 9}, "POWER_OR_PRESET", "$.fleet[0].drones.energy"),
    ({"battery_wh": 9, "preset": "dorling-2017", "power": {"cruise_w": 1}}, "POWER_OR_PRESET",
     "$.fleet[0].drones.energy"),
    ({"battery_wh": 9, "preset": "dorling-2016"}, "UNKNOWN_VALUE",
     "$.fleet[0].drones.energy.preset"),
    ({"battery_wh": 9, "preset": "dorling-2017", "weight_dimension": 1}, "DIMENSION_MISMATCH",
     "$.fleet[0].drones.energy.weight_dimension"),
    ({"battery_wh": 9, "preset": "rodrigues-2022", "kg_per_unit": 1e9}, "OUT_OF_RANGE",
     "$.fleet[0].drones.energy"),
    ({"battery_wh": 9, "reserve": 1, "preset": "dorling-2017"}, "OUT_OF_RANGE",
     "$.fleet[0].drones.energy.reserve"),
    ({"battery_wh": 0, "preset": "dorling-2017"}, "OUT_OF_RANGE",
     "$.fleet[0].drones.energy.battery_wh"),
])
def test_energies_that_make_no_sense_are_refused(
        energy: dict[str, Any], code: str, path: str, smallest: Request) -> None:
    smallest["fleet"][0]["drones"] = {"count": 1, "capacity": [10], "energy": energy}
    with pytest.raises(RequestError) as refused:
        problem_of(smallest)
    assert [(error.code, error.path) for error in refused.value.errors] == [(code, path)]


RECORDED = [  # UAV type, lb, seconds out, J; seconds back, J; hovering s, J; by Murray and Raj
    (31.2928, 4.0, 67.074964, 87891.3, 28.102909, 28790.0, 4.408520, 775.6),
    (15.6464, 4.0, 129.833997, 73262.0, 79.317229, 17606.3, 86.554121, 15226.8),
    (15.6464, 2.0, 154.552760, 56835.2, 189.771522, 42451.7, 32.954828, 5797.5),
]


@pytest.mark.parametrize(
    ("speed", "lb", "out", "energy_out", "back", "energy_back", "hover", "energy_hover"), RECORDED)
def test_legs_take_what_murray_and_raj_recorded(
        speed: float, lb: float, out: float, energy_out: float, back: float, energy_back: float,
        hover: float, energy_hover: float, smallest: Request) -> None:
    smallest["customers"][0]["demand"] = [lb]
    smallest["customers"][1]["demand"] = [5]
    smallest["fleet"][0]["capacity"] = [10]
    _, energy = with_energy(
        smallest, {"battery_wh": 457503 / 3600, "reserve": 0, "kg_per_unit": LB,
                   "preset": "murray-raj-2020"}, capacity=[5], speed_kmh=speed * 3.6)
    for taken, joules in ((leg_energy(energy, round(out * 1000), round(lb * 1000)), energy_out),
                          (leg_energy(energy, round(back * 1000), 0), energy_back),
                          (hover_energy(energy, round(hover * 1000), 0), energy_hover)):
        assert taken / 1e6 == pytest.approx(joules, rel=2e-5, abs=0.06)


def test_presets_say_what_their_publications_do() -> None:
    assert powers("murray-raj-2020").hover(0.0) == pytest.approx(175.9225, abs=1e-4)
    assert powers("murray-raj-2020-linear-fast").cruise(2.0) == pytest.approx(1440.4652)
    assert powers("murray-raj-2020-linear-slow").cruise(1.0) == pytest.approx(392.0152)
    # A battery of 360 kJ weighs 360 / 650 kg.
    assert powers("dorling-2017").cruise(1.0) == pytest.approx(26.9 + 46.7 * (1 + 360 / 650))
    assert powers("dorling-2017").per_wh == pytest.approx(46.7 * 3.6 / 650)
    cruise, _, climb, descent, *_ = powers("rodrigues-2022")
    lifted = (2.431 + 0.5) ** 1.5 / 1.225 ** 0.5
    assert cruise(0.5) == pytest.approx(68.9 * lifted + 16.8)
    assert climb(0.5) == pytest.approx(80.4 * lifted + 13.8)
    assert descent(0.5) == pytest.approx(71.5 * lifted - 24.3)


@pytest.mark.parametrize("number", [2, 100])
def test_bent_powers_are_stated_at_the_weights_that_occur_if_they_are_few(
        number: int, smallest: Request) -> None:
    one = smallest["customers"][0]
    smallest["customers"] = [one | {"id": str(index), "demand": [round(0.03 + index / 11, 3)]}
                             for index in range(number)]
    smallest["fleet"][0]["capacity"] = [1000]
    _, energy = with_energy(smallest, {"battery_wh": 100, "preset": "rodrigues-2022"},
                            capacity=[5])
    assert len(energy.weights) <= MAX_POINTS
    # No more than all demands, 0.03 and 0.121, or than the drone lifts.
    assert (energy.weights[0], energy.weights[-1]) == (0, 151 if number == 2 else 5000)
    assert (30 in energy.weights) == (number == 2)
    curve = powers("rodrigues-2022").cruise
    for weight in range(0, energy.weights[-1] + 1, 50):
        exact = curve(weight / 1000) * 1000
        stated = float(np.interp(weight, energy.weights, energy.cruise))
        assert -1 < stated - exact < 0.001 * exact
