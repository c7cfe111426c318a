"""Judges a reply from the request alone, sharing no code with the service.

Requests must state durations, and distances where distances count, and whole seconds: no
`speed_factor` by which they wouldn't be.
"""

from itertools import pairwise
from typing import Any

Data = dict[str, Any]
FOREVER = 10**12


def judge(request: Data, reply: Data) -> None:
    """Assert that a reply keeps all rules of the request and adds up."""
    jobs = {job["id"]: job for job in request["jobs"]}
    vehicles = {vehicle["id"]: vehicle for vehicle in request["vehicles"]}
    served = [step["id"] for route in reply["routes"] for step in route["steps"]
              if step["type"] == "job"]
    left_out = [job["id"] for job in reply["unassigned"]]
    assert sorted(served + left_out) == sorted(jobs)
    used = [route["vehicle"] for route in reply["routes"]]
    assert len(set(used)) == len(used)
    for route in reply["routes"]:
        _judge_route(request, vehicles[route["vehicle"]], jobs, route)
    summary = reply["summary"]
    for name in ("cost", "setup", "service", "duration", "waiting_time", "priority"):
        assert summary[name] == sum(route[name] for route in reply["routes"])
    assert (summary["routes"], summary["unassigned"]) == (len(used), len(left_out))


def _judge_route(request: Data, vehicle: Data, jobs: dict[int, Data], route: Data) -> None:
    start, *halts, end = route["steps"]
    assert (start["type"], end["type"]) == ("start", "end")
    visited = [jobs[step["id"]] for step in halts]
    assert 1 <= len(visited) <= vehicle.get("max_tasks", FOREVER)
    for job in visited:
        assert set(job.get("skills", ())) <= set(vehicle.get("skills", ()))
    _judge_loads(vehicle, visited, route["steps"])
    tasks = _judge_times(request, vehicle, visited, route["steps"])
    matrices = _matrices(request, vehicle)
    duration = sum(matrices["durations"][i][j] for i, j in _legs(vehicle, visited))
    assert route["duration"] == duration <= vehicle.get("max_travel_time", FOREVER)
    distance = 0
    if "distances" in matrices:
        distance = sum(matrices["distances"][i][j] for i, j in _legs(vehicle, visited))
        assert route["distance"] == distance <= vehicle.get("max_distance", FOREVER)
    costs = {"fixed": 0, "per_hour": 3600, "per_km": 0, "per_task_hour": 0,
             **vehicle.get("costs", {})}
    travel = duration * costs["per_hour"] / 3600 + distance * costs["per_km"] / 1000
    if "costs" in matrices:
        travel = sum(matrices["costs"][i][j] for i, j in _legs(vehicle, visited))
    cost = costs["fixed"] + travel + tasks * costs["per_task_hour"] / 3600
    assert abs(route["cost"] - cost) < 2  # each term is rounded
    assert route["priority"] == sum(job.get("priority", 0) for job in visited)


def _judge_times(request: Data, vehicle: Data, visited: list[Data], steps: list[Data]) -> int:
    """Return the time for setup and service."""
    begin, finish = vehicle.get("time_window", (0, FOREVER))
    assert begin <= steps[0]["arrival"] <= steps[-1]["arrival"] <= finish
    durations = _matrices(request, vehicle)["durations"]
    legs = iter(_legs(vehicle, visited))
    time, place = steps[0]["arrival"], vehicle.get("start_index")
    tasks = 0
    for job, step in zip(visited, steps[1:-1], strict=True):
        if place is not None:
            i, j = next(legs)
            time += durations[i][j]
        assert step["arrival"] == time
        time += step["waiting_time"]
        assert any(first <= time <= last for first, last
                   in job.get("time_windows", [(0, FOREVER)]))
        setup, service = (job.get(f"{name}_per_type", {}).get(vehicle.get("type"), job.get(name, 0))
                          for name in ("setup", "service"))
        setup = 0 if job["location_index"] == place else setup
        assert (step["setup"], step["service"]) == (setup, service)
        place = job["location_index"]
        time += setup + service
        tasks += setup + service
    if "end_index" in vehicle:
        i, j = next(legs)
        time += durations[i][j]
    assert steps[-1]["arrival"] == time
    assert next(legs, None) is None
    return tasks


def _judge_loads(vehicle: Data, visited: list[Data], steps: list[Data]) -> None:
    capacity = vehicle.get("capacity", [])
    none = [0] * len(capacity)
    for index, most in enumerate(capacity):
        brought = [_delivery(job, none)[index] for job in visited]
        taken = [job.get("pickup", none)[index] for job in visited]
        load = sum(brought)
        loads = [load]
        for less, more in zip(brought, taken, strict=True):
            load += more - less
            loads.append(load)
        loads.append(load)
        assert max(loads) <= most
        assert [step["load"][index] for step in steps] == loads


def _delivery(job: Data, none: list[int]) -> list[int]:
    if "delivery" not in job and "pickup" not in job:
        job = {"delivery": job.get("amount", none)}
    amounts: list[int] = job.get("delivery", none)
    return amounts


def _legs(vehicle: Data, visited: list[Data]) -> list[tuple[int, int]]:
    places = [job["location_index"] for job in visited]
    if "start_index" in vehicle:
        places.insert(0, vehicle["start_index"])
    if "end_index" in vehicle:
        places.append(vehicle["end_index"])
    return list(pairwise(places))


def _matrices(request: Data, vehicle: Data) -> Data:
    return request["matrices"][vehicle.get("profile", "car")]
