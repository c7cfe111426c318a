"""Requests described by a few genes, so that a search can look for those that take the longest.

A gene is a choice among values in order of what they ask of the service. Any choice of genes makes
a request; one that would be too long is cut: fewer customers, corners and changes of speed.
"""

import json
import math
import random
from collections.abc import Mapping
from typing import Any

Data = dict[str, Any]
Genes = Mapping[str, int]
Point = tuple[float, float]

LARGEST = 200_000
"""Bytes of the longest request."""

HOUR = 3600
SIDE_M = 30_000.0

COMMON: dict[str, tuple[Any, ...]] = {
    "customers": (1, 3, 10, 30, 100, 300, 1000, 2000, 3000),
    "layout": ("uniform", "clusters", "one place", "line"),
    "types": (1, 2, 5, 20, 100),
    "count": (1, 3, 10, 100, 10_000),
    "customers_per_vehicle": (1, 3, 10, 100, 10_000),
    "dimensions": (1, 2, 3),
    "windows": ("none", "wide", "narrow", "late", "impossible"),
    "service": (0, 60, 1800),
    "matrix": (False, False, False, True),
    "seed": tuple(range(16)),
}
"""Genes of both kinds of requests."""

PLAN: dict[str, tuple[Any, ...]] = COMMON | {
    "coordinates": ("planar", "planar", "geographic"),
    "depots": (1, 2, 10, 100),
    "speeds": ("equal", "different"),
    "free": ("none", "by km", "all"),
    "soft": (None, 0.0, 10.0),
    "early": (0.0, 10.0),
    "steps": (0, 0, 1, 24, 200, 1000),
    "trips": (1, 1, 3, 1000),
    "hours": (None, 1, 8, 48),
    "distance": (None, 20_000, 200_000),
    "release": (False, True),
    "served_by": ("either", "drone", "mixed"),
    "drones": (0, 0, 1, 2, 8, 32),
    "drone_types": (1, 1, 2, 8),
    "sortie": (1, 2, 5, 100),
    "endurance": (None, 300, 1800, 7200),
    "launch": (0, 60),
    "areas": (0, 0, 1, 2, 20, 200),
    "corners": (3, 10, 100, 500),
    "shape": ("circle", "star", "comb"),
    "radius": (100.0, 2000.0, 10_000.0),
    "wind": (0, 0, 30),
    "unassigned": (None, 0, 5),
    "policy": ("attention", "pointer"),
    "decoding": ("greedy", "greedy", "sample"),
    "samples": (1, 64, 4096),
    "aboard": (None, None, 0, 600, 3600),
    "breaks": (0, 0, 1, 2, 8),
    "break_at": ("stop", "anywhere"),
    "after_departure": (False, True),
    "driving": (None, None, "eu-561", "eu-561+2002-15", "us-hos"),
    "zones": (0, 0, 0, 2, 20, 1000),
    "replan": ("no", "no", "no", "goes on", "under way"),
}
"""Genes of `POST /plan`, and of what is asked of its plans."""

VROOM: dict[str, tuple[Any, ...]] = COMMON | {
    "num_windows": (1, 2, 10, 100),
    "pickups": (False, True),
    "priorities": (False, True),
    "setup": (False, True),
    "limits": (False, True),
    "ends": ("both", "start", "end", "different"),
}
"""Genes of `POST /vroom`."""

KINDS = {"/plan": PLAN, "/vroom": VROOM, "/check": PLAN, "/fit": PLAN, "/explain": PLAN}


def random_genes(rng: random.Random, path: str) -> dict[str, int]:
    """Draw a choice for each gene of the requests to an endpoint."""
    return {name: rng.randrange(len(values)) for name, values in KINDS[path].items()}


def changed_genes(rng: random.Random, path: str, genes: Genes) -> dict[str, int]:
    """Return genes of which one to three are a step away, or anywhere else."""
    changed = dict(genes)
    for name in rng.sample(sorted(KINDS[path]), rng.randint(1, 3)):
        last = len(KINDS[path][name]) - 1
        step = changed[name] + rng.choice((-1, 1))
        changed[name] = min(last, max(0, step)) if rng.random() < 0.5 else rng.randint(0, last)
    return changed


