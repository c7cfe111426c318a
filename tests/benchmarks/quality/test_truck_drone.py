"""Tests of `benchmarks.quality.truck_drone`, on made-up instances in the sets' formats."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from benchmarks.quality.truck_drone import (
    UNIT, load_fstsp_murray_chu, load_hvdrp_karak, load_tspd_agatz, load_tspd_bogyrbayeva,
    load_tspd_large, load_vrpd_sacramento, load_vrptw_drone_joo_lee,
)
from benchmarks.quality.truck_drone_rules import CROSSINGS, LOOPS
from model.judge.check import Evaluation, check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import Problem
from model.solution import Solution

pytestmark = pytest.mark.slow

AGATZ = """/*The speed of the Truck*/
1.0
/*The speed of the Drone*/
0.5
/*Number of Nodes*/
3
/*The Depot*/
0.0 0.0 depot
/*The Locations (x_coor y_coor name)*/
3.0 4.0 near
6.0 8.0 far
"""

SOLOMON = """R1

VEHICLE
NUMBER     CAPACITY
  25         200

CUSTOMER
CUST NO.   XCOORD.    YCOORD.    DEMAND   READY TIME   DUE DATE   SERVICE TIME

    0       0          0          0          0        200          0
    1      10          0         10         50        100         10
    2      11          1          5          0         30         10
    3      40          0          5          0        200         10
    4      10          2         30          0        200         10
"""


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _plan(problem: Problem, stops: tuple[int, ...], *sorties: SortieDecision) -> Solution:
    """Plan one truck's trip, the rest unassigned; places by the numbers of the files."""
    def here(nodes: tuple[int, ...]) -> tuple[int, ...]:
        return tuple(node and node + problem.num_depots - 1 for node in nodes)

    trip = TripDecision(here(stops), tuple(replace(sortie, nodes=here(sortie.nodes))
                                           for sortie in sorties))
    served = trip.customers(problem.num_depots)
    unassigned = tuple(node for node in range(problem.num_depots, problem.num_nodes)
                       if node not in served)
    return Solution((schedule(problem, RouteDecision(0, 0, (trip,))),), unassigned)


def _judge(problem: Problem, stops: tuple[int, ...], *sorties: SortieDecision) -> Evaluation:
    return check(problem, _plan(problem, stops, *sorties))


def _codes(problem: Problem, stops: tuple[int, ...], *sorties: SortieDecision) -> set[str]:
    return {violation.code for violation in _judge(problem, stops, *sorties).violations}


@pytest.fixture
def agatz(tmp_path: Path) -> Path:
    """Write one instance of every kind."""
    columns = "instance,n,reference_value,method,source,kind"
    _write(tmp_path / "instances" / "line-1-n3.txt", AGATZ)
    _write(tmp_path / "restricted" / "line-2-n3.txt", "#MAXFLY 7.25\n#NOVISIT 1\n\n" + AGATZ)
    _write(tmp_path / "restricted" / "line-3-n3.txt", "#MAXFLY Infinity\n#NOVISIT 2\n\n" + AGATZ)
    _write(tmp_path / "reference_values.csv",
           f"{columns}\nline-1-n3,3,12.5,truck-only TSP tour,nowhere,upper_bound\n")
    _write(tmp_path / "restricted_reference_values.csv",
           f"{columns}\nline-2-n3,3,20,exact,nowhere,optimal\nline-3-n3,3,15,exact,nowhere,optimal\n")
    return tmp_path


def test_agatz_cost_is_the_makespan(agatz: Path) -> None:
    free, *_ = load_tspd_agatz(agatz)
    evaluation = _judge(free.problem, (0, 1, 0), SortieDecision((2,), 0, 1))
    assert evaluation.is_feasible
    # Drone 10 and back 5 at double speed while the truck drives 5, then both drive home.
    assert evaluation.cost.total == pytest.approx(7.5 + 5)
    assert (free.name, free.set_name, free.size) == ("line-1-n3", "tspd_agatz", 2)
    assert (free.reference, free.kind, free.forbids) == (12.5, "truck only", frozenset())


