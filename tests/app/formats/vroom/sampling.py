"""Random requests that touch most of what VROOM takes."""

import random
from typing import Any

Data = dict[str, Any]


def sample_request(draw: random.Random, most_jobs: int = 9) -> Data:
    """Return a request in VROOM's terms, by matrices."""
    num_jobs = draw.randint(1, most_jobs)
    places = draw.randint(2, num_jobs + 3)
    sizes = draw.randint(0, 2)
    has_windows, has_distances = draw.random() < 0.5, draw.random() < 0.6
    profiles = ["car", "bike"] if draw.random() < 0.3 else ["car"]
    seconds, metres = _matrix(draw, places, 5, 300), _matrix(draw, places, 50, 3000)
    matrices = {profile: {"durations": [[(number + 1) * entry for entry in row] for row in seconds]}
                for number, profile in enumerate(profiles)}
    if has_distances:
        for profile in profiles:
            matrices[profile]["distances"] = metres
    vehicles = [{"id": 10 * number + 3, "profile": draw.choice(profiles),
                 **_ends(draw, places), **_vehicle(draw, sizes, has_windows, has_distances)}
                for number in range(draw.randint(1, 3))]
    jobs = [{"id": 3 * number + 1, "location_index": draw.randrange(places),
             **_job(draw, sizes, has_windows)} for number in range(num_jobs)]
    request: Data = {"vehicles": vehicles, "jobs": jobs, "matrices": matrices}
    if draw.random() < 0.4:
        request["shipments"] = [_shipment(draw, places, sizes, has_windows)
                                for _ in range(draw.randint(1, 3))]
        for number, each in enumerate(request["shipments"]):
            each["pickup"]["id"], each["delivery"]["id"] = number, number
    if draw.random() < 0.4:
        for vehicle in vehicles:
            vehicle["breaks"] = [_break(draw, number, sizes)
                                 for number in range(draw.randint(0, 2))]
    return request


def _matrix(draw: random.Random, places: int, least: int, most: int) -> list[list[int]]:
    return [[0 if i == j else draw.randint(least, most) for j in range(places)]
            for i in range(places)]


def _ends(draw: random.Random, places: int) -> Data:
    start, end = draw.randrange(places), draw.randrange(places)
    return draw.choice([{"start_index": start, "end_index": start},
                        {"start_index": start, "end_index": start},
                        {"start_index": start, "end_index": end},
                        {"start_index": start}, {"end_index": end}])


def _some(draw: random.Random, likely: float, **fields: Any) -> Data:
    """Return each field with a likelihood of its own draw."""
    return {name: value for name, value in fields.items() if draw.random() < likely}


def _vehicle(draw: random.Random, sizes: int, has_windows: bool, has_distances: bool) -> Data:
    vehicle = _some(
        draw, 0.25, description="a van", skills=[draw.randint(1, 3)], type=draw.choice("ab"),
        max_tasks=draw.randint(1, 5), max_travel_time=draw.randint(100, 1500),
        costs=_some(draw, 0.5, fixed=draw.randint(0, 500), per_hour=draw.randint(0, 9000),
                    per_task_hour=draw.randint(0, 5000)))
    if sizes:
        vehicle["capacity"] = [draw.randint(2, 30) for _ in range(sizes)]
    if has_windows and draw.random() < 0.5:
        begin = draw.randint(0, 200)
        vehicle["time_window"] = [begin, begin + draw.randint(500, 3000)]
    if has_distances:
        vehicle |= _some(draw, 0.25, max_distance=draw.randint(1000, 10_000))
        if "costs" in vehicle:
            vehicle["costs"] |= _some(draw, 0.5, per_km=draw.randint(0, 900))
    return vehicle


def _shipment(draw: random.Random, places: int, sizes: int, has_windows: bool) -> Data:
    shipment: Data = _some(draw, 0.3, priority=draw.randint(0, 10), skills=[draw.randint(1, 3)])
    if sizes:
        shipment["amount"] = [draw.randint(0, 6) for _ in range(sizes)]
    for kind in ("pickup", "delivery"):
        end = _job(draw, 0, has_windows)
        shipment[kind] = {"location_index": draw.randrange(places), **{
            name: value for name, value in end.items() if name not in ("priority", "skills")}}
    return shipment


def _break(draw: random.Random, number: int, sizes: int) -> Data:
    begin = draw.randint(0, 900)
    each: Data = {"id": number, "time_windows": [[begin, begin + draw.randint(50, 900)]],
            "service": draw.randint(10, 120)}
    if draw.random() < 0.2:
        begin = each["time_windows"][0][1] + draw.randint(50, 300)
        each["time_windows"].append([begin, begin + 200])
    return each | (_some(draw, 0.2, max_load=[draw.randint(2, 15) for _ in range(sizes)])
                   if sizes else {})


def _job(draw: random.Random, sizes: int, has_windows: bool) -> Data:
    job = _some(draw, 0.4, service=draw.randint(0, 60), setup=draw.randint(0, 60),
                priority=draw.randint(0, 10))
    job |= _some(draw, 0.15, description="a job", skills=[draw.randint(1, 3)],
                 setup_per_type={"a": draw.randint(0, 60)},
                 service_per_type={"b": draw.randint(0, 60)})
    if sizes:
        amounts = [[draw.randint(0, 6) for _ in range(sizes)] for _ in range(3)]
        job |= _some(draw, 0.5, delivery=amounts[0]) | _some(draw, 0.2, pickup=amounts[1])
        if "delivery" not in job and "pickup" not in job:
            job |= _some(draw, 0.2, amount=amounts[2])
    if has_windows and draw.random() < 0.5:
        begin = draw.randint(0, 1000)
        windows = [[begin, begin + draw.randint(20, 500)]]
        while draw.random() < 0.3:
            begin = windows[-1][1] + draw.randint(1, 300)
            windows.append([begin, begin + draw.randint(10, 300)])
        job["time_windows"] = windows
    return job
