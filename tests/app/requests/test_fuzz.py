"""Whatever a client sends is planned or refused, never a crash."""

import copy
import json
import random
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import pytest

from app.plans.service import PlanService
from app.requests.reading import read_request
from app.schemas.errors import InvalidRequestError, RequestError
from app.schemas.response import PlanReply
from model.planner import Planner
from tests.seeds import often

Container = dict[str, Any] | list[Any]

VALUES: tuple[Any, ...] = (
    None, True, False, 0, -1, 1, 0.5, 1e-9, 7e8, 1e9, 1e12, 1e300, -1e300, 10**30, 2**63, "", "x",
    "12", "\u0000", [], {}, [[]], [0], [0, 0], [[0, 0], [1, 0], [0, 1]], {"earliest": 9}, "drone")


def _containers(value: Any) -> Iterator[Container]:
    if isinstance(value, dict | list):
        yield value
        for part in value.values() if isinstance(value, dict) else value:
            yield from _containers(part)


def _replace(container: Container, key: Any, rng: random.Random) -> None:
    container[key] = copy.deepcopy(rng.choice(VALUES))


def _delete(container: Container, key: Any, rng: random.Random) -> None:
    del container[key]


def _duplicate(container: Container, key: Any, rng: random.Random) -> None:
    if isinstance(container, list):
        container.append(copy.deepcopy(container[key]))
    else:
        container[f"{key}2"] = container[key]


def _scale(container: Container, key: Any, rng: random.Random) -> None:
    if isinstance(container[key], int | float) and not isinstance(container[key], bool):
        container[key] *= rng.choice((0, -1, 0.001, 3, 1000, 1e6))


MUTATIONS: tuple[Callable[[Container, Any, random.Random], None], ...] = (
    _replace, _delete, _duplicate, _scale)


def _mutated(request: Any, rng: random.Random) -> Any:
    request = copy.deepcopy(request)
    for _ in range(rng.randint(1, 3)):
        container = rng.choice([part for part in _containers(request) if part])
        keys = list(container) if isinstance(container, dict) else range(len(container))
        rng.choice(MUTATIONS)(container, rng.choice(keys), rng)
    return request


@pytest.fixture
def rich(with_drones: dict[str, Any]) -> dict[str, Any]:
    """Return a request that uses about every field."""
    for index, place in enumerate([*with_drones["depots"], *with_drones["customers"]]):
        place["location_index"] = index
    table = [[abs(i - j) * 100 for j in range(5)] for i in range(5)]
    truck = with_drones["fleet"][0]
    truck |= {"max_working_duration": 9000, "max_trip_distance": 50000, "max_trips": 2,
              "reload_duration": 60, "skills": ["cold"]}
    van = {"id": "van", "count": 1, "capacity": [30], "profile": "van",
           "speed_profile": [{"from": 100, "factor": 0.5}, {"from": 900, "factor": 1}]}
    bike = {"id": "bike", "count": 1, "capacity": [3], "speed_kmh": 15,
            "speed_profile": [{"from": 100, "speed_kmh": 10}]}
    with_drones["fleet"] += [van, bike]
    with_drones["customers"][0] |= {"skills": ["cold"], "release_time": 30}
    return with_drones | {
        "matrices": {"van": {"durations": table, "distances": table}},
        "airspace": {"no_fly": [[[2, 2], [3, 2], [3, 3], [2, 3]]],
                     "wind": {"speed_kmh": 10, "direction_deg": 90}},
        "unassigned_cost": 500, "coordinate_system": "planar"}


@pytest.mark.parametrize("coordinate_system", ["planar", "geographic"])
def test_mutated_requests_are_planned_or_refused(planner: Planner, rich: dict[str, Any],
                                                 coordinate_system: str) -> None:
    rich["coordinate_system"] = coordinate_system
    rng = random.Random(7)
    outcomes = {"planned": 0, "refused": 0}
    for _ in range(often(400)):
        body = json.dumps(_mutated(rich, rng)).encode()
        try:
            reply = PlanService(planner).reply_to(read_request(body, planner.policies), 0.0)
        except InvalidRequestError as error:
            outcomes["refused"] += len(error.errors) > 0
        else:
            PlanReply.model_validate_json(reply)
            outcomes["planned"] += 1
    assert sum(outcomes.values()) == often(400)
    assert min(outcomes.values()) > often(50)


def test_mutated_bytes_are_planned_or_refused(planner: Planner, rich: dict[str, Any]) -> None:
    rng = random.Random(8)
    original = json.dumps(rich).encode()
    for _ in range(often(300)):
        body = bytearray(original)
        for _ in range(rng.randint(1, 4)):
            start = rng.randrange(len(body))
            body[start : start + rng.randint(0, 3)] = rng.randbytes(rng.randint(0, 3))
        with suppress(RequestError):
            PlanService(planner).reply_to(read_request(bytes(body), planner.policies), 0.0)