def test_agatz_trucks_pass_a_node_again(agatz: Path) -> None:
    """Places of launch sites come behind the depot: the depot's, then those of customers."""
    free, *_ = load_tspd_agatz(agatz)
    problem = free.problem
    assert [problem.depots[site].after for site in problem.launch_sites] == [None, "1", "2"]
    assert all(problem.allows_stop(0, site) for site in problem.launch_sites)


def test_agatz_restrictions_hold(agatz: Path) -> None:
    _, short, kept = load_tspd_agatz(agatz)
    assert {short.set_name, kept.set_name} == {"tspd_agatz_restricted"}
    assert _codes(short.problem, (0, 1, 0), SortieDecision((2,), 0, 1)) == {"ENDURANCE"}
    assert _codes(short.problem, (0, 2, 0), SortieDecision((1,), 0, 1)) == {"SERVED_BY"}
    assert _codes(kept.problem, (0, 1, 0), SortieDecision((2,), 0, 1)) == {"SERVED_BY"}
    assert _codes(kept.problem, (0, 2, 0), SortieDecision((1,), 0, 1)) == set()


def test_agatz_refuses_a_wrong_number_of_places(agatz: Path) -> None:
    _write(agatz / "instances" / "line-1-n3.txt", AGATZ + "1.0 1.0 more\n")
    with pytest.raises(ValueError, match="line-1-n3: 4 places, 3 nodes"):
        load_tspd_agatz(agatz)


def test_large_sizes_have_published_means_and_no_launch_sites(tmp_path: Path) -> None:
    for name in ("line-1-n3", "line-2-n3", "line-3-n4"):
        _write(tmp_path / f"{name}.txt", AGATZ)
    _write(tmp_path / "table.csv", "layout,n,alpha,icp_mean,files_in_repository,files_here\n"
           "line,3,1,15,2,2\nline,3,2,12,2,2\nline,4,2,20,2,1\n")
    first, second = load_tspd_large(tmp_path)
    assert (first.name, second.name) == ("line-1-n3", "line-2-n3")
    assert (first.set_name, first.size, first.reference, first.heuristic) == (
        "tspd_line", 2, None, 12)
    assert first.problem.launch_sites == ()
    evaluation = _judge(first.problem, (0, 1, 0), SortieDecision((2,), 0, 1))
    assert evaluation.cost.total == pytest.approx(7.5 + 5)


def test_bogyrbayeva_keeps_optimum_and_heuristic_apart(tmp_path: Path) -> None:
    _write(tmp_path / "n2.txt", "0 0 3 4\n0 0 6 8 \n")
    _write(tmp_path / "reference_values.csv",
           "instance,n,reference_value,own_exact_dp\nn2_row51,2,6,5\nn2_row52,2,12,\n")
    first, second = load_tspd_bogyrbayeva(tmp_path)
    assert (first.reference, first.kind, first.heuristic) == (5, "optimal", 6)
    assert (second.name, second.reference, second.kind) == ("n2_row52", 12, "upper bound")
    # A drone alone, from the depot and back to it.
    evaluation = _judge(second.problem, (0, 0), SortieDecision((1,), 0, 0))
    assert evaluation.is_feasible
    assert evaluation.cost.total == pytest.approx(10)


@pytest.fixture
def fstsp(tmp_path: Path) -> Path:
    """Write an instance of two customers; the second is too heavy for the drone."""
    place = tmp_path / "instances" / "tiny"
    _write(place / "nodes.csv", "0, 1, 1, 0.4 \n1, 2, 2, 0 \n2, 3, 3, 1 \n3, 1, 1, 0 \n")
    _write(place / "Cprime.csv", "1\n")
    _write(place / "tau.csv", "0,4,5,0\n4,0,6,4\n5,6,0,5\n0,0,0,0\n")
    _write(place / "tauprime.csv", "0,8,9,0\n8,0,10,8\n9,10,0,9\n0,0,0,0\n")
    rows = "".join(f"tiny,2,{value},{minutes}\n" for value, minutes in ((15, 18), (24, 19)))
    _write(tmp_path / "reference_values.csv", "instance,n,reference_value,endurance_min\n" + rows)
    return tmp_path


