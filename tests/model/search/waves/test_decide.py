"""Who leaves now and who waits, on a line: places at -10, -9, 9 and 10 km from the depot."""

import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.problem import (
    Customer, Depot, DroneType, Problem, Relation, Travel, VehicleType,
)
from model.search.waves.decide import Outlook, WaveConfig, decide, must_leave
from model.search.waves.future import Coming, Wave
from model.solution import Solution
from tests.seeds import seeds

PLACES = -10, -9, 9, 10
HOUR = 3_600_000
NOW, NEXT = HOUR, 2 * HOUR
FEW = WaveConfig(futures=6, turns=200, last_turns=200, price_share=1.0)


def wave_of(*open_orders: tuple[int, Customer], departures: tuple[int, ...] = (NOW, NEXT)) -> Wave:
    """Return open orders at some places, by index, which a kilometre and a minute are apart."""
    at = np.array([0, *PLACES, *(PLACES[place] for place, _ in open_orders)])
    apart = np.abs(at[:, None] - at)
    customers = (*(Customer(f"place {place}", (0,)) for place in PLACES),
                 *(customer for _, customer in open_orders))
    problem = Problem(
        (Depot("depot"),), customers, (VehicleType("van", 3, (2000,), 0, cost_per_km=1.0),),
        (Travel(apart * 60_000, apart * 1_000_000),), np.zeros((len(at), 2)), 1e4)
    return Wave(problem, tuple(range(5, len(at))), departures)


def order(name: str, latest: int = 4 * HOUR, release: int = 0) -> Customer:
    return Customer(name, (1000,), latest=latest, release_time=release)


def coming(place: int) -> list[Coming]:
    return [Coming(1 + place, order("came"), NEXT)]


def leaves(plan: Solution) -> list[int]:
    return sorted(stop.node for route in plan.routes for trip in route.trips
                  for stop in trip.customer_stops)


def told(outlooks: Sequence[Outlook]) -> list[tuple[bool, bool, int, int, int | None]]:
    return [(each.leaves, each.must, each.futures, each.later_in, each.departure)
            for each in outlooks]


URGENT, EASY = order("urgent", latest=NOW + 600_000), order("easy")


def test_an_order_rides_along_now_where_nobody_comes_near() -> None:
    found = decide(wave_of((3, URGENT), (2, EASY)), lambda rng: coming(0), FEW)
    assert leaves(found.plan) == [5, 6]
    assert told(found.outlooks) == [(True, True, 6, 0, None), (True, False, 6, 0, None)]
    assert found.outlooks[1].saved == pytest.approx(18.0)


def test_an_order_waits_for_one_that_will_come_near() -> None:
    found = decide(wave_of((0, URGENT), (2, EASY)), lambda rng: coming(3), FEW)
    assert leaves(found.plan) == [5]
    assert told(found.outlooks) == [(True, True, 6, 0, None), (False, False, 6, 6, NEXT)]
    # Alone 18 km now, or on the way later.
    assert found.outlooks[1].saved == pytest.approx(18.0)


@pytest.mark.parametrize(("goes_on", "price"), [(True, 9.0), (False, 18.0)])
def test_what_leaving_later_costs_counts_less_where_more_departures_follow(
        goes_on: bool, price: float) -> None:
    wave = replace(wave_of((3, URGENT), (2, EASY)), goes_on=goes_on)
    found = decide(wave, lambda rng: (), replace(FEW, price_share=0.5))
    assert found.outlooks[1].saved == pytest.approx(price)


def test_without_a_forecast_orders_leave_as_late_as_is_safe() -> None:
    found = decide(wave_of((3, URGENT), (2, EASY)), None, FEW)
    assert leaves(found.plan) == [5]
    assert told(found.outlooks) == [(True, True, 0, 0, None), (False, False, 0, 0, None)]
    assert found.outlooks[1].saved is None


def test_who_can_not_leave_now_waits() -> None:
    late = order("late", release=NEXT)
    found = decide(wave_of((3, URGENT), (2, late)), lambda rng: (), FEW)
    assert leaves(found.plan) == [5]


def test_all_must_leave_now_where_vehicles_are_home_by_the_next_departure() -> None:
    wave = wave_of((2, EASY))
    kinds = tuple(replace(kind, latest=NEXT - 1) for kind in wave.problem.vehicle_types)
    found = decide(replace(wave, problem=replace(wave.problem, vehicle_types=kinds)),
                   lambda rng: coming(3), FEW)
    assert told(found.outlooks) == [(True, True, 0, 0, None)]


