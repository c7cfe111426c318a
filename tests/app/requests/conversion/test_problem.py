"""Requests become problems with the numbers worked out by hand."""

import json
from dataclasses import fields
from typing import Any

import numpy as np
import pytest

from app.requests.conversion.leaving_out import default_unassigned_cost
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.problem import to_problem
from app.requests.conversion.travels import Travels
from app.requests.reading import read_request
from app.schemas.customer import CustomerInput
from app.schemas.driving import DrivingRulesInput
from app.schemas.drones import DronesInput
from app.schemas.fields import Input
from app.schemas.request import DepotInput
from app.schemas.vehicle import BreakInput, VehicleTypeInput
from model.judge.check import check
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import time_route
from model.judge.timing import RouteDecision, TripDecision
from model.problem import (
    UNLIMITED, UNREACHABLE, Break, Customer, Depot, DrivingRules, DroneType, IncompatibleGoods,
    Overtime, Problem, SpeedProfile, VehicleType,
)
from model.solution import Solution

Request = dict[str, Any]


def problem_of(request: Request) -> Problem:
    return to_problem(read_request(json.dumps(request).encode(), policies=None))


def test_defaults_of_the_smallest_request(smallest: Request) -> None:
    problem = problem_of(smallest)
    (truck,) = problem.vehicle_types
    assert (truck.id, truck.count, truck.capacity) == ("truck", 1, (20_000,))
    assert (truck.fixed_cost, truck.cost_per_km, truck.cost_per_hour) == (0, 1, 0)
    assert (truck.earliest, truck.latest, truck.max_trips) == (0, UNLIMITED, 1)
    assert truck.max_working_duration is truck.max_trip_distance is truck.drones is None
    first = problem.customers[0]
    assert (first.id, first.demand, first.served_by) == ("A", (10_000,), "either")
    assert (first.earliest, first.latest, first.late_cost_per_hour) == (0, UNLIMITED, None)


@pytest.mark.parametrize(("rounding", "legs"), [
    ("exact", [5000, 3606, 1414]), ("round", [5000, 4000, 1000]), ("trunc", [5000, 3000, 1000]),
    ("dimacs", [5000, 3600, 1400]), ("thousandths", [5000, 3606, 1414])])
def test_planar_legs_are_rounded_in_planar_units(smallest: Request, rounding: str,
                                                 legs: list[int]) -> None:
    smallest["customers"][1]["location"] = [2, 3]
    smallest["fleet"][0] |= {"speed_kmh": 3.6, "drones": {
        "count": 1, "capacity": [1], "speed_kmh": 36}}
    for unit in (1, 1000):
        problem = problem_of(smallest | {"planar_rounding": rounding, "planar_unit": unit})
        drive, flight = problem.travel
        first = [drive.distance[:].item(leg) for leg in ((0, 1), (0, 2), (1, 2))]
        assert first == pytest.approx([unit * leg for leg in legs], abs=0.5 * unit)
        if rounding != "exact":
            assert first == [unit * leg for leg in legs]
            assert drive.duration[:].tolist() == drive.distance[:].tolist()
            assert (flight.distance[:] == drive.distance[:]).all()


def test_flights_around_areas_stay_exact(smallest: Request) -> None:
    smallest["customers"][1]["location"] = [2, 3]
    smallest["fleet"][0]["drones"] = {"count": 1, "capacity": [1]}
    smallest |= {"planar_rounding": "round", "airspace": {"wind": {"speed_kmh": 1}}}
    drive, flight = problem_of(smallest).travel
    assert (drive.distance[:].item(0, 2), flight.distance[:].item(0, 2)) == (4_000_000, 3_605_551)


def test_several_windows_are_one_after_another(smallest: Request) -> None:
    first, second = smallest["customers"]
    first["time_windows"] = [
        {"earliest": 5, "latest": 5, "early_cost_per_hour": 2},
        {"earliest": 7.5, "latest": 8, "early_cost_per_hour": 2},
        {"earliest": 20, "late_cost_per_hour": 9, "late_cost": 4, "early_cost_per_hour": 2}]
    second["time_windows"] = [{"earliest": 3, "latest": 4}]
    several, one = problem_of(smallest).customers
    assert (several.earliest, several.gaps, several.latest) == (
        5000, ((5000, 7500), (8000, 20_000)), UNLIMITED)
    assert (several.late_cost_per_hour, several.early_cost_per_hour) == (9, 2)
    assert several.late_cost == 4
    assert (one.earliest, one.gaps, one.latest) == (3000, (), 4000)