def mixed_genes(rng: random.Random, first: Genes, second: Genes) -> dict[str, int]:
    """Return genes of which each is that of one of the two."""
    return {name: rng.choice((first[name], second[name])) for name in first}


def request_of(path: str, genes: Genes, time_limit: float) -> Data:
    """Return the request that genes describe, cut to `LARGEST`.

    A request that goes on from a plan lacks `replan`, which needs that plan: `gene` tells. What is
    asked of a plan is asked of that of the request here.
    """
    build = _vroom_request if path == "/vroom" else _plan_request
    share = 1.0
    while True:
        request = build(_Chosen(path, genes, share), time_limit)
        length = len(json.dumps(request, separators=(",", ":")))
        if length <= LARGEST:
            return request
        share *= max(0.2, min(0.95, LARGEST / length))


def gene(path: str, genes: Genes, name: str) -> Any:
    """Return the value of a gene."""
    return KINDS[path][name][genes[name]]


class _Chosen:
    """The values that genes choose, large numbers cut to a share."""

    CUT = ("customers", "corners", "steps", "drone_types", "types", "depots", "areas",
           "num_windows", "zones")
    LARGEST_MATRIX = 200

    def __init__(self, path: str, genes: Genes, share: float) -> None:
        self._values = {name: values[genes[name]] for name, values in KINDS[path].items()}
        if self._values["matrix"]:
            self._values["customers"] = min(self._values["customers"], self.LARGEST_MATRIX)
        for name in self.CUT:
            if self._values.get(name, 0) > 3:
                self._values[name] = max(3, int(self._values[name] * share))
        self.rng = random.Random(genes["seed"])

    def __getitem__(self, name: str) -> Any:
        return self._values[name]


def _places(chosen: _Chosen, number: int) -> list[Point]:
    """Return points in metres from the middle of the area."""
    rng, half = chosen.rng, SIDE_M / 2
    middles = [(rng.uniform(-half, half), rng.uniform(-half, half)) for _ in range(8)]

    def draw() -> Point:
        if chosen["layout"] == "one place":
            return 1000.0, 1000.0
        if chosen["layout"] == "line":
            return round(rng.uniform(-half, half)), 0.0
        if chosen["layout"] == "clusters":
            x, y = rng.choice(middles)
            return round(rng.gauss(x, 500)), round(rng.gauss(y, 500))
        return round(rng.uniform(-half, half)), round(rng.uniform(-half, half))

    return [draw() for _ in range(number)]


def _day(chosen: _Chosen) -> int:
    """Return how long all customers take some vehicle, in seconds: windows lie within."""
    return max(8 * HOUR, min(10**6, int(100 * chosen["customers"])))