def test_all_must_leave_at_the_last_departure() -> None:
    wave = wave_of((3, URGENT), (2, EASY), departures=(NOW,))
    assert must_leave(wave) == {5, 6}
    assert leaves(decide(wave, lambda rng: (), FEW).plan) == [5, 6]


def test_one_of_two_leaves_where_a_vehicle_takes_but_one_at_a_time() -> None:
    wave = wave_of((2, EASY), (3, EASY))
    one = replace(wave.problem.vehicle_types[0], count=1, capacity=(1000,))
    wave = replace(wave, problem=replace(wave.problem, vehicle_types=(one,)))
    assert len(must_leave(wave)) == 1
    assert len(leaves(decide(wave, None, FEW).plan)) == 1


def test_who_only_drones_may_serve_leaves_by_drone() -> None:
    wave = wave_of((3, replace(EASY, served_by="drone")))
    van = replace(wave.problem.vehicle_types[0], drones=DroneType(1, (1000,), 0))
    wave = replace(wave, problem=replace(wave.problem, vehicle_types=(van,)))
    found = decide(wave, lambda rng: (), FEW)
    assert [route.trips[0].sorties[0].nodes for route in found.plan.routes] == [(5,)]
    assert [each.leaves for each in found.outlooks] == [True]


def test_nothing_leaves_where_nothing_is_open() -> None:
    found = decide(wave_of(), lambda rng: coming(0), FEW)
    assert (found.plan, found.outlooks) == (Solution(()), ())


def test_who_must_leave_and_is_too_many_is_named() -> None:
    wave = wave_of((0, URGENT), (3, URGENT), (3, replace(URGENT, id="second")))
    one = replace(wave.problem.vehicle_types[0], count=1)
    problem = replace(wave.problem, vehicle_types=(one,))
    found = decide(replace(wave, problem=problem), lambda rng: (), FEW)
    assert (leaves(found.plan), found.plan.unassigned) == ([6, 7], (5,))
    assert not found.outlooks[0].leaves


def drawn(rng: np.random.Generator) -> list[Coming]:
    return [each for place in rng.integers(4, size=3).tolist() for each in coming(place)]


def test_the_same_seed_decides_the_same_and_the_routes_are_legal() -> None:
    rng = np.random.default_rng(5)
    orders = [(int(rng.integers(4)), order(str(number), NOW + 600_000 * int(rng.integers(1, 9))))
              for number in range(6)]
    wave = wave_of(*orders)
    found = decide(wave, drawn, FEW)
    assert decide(wave, drawn, FEW) == found
    rest = tuple(sorted({*range(1, wave.problem.num_nodes)}.difference(leaves(found.plan))))
    assert check(wave.problem, replace(found.plan, unassigned=rest)).violations == ()
    assert min(route.trips[0].stops[0].departure for route in found.plan.routes) >= NOW
    assert must_leave(wave) <= {*leaves(found.plan)}


@pytest.mark.parametrize("seed", seeds(12))
def test_legs_of_any_length_are_dispatched_legally(seed: int) -> None:
    rng = np.random.default_rng(seed)
    wave = wave_of(*((int(rng.integers(4)), order(str(number))) for number in range(5)))
    minutes = rng.integers(0, 60, (wave.problem.num_nodes,) * 2)
    travel = Travel(minutes * 60_000, rng.integers(0, 60, minutes.shape) * 1_000_000)
    wave = replace(wave, problem=replace(wave.problem, travel=(travel,)))
    found = decide(wave, drawn, FEW)
    rest = tuple(sorted({*range(1, wave.problem.num_nodes)}.difference(leaves(found.plan))))
    assert check(wave.problem, replace(found.plan, unassigned=rest)).violations == ()


def test_a_decision_is_there_in_time() -> None:
    began = time.perf_counter()
    many = replace(FEW, futures=100_000, seconds=0.4)
    found = decide(wave_of((3, URGENT), (2, EASY)), drawn, many)
    assert 2 <= found.outlooks[0].futures < 1000
    assert time.perf_counter() - began < 3.0


@pytest.mark.parametrize("departures", [(), (NEXT, NOW), (NOW, NOW)])
def test_departures_that_do_not_ascend_are_refused(departures: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match="departures"):
        wave_of(departures=departures)


def test_orders_that_belong_together_are_refused() -> None:
    wave = wave_of((2, EASY), (3, EASY))
    tied = replace(wave.problem, relations=(Relation("together", (5, 6), "vehicle"),))
    with pytest.raises(ValueError, match="relations"):
        replace(wave, problem=tied)