def test_planar_legs_at_forty_km_per_hour(smallest: Request) -> None:
    (travel,) = problem_of(smallest).travel
    # 3-4-5 triangle: 5 km take 5 / 40 h = 450 s; both customers are 5 km from (3, 4).
    assert travel.distance[:].tolist() == [
        [0, 5_000_000, 6_000_000], [5_000_000, 0, 5_000_000], [6_000_000, 5_000_000, 0]]
    assert travel.duration[:].tolist() == [
        [0, 450_000, 540_000], [450_000, 0, 450_000], [540_000, 450_000, 0]]


def test_every_quantity_is_held_as_thousandths(smallest: Request) -> None:
    smallest["customers"][0] |= {
        "demand": [1.234], "service_duration": 0.0004, "release_time": 7,
        "time_window": {"earliest": 1.5, "latest": 2.0004, "late_cost_per_hour": 3,
                        "early_cost_per_hour": 4},
        "skills": ["cold"], "served_by": "drone"}
    smallest["fleet"][0] |= {
        "shift": {"earliest": 1, "latest": 9}, "max_working_duration": 8.5,
        "max_trip_distance": 12.25, "max_distance": 20.5, "max_travel_duration": 7.5,
        "max_trips": 2, "reload_duration": 3, "skills": ["cold"], "costs": {"fixed": 5, "per_km": 6,
                                                              "per_hour": 7, "per_stop": 0.5},
        "overtime": {"max_duration": 4.5, "cost_per_hour": 11}, "max_stops": 3, "max_sorties": 0,
        "co2_kg_per_km": 0.25, "co2_kg_per_kwh": 0.4,
        "drones": {"count": 2, "capacity": [1.5], "speed_kmh": 30, "endurance": 1.25,
                   "endurance_includes_waiting": False, "launch_duration": 0.1,
                   "recovery_duration": 0.2, "service_duration": 0.3,
                   "turnaround": {"swap_duration": 0.4, "batteries": 5},
                   "max_customers_per_sortie": 3, "costs": {"per_km": 8, "per_hour": 9}}}
    problem = problem_of(smallest)
    customer = problem.customers[0]
    assert (customer.demand, customer.service_duration) == ((1234,), 0)
    assert (customer.earliest, customer.latest, customer.release_time) == (1500, 2000, 7000)
    assert (customer.late_cost_per_hour, customer.early_cost_per_hour) == (3, 4)
    assert (customer.skills, customer.served_by) == ({"cold"}, "drone")
    truck = problem.vehicle_types[0]
    assert (truck.earliest, truck.latest, truck.reload_duration) == (1000, 9000, 3000)
    assert (truck.max_working_duration, truck.max_travel_duration) == (8500, 7500)
    assert (truck.max_trip_distance, truck.max_distance) == (12250, 20500)
    assert (truck.fixed_cost, truck.cost_per_km, truck.cost_per_hour) == (5, 6, 7)
    assert (truck.cost_per_stop, truck.max_stops, truck.max_sorties) == (0.5, 3, 0)
    assert truck.overtime == Overtime(11, 4500)
    assert (truck.co2_kg_per_km, truck.co2_kg_per_kwh) == (0.25, 0.4)
    drones = truck.drones
    assert drones is not None
    assert (drones.count, drones.capacity, drones.max_customers_per_sortie) == (2, (1500,), 3)
    assert (drones.endurance, drones.endurance_includes_waiting) == (1250, False)
    assert (drones.launch_duration, drones.recovery_duration) == (100, 200)
    assert (drones.swap_duration, drones.batteries) == (400, 5)
    assert (drones.service_duration, drones.cost_per_km, drones.cost_per_hour) == (300, 8, 9)
    assert problem.travel[drones.travel].duration[0, 1] == 600_000


@pytest.mark.parametrize(("stated", "kind"), [
    (VehicleTypeInput, VehicleType), (DronesInput, DroneType), (CustomerInput, Customer),
    (DepotInput, Depot), (BreakInput, Break), (DrivingRulesInput, DrivingRules)])
def test_numbers_that_a_request_states_by_name_have_a_unit(stated: type[Input],
                                                           kind: type[Any]) -> None:
    plain = {each.name for each in fields(kind)
             if each.type in (int, float, int | None, float | None)}
    nodes = {"depot", "end"}
    assert plain & stated.model_fields.keys() <= nodes


def test_what_is_picked_up_counts_in_the_same_steps(smallest: Request) -> None:
    smallest["customers"][0] |= {"demand": [1], "pickup": [0.00025]}
    smallest["fleet"][0] |= {"pickups": "last", "costs": {"per_load_km": 3}}
    problem = problem_of(smallest)
    assert problem.amount_decimals == (5,)
    assert [(customer.demand, customer.pickup) for customer in problem.customers] == [
        ((100_000,), (25,)), ((500_000,), ())]
    truck, = problem.vehicle_types
    assert (truck.pickups, truck.cost_per_load_km) == ("last", 3)