def test_fstsp_launch_is_free_at_the_depot_only(fstsp: Path) -> None:
    _, longer = load_fstsp_murray_chu(fstsp)
    assert (longer.name, longer.reference) == ("tiny-e19", 24)
    outward = _judge(longer.problem, (0, 2, 0), SortieDecision((1,), 0, 1))
    assert outward.is_feasible
    assert outward.cost.total == pytest.approx((8 + 10) + 1 + 5)
    homeward = _judge(longer.problem, (0, 2, 0), SortieDecision((1,), 1, 2))
    assert homeward.is_feasible
    assert homeward.cost.total == pytest.approx(5 + 1 + (10 + 8) + 1)


def test_fstsp_counts_recovery_as_flight(fstsp: Path) -> None:
    shorter, longer = load_fstsp_murray_chu(fstsp)
    outward = SortieDecision((1,), 0, 1)
    assert _codes(shorter.problem, (0, 2, 0), outward) == {"ENDURANCE"}
    assert _codes(longer.problem, (0, 1, 0), SortieDecision((2,), 0, 1)) >= {"SERVED_BY"}
    assert longer.forbids == {LOOPS}


@pytest.fixture
def sacramento(tmp_path: Path) -> Path:
    """Write an instance whose first customer is light and whose second is too heavy to fly."""
    _write(tmp_path / "instances" / "3.5.1.txt",
           "Customers 3 \nX \t Y \t Demand \n3 4 5.0  \n6 8 5.0000004  \n0 30 1 \n")
    _write(tmp_path / "instances" / "3.5.2.txt", "Customers 1\nX Y Demand\n3 4 5.0\n")
    _write(tmp_path / "reference_values.csv",
           "instance,n,reference_value\n3.5.1,3,2.5\n3.5.2,1,\n")
    return tmp_path


def test_sacramento_costs_miles_of_truck_and_drone(sacramento: Path) -> None:
    known, unknown = load_vrpd_sacramento(sacramento)
    assert (known.reference, known.kind, known.forbids) == (2.5, "optimal", {LOOPS})
    assert (unknown.reference, unknown.kind, unknown.size) == (None, "none", 1)
    evaluation = _judge(known.problem, (0, 2, 0), SortieDecision((1,), 0, 1))
    assert evaluation.is_feasible
    assert evaluation.cost.distance == pytest.approx(0.127351 * (20 + 0.1 * 10))


def test_sacramento_limits_payload_flight_and_idle_trucks(sacramento: Path) -> None:
    problem = load_vrpd_sacramento(sacramento)[0].problem
    assert _codes(problem, (0, 1, 0), SortieDecision((2,), 0, 1)) == {"PAYLOAD"}
    # 65 minutes out and back; the truck needs 19 with its service.
    assert _codes(problem, (0, 1, 0), SortieDecision((3,), 0, 2)) == {"ENDURANCE"}
    # The drone is back after 13 minutes; the truck comes after 51 more.
    assert _codes(problem, (0, 3, 0), SortieDecision((1,), 0, 1)) == {"ENDURANCE"}
    assert "WORKING_DURATION" in _codes(problem, (0, 0), SortieDecision((1,), 0, 1))


@pytest.fixture
def joo_lee(tmp_path: Path) -> Problem:
    """Load an instance of four customers, of which 3 is far and 4 is heavy."""
    _write(tmp_path / "instances" / "R1.txt", SOLOMON)
    _write(tmp_path / "reference_values.csv",
           "instance,n,reference_value,lower_bound\nR1,4,2071,2071\n")
    instance, = load_vrptw_drone_joo_lee(tmp_path)
    assert (instance.reference, instance.kind, instance.size) == (2071, "optimal", 4)
    assert instance.forbids == {CROSSINGS}
    return instance.problem


