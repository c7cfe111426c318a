"""Tests of the engine's meaning of flights against the judge's."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.judge.launches import launch_duration
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.engine.instance import pack
from model.engine.records import Record, Records
from model.problem import UNREACHABLE, DroneType, Problem
from model.solution import Solution
from tests.engine.rules.asking import asked
from tests.model.tiny import MINUTE, draw_late, draw_tiny, with_energy, with_gaps, with_pickups

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


def flown(kind: Record, places: Records, node: int, begin: int, out: int,
          home: int) -> tuple[int, ...]:
    place = places[kind.drone_variant, node]
    return asked("flown", 4, kind, place, len(place), begin, out, home)


def is_short_enough(kind: Record, takeoff: int, back: int, begin: int) -> bool:
    return asked("endures", 1, kind, takeoff, back, begin) == (True,)


def lasts(kind: Record, places: Records, node: int, out: int, home: int) -> tuple[int, ...]:
    place = places[kind.drone_variant, node]
    return asked("lasts", 2, kind, place, len(place), out, home)


def enduring(kind: Record, takeoff_d: int, takeoff_c: int, d: int, c: int) -> tuple[int, ...]:
    return asked("enduring", 2, kind, takeoff_d, takeoff_c, d, c)


def is_charged(kind: Record, places: Records, node: int, out: int, home: int, takeoff: int,
               served: int, begin: int) -> bool:
    place = places[kind.drone_variant, node]
    left, = asked("battery_left", 1, kind, place, len(place), out, home, takeoff, served, begin)
    return left >= 0


def handled(kind: Record, time: int, launched: int) -> tuple[int, ...]:
    return asked("handled", 5, kind, time, launched)


def drawn(seed: int, count: int = 200) -> list[tuple[Problem, DroneType, int, int]]:
    """Return problems whose first type has drones, a customer's node in each, and a start."""
    rng = np.random.default_rng(seed)
    found: list[tuple[Problem, DroneType, int, int]] = []
    while len(found) < count:
        problem = (draw_tiny, draw_late)[len(found) % 2](rng)
        if len(found) % 4 > 1:
            problem = with_gaps(rng, problem)
        if len(found) % 3 == 2:
            problem = with_energy(rng, with_pickups(rng, problem))
        drones = problem.vehicle_types[0].drones
        if drones is not None:
            node = int(rng.integers(problem.num_depots, problem.num_nodes))
            found.append((problem, drones, node, int(rng.integers(0, 60)) * MINUTE))
    return found


def test_a_sortie_is_timed_and_allowed_as_the_judge_says() -> None:
    too_long = fine = held = 0
    for problem, drones, node, start in drawn(seed=11):
        depot, legs = problem.vehicle_types[0].depot, problem.travel[drones.travel].duration
        out, home = legs.item(depot, node), legs.item(node, depot)
        if UNREACHABLE in (out, home):
            continue
        decision = TripDecision((depot, depot), (SortieDecision((node,), 0, 0, 0),), start=start)
        route = schedule(problem, RouteDecision(0, 0, (decision,)))
        sortie, = route.trips[0].sorties
        instance = pack([problem])
        kind, places = instance.type[0, 0], instance.node[0]
        if not lasts(kind, places, node, out, home)[0]:
            too_long += 1
            continue
        takeoff, arrival, back, end = flown(kind, places, node, start, out, home)
        assert (takeoff, arrival, end) == (sortie.launch_time, sortie.visits[0].arrival,
                                           sortie.recovery_time)
        assert back == sortie.visits[0].departure + home == sortie.recovery_start
        others = tuple(other for other in range(problem.num_depots, problem.num_nodes)
                       if other != node)
        codes = {v.code for v in check(problem, Solution((route,), others)).violations}
        assert is_short_enough(kind, takeoff, back, back) == ("ENDURANCE" not in codes)
        charged = is_charged(kind, places, node, out, home, takeoff, back - home, back)
        assert charged == ("ENERGY" not in codes)
        fine, held = fine + ("ENDURANCE" not in codes), held + (
            takeoff > start + drones.launch_duration)
    assert min(too_long, fine, held) > 5


def test_waiting_for_the_recovery_counts_where_it_is_said_to() -> None:
    for problem, drones, _, takeoff in drawn(seed=12):
        kind = pack([problem]).type[0, 0]
        back = takeoff + drones.endurance
        assert is_short_enough(kind, takeoff, back, back)
        assert not is_short_enough(kind, takeoff, back + 1, back + 1)
        assert (is_short_enough(kind, takeoff, back, back + 1)
                != drones.endurance_includes_waiting)


def test_a_flight_that_nobody_can_fly_never_lasts() -> None:
    for problem, _, node, _ in drawn(seed=13, count=40):
        instance = pack([problem])
        kind, places = instance.type[0, 0], instance.node[0]
        for out, home in ((UNREACHABLE, 0), (0, UNREACHABLE)):
            assert lasts(kind, places, node, out, home) == (False, True)


def test_launch_and_recovery_take_what_the_drone_says() -> None:
    for problem, drones, _, time in drawn(seed=14, count=40):
        begin, launch, both, counted, differ = handled(pack([problem]).type[0, 0], time, 0)
        assert (begin, launch) == (time, drones.launch_duration)
        assert both == drones.launch_duration + drones.recovery_duration
        assert counted == time + drones.endurance_includes_waiting
        assert not differ


def test_each_launch_but_the_first_of_a_trip_takes_a_swap_longer() -> None:
    for problem, drones, _, time in drawn(seed=16, count=40):
        for has_launched in (False, True):
            swapping = replace(drones, swap_duration=MINUTE, has_launched=has_launched)
            truck = replace(problem.vehicle_types[0], max_trips=1, drones=swapping)
            kind = pack([replace(problem, vehicle_types=(truck,))]).type[0, 0]
            for launched in range(3):
                begin, launch, both, _, differ = handled(kind, time, launched)
                assert (begin, differ) == (time, not has_launched)
                assert launch == launch_duration(swapping, is_first=launched == 0)
                assert both == drones.launch_duration + MINUTE + drones.recovery_duration


def test_endurance_allows_an_interval_of_arrivals_at_the_beginning_of_a_block() -> None:
    rng = np.random.default_rng(15)
    empty = bounded = 0
    for problem, drones, _, _ in drawn(seed=15):
        kind = pack([problem]).type[0, 0]
        takeoff_d, takeoff_c = (int(value) * MINUTE for value in rng.integers(0, 30, 2))
        d, c = (value + int(more) * MINUTE for value, more in zip(
            (takeoff_d, takeoff_c), rng.integers(0, 30, 2), strict=True))
        first, last = enduring(kind, takeoff_d, takeoff_c, d, c)
        for time in range(0, 60 * MINUTE, MINUTE):
            airborne = max(time + d, c) - max(time + takeoff_d, takeoff_c)
            assert (first <= time <= last) == (airborne <= drones.endurance)
        empty, bounded = empty + (first > last), bounded + (0 < first <= last)
    assert min(empty, bounded) > 5