def test_loads_have_up_to_eight_dimensions(smallest: Request) -> None:
    for customer in smallest["customers"]:
        customer["demand"] = [1] * 8
    smallest["fleet"][0]["capacity"] = [2] * 8
    assert problem_of(smallest).num_dimensions == 8


def test_no_drones_per_truck_means_no_drones(smallest: Request) -> None:
    smallest["fleet"][0]["drones"] = {"count": 0, "capacity": [1]}
    assert problem_of(smallest).vehicle_types[0].drones is None


def test_equal_legs_are_shared(smallest: Request) -> None:
    drones = {"count": 1, "capacity": [1]}
    smallest["fleet"] = [
        {"id": "a", "count": 1, "capacity": [1]},
        {"id": "b", "count": 1, "capacity": [1], "speed_kmh": 40, "drones": drones},
        {"id": "c", "count": 1, "capacity": [1], "speed_kmh": 60, "drones": drones}]
    problem = problem_of(smallest)
    assert [kind.travel for kind in problem.vehicle_types] == [0, 0, 1]
    assert [kind.drones.travel for kind in problem.vehicle_types if kind.drones] == [1, 1]
    assert len(problem.travel) == 2


def test_geographic_distances_are_great_circles(smallest: Request) -> None:
    smallest["coordinate_system"] = "geographic"
    # One degree of a great circle of a sphere of radius 6371.0088 km is 111.195 km.
    smallest["customers"][0]["location"] = [0, 1]
    (travel,) = problem_of(smallest).travel
    assert travel.distance[0, 1] == pytest.approx(111_195_080, abs=10)


def test_rush_hour_slows_legs_that_are_built_at_the_fastest_speed(smallest: Request) -> None:
    smallest["fleet"][0] |= {"speed_kmh": 30, "speed_profile": [
        {"from": 60, "speed_kmh": 15}, {"from": 120, "factor": 2}]}
    problem = problem_of(smallest)
    truck = problem.vehicle_types[0]
    assert truck.speed_profile == SpeedProfile((60_000, 120_000), (500_000, 250_000, 1_000_000))
    assert problem.travel[truck.travel].duration[0, 1] == 300_000


def test_wind_and_no_fly_areas_change_flights_alone(smallest: Request) -> None:
    smallest["fleet"][0] |= {"speed_kmh": 60, "drones": {"count": 1, "capacity": [1]}}
    smallest["airspace"] = {
        "no_fly": [[[5.9, -0.1], [6.1, -0.1], [6.1, 0.1], [5.9, 0.1]]],
        "wind": {"speed_kmh": 20, "direction_deg": 270}}
    smallest["customers"][0]["location"] = [0, 2]
    smallest["customers"].append({"id": "C", "location": [4, 0], "demand": [1]})
    problem = problem_of(smallest)
    truck = problem.vehicle_types[0]
    assert truck.drones is not None
    flights, drives = problem.travel[truck.drones.travel], problem.travel[truck.travel]
    # Eastwards, with the west wind, at 80 km/h: 4 km in 180 s; back at 40 km/h in 360 s.
    assert (flights.duration[0, 3], flights.duration[3, 0]) == (180_000, 360_000)
    assert drives.duration[0, 3] == 240_000
    # B lies within the area.
    assert flights.duration[0, 2] == UNREACHABLE
    assert drives.duration[0, 2] == 360_000


def test_diagonal_of_a_matrix_counts_between_places_of_one_row_alone(smallest: Request) -> None:
    for place, index in zip([*smallest["depots"], *smallest["customers"]], (0, 1, 1),
                            strict=True):
        place["location_index"] = index
    table = [[7, 10], [20, 5]]
    smallest["matrices"] = {"truck": {"durations": table, "distances": table}}
    (travel,) = problem_of(smallest).travel
    for matrix in travel.arrays():
        assert matrix.tolist() == [[0, 10_000, 10_000], [20_000, 0, 5000], [20_000, 5000, 0]]


