"""Requests of `POST /vroom` that fit the schema and make little sense otherwise.

Each fits in kind and range; what it says is extreme, contradictory or hopeless. Most are to be
planned, some refused. All is drawn from the generator passed.
"""

import random
from typing import Any

Data = dict[str, Any]

LARGEST = 2**32 - 1
"""Largest number that VROOM takes."""

SIZES = (1, 1, 2, 3, 5, 8, 20)
TEXTS = ("", "van", "Führerschein Ünïcødé", "顧客", "\u202e", "a/b?#&='\"\\", "🚚" * 40)
PROFILES = ("car", "car", "car", "truck", "bike")


def wild_vroom(rng: random.Random) -> Data:
    """Return a request."""
    by_matrix, dimensions = rng.random() < 0.5, rng.randint(0, 3)
    number = rng.choice(SIZES)
    longitude, latitude, spread = rng.choice((
        (13.4, 52.5, 0.3), (180.0, 0.0, 0.2), (-180.0, 60.0, 0.2), (0.0, 89.95, 0.05),
        (77.0, -89.9, 0.1), (0.0, 0.0, 85.0), (5.0, 5.0, 0.0)))

    def place() -> Data:
        if by_matrix:
            return {"location_index": rng.randrange(number + 2)}
        x, y = (rng.uniform(-spread, spread) for _ in range(2))
        return {"location": [(longitude + x + 180) % 360 - 180,
                             max(-90.0, min(90.0, latitude + y))]}

    request: Data = {
        "jobs": [{"id": rng.choice((index, index, 2**64 - 1 - index)), **place(),
                  **_job(rng, dimensions)} for index in range(number)],
        "vehicles": [_vehicle(rng, index, dimensions, place)
                     for index in range(rng.choice((1, 1, 2, 4)))],
        "options": {"l": rng.choice((0.001, 0.02, 0.05)), "t": 1,
                    "g": not by_matrix and rng.random() < 0.3}}
    if rng.random() < 0.4:
        request["shipments"] = [_shipment(rng, index, dimensions, place)
                                for index in range(rng.choice((1, 2, 5)))]
    if by_matrix:
        longest = rng.choice((0, 60, 3600, 10**6, LARGEST))
        request["matrices"] = {profile: _matrices(rng, number + 2, longest)
                               for profile in ("car", "truck", "bike")}
    return request


def _some(rng: random.Random, share: float, **fields: Any) -> Data:
    """Return each field or not."""
    return {name: value for name, value in fields.items() if rng.random() < share}


def _amounts(rng: random.Random, dimensions: int, choices: tuple[int, ...]) -> list[int]:
    return [rng.choice(choices) for _ in range(dimensions)]


def _job(rng: random.Random, dimensions: int) -> Data:
    loads = (0, 1, 1, 2, 5, 5, 9, LARGEST)
    amount = {"amount": _amounts(rng, dimensions, loads)} if rng.random() < 0.003 else {}
    return amount | _some(
        rng, 0.3, setup=rng.choice((0, 60, 10**8)), service=rng.choice((0, 300, 10**8)),
        delivery=_amounts(rng, dimensions, loads), pickup=_amounts(rng, dimensions, loads),
        description=rng.choice(TEXTS),
        priority=rng.randint(0, 100), skills=[rng.choice((0, 1, LARGEST))],
        setup_per_type={"van": rng.randint(0, 600)}, service_per_type={"": rng.randint(0, 600)},
        time_windows=_windows(rng))


def _shipment(rng: random.Random, index: int, dimensions: int, place: Any) -> Data:
    shared = _some(rng, 0.3, amount=_amounts(rng, dimensions, (0, 1, 2, 5, LARGEST)),
                   priority=rng.randint(0, 100), skills=[rng.choice((0, 1, LARGEST))])
    return shared | {kind: {"id": rng.choice((index, index, 2**64 - 1 - index)), **place(), **{
        name: value for name, value in _job(rng, 0).items()
        if name not in ("amount", "delivery", "pickup", "priority", "skills")}}
        for kind in ("pickup", "delivery")}


def _break(rng: random.Random, index: int, dimensions: int) -> Data:
    return {"id": index} | _some(
        rng, 0.6, time_windows=_windows(rng), service=rng.choice((0, 300, 2700, 10**8)),
        description=rng.choice(TEXTS)) | _some(
        rng, 0.2, max_load=_amounts(rng, dimensions, (0, 3, 10, LARGEST)))


def _windows(rng: random.Random) -> list[list[int]]:
    windows, time = [], rng.choice((0, 0, 3600, 10**6, LARGEST - 100))
    for _ in range(rng.choice((1, 1, 2, 4, 12))):
        end = min(LARGEST, time + rng.choice((0, 1, 600, 7200)))
        windows.append([time, end])
        time = end + rng.choice((1, 60, 3600))
        if time > LARGEST:
            break
    if rng.random() < 0.03:
        windows.reverse()
    return windows


def _vehicle(rng: random.Random, index: int, dimensions: int, place: Any) -> Data:
    vehicle: Data = {"id": index}
    for name in rng.choice((("start", "end"), ("start", "end"), ("start",), ("end",))):
        for field, value in place().items():
            vehicle[field.replace("location", name)] = value
    if dimensions and rng.random() < 0.99:
        vehicle["capacity"] = _amounts(rng, dimensions, (0, 3, 10, 100, LARGEST))
    if rng.random() < 0.3:
        vehicle["breaks"] = [_break(rng, number, len(vehicle.get("capacity", ())))
                             for number in range(rng.choice((1, 1, 2, 8)))]
    begin = rng.choice((0, 0, 600, 10**6, LARGEST))
    return vehicle | _some(
        rng, 0.25, profile=rng.choice(PROFILES), description=rng.choice(TEXTS),
        skills=[0, 1], type=rng.choice(("", "van")), max_tasks=rng.choice((0, 1, 3, LARGEST)),
        time_window=[begin, min(LARGEST, begin + rng.choice((0, 3600, 10**6)))],
        max_travel_time=rng.choice((0, 600, 10**5, LARGEST)),
        speed_factor=rng.choice((0.2, 0.5, 1.0, 5.0)),
        costs={"fixed": rng.choice((0, 100, LARGEST)),
               "per_task_hour": rng.choice((0, 10, LARGEST)), **_some(
                   rng, 0.3, per_hour=rng.choice((0, 3600, LARGEST)),
                   per_km=rng.choice((0, 10, LARGEST)))})


def _matrices(rng: random.Random, number: int, longest: int) -> Data:
    def table() -> list[list[int]]:
        return [[0 if i == j else rng.choice((0, rng.randint(0, longest), longest))
                 for j in range(number)] for i in range(number)]

    return ({"durations": table()} | _some(rng, 0.8, distances=table())
            | _some(rng, 0.1, costs=table()))