def test_joo_lee_rounds_out_and_back_together(joo_lee: Problem) -> None:
    # Flown before the truck's own window opens; a leg of 1.414 costs 141 by truck.
    evaluation = _judge(joo_lee, (0, 1, 0), SortieDecision((2,), 1, 1))
    assert evaluation.is_feasible
    assert evaluation.cost.distance == 2000 + 70
    assert evaluation.makespan == (50 + 10 + 10) * UNIT


def test_joo_lee_limits_flights(joo_lee: Problem) -> None:
    assert _codes(joo_lee, (0, 1, 0), SortieDecision((2,), 0, 0)) == {"UNREACHABLE"}
    assert _codes(joo_lee, (0, 1, 0), SortieDecision((3,), 1, 1)) == {"UNREACHABLE"}
    assert _codes(joo_lee, (0, 1, 0), SortieDecision((4,), 1, 1)) == {"PAYLOAD"}
    assert _codes(joo_lee, (0, 3, 2, 0)) == {"TIME_WINDOW"}


def _karak(folder: Path, drones: list[dict[str, float]]) -> None:
    stations = [{"label": 1, "x": 0, "y": 5.0}, {"label": 2, "x": 5.0, "y": 0}]
    clients = [{"label": 3, "x": 1.0, "y": 5.0, "delivery": 6.0, "pickup": 1.0},
               {"label": 4, "x": 2.0, "y": 5.0, "delivery": 4.0, "pickup": 6.5}]
    data = {"name": "A-1", "symmetric": {
        "droneSpecification": drones, "vehicleCost": 1.0, "depotCoordinates": {"x": 0, "y": 0},
        "stationCoordinates": stations, "clientCoordinates": clients}}
    _write(folder / "instances" / "A-1.hvdrp.json", json.dumps(data))
    _write(folder / "reference_values.csv", "instance,n,reference_value\nA-1,2,18\n")


def test_karak_has_a_variant_per_choice_of_stations(tmp_path: Path) -> None:
    drone = {"range": 4.0, "weight": 10.0, "cost": 2.0}
    _karak(tmp_path, [{"id": 0, **drone}, {"id": 1, **drone}])
    instance, = load_hvdrp_karak(tmp_path)
    names = [[customer.id for customer in problem.customers] for problem in instance.variants]
    assert names == [["1", "2", "3", "4"], ["1", "3", "4"], ["2", "3", "4"]]
    assert instance.problem is instance.variants[0]
    assert (instance.size, instance.forbids) == (2, frozenset())
    problem = instance.variants[1]
    evaluation = check(problem, _plan(problem, (0, 1, 0), SortieDecision((2, 3), 1, 1)))
    assert evaluation.is_feasible
    assert evaluation.cost.total == pytest.approx(10 + 2 * 4)
    # Whoever takes 6.5 in first has 6 to deliver aboard still.
    assert _codes(problem, (0, 1, 0), SortieDecision((3, 2), 1, 1)) == {"PAYLOAD"}
    assert _codes(problem, (0, 1, 0), SortieDecision((2, 3), 0, 1)) >= {"UNREACHABLE"}
    assert _codes(problem, (0, 1, 2, 0), SortieDecision((3,), 1, 1)) == {"SERVED_BY"}


def test_karak_refuses_drones_that_differ(tmp_path: Path) -> None:
    _karak(tmp_path, [{"id": 0, "range": 4.0, "weight": 10.0, "cost": 2.0},
                      {"id": 1, "range": 5.0, "weight": 10.0, "cost": 2.0}])
    with pytest.raises(ValueError, match="droneSpecification"):
        load_hvdrp_karak(tmp_path)
