"""Nothing is written where a search has no room: what asks for more is a move that isn't made."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.engine.library import call
from model.judge.check import check
from model.problem import Customer, Depot, DroneType, Problem, Travel, VehicleType
from model.search.beginning import translate
from model.search.route.room import STOPS_OPENED, Room, room_for
from model.search.improve import SearchConfig, improve
from model.search.problem_data import make_data
from model.search.route.layout import ProblemData
from model.solution import Solution
from tests.model.search.mixed_days import mixed_day
from tests.model.tiny_launches import with_launch_sites, with_some_revisits
from tests.model.tiny_shipments import with_shipments
from training.instances import generate
from tests.seeds import seeds

CROWD = 210
"""Customers, of whom two trucks take three each: so many are missing each turn that a stop at a
launch site is put in for twenty of them."""


def crowd_at(place: int) -> Problem:
    """Return a problem whose customers are all at one place, as are its depot and a launch site."""
    depots = Depot("d"), Depot("l", "launch_site", stop_cost=float(place))
    nodes = CROWD + len(depots)
    here = np.zeros((nodes, nodes), np.int64)
    truck = VehicleType("t", 2, (3,), travel=0, fixed_cost=5.0, cost_per_km=1.0,
                        drones=DroneType(2, (3,), travel=0, endurance=1_800_000))
    return Problem(depots, tuple(Customer(str(each), (1,)) for each in range(CROWD)), (truck,),
                   (Travel(here, here),), np.zeros((nodes, 2)), unassigned_cost=1e6)


def improved(problem: Problem, seed: int, turns: int) -> Solution:
    """Return what a search makes of nobody served."""
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    found = improve(problem, pack([problem]), nobody, SearchConfig(seed=seed, turns=turns))
    assert check(problem, found.solution).violations == (), seed
    return found.solution


def test_stops_for_crowds_who_are_missing_have_room() -> None:
    for seed in range(3):
        plan = improved(crowd_at(1), seed, 300)
        assert len(plan.unassigned) == CROWD - 6


def tight(problem: Problem, data: ProblemData, solution: Solution) -> Room:
    """Return room for one trip without launch sites, a third of all sorties, and the plan given."""
    room = room_for(problem, data, solution)
    halts = 2 * (room.sorties - 1) if len(data.halts) else 0
    stops = [sum(len(trip.stops) for trip in route.trips) for route in solution.routes]
    sorties = [sum(len(trip.sorties) for trip in route.trips) for route in solution.routes]
    return room._replace(
        stops=max([4, room.stops - halts - 2 * room.trips - STOPS_OPENED + 2, *stops]),
        sorties=max([1, room.sorties // 3, *sorties]))


@pytest.mark.parametrize("variant", ["multitrip", "drone", "table1", "mixed"])
def test_searches_go_on_where_routes_have_no_room(
        monkeypatch: pytest.MonkeyPatch, variant: str) -> None:
    monkeypatch.setattr(translate, "room_for", tight)
    improved(generate(np.random.default_rng(5), 60, variant), 1, 300)


def test_all_kinds_of_moves_ask_for_room(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(translate, "room_for", tight)
    for seed in seeds(12):
        rng = np.random.default_rng(seed)
        drawn = mixed_day(rng) if seed % 2 else generate(rng, 12, "drone")
        if seed % 4 == 0:
            drawn = with_some_revisits(rng, with_launch_sites(rng, drawn))
        elif seed % 4 == 2:
            drawn = with_shipments(rng, drawn)
        improved(drawn, seed, 40)


def test_what_a_plan_given_has_fits() -> None:
    problem = crowd_at(0)
    plan = improved(problem, 1, 100)
    data = make_data(problem, pack([problem]))
    none = room_for(replace(problem, vehicle_types=tuple(
        replace(kind, capacity=(0,)) for kind in problem.vehicle_types)), data, plan)
    stops = max(sum(len(trip.stops) + len(trip.sorties) for trip in route.trips)
                for route in plan.routes)
    assert none.stops >= stops


def test_a_count_for_which_there_is_no_room_fails_alone() -> None:
    problem = crowd_at(0)
    searcher = translate.make_searcher(problem, make_data(problem, pack([problem])),
                                       Solution((), ()), np.random.SeedSequence(0))
    searcher.count.best_missing = len(searcher.missing) + 1
    with pytest.raises(RuntimeError, match="tandem_go_back"):
        call("tandem_go_back", searcher)
    improved(problem, 1, 50)
