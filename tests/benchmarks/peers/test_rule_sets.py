"""Tests of `benchmarks.peers.rule_sets`, on made-up instances in the formats of the sets."""

from pathlib import Path

import numpy as np
import pytest

from benchmarks.peers import pyvrp, tandem
from benchmarks.peers.answers import PeerAnswer, Verdict, has_rare_rules, judge, stated_cost
from benchmarks.peers.published import Published, read_routes, routes_of_types, to_problem
from benchmarks.peers.rule_sets import read_rule_instance, rule_set

pytestmark = pytest.mark.slow

# Three customers on a street, the depots at its ends.
DEPOTS = """NAME: PR90A
TYPE: MDVRPTW
EDGE_WEIGHT_TYPE: EUC_2D
DIMENSION: 5
VEHICLES: 3
CAPACITY: 10
VEHICLES_MAX_DURATION: 9
NODE_COORD_SECTION
1 0 0
2 10 0
3 1 0
4 2 0
5 9 0
DEMAND_SECTION
1 0
2 0
3 4
4 4
5 4
SERVICE_TIME_SECTION
1 0
2 0
3 1
4 1
5 1
TIME_WINDOW_SECTION
1 0 100
2 0 100
3 0 100
4 50 52
5 0 100
VEHICLES_DEPOT_SECTION
1 1
2 1
3 2
DEPOT_SECTION
1
2
-1
EOF
"""

SITES = """NAME: PR91
TYPE: SDVRPTW
EDGE_WEIGHT_TYPE: EUC_2D
DIMENSION: 3
VEHICLES: 3
VEHICLES_MAX_DURATION: 50
NODE_COORD_SECTION
1 0 0
2 3 4
3 6 8
DEMAND_SECTION
1 0
2 4
3 4
SERVICE_TIME_SECTION
1 0
2 1
3 1
TIME_WINDOW_SECTION
1 0 100
2 0 100
3 0 100
CAPACITY_SECTION
1 10
2 10
3 20
VEHICLES_ALLOWED_CLIENTS_SECTION
1 2
2 2
3 2 3
EOF
"""

PRIZES = """NAME : C9_10_9
TYPE : PCVRPTW
DIMENSION : 3
VEHICLES : 2
CAPACITY : 10
SERVICE_TIME : 2
EDGE_WEIGHT_TYPE : EUC_2D
NODE_COORD_SECTION
1 0 0
2 1 1
3 5 5
DEMAND_SECTION
1 0
2 4
3 4
TIME_WINDOW_SECTION
1 0 100
2 0 90
3 0 90
PRIZE_SECTION
1 0
2 4
3 6
DEPOT_SECTION
1
-1
EOF
"""

WINDOWS = """4 12 2 1
0 10
0 0 0 0 0 0 0 0 100
1 3 4 2 4 1 1 2 0 3 20 30
2 6 8 2 4 1 1 1 0 60
"""

BACKHAULS = """NAME: X-n4
TYPE: VRPB
DIMENSION: 4
CAPACITY: 10
EDGE_WEIGHT_TYPE: EUC_2D
NODE_COORD_SECTION
1 0 0
2 1 0
3 2 0
4 3 0
DEMAND_SECTION
1 0
2 0
3 9
4 0
BACKHAUL_SECTION
1 0
2 8
3 0
4 2
DEPOT_SECTION
1
EOF
"""

BOTH_WAYS = """NAME : CON9-9
TYPE : VRPSPD
DIMENSION : 3
VEHICLES : 1
CAPACITY : 10
EDGE_WEIGHT_TYPE : EXPLICIT
EDGE_WEIGHT_FORMAT : FULL_MATRIX
EDGE_WEIGHT_SECTION
0 1 2
1 0 1
2 1 0
PICKUP_AND_DELIVERY_SECTION
1 0 0 10000000 0 0 0
2 0 0 10000000 0 3 7
3 0 0 10000000 0 9 2
DEPOT_SECTION
1
-1
EOF
"""

