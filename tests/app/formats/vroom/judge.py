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
    jobs = tasks_of(request)
    vehicles = {vehicle["id"]: vehicle for vehicle in request["vehicles"]}
    served = [(step["type"], step["id"]) for route in reply["routes"] for step in route["steps"]
              if step["type"] not in ("start", "break", "end")]
    left_out = [(job["type"], job["id"]) for job in reply["unassigned"]]
    assert sorted(served + left_out) == sorted(jobs)
    used = [route["vehicle"] for route in reply["routes"]]
    assert len(set(used)) == len(used)
    for route in reply["routes"]:
        _judge_route(request, vehicles[route["vehicle"]], jobs, route)
    summary = reply["summary"]
    for name in ("cost", "setup", "service", "duration", "waiting_time", "priority"):
        assert summary[name] == sum(route[name] for route in reply["routes"])
    assert (summary["routes"], summary["unassigned"]) == (len(used), len(left_out))


def tasks_of(request: Data) -> dict[tuple[str, int], Data]:
    """Return jobs and the ends of shipments, as jobs, by kind and id."""
    tasks = {("job", job["id"]): {"kind": "job", **job} for job in request["jobs"]}
    for each in request.get("shipments", ()):
        shared = {name: value for name, value in each.items()
                  if name not in ("pickup", "delivery", "amount")}
        for kind, other in (("pickup", "delivery"), ("delivery", "pickup")):
            tasks[kind, each[kind]["id"]] = {
                "kind": kind, "mate": (other, each[other]["id"]), **shared, **each[kind]}
            if "amount" in each:
                tasks[kind, each[kind]["id"]][kind] = each["amount"]
    return tasks


def _judge_route(request: Data, vehicle: Data, jobs: dict[tuple[str, int], Data],
                 route: Data) -> None:
    start, *steps, end = route["steps"]
    assert (start["type"], end["type"]) == ("start", "end")
    halts = [step for step in steps if step["type"] != "break"]
    names = [(step["type"], step["id"]) for step in halts]
    visited = [jobs[name] for name in names]
    for place, job in enumerate(visited):
        if "mate" in job:
            assert (names.index(job["mate"]) > place) == (job["kind"] == "pickup")
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
    tasks += sum(each.get("service", 0) for each in vehicle.get("breaks", ()))
    assert route["setup"] + route["service"] == tasks
    cost = costs["fixed"] + travel + tasks * costs["per_task_hour"] / 3600
    assert abs(route["cost"] - cost) < 2  # each term is rounded
    assert route["priority"] == sum(job.get("priority", 0) for job in visited)


def _judge_times(request: Data, vehicle: Data, visited: list[Data], steps: list[Data]) -> int:
    """Return the time for setup and service."""
    begin, finish = vehicle.get("time_window", (0, FOREVER))
    assert begin <= steps[0]["arrival"] <= steps[-1]["arrival"] <= finish
    durations = _matrices(request, vehicle)["durations"]
    gaps = [durations[i][j] for i, j in _legs(vehicle, visited)]
    gaps = [*([] if "start_index" in vehicle else [0]), *gaps,
            *([] if "end_index" in vehicle else [0])]
    time, place = steps[0]["arrival"], vehicle.get("start_index")
    tasks, left, halts, rests = 0, gaps.pop(0), iter(visited), []
    for step in steps[1:]:
        driven = step["arrival"] - time
        if step["type"] == "break":
            rests.append(step["id"])
            assert 0 <= driven <= left
            time, left = _judge_rest(vehicle, step), left - driven
            continue
        assert driven == left
        time += driven
        if step["type"] == "end":
            break
        job, left, time = next(halts), gaps.pop(0), time + step["waiting_time"]
        assert any(first <= time <= last for first, last
                   in job.get("time_windows", [(0, FOREVER)]))
        setup, service = (job.get(f"{name}_per_type", {}).get(vehicle.get("type"), job.get(name, 0))
                          for name in ("setup", "service"))
        setup = 0 if job["location_index"] == place else setup
        assert (step["setup"], step["service"]) == (setup, service)
        place = job["location_index"]
        time += setup + service
        tasks += setup + service
    assert not gaps
    assert next(halts, None) is None
    assert sorted(rests) == sorted(each["id"] for each in vehicle.get("breaks", ()))
    return tasks


def _judge_rest(vehicle: Data, step: Data) -> int:
    """Return when a break is over."""
    (stated,) = (each for each in vehicle["breaks"] if each["id"] == step["id"])
    start: int = step["arrival"] + step["waiting_time"]
    assert any(first <= start <= last for first, last
               in stated.get("time_windows", [(0, FOREVER)]))
    assert step["service"] == stated.get("service", 0)
    if "max_load" in stated:
        assert all(load <= most for load, most in zip(step["load"], stated["max_load"],
                                                      strict=True))
    return start + int(step["service"])


def _judge_loads(vehicle: Data, visited: list[Data], steps: list[Data]) -> None:
    capacity = vehicle.get("capacity", [])
    none = [0] * len(capacity)
    for index, most in enumerate(capacity):
        load = sum(_delivery(job, none)[index] for job in visited if job["kind"] == "job")
        halts = iter(visited)
        for step in steps:
            if step["type"] not in ("start", "break", "end"):
                job = next(halts)
                load += job.get("pickup", none)[index] - _delivery(job, none)[index]
            assert step["load"][index] == load <= most


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
