"""Random requests of few jobs with limits and windows, and their best plans by trying all."""

import random
from collections.abc import Sequence
from itertools import permutations
from typing import Any

from pydantic_core import to_json

from app.formats.vroom.places import find_places
from app.formats.vroom.reading import read_request
from app.formats.vroom.translate import translate
from model.dialects.vroom.checking import drive, route_faults
from model.dialects.vroom.places import Sites
from model.dialects.vroom.request import Request

Data = dict[str, Any]
Value = tuple[int, int, int]


def drawn_request(draw: random.Random, num_jobs: int, binds: bool) -> Data:
    """Return jobs for two vehicles limited in what isn't what they cost.

    Windows keep nobody from anything unless `binds`.
    """
    limit, costs = draw.choice([
        ({"max_travel_time": draw.randint(800, 2500)}, {"per_hour": 0, "per_km": 5}),
        ({"max_distance": draw.randint(6000, 25000)}, {}),
        ({"max_distance": draw.randint(6000, 25000)}, {"per_hour": 1000, "per_km": 3})])
    vehicles: list[Data] = [
        {"id": number, "start_index": 0, "end_index": 0, "capacity": [draw.randint(2, 6)],
         "costs": costs | {"fixed": draw.choice([0, 300])}, **limit} for number in range(2)]
    jobs: list[Data] = [{"id": job, "location_index": job, "service": draw.randint(0, 100),
                         draw.choice(["delivery", "pickup"]): [draw.randint(1, 2)]}
                        for job in range(1, num_jobs + 1)]
    if not binds:
        vehicles[0]["time_window"] = [0, 100_000]
        jobs[0]["time_windows"] = [[0, 100_000]]
    else:
        for job in jobs:
            if draw.random() < 0.6:
                begin = draw.randint(0, 2500)
                job["time_windows"] = [[begin, begin + draw.randint(200, 1500)]]
        vehicles[1]["time_window"] = [0, draw.randint(2000, 5000)]
    return {"vehicles": vehicles, "jobs": jobs, "matrices": {"car": {
        "durations": _matrix(draw, num_jobs + 1, 50, 900),
        "distances": _matrix(draw, num_jobs + 1, 500, 9000)}}, "options": {"l": 0.2}}


def _matrix(draw: random.Random, size: int, least: int, most: int) -> list[list[int]]:
    return [[0 if i == j else draw.randint(least, most) for j in range(size)]
            for i in range(size)]


def read(stated: Data) -> tuple[Request, Sites]:
    """Return a request in the planner's words."""
    request = read_request(to_json(stated), 100, 100)
    return translate(request), find_places(request, {})


def best_value(stated: Data) -> Value:
    """Return priorities and number of those served by the best plan, and minus its cost."""
    request, places = read(stated)
    best: dict[int, Value] = {0: (0, 0, 0)}  # by the set of jobs served so far
    for vehicle in range(len(request.vehicles)):
        longer = dict(best)
        for jobs in _orders(len(request.jobs)):
            if any(route_faults(request, places, vehicle, jobs)):
                continue
            cost = drive(request, places, vehicle, jobs).cost
            taken = sum(1 << job for job in jobs)
            worth = sum(request.jobs[job].priority for job in jobs)
            for served, value in best.items():
                if not served & taken:
                    total = (value[0] + worth, value[1] + len(jobs), value[2] - cost)
                    longer[served | taken] = max(total, longer.get(served | taken, total))
        best = longer
    return max(best.values())


def _orders(number: int) -> list[Sequence[int]]:
    return [order for length in range(1, number + 1)
            for order in permutations(range(number), length)]
