"""Tests of when the engine lets a vehicle leave, and counts its work, against the judge's."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge.metrics import measure_route, measure_trip
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.engine.instance import pack
from model.engine.records import Record
from tests.engine.rules.asking import asked
from tests.model.tiny import draw_tiny, with_beginnings
from tests.seeds import seeds

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


def begun(kind: Record, time: int) -> tuple[int, ...]:
    return asked("begun_at", 3, kind, time)


@pytest.mark.parametrize("seed", seeds(40))
def test_a_vehicle_leaves_and_works_when_the_judge_says(seed: int) -> None:
    rng = np.random.default_rng(seed)
    problem = with_beginnings(rng, draw_tiny(rng))
    kind, start = problem.vehicle_types[0], int(rng.integers(0, 30)) + 40 * 60_000
    decision = TripDecision((kind.begins_at, problem.num_depots, kind.ends_at), start=start)
    route = schedule(problem, RouteDecision(0, 0, (decision,)))
    trip, = route.trips
    leave, since, has = begun(pack([problem]).type[0, 0], start)
    worked = kind.earliest - kind.works_since if kind.works_since is not None else 0
    metrics, _ = measure_route(problem, route, [measure_trip(problem, kind, trip)])
    assert leave == trip.stops[0].departure
    assert has == (kind.works_since is not None)
    assert trip.stops[-1].departure - since + worked == metrics.working_duration


def test_a_truck_without_a_beginning_of_its_own_leaves_as_its_trip_begins() -> None:
    problem = draw_tiny(np.random.default_rng(3))
    plain = replace(problem.vehicle_types[0], busy_until=0, works_since=None)
    kind = pack([replace(problem, vehicle_types=(plain,))]).type[0, 0]
    assert begun(kind, 7) == (7, 7, False)
