"""The best routes for few jobs: as good as what trying all orders finds."""

import random

import pytest

from model.dialects.vroom.exact import best_routes, is_few
from model.dialects.vroom.kinds import find_kinds
from model.dialects.vroom.timing import RouteTimer
from tests.model.dialects.vroom.drawn import Data, best_value, drawn_request, read
from tests.seeds import seeds


def value_of_best(stated: Data) -> tuple[int, int, int]:
    """Return what the routes found are worth."""
    request, places = read(stated)
    kinds = find_kinds(request, places)
    vehicles = [number for number, kind in enumerate(kinds) for _ in kind.vehicles]
    routes = best_routes(request, places, kinds, range(len(request.jobs)), vehicles,
                         lambda: False)
    assert routes is not None
    timed = [RouteTimer(request, places, kinds[kind].vehicles[0]).drive(jobs)
             for kind, its_routes in routes.items() for jobs in its_routes]
    served = [job for route in timed if route is not None for job in route.jobs]
    assert len(served) == len(set(served))
    return (sum(request.jobs[job].priority for job in served), len(served),
            -sum(route.cost for route in timed if route is not None))


@pytest.mark.parametrize("seed", seeds(40))
def test_routes_are_as_good_as_those_found_by_trying_all(seed: int) -> None:
    draw = random.Random(seed)
    stated = drawn_request(draw, 4, binds=seed % 2 == 1)
    if seed % 4 == 3:
        for job in stated["jobs"]:
            job["priority"] = draw.randint(0, 9)
    assert value_of_best(stated) == best_value(stated)


def test_few_are_few_enough_to_be_looked_at_in_a_moment() -> None:
    assert [is_few(7, 4, 8), is_few(7, 5, 0), is_few(12, 1, 0)] == [True, False, False]
    assert [is_few(8, 1, 9), is_few(8, 1, 16), is_few(4, 3, 32)] == [True, False, True]
    assert not is_few(5000, 1, 0)


def test_too_many_ways_to_begin_with_are_left_to_the_planner(
        monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("model.dialects.vroom.exact.MOST_BEGINNINGS", 10)
    request, places = read(drawn_request(random.Random(1), 4, binds=False))
    assert best_routes(request, places, find_kinds(request, places), range(4), [0],
                        lambda: False) is None


def test_the_best_routes_are_left_to_the_planner_where_they_take_too_long() -> None:
    asked: list[int] = []

    def should_stop() -> bool:
        asked.append(len(asked))
        return len(asked) > 10

    request, places = read(drawn_request(random.Random(1), 4, binds=False))
    assert best_routes(request, places, find_kinds(request, places), range(4), [0],
                       should_stop) is None
    assert len(asked) == 11