OPEN = """NAME : C9
TYPE : OVRP
DIMENSION : 3
VEHICLES : 2
CAPACITY : 10
DISTANCE : 20
SERVICE_TIME : 2
EDGE_WEIGHT_TYPE : EXACT_2D
NODE_COORD_SECTION
1 0 0
2 3 4
3 6 8
DEMAND_SECTION
1 0
2 4
3 4
DEPOT_SECTION
1
-1
EOF
"""


def _read(folder: Path, set_name: str, name: str, text: str) -> Published:
    path = folder / set_name / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, "utf-8")
    return read_rule_instance(path, set_name)


def _judge(instance: Published, path: Path, plan: str) -> Verdict:
    """Judge a `.sol` file; the judge's cost is also that of the instance's own numbers."""
    path.write_text(plan, "utf-8")
    routes = routes_of_types(instance, read_routes(path))
    verdict = judge(to_problem(instance), routes)
    assert verdict.num_missing or verdict.cost == pytest.approx(stated_cost(instance, routes))
    return verdict


def test_vehicles_return_to_their_own_depots_in_time(tmp_path: Path) -> None:
    instance = _read(tmp_path, "mdvrptw", "PR90A.vrp", DEPOTS)
    assert [(kind.count, kind.depot, kind.max_duration) for kind in instance.vehicles] == [
        (2, 0, 9000), (1, 1, 9000)]
    assert (instance.num_depots, instance.num_customers) == (2, 3)
    path = tmp_path / "x.sol"
    # It leaves as late as the window lets it: 1 + 1 + 1 + 1 + 2 are within 9.
    best = _judge(instance, path, "Route #1: 2 3\nRoute #2:\nRoute #3: 4\n")
    assert (best.counts, best.cost) == (True, pytest.approx(6.0))
    # From the other end it is 8 + 1 + 8.
    assert not _judge(instance, path, "Route #1: 2\nRoute #2: 4\nRoute #3: 3\n").is_feasible


def test_vehicles_serve_whom_they_may(tmp_path: Path) -> None:
    instance = _read(tmp_path, "sdvrptw", "PR91.vrp", SITES)
    assert [(kind.count, kind.capacity, kind.serves) for kind in instance.vehicles] == [
        (2, 10, (1,)), (1, 20, (1, 2))]
    path = tmp_path / "x.sol"
    assert _judge(instance, path, "Route #1:\nRoute #2:\nRoute #3: 1 2\n").cost == 20
    assert not _judge(instance, path, "Route #1: 1 2\n").is_feasible


def test_who_is_left_out_costs_a_prize(tmp_path: Path) -> None:
    instance = _read(tmp_path, "pcvrptw", "C9_10_9.vrp", PRIZES)
    assert instance.service.tolist() == [0, 20, 20]
    verdict = _judge(instance, tmp_path / "x.sol", "Route #1: 1\n")
    assert (verdict.counts, verdict.cost) == (True, pytest.approx(2.8 + 6))


def test_one_of_several_windows_is_chosen(tmp_path: Path) -> None:
    instance = _read(tmp_path, "vrpmtw", "rm999.txt", WINDOWS)
    assert (instance.earliest[1], instance.latest[1], instance.gaps[1]) == (
        0, 30_000, ((3000, 20_000),))
    assert instance.gaps[2] == ()
    customer = to_problem(instance).customers[0]
    assert (customer.openings, customer.latest) == ((0, 20_000_000), 30_000_000)
    assert _judge(instance, tmp_path / "x.sol", "Route #1: 1 2\n").counts


def test_routes_end_with_their_last_customer(tmp_path: Path) -> None:
    instance = _read(tmp_path, "ovrp", "C9.vrp", OPEN)
    assert (instance.num_depots, instance.vehicles[0].max_duration) == (2, 20_000)
    assert (instance.travel[:, 1].max(), instance.travel[1].max()) == (0, 0)
    path = tmp_path / "x.sol"
    best = _judge(instance, path, "Route #1: 1 2\n")
    assert (best.counts, best.cost) == (True, 10.0)
    # Two legs of 5 and twice 2 of service, and no way home.
    for longest, counts in ((14, True), (13, False)):
        limited = _read(tmp_path, "ovrp", "C9.vrp", OPEN.replace(": 20", f": {longest}"))
        assert _judge(limited, path, "Route #1: 1 2\n").counts == counts