def _window(chosen: _Chosen) -> Point | None:
    """Return a window in whole seconds."""
    if chosen["windows"] == "none":
        return None
    day = _day(chosen)
    begin = chosen.rng.randrange(day)
    width = {"wide": day // 3, "narrow": 300, "late": 600, "impossible": 0}[chosen["windows"]]
    if chosen["windows"] == "late":
        begin += day
    return (0, 1) if chosen["windows"] == "impossible" else (begin, begin + width)


def _plan_request(chosen: _Chosen, time_limit: float) -> Data:
    depots = [{"id": f"D{number}", "location": place}
              for number, place in enumerate(_places(chosen, chosen["depots"]))]
    customers = [{"id": str(number), "location": place, **_customer(chosen)}
                 for number, place in enumerate(_places(chosen, chosen["customers"]))]
    request: Data = {
        "depots": depots, "customers": customers,
        "fleet": [_vehicle_type(chosen, number) for number in range(chosen["types"])],
        "airspace": {"no_fly": [_area(chosen, place)
                                for place in _places(chosen, chosen["areas"])],
                     "wind": {"speed_kmh": chosen["wind"], "direction_deg": 45}},
        "unassigned_cost": chosen["unassigned"],
        "options": {"policy": chosen["policy"], "decoding": chosen["decoding"],
                    "num_samples": chosen["samples"], "time_limit": time_limit, "threads": 1}}
    if chosen["coordinates"] == "geographic":
        _make_geographic(request)
        if chosen["zones"]:
            request["airspace"]["zones"] = [_zones(chosen)]
    if chosen["matrix"]:
        for index, place in enumerate([*depots, *customers]):
            place["location_index"] = index
        request["matrices"] = {"truck": {"durations": _matrix(chosen, len(depots)
                                                              + len(customers))}}
    return request


def _customer(chosen: _Chosen) -> Data:
    window = _window(chosen)
    served_by = chosen["served_by"]
    if served_by == "mixed":
        served_by = chosen.rng.choice(("either", "truck", "drone"))
    return {
        "demand": [1] * chosen["dimensions"], "served_by": served_by,
        **({"service_duration": chosen["service"]} if chosen["service"] else {}),
        **({} if chosen["aboard"] is None else {"max_time_aboard": chosen["aboard"]}),
        **({"release_time": chosen.rng.randrange(_day(chosen) // 2)} if chosen["release"] else {}),
        **({} if window is None else {"time_window": {
            "earliest": window[0], "latest": window[1], "late_cost_per_hour": chosen["soft"],
            "early_cost_per_hour": chosen["early"]}})}


def _vehicle_type(chosen: _Chosen, number: int) -> Data:
    rng, dimensions = chosen.rng, chosen["dimensions"]
    per_km, per_hour = {"none": (1, 1), "by km": (0, 1), "all": (0, 0)}[chosen["free"]]
    kind: Data = {
        "id": f"T{number}", "count": chosen["count"],
        "capacity": [chosen["customers_per_vehicle"]] * dimensions,
        "costs": {"fixed": rng.randrange(50), "per_km": per_km, "per_hour": per_hour},
        "depot": f"D{number % chosen['depots']}", "max_trips": chosen["trips"],
        "speed_kmh": 40 + number * (chosen["speeds"] == "different")}
    if chosen["steps"]:
        day = _day(chosen)
        kind["speed_profile"] = [
            {"from": round(day * step / chosen["steps"], 1), "factor": rng.choice((0.5, 1, 2))}
            for step in range(chosen["steps"])]
    if chosen["driving"] is not None:
        kind["driving_rules"] = {"preset": chosen["driving"]}
    if chosen["breaks"]:
        kind["breaks"] = [
            {"id": f"b{place}", "duration": 300, "at": chosen["break_at"],
             "after_departure": chosen["after_departure"], "paid": bool(place % 2),
             "start": {"earliest": 1800 * (place + 1), "latest": 1800 * (place + 1) + 2400}}
            for place in range(chosen["breaks"])]
    if chosen["hours"] is not None:
        kind["max_working_duration"] = chosen["hours"] * HOUR
    if chosen["distance"] is not None:
        kind["max_trip_distance"] = chosen["distance"]
    if chosen["drones"]:
        drones = {
            "count": chosen["drones"], "capacity": [3] * dimensions,
            "speed_kmh": 60 + number * (chosen["speeds"] == "different"),
            "endurance": chosen["endurance"], "launch_duration": chosen["launch"],
            "recovery_duration": chosen["launch"], "max_customers_per_sortie": chosen["sortie"]}
        kind["drones"] = drones if chosen["drone_types"] == 1 else [
            drones | {"id": f"d{place}", "count": 1, "speed_kmh": 60 + number + place}
            for place in range(chosen["drone_types"])]
    return kind


def _area(chosen: _Chosen, place: Point) -> list[Point]:
    """Return the corners of a no-fly area about a place."""
    x, y, number = *place, chosen["corners"]
    radius = chosen["radius"]
    if chosen["shape"] == "comb":
        teeth = [(x + radius * (2 * index / number - 1), y + radius * (index % 2))
                 for index in range(number - 2)]
        return [*teeth, (x + radius, y - radius), (x - radius, y - radius)]
    least = 0.5 if chosen["shape"] == "star" else 1.0
    return [(round(x + radius * share * math.cos(angle), 2),
             round(y + radius * share * math.sin(angle), 2))
            for index in range(number)
            for angle, share in ((math.tau * index / number, least if index % 2 else 1.0),)]


def _zones(chosen: _Chosen) -> Data:
    """Return zones as GeoJSON, a ring of corners each."""
    return {"format": "geojson", "data": {"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {
            "type": "Polygon", "coordinates": [[*ring, ring[0]]]}}
        for place in _places(chosen, chosen["zones"])
        for ring in ([_degrees(corner) for corner in _area(chosen, place)],)]}}


def _make_geographic(request: Data) -> None:
    """Turn metres into degrees about a place in the north. In place."""
    def degrees(point: Point) -> Point:
        return round(10 + point[0] / 65_000, 6), round(54 + point[1] / 111_000, 6)

    request["coordinate_system"] = "geographic"
    for place in [*request["depots"], *request["customers"]]:
        place["location"] = degrees(place["location"])
    request["airspace"]["no_fly"] = [[degrees(corner) for corner in area]
                                     for area in request["airspace"]["no_fly"]]


def _matrix(chosen: _Chosen, number: int) -> list[list[int]]:
    return [[0 if i == j else chosen.rng.randrange(30, 3000) for j in range(number)]
            for i in range(number)]


def _vroom_request(chosen: _Chosen, time_limit: float) -> Data:
    rng = chosen.rng
    places = [_degrees(place) for place in _places(chosen, chosen["customers"])]
    jobs = [{"id": number, "location": place, **_job(chosen)}
            for number, place in enumerate(places)]
    vehicles: list[Data] = []
    for number in range(min(chosen["types"] * chosen["count"], 200)):
        start, end = _degrees((0.0, 0.0)), _degrees((rng.uniform(0, 9000), 0.0))
        vehicle = {"id": number,
                   "capacity": [chosen["customers_per_vehicle"]] * chosen["dimensions"],
                   **({} if chosen["ends"] == "end" else {"start": start}),
                   **({} if chosen["ends"] == "start" else {
                       "end": end if chosen["ends"] == "different" else start})}
        if number < chosen["types"]:
            vehicle |= {"costs": {"fixed": number}, "speed_factor": 1 + number / 100}
        if chosen["limits"]:
            vehicle |= {"max_tasks": 1 + number % 20, "max_travel_time": 4 * HOUR,
                        "max_distance": 100_000}
        vehicles.append(vehicle)
    request: Data = {"jobs": jobs, "vehicles": vehicles, "options": {"l": time_limit, "t": 1}}
    if chosen["matrix"]:
        for index, job in enumerate(jobs):
            job["location_index"] = index
        for vehicle in vehicles:
            for name in ("start", "end"):
                if name in vehicle:
                    vehicle[f"{name}_index"] = 0
        request["matrix"] = _matrix(chosen, len(jobs))
    return request


def _degrees(place: Point) -> Point:
    return round(10 + place[0] / 65_000, 5), round(54 + place[1] / 111_000, 5)


def _job(chosen: _Chosen) -> Data:
    job: Data = {"service": chosen["service"], "delivery": [1] * chosen["dimensions"]}
    if chosen["pickups"] and chosen.rng.random() < 0.5:
        job["pickup"] = job.pop("delivery")
    if chosen["priorities"]:
        job["priority"] = chosen.rng.randrange(101)
    if chosen["setup"]:
        job["setup"] = 120
    windows = sorted(filter(None, (_window(chosen) for _ in range(chosen["num_windows"]))))
    apart: list[list[float]] = []
    for begin, end in windows:
        if not apart or begin > apart[-1][1]:
            apart.append([begin, end])
    return job | ({"time_windows": apart} if apart else {})
