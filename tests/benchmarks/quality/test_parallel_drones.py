from pathlib import Path

from benchmarks.quality.parallel_drones import problem_of

INSTANCE = """NUM DRONES,2
NUM TRUCKS,1
TRUCK SPEED,1
DRONE SPEED,2
DRONE ENDURANCE,10000.00
0\t 0\t 0\t 0
1\t 3\t 4\t 0
2\t 0\t 8\t 1
"""


def test_trucks_drive_around_corners_and_drones_fly_straight(tmp_path: Path) -> None:
    path = tmp_path / "two.txt"
    path.write_text(INSTANCE, "utf-8")
    problem = problem_of(path)
    truck, drone = problem.vehicle_types
    assert (drone.count, drone.flies) == (2, True)
    assert problem.travel[truck.travel].duration[0].tolist() == [0, 7000, 8000]
    assert problem.travel[drone.travel].duration[0].tolist() == [0, 2500, 4000]
    assert [customer.served_by for customer in problem.customers] == ["either", "truck"]