def test_matrices_are_read_by_location_index(smallest: Request) -> None:
    for place, index in zip([*smallest["depots"], *smallest["customers"]], (2, 0, 1),
                            strict=True):
        place["location_index"] = index
    durations = [[0, 10.0001, 20], [30, 0, 40], [50, 60, 0]]
    smallest["matrices"] = {"truck": {"durations": durations}, "drone": {
        "durations": durations, "distances": [[0, 1, 2], [3, 0, 4], [5, 6, 0]]}}
    smallest["fleet"][0] |= {"speed_profile": [{"from": 5, "factor": 2}],
                             "drones": {"count": 1, "capacity": [1]}}
    problem = problem_of(smallest)
    truck = problem.vehicle_types[0]
    assert truck.drones is not None
    drive, flight = problem.travel[truck.travel], problem.travel[truck.drones.travel]
    assert flight.duration[:].tolist() == [[0, 50_000, 60_000], [20_000, 0, 10_001],
                                        [40_000, 30_000, 0]]
    assert flight.distance[:].tolist() == [[0, 5000, 6000], [2000, 0, 1000], [4000, 3000, 0]]
    # Twice as fast at best, and half of that before 5 s; distances from locations.
    assert drive.duration[0].tolist() == [0, 25_000, 30_000]
    assert truck.speed_profile == SpeedProfile((5000,), (500_000, 1_000_000))
    assert drive.distance[0].tolist() == [0, 5_000_000, 6_000_000]


def test_without_locations_the_policy_sees_an_embedding(smallest: Request) -> None:
    for index, place in enumerate([*smallest["depots"], *smallest["customers"]]):
        del place["location"]
        place["location_index"] = index
    table = [[0, 3, 5], [3, 0, 4], [5, 4, 0]]
    smallest["matrices"] = {"truck": {"durations": table, "distances": table}}
    points = problem_of(smallest).coordinates
    assert np.hypot(*(points[1] - points[2])) == pytest.approx(4000)


def test_service_durations_by_type_are_the_trucks_and_the_drones(smallest: Request) -> None:
    smallest["fleet"][0]["drones"] = {"count": 1, "capacity": [1], "service_duration": 40}
    kind, (one, *_) = smallest["fleet"][0]["id"], smallest["customers"]
    one |= {"service_duration": 60, "service_duration_by_type": {kind: 120, f"{kind}/drone": 30.5}}
    problem = problem_of(smallest)
    truck, (first, second) = problem.vehicle_types[0], problem.customers[:2]
    assert truck.drones is not None
    assert (truck.service_at(first), truck.drones.service_at(first)) == (120_000, 30_500)
    assert (truck.service_at(second), truck.drones.service_at(second)) == (0, 40_000)


def test_setups_are_spared_at_one_place(smallest: Request) -> None:
    first, second = smallest["customers"]
    first |= {"setup_duration": 90, "location": second["location"]}
    second["setup_duration"] = 60
    problem = problem_of(smallest)
    assert problem.setup_between(0, 1) == 90_000
    assert problem.setup_between(0, 2) == 60_000
    assert problem.setup_between(1, 2) == problem.setup_between(2, 0) == 0
    for place, index in zip([*smallest["depots"], *smallest["customers"]], (1, 0, 1), strict=True):
        place["location_index"] = index
    table = [[0, 10], [20, 0]]
    smallest["matrices"] = {"truck": {"durations": table, "distances": table}}
    problem = problem_of(smallest)
    assert (problem.setup_between(0, 2), problem.setup_between(1, 2)) == (0, 60_000)


def test_flights_back_are_legs_of_their_own_where_somebody_sets_up(smallest: Request) -> None:
    def ways() -> int:
        request = read_request(json.dumps(smallest).encode(), policies=None)
        return Travels(PlacedRequest(request)).count()

    smallest["fleet"][0]["drones"] = {"count": 1, "capacity": [1]}
    assert ways() == 2
    smallest["customers"][0]["setup_duration"] = 1
    assert ways() == 3


def test_open_ends_and_vehicles_own_places_have_sites_too(smallest: Request) -> None:
    first, second = smallest["customers"]
    first["setup_duration"] = second["setup_duration"] = 60
    smallest["fleet"][0] |= {"start_location": first["location"], "end": "open"}
    problem = problem_of(smallest)
    assert [depot.kind for depot in problem.depots] == ["depot", "start", "nowhere"]
    assert [problem.setup_between(depot, 3) for depot in range(3)] == [60_000, 0, 60_000]
    assert problem.setup_between(1, 4) == problem.setup_between(3, 4) == 60_000


def test_goods_that_must_not_go_together_are_read(smallest: Request) -> None:
    smallest["customers"][0]["goods"] = ["food", "ice"]
    smallest["incompatible_goods"] = [{"goods": ["food", "paint"], "scope": "vehicle"}]
    problem = problem_of(smallest)
    assert problem.customers[0].goods == {"food", "ice"}
    assert problem.incompatible_goods == (
        IncompatibleGoods(frozenset({"food", "paint"}), "vehicle"),)


