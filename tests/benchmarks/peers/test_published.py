"""Tests of `benchmarks.peers.published`, on made-up instances in the formats of the sets."""

from pathlib import Path

import numpy as np
import pytest

from benchmarks.peers.answers import judge
from benchmarks.peers.published import (
    NO_LIMIT, Published, published_set, read_published, read_routes, routes_of_types, to_problem,
)
from model.problem import UNLIMITED

pytestmark = pytest.mark.slow

SOLOMON = """C901

VEHICLE
NUMBER     CAPACITY
  2         20

CUSTOMER
CUST NO.  XCOORD.   YCOORD.    DEMAND   READY TIME  DUE DATE   SERVICE   TIME

    0      0          0          0          1         90          0
    1      3          4         10          7         20          2
    2      1          1         12          0         20          3
"""

CVRP = """NAME : X-n3-k2
TYPE : CVRP
DIMENSION : 3
EDGE_WEIGHT_TYPE : EUC_2D
CAPACITY : 5
NODE_COORD_SECTION
1 0 0
2 1 1
3 3 3
DEMAND_SECTION
1 0
2 4
3 5
DEPOT_SECTION
 1
 -1
EOF
"""

FLEET = """NAME: X3-HVRP
TYPE: HFVRP
DIMENSION: 3
VEHICLES: 3
EDGE_WEIGHT_TYPE: EUC_2D
NODE_COORD_SECTION
1\t0\t0
2\t3\t4
3\t1\t1
DEMAND_SECTION
1\t0
2\t4
3\t6
CAPACITY_SECTION
1\t4
2\t4
3\t9
VEHICLES_FIXED_COST_SECTION
1\t1500
2\t1500
3\t2000
VEHICLES_UNIT_DISTANCE_COST_SECTION
1\t50
2\t50
3\t120
DEPOT_SECTION
1
EOF
"""

TRIPS = """NAME: C9R0.5
TYPE: MTVRPTWR
EDGE_WEIGHT_TYPE: EUC_2D
DIMENSION: 3
VEHICLES: 2
CAPACITY: 12
SERVICE_TIME: 2
NODE_COORD_SECTION
1 0 0
2 3 4
3 1 1
DEMAND_SECTION
1 0
2 10
3 12
TIME_WINDOW_SECTION
1 0 90
2 0 50
3 0 50
RELEASE_TIME_SECTION
1 0
2 1
3 30
VEHICLES_RELOAD_DEPOT_SECTION
1 1
2 1
DEPOT_SECTION
1
EOF
"""


def _write(folder: Path, set_name: str, name: str, text: str) -> Path:
    path = folder / set_name / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, "utf-8")
    return path


def _cost(instance: Published, path: Path, solution: str) -> float:
    """Return what a feasible `.sol` file costs."""
    path.write_text(solution, "utf-8")
    verdict = judge(to_problem(instance), routes_of_types(instance, read_routes(path)))
    assert verdict.counts
    return verdict.cost


def test_time_windows_are_counted_in_tenths(tmp_path: Path) -> None:
    instance = read_published(_write(tmp_path, "solomon", "C901.txt", SOLOMON), "solomon")
    assert instance.travel.tolist() == [[0, 50, 14], [50, 0, 36], [14, 36, 0]]
    assert instance.earliest.tolist() == [10, 70, 0]
    assert instance.latest.tolist() == [900, 200, 200]
    assert instance.service.tolist() == [0, 20, 30]
    assert instance.demand.tolist() == [0, 10, 12]
    assert [(kind.count, kind.capacity) for kind in instance.vehicles] == [(2, 20)]
    assert (instance.name, instance.max_trips, instance.has_windows) == ("C901", 1, True)
    cost = _cost(instance, tmp_path / "C901.sol", "Route #1: 1\nRoute #2: 2\nCost 12.8\n")
    assert cost == pytest.approx(12.8, rel=1e-12)


def test_problem_has_the_hours_of_the_depot(tmp_path: Path) -> None:
    instance = read_published(_write(tmp_path, "solomon", "C901.txt", SOLOMON), "solomon")
    problem = to_problem(instance)
    truck, customer = problem.vehicle_types[0], problem.customers[0]
    assert (truck.earliest, truck.latest, truck.count) == (10_000, 900_000, 2)
    assert (customer.earliest, customer.latest, customer.service_duration) == (
        70_000, 200_000, 20_000)
    assert (customer.demand, truck.capacity) == ((10_000,), (20_000,))
    assert np.array_equal(*problem.travel[0].arrays())


def test_distances_alone_are_rounded_to_the_nearest_unit(tmp_path: Path) -> None:
    instance = read_published(_write(tmp_path, "cvrp_x", "X-n3-k2.vrp", CVRP), "cvrp_x")
    assert instance.travel.tolist() == [[0, 1, 4], [1, 0, 3], [4, 3, 0]]
    assert instance.vehicles[0].count == 2
    assert not instance.has_windows
    assert instance.latest.tolist() == [NO_LIMIT] * 3
    problem = to_problem(instance)
    assert problem.vehicle_types[0].latest == problem.customers[0].latest == UNLIMITED
    assert problem.unassigned_cost == 80
    assert _cost(instance, tmp_path / "x.sol", "Route #1: 2\nRoute #2: 1\n") == pytest.approx(10)