def test_all_is_delivered_before_anything_is_picked_up(tmp_path: Path) -> None:
    instance = _read(tmp_path, "vrpb", "X-n4.vrp", BACKHAULS)
    assert instance.vehicles[0].count == 3
    path = tmp_path / "x.sol"
    best = _judge(instance, path, "Route #1: 2 3 1\n")
    assert (best.counts, best.cost) == (True, 6.0)
    assert not _judge(instance, path, "Route #1: 1 2 3\n").is_feasible
    assert not _judge(instance, path, "Route #1: 2\nRoute #2: 3 1\n").is_feasible


def test_what_is_aboard_fits_everywhere(tmp_path: Path) -> None:
    instance = _read(tmp_path, "vrpspd", "CON9-9.vrpspd", BOTH_WAYS)
    assert instance.pickup is not None
    assert (instance.demand.tolist(), instance.pickup.tolist()) == ([0, 7, 2], [0, 3, 9])
    assert instance.travel.tolist() == [[0, 1, 2], [1, 0, 1], [2, 1, 0]]
    path = tmp_path / "x.sol"
    # It would bring home 12.
    assert not _judge(instance, path, "Route #1: 1 2\n").is_feasible
    apart = _judge(instance, path, "Route #1: 1\nRoute #2: 2\n")
    assert (apart.counts, apart.cost) == (True, pytest.approx(0.0006))


BEST = [
    ("mdvrptw", "PR90A.vrp", DEPOTS, 6.0),
    ("sdvrptw", "PR91.vrp", SITES, 20.0),
    ("pcvrptw", "C9_10_9.vrp", PRIZES, 8.8),
    ("vrpmtw", "rm999.txt", WINDOWS, 20.0),
    ("vrpb", "X-n4.vrp", BACKHAULS, 6.0),
    ("vrpspd", "CON9-9.vrpspd", BOTH_WAYS, 0.0006),
    ("ovrp", "C9.vrp", OPEN, 10.0),
]


def _require_best(instance: Published, answer: PeerAnswer, cost: float) -> None:
    """Require that the judge finds the best plan, as the instance's own numbers do."""
    assert has_rare_rules(instance)
    assert judge(to_problem(instance), answer.routes) == Verdict(pytest.approx(cost), True, 0)
    assert stated_cost(instance, answer.routes) == pytest.approx(cost)


@pytest.mark.parametrize(("set_name", "name", "text", "cost"), BEST)
def test_pyvrp_if_installed_finds_the_best_plan(tmp_path: Path, set_name: str, name: str,
                                                text: str, cost: float) -> None:
    pytest.importorskip("pyvrp")
    instance = _read(tmp_path, set_name, name, text)
    _require_best(instance, pyvrp.solve(instance, 0.05, 1), cost)


@pytest.mark.parametrize(("set_name", "name", "text", "cost"), BEST)
def test_tandem_finds_the_best_plan(tmp_path: Path, set_name: str, name: str, text: str,
                                    cost: float) -> None:
    instance = _read(tmp_path, set_name, name, text)
    tandem.solve(instance, 0.01, 1, 1)  # so that all code is loaded
    _require_best(instance, tandem.solve(instance, 0.3, 1, 1), cost)


def test_best_known_cost_is_read_beside_the_files(tmp_path: Path) -> None:
    assert np.isnan(_read(tmp_path, "vrpmtw", "rm999.txt", WINDOWS).best_known)
    table = tmp_path / "vrpmtw" / "best_known.csv"
    table.write_text("instance,best_known,own_reference\nrm999,,20.5\n", "utf-8")
    assert [instance.best_known for instance in rule_set(tmp_path, "vrpmtw")] == [20.5]


def test_foreign_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="set: 'ovrp' has no files"):
        rule_set(tmp_path, "ovrp")
    with pytest.raises(ValueError, match="depots come first"):
        _read(tmp_path, "pcvrptw", "x.vrp", PRIZES.replace("DEPOT_SECTION\n1", "DEPOT_SECTION\n2"))
    with pytest.raises(ValueError, match="2 customers, not 3"):
        _read(tmp_path, "vrpmtw", "x.txt", WINDOWS.replace("4 12 2", "4 12 3"))
