"""What looks wrong with a request, by what was seen, and nothing of what was meant."""

import json
import time
from collections.abc import Callable, Iterator
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest

from app.requests.reading import read_request
from app.requests.warnings.finding import warnings_of
from app.requests.warnings.warning import RequestWarning

Request = dict[str, Any]

ROOT = Path(__file__).resolve().parents[4]
EXAMPLES = sorted([*(ROOT / "examples").glob("*.json"),
                   *(ROOT / "app" / "schemas" / "examples").glob("*.json")])

MUNICH = [[11.575 + 0.011 * (number % 8) - 0.04, 48.137 + 0.007 * (number // 8) - 0.03]
          for number in range(60)]


def munich() -> Request:
    """Return sixty orders in a city, as they are meant."""
    return {
        "coordinate_system": "geographic",
        "depots": [{"id": "hub", "location": [11.56, 48.14]}],
        "customers": [
            {"id": f"C{number}", "location": [round(x, 4) for x in point], "demand": [10],
             "service_duration": 300, "time_window": {"earliest": 28800, "latest": 43200}}
            for number, point in enumerate(MUNICH)],
        "fleet": [{"id": "van", "count": 3, "capacity": [300], "speed_kmh": 30,
                   "shift": {"earliest": 25200, "latest": 61200},
                   "drones": {"count": 1, "capacity": [5], "endurance": 1800}}],
        "roads": "none",
    }


def seen(request: Request, **settings: Any) -> tuple[RequestWarning, ...]:
    """Return the warnings about a request."""
    return warnings_of(read_request(json.dumps(request).encode(), None), **settings)


def changed(change: Callable[[Request], Any]) -> Request:
    """Return the orders with something changed."""
    request = munich()
    change(request)
    return request


def swap(entry: Request) -> None:
    entry["location"].reverse()


def each(change: Callable[[Request], Any]) -> Callable[[Request], Any]:
    """Return a change of all customers."""
    def change_all(request: Request) -> None:
        for customer in request["customers"]:
            change(customer)
    return change_all


def all_swapped(request: Request) -> None:
    for entry in [*request["depots"], *request["customers"]]:
        swap(entry)


def in_units(factor: float) -> Callable[[Request], Any]:
    """Return a change of all windows to another unit."""
    def change(customer: Request) -> None:
        window = customer["time_window"]
        customer["time_window"] = {name: time * factor for name, time in window.items()}
    return each(change)


def of_fleet(**fields: Any) -> Callable[[Request], Any]:
    """Return a change of the vehicle type."""
    return lambda request: request["fleet"][0].update(fields)


def of_customers(**fields: Any) -> Callable[[Request], Any]:
    """Return a change of each customer."""
    return each(lambda customer: customer.update(deepcopy(fields)))


def matrix(request: Request, seconds_a_metre: float) -> None:
    size = len(request["customers"]) + 1
    metres = [[abs(row - column) * 500.0 for column in range(size)] for row in range(size)]
    request["matrices"] = {"truck": {
        "distances": metres,
        "durations": [[length * seconds_a_metre for length in row] for row in metres]}}
    for index, entry in enumerate([*request["depots"], *request["customers"]]):
        entry["location_index"] = index
    request["fleet"][0]["drones"] = None


CHANGES: dict[str, tuple[Callable[[Request], Any], str, str]] = {
    "planar": (lambda request: request.pop("coordinate_system"), "LOOKS_LIKE_DEGREES",
               "$.coordinate_system"),
    "planar kilometres": (
        lambda request: request.update(coordinate_system="planar", planar_unit=1000),
        "LOOKS_LIKE_DEGREES", "$.coordinate_system"),
    "customers swapped": (each(swap), "LOOKS_SWAPPED", "$.customers[0].location"),
    "depot swapped": (lambda request: swap(request["depots"][0]), "LOOKS_SWAPPED",
                      "$.customers[0].location"),
    "one swapped": (lambda request: swap(request["customers"][7]), "LOOKS_SWAPPED",
                    "$.customers[7].location"),
    "all swapped": (all_swapped, "LOOKS_SWAPPED", "$.depots[0].location"),
    "one in Madrid": (lambda request: request["customers"][9].update(location=[-3.7, 40.41]),
                      "FAR_APART", "$.customers[9].location"),
    "one nowhere": (lambda request: request["customers"][3].update(location=[0, 0]),
                    "LOCATION_AT_ZERO", "$.customers[3].location"),
    "in the town hall": (
        lambda request: [customer.update(location=[11.5755, 48.1374])
                         for customer in request["customers"][20:40]],
        "CUSTOMERS_AT_ONE_POINT", "$.customers[20]"),
    "area in Zürich": (
        lambda request: request.update(airspace={"no_fly": [
            [[8.5, 57.3], [8.6, 57.3], [8.6, 57.4]]]}),
        "AREA_ELSEWHERE", "$.airspace.no_fly[0]"),
    "minutes": (in_units(1 / 60), "WINDOWS_LOOK_LIKE_MINUTES", "$.customers[0].time_window"),
    "hours": (in_units(1 / 3600), "WINDOWS_LOOK_LIKE_HOURS", "$.customers[0].time_window"),
    "milliseconds": (in_units(1000), "WINDOWS_LOOK_LIKE_MILLISECONDS",
                     "$.customers[0].time_window"),
    "tomorrow": (of_customers(time_window={"earliest": 115200, "latest": 129600}),
                 "WINDOWS_OUTSIDE_SHIFTS", "$.customers[0].time_window"),
    "services in minutes": (of_customers(service_duration=5), "SERVICE_LOOKS_LIKE_MINUTES",
                            "$.customers[0].service_duration"),
    "services in milliseconds": (
        of_customers(service_duration=300_000, unassigned_cost=1),
        "SERVICE_LOOKS_LIKE_MILLISECONDS", "$.customers[0].service_duration"),
    "shift in minutes": (of_fleet(shift={"earliest": 420, "latest": 1020}),
                         "SHIFT_LOOKS_LIKE_MINUTES", "$.fleet[0].shift.latest"),
    "shift in hours": (of_fleet(shift={"earliest": 7, "latest": 17}), "SHIFT_LOOKS_LIKE_HOURS",
                       "$.fleet[0].shift.latest"),
    "shift of days": (of_fleet(shift={"latest": 200_000}), "SHIFT_LONGER_THAN_A_DAY",
                      "$.fleet[0].shift.latest"),
    "work in hours": (of_fleet(max_working_duration=8), "WORKING_DURATION_LOOKS_LIKE_HOURS",
                      "$.fleet[0].max_working_duration"),
    "work in minutes": (of_fleet(max_working_duration=480), "WORKING_DURATION_LOOKS_LIKE_MINUTES",
                        "$.fleet[0].max_working_duration"),
    "flights in minutes": (
        lambda request: request["fleet"][0]["drones"].update(endurance=30),
        "ENDURANCE_LOOKS_LIKE_MINUTES", "$.fleet[0].drones.endurance"),
    "trips in minutes": (
        lambda request: (request["fleet"][0].pop("drones"),
                         of_fleet(flies=True, endurance=30)(request)),
        "ENDURANCE_LOOKS_LIKE_MINUTES", "$.fleet[0].endurance"),
    "small fleet": (of_fleet(count=1), "FLEET_TOO_SMALL", "$.fleet[0].capacity"),
    "few cooled": (
        lambda request: (request["fleet"].append(
            request["fleet"][0] | {"id": "cooled", "count": 1, "skills": ["cooled"]}),
            of_customers(skills=["cooled"])(request)),
        "FLEET_TOO_SMALL", "$.fleet[1].capacity"),
    "nobody cooled": (lambda request: request["customers"][4].update(skills=["cooled"]),
                      "NOBODY_MAY_SERVE", "$.customers[4]"),
    "a large order": (lambda request: request["customers"][5].update(demand=[301]),
                      "LARGER_THAN_ANY_VEHICLE", "$.customers[5].demand"),
    "no time": (
        lambda request: (of_customers(service_duration=7200)(request),
                         of_fleet(drones=None)(request)),
        "SHIFTS_TOO_SHORT", "$.fleet[0].shift"),
    "metres a second": (of_fleet(speed_kmh=13.89), "SPEED_LOOKS_LIKE_METRES_PER_SECOND",
                        "$.fleet[0].speed_kmh"),
    "miles a minute": (of_fleet(speed_kmh=2), "SPEED_UNLIKELY", "$.fleet[0].speed_kmh"),
    "matrix in minutes": (lambda request: matrix(request, 0.12 / 60), "MATRIX_UNITS",
                          "$.matrices.truck"),
    "no roads": (lambda request: request.pop("roads"), "AS_THE_CROW_FLIES", "$.fleet[0].profile"),
}


def test_what_is_meant_is_not_warned_of() -> None:
    assert seen(munich()) == ()
    assert seen(changed(lambda request: matrix(request, 0.12))) == ()


@pytest.mark.parametrize("name", CHANGES)
def test_what_is_hardly_meant_is_said_once(name: str) -> None:
    change, code, path = CHANGES[name]
    warning, = seen(changed(change))
    assert (warning.code, warning.path) == (code, path)


@pytest.mark.parametrize("name", ["minutes", "work in hours", "flights in minutes", "one swapped"])
def test_what_to_write_is_what_was_meant(name: str) -> None:
    warning, = seen(changed(CHANGES[name][0]))
    meant = {"minutes": "write 28800 and 43200", "work in hours": "write 28800",
             "flights in minutes": "write 1800", "one swapped": "[11.612, 48.107]"}
    assert meant[name] in warning.message


def test_roads_are_no_flight_of_a_crow() -> None:
    request = changed(lambda request: request.pop("roads"))
    assert seen(request, road_profiles={"truck"}) == ()
    assert [warning.code for warning in seen(request, road_profiles={"bicycle"})] == [
        "AS_THE_CROW_FLIES"]


def test_what_flies_is_not_told_that_it_flies_as_crows_do() -> None:
    request = changed(lambda request: request.pop("roads"))
    truck = request["fleet"][0]
    quad = {"id": "quad", "flies": True, "count": 9, "capacity": truck["capacity"],
            "speed_kmh": 60}
    alone = request | {"fleet": [quad]}
    assert "AS_THE_CROW_FLIES" not in [warning.code for warning in seen(alone)]
    beside = request | {"fleet": [quad, truck]}
    assert [warning.path for warning in seen(beside) if warning.code == "AS_THE_CROW_FLIES"] == [
        "$.fleet[1].profile"]


@pytest.mark.parametrize(("change", "code", "path"), [
    (lambda request: request["fleet"][0].update(avoid=["tolls"]), "AVOID_WITHOUT_ROADS",
     "$.fleet[0].avoid"),
    (lambda request: request["customers"][3].update(approach="curb"), "APPROACH_WITHOUT_ROADS",
     "$.customers[3].approach"),
    (lambda request: request.update(roads={"approach": "curb"}), "APPROACH_WITHOUT_ROADS",
     "$.roads.approach"),
])
def test_roads_alone_know_what_to_avoid_and_sides_of_streets(
        change: Callable[[Request], Any], code: str, path: str) -> None:
    request = changed(lambda request: (request.pop("roads"), change(request)))
    assert seen(request, road_profiles={"truck"}) == ()
    by_crow = {warning.code: warning for warning in seen(request)}
    assert set(by_crow) == {"AS_THE_CROW_FLIES", code}
    assert by_crow[code].path == path
    assert "Roads alone know it" in by_crow[code].message


def requests_of(path: Path) -> Iterator[bytes]:
    """Yield the request that a file of an example holds."""
    content = json.loads(path.read_text("utf-8"))
    content = content.get("problem", content)
    if "depots" in content:
        yield json.dumps(content).encode()


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_no_example_is_warned_of_but_of_crows(path: Path) -> None:
    for content in requests_of(path):
        codes = {warning.code for warning in warnings_of(read_request(content, None))}
        assert codes <= {"AS_THE_CROW_FLIES"}


def test_warnings_of_many_customers_take_no_time() -> None:
    request = munich()
    request["customers"] = [
        customer | {"id": f"{number}-{customer['id']}"} for number in range(50)
        for customer in request["customers"]]
    parsed = read_request(json.dumps(request).encode(), None)
    began = time.process_time()
    assert warnings_of(parsed)
    assert time.process_time() - began < 1.0


@pytest.mark.parametrize("places", [
    [[11.57, 48.13], [11.61, 48.12], [11.53, 48.12]], [[24, 58], [24, 58.1], [24.1, 58]],
    [[13.4, 52.5], [11.6, 48.1], [9, 53.5]], [[-74, 40.7], [-118.2, 34.1], [-95.4, 29.8]],
    [[151.2, -33.87], [151.25, -33.9], [151.1, -33.8]]])
def test_rough_degrees_are_told_where_no_coordinate_system_is_stated(
        places: list[list[float]]) -> None:
    depot, *customers = places
    request: Request = {
        "depots": [{"id": "d", "location": depot}],
        "customers": [{"id": str(index), "location": place, "demand": [1]}
                      for index, place in enumerate(customers)],
        "fleet": [{"id": "van", "count": 1, "capacity": [9]}]}
    (warning,) = seen(request)
    assert (warning.code, warning.path) == ("LOOKS_LIKE_DEGREES", "$.coordinate_system")
    assert '"coordinate_system": "geographic"' in warning.message
    for stated in ({"coordinate_system": "planar"}, {"planar_unit": 1000}):
        assert "LOOKS_LIKE_DEGREES" not in [each.code for each in seen(request | stated)]


@pytest.mark.parametrize("places", [
    [[0, 0], [3.5, 4], [6, 0.5]], [[40, 50], [45, 68], [42, 66], [20, 85], [88, 30]]])
def test_small_planes_around_the_origin_are_no_degrees(places: list[list[float]]) -> None:
    request: Request = {
        "depots": [{"id": "d", "location": places[0]}],
        "customers": [{"id": str(index), "location": place, "demand": [1]}
                      for index, place in enumerate(places[1:])],
        "fleet": [{"id": "van", "count": 1, "capacity": [9]}]}
    assert "LOOKS_LIKE_DEGREES" not in [each.code for each in seen(request)]


def of_shipments(amount: int, number: int = 2) -> Request:
    """Return orders that are shipments alone, for one vehicle of four."""
    request = munich()
    request["customers"] = []
    request["shipments"] = [
        {"id": f"S{index}", "amount": [amount], "pickup": {"location": [11.5, 48.1]},
         "delivery": {"location": [11.6, 48.2]}} for index in range(number)]
    request["fleet"] = [{"id": "van", "count": 1, "capacity": [4]}]
    return request


def test_shipments_are_not_added_up_since_one_makes_room_for_the_next() -> None:
    assert not [each for each in seen(of_shipments(4)) if each.code == "FLEET_TOO_SMALL"]
    beside = of_shipments(4)
    beside["customers"] = [{"id": "C", "location": [11.55, 48.15], "demand": [4]}]
    assert not [each for each in seen(beside) if each.code == "FLEET_TOO_SMALL"]
    beside["customers"].append({"id": "D", "location": [11.56, 48.15], "demand": [1]})
    assert [each.message[:31] for each in seen(beside) if each.code == "FLEET_TOO_SMALL"] == [
        "Customers ask for 5 in all, and"]
    assert [each.code for each in seen(of_shipments(5))] == ["LARGER_THAN_ANY_VEHICLE"]


def test_the_shortest_service_of_a_customers_places_is_what_he_takes() -> None:
    request = munich()
    request["fleet"] = [{"id": "van", "count": 1, "capacity": [4000],
                         "shift": {"earliest": 28800, "latest": 36000}}]
    for customer in request["customers"]:
        customer["service_duration"] = 200
    assert [each.code for each in seen(request)] == ["SHIFTS_TOO_SHORT"]
    for customer in request["customers"]:
        customer["alternatives"] = [{"id": "locker", "location": [11.56, 48.14],
                                     "service_duration": 20}]
    assert "SHIFTS_TOO_SHORT" not in [each.code for each in seen(request)]
