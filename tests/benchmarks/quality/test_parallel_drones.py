from pathlib import Path

from benchmarks.quality.parallel_drones import problem_of
from model.problem import Problem

INSTANCE = """NUM DRONES,2
NUM TRUCKS,1
TRUCK SPEED,1
DRONE SPEED,2
DRONE ENDURANCE,10000.00
0\t 0\t 0\t 0
1\t 3\t 4\t 0
2\t 0\t 8\t 1
"""


def read(folder: Path, text: str) -> Problem:
    """Return the problem of an instance's text."""
    path = folder / "instance.txt"
    path.write_text(text, "utf-8")
    return problem_of(path)


def test_trucks_drive_around_corners_and_drones_fly_straight(tmp_path: Path) -> None:
    problem = read(tmp_path, INSTANCE)
    truck, drone = problem.vehicle_types
    assert (drone.count, drone.flies) == (2, True)
    assert problem.travel[truck.travel].duration[0].tolist() == [0, 7000, 8000]
    assert problem.travel[drone.travel].duration[0].tolist() == [0, 2500, 4000]
    assert [customer.served_by for customer in problem.customers] == ["either", "truck"]


BY_COST = """NUM DRONES,4
NUM TRUCKS,10
TRUCK CAP,1300.0
DRONE CAP,2.27
TRUCK SPEED,30.0
DRONE SPEED,60.0
DRONE ENDURANCE,0.6
DRONE TIME LIMIT,1.5
TRUCK TIME LIMIT,2
TRUCK UNIT COST,1.25
DRONE UNIT COST,0.03
0 0 0 0
1 3 4 1.5
"""


def test_hours_are_limited_and_kilometres_cost_where_that_is_asked(tmp_path: Path) -> None:
    problem = read(tmp_path, BY_COST)
    truck, drone = problem.vehicle_types
    assert not problem.fairness.is_stated
    assert (truck.max_working_duration, drone.max_working_duration) == (7_200_000, 5_400_000)
    assert (truck.cost_per_km, drone.cost_per_km, drone.endurance) == (1.25, 0.03, 2_160_000)
    assert (problem.customers[0].demand, drone.capacity) == ((1_500_000, 1), (2_270_000, 1))
    assert problem.travel[truck.travel].duration[0, 1] == 7 / 30 * 3_600_000
    assert problem.travel[drone.travel].distance[0, 1] == 5_000_000


SEVERAL_TRIPS = """trucks_count 2
drones_count 3
customers 2
depot 0 0
Coordinate X         Coordinate Y         Dronable Demand
3000.0   4000.0     1        2.0
0.0      156.464    1        5.5
"""


def test_nothing_is_an_hour_aboard_where_all_is_picked_up(tmp_path: Path) -> None:
    problem = read(tmp_path, SEVERAL_TRIPS)
    truck, drone = problem.vehicle_types
    assert (truck.count, drone.count, drone.endurance) == (2, 3, 700_000)
    assert problem.travel[truck.travel].duration[0, 2] == 10_000
    assert [customer.served_by for customer in problem.customers] == ["either", "truck"]
    assert {customer.max_time_aboard for customer in problem.customers} == {3_600_000}