def test_leaving_a_customer_out_costs_more_than_any_detour(smallest: Request) -> None:
    smallest["fleet"][0] |= {"costs": {"fixed": 5, "per_km": 2, "per_hour": 10},
                             "shift": {"latest": 7200}}
    smallest["customers"][0] |= {"service_duration": 360, "time_window": {
        "latest": 3600, "late_cost_per_hour": 7}}
    problem = problem_of(smallest)
    # 10 x (5 + 2 x 6 km x 2 + (2 x 0.15 h + 0.1 h + 2 h) x 10) + 7 x 2 h
    assert problem.unassigned_cost == pytest.approx(10 * (5 + 24 + 24) + 14)
    assert problem_of(smallest | {"unassigned_cost": 3}).unassigned_cost == 3


def test_drones_may_take_off_anywhere_unless_a_place_says_otherwise(smallest: Request) -> None:
    assert not problem_of(smallest).forbids_launches
    smallest["depots"][0]["launch"] = smallest["customers"][1]["launch"] = False
    smallest["fleet"][0] |= {"start_location": [0, 0], "end": "open"}
    problem = problem_of(smallest)
    assert [depot.launch for depot in problem.depots] == [False, True, True]
    assert [customer.launch for customer in problem.customers] == [True, False]


def test_whoever_must_be_served_costs_more_than_all_others(smallest: Request) -> None:
    alone = problem_of(smallest)
    smallest["customers"][1]["unassigned_cost"] = 500
    problem = problem_of(smallest)
    must, other = problem.customers
    assert problem.unassigned_cost == alone.unassigned_cost + 500
    assert problem.cost_of_leaving_out(must) == problem.unassigned_cost
    assert problem.cost_of_leaving_out(other) == 500
    assert [problem.must_be_served(customer) for customer in (must, other)] == [True, False]
    priced = problem_of(smallest | {"unassigned_cost": 3})
    assert [priced.cost_of_leaving_out(customer) for customer in priced.customers] == [3, 500]
    assert not any(map(priced.must_be_served, priced.customers))


def test_whoever_must_be_served_costs_more_than_that_all_others_change(smallest: Request) -> None:
    alone = problem_of(smallest).unassigned_cost
    for index, customer in enumerate(smallest["customers"]):
        customer["vehicle_costs"] = {smallest["fleet"][0]["id"]: 100 + index}
    assert problem_of(smallest).unassigned_cost == alone + 201
    smallest["launch_sites"] = [{"id": "lay-by", "location": [0, 0], "cost": 50}]
    assert problem_of(smallest).unassigned_cost == alone + 201 + 2 * 2 * 50
    for customer in smallest["customers"]:
        customer["time_window"] = {"latest": 0, "late_cost_per_hour": 0, "late_cost": 7}
    assert problem_of(smallest).unassigned_cost == alone + 201 + 200 + 2 * 7
    # Each may be late for an hour because of whoever is served before it.
    hour = 3600
    for customer in smallest["customers"]:
        customer["time_window"] = {"latest": hour, "late_cost_per_hour": 0}
    in_time = problem_of(smallest).unassigned_cost
    for customer in smallest["customers"]:
        customer["time_window"]["late_cost_per_hour"] = 30
    assert problem_of(smallest).unassigned_cost == pytest.approx(in_time + 2 * 30)


@pytest.mark.parametrize("stated", [
    {"breaks": [{"id": "b", "duration": 36_000, "start": {"earliest": 0, "latest": 60},
                 "after_departure": True}]},
    {"driving_rules": {"max_driving": 60, "break_duration": 36_000}}])
def test_whoever_must_be_served_costs_more_than_all_pauses(smallest: Request,
                                                           stated: Request) -> None:
    smallest["fleet"][0] |= stated | {"costs": {"per_hour": 50}, "drones": None}
    problem = problem_of(smallest)
    served = RouteDecision(0, 0, (TripDecision((0, 1, 0)),))
    plan = Solution((time_route(problem, served, "route", EVERYTHING_OPEN).route,), (2,))
    evaluation = check(problem, plan)
    assert evaluation.violations == ()
    assert evaluation.cost.time >= 50 * 10
    assert problem.unassigned_cost > evaluation.cost.time


def test_leaving_a_customer_out_costs_something_where_nothing_else_does(
        smallest: Request) -> None:
    smallest["fleet"][0]["costs"] = {"per_km": 0}
    problem = problem_of(smallest)
    assert problem.unassigned_cost == 1
    assert default_unassigned_cost((), problem.vehicle_types, problem.travel) == 1