def test_fleet_has_a_type_for_each_run_of_equal_vehicles(tmp_path: Path) -> None:
    instance = read_published(_write(tmp_path, "hfvrp", "X3-HVRP.vrp", FLEET), "hfvrp")
    assert [(kind.count, kind.capacity, kind.fixed_cost, kind.unit_cost)
            for kind in instance.vehicles] == [(2, 4, 1_500_000, 50), (1, 9, 2_000_000, 120)]
    assert instance.travel[0].tolist() == [0, 5000, 1414]
    cost = _cost(instance, tmp_path / "x.sol", "Route #1:\nRoute #2: 1\nRoute #3: 2\n")
    assert cost == pytest.approx(15 + 0.5 * 10 + 20 + 1.2 * 2.828, rel=1e-12)


def test_reloads_part_the_trips_of_a_vehicle(tmp_path: Path) -> None:
    instance = read_published(_write(tmp_path, "mtvrptwr", "C9R0.5.vrp", TRIPS), "mtvrptwr")
    assert instance.service.tolist() == [0, 20, 20]
    assert instance.release.tolist() == [0, 10, 300]
    assert instance.max_trips == 2
    path = tmp_path / "x.sol"
    assert _cost(instance, path, "Route #1: 1 0 2\n") == pytest.approx(12.8, rel=1e-12)
    assert read_routes(path) == [[[1], [2]]]
    late = to_problem(instance).customers[1]
    assert late.release_time == 300_000


def test_best_known_cost_is_read_beside_the_sets(tmp_path: Path) -> None:
    path = _write(tmp_path, "cvrp_x", "X-n3-k2.vrp", CVRP)
    assert np.isnan(read_published(path, "cvrp_x").best_known)
    table = tmp_path / "best_known.csv"
    table.write_text("instance,set,best_known_cost\nX-n3-k2,hfvrp,7\nX-n3-k2,cvrp_x,10\n", "utf-8")
    assert read_published(path, "cvrp_x").best_known == 10
    table.write_text("instance,set,best_known_cost\n", "utf-8")
    assert np.isnan(read_published(path, "cvrp_x").best_known)


def test_set_is_sorted_and_leaves_solutions_out(tmp_path: Path) -> None:
    for name in ("b.vrp", "a.vrp", "a.sol"):
        _write(tmp_path, "cvrp_x", name, CVRP)
    assert [instance.name for instance in published_set(tmp_path, "cvrp_x")] == ["a", "b"]
    assert [instance.name for instance in published_set(tmp_path, "cvrp_x", ["b"])] == ["b"]


def test_sets_of_large_instances_are_read_by_name_and_have_a_table_of_their_own(
        tmp_path: Path) -> None:
    path = _write(tmp_path, "xxl", "a.vrp", CVRP)
    assert published_set(tmp_path, "xxl") == []
    path.with_name("best_known.csv").write_text("instance,best_known\na,12\n", "utf-8")
    [instance] = published_set(tmp_path, "xxl", ["a"])
    assert (instance.name, instance.best_known) == ("a", 12)


def test_leaving_a_customer_out_costs_more_than_its_detour(tmp_path: Path) -> None:
    instance = read_published(_write(tmp_path, "hfvrp", "X3-HVRP.vrp", FLEET), "hfvrp")
    assert to_problem(instance).unassigned_cost == pytest.approx(10 * (20 + 1.2 * 10))


def test_unknown_sets_and_foreign_rules_are_refused(tmp_path: Path) -> None:
    path = _write(tmp_path, "cvrp_x", "limited.vrp",
                  CVRP.replace("CAPACITY", "DISTANCE : 9\nCAPACITY"))
    with pytest.raises(ValueError, match="set: 'tsp' is none of solomon"):
        read_published(path, "tsp")
    with pytest.raises(ValueError, match="set: 'hfvrp' has no files"):
        published_set(tmp_path, "hfvrp")
    with pytest.raises(ValueError, match=r"limited\.vrp: instances of a set have one depot"):
        read_published(path, "cvrp_x")
    explicit = CVRP.replace("EUC_2D", "EXPLICIT\nEDGE_WEIGHT_FORMAT : LOWER_ROW")
    section = explicit[explicit.index("NODE_COORD"):explicit.index("DEMAND")]
    explicit = explicit.replace(section, "EDGE_WEIGHT_SECTION\n1\n2 3\n")
    with pytest.raises(ValueError, match=r"blind\.vrp: instances of a set have coordinates"):
        read_published(_write(tmp_path, "cvrp_x", "blind.vrp", explicit), "cvrp_x")
    fraction = SOLOMON.replace("  7         20          2", "  7.25      20          2")
    with pytest.raises(ValueError, match="earliest: the set's unit does not make it whole"):
        read_published(_write(tmp_path, "solomon", "C902.txt", fraction), "solomon")


def test_solution_with_more_routes_than_vehicles_is_refused(tmp_path: Path) -> None:
    instance = read_published(_write(tmp_path, "cvrp_x", "X-n3-k2.vrp", CVRP), "cvrp_x")
    with pytest.raises(ValueError, match="routes: 3 for 2 vehicles"):
        routes_of_types(instance, [[[1]], [[2]], []])
