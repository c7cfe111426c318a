"""The Rust solver vrp-cli, by its Python package, on published instances and on shipments."""

import json
import time
from datetime import UTC, datetime, timedelta
from importlib import import_module
from importlib.metadata import version
from typing import Any

from benchmarks.peers.answers import PeerAnswer, PeerRoute, has_rare_rules, useful_counts
from benchmarks.peers.published import Published
from model.problem import IntArray

ONE_THREAD = {"numThreadPools": 1, "threadsPerPool": 1}


def solve(instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
    """Plan within a limit of whole seconds, on one thread.

    None where vehicles may reload or the limit isn't a number of seconds. The solver takes no
    seed: each run is another.
    """
    if has_rare_rules(instance) or seconds < 1 or seconds != int(seconds):
        return None
    began = time.perf_counter()
    tours = _solve(_to_pragmatic(instance), instance.travel, int(seconds))
    elapsed = time.perf_counter() - began
    return PeerAnswer([_read_tour(tour) for tour in tours], elapsed, version("vrp-cli"))


def plan_shipments(stops: IntArray, legs: IntArray, capacity: int, vehicles: int, fixed_cost: int,
                   seconds: int) -> list[list[int]]:
    """Plan pickups and deliveries of one kind of vehicle; return routes as nodes without the depot.

    `stops` are (node, 6): demand, earliest, latest, service, its pickup, its delivery; `legs`
    (node, node) durations and lengths. The depot is node 0. The limit is of the clock on the wall.
    """
    ends = [(node, int(stops[node, 5])) for node in range(1, len(stops)) if stops[node, 0] > 0]
    jobs = [{"id": str(node), "pickups": [_end(stops, node, int(stops[node, 0]))],
             "deliveries": [_end(stops, delivery, int(stops[node, 0]))]}
            for node, delivery in ends]
    shift = {"start": {"earliest": _instant(0), "location": {"index": 0}},
             "end": {"latest": _instant(int(stops[0, 2])), "location": {"index": 0}}}
    kind = {"typeId": "0", "vehicleIds": [f"0-{number}" for number in range(vehicles)],
            "profile": {"matrix": "truck"}, "shifts": [shift], "capacity": [capacity],
            "costs": {"fixed": fixed_cost, "distance": 1, "time": 0}}
    tours = _solve(_whole(jobs, [kind]), legs, seconds)
    return [[int(activity["jobTag"]) for stop in tour["stops"] for activity in stop["activities"]
             if activity["type"] in ("pickup", "delivery")] for tour in tours]


def _end(stops: IntArray, node: int, amount: int) -> dict[str, Any]:
    earliest, latest, service = (int(value) for value in stops[node, 1:4])
    return {"places": [{"location": {"index": node}, "duration": service, "tag": str(node),
                        "times": [[_instant(earliest), _instant(latest)]]}], "demand": [amount]}


def _solve(problem: dict[str, Any], legs: IntArray, seconds: int) -> list[dict[str, Any]]:
    """Return the tours that it finds within a limit, on one thread."""
    vrp_cli: Any = import_module("vrp_cli")
    config = {
        "termination": {"maxTime": seconds},
        "environment": {"parallelism": ONE_THREAD, "logging": {"enabled": False}}}
    reply = vrp_cli.solve_pragmatic(json.dumps(problem), [json.dumps(_to_matrix(legs))],
                                    json.dumps(config))
    tours: list[dict[str, Any]] = json.loads(reply)["tours"]
    return tours


def _instant(seconds: int) -> str:
    return (datetime(2000, 1, 1, tzinfo=UTC) + timedelta(seconds=seconds)).isoformat()


def _to_matrix(legs: IntArray) -> dict[str, Any]:
    listed = legs.ravel().tolist()
    return {"profile": "truck", "travelTimes": listed, "distances": listed}


def _to_pragmatic(instance: Published) -> dict[str, Any]:
    """Return the instance in the solver's own format; a unit of time is a second."""
    jobs = []
    for node in range(1, instance.num_customers + 1):
        place: dict[str, Any] = {"location": {"index": node},
                                 "duration": int(instance.service[node])}
        if instance.has_windows:
            place["times"] = [[_instant(int(instance.earliest[node])),
                               _instant(int(instance.latest[node]))]]
        jobs.append({"id": str(node), "deliveries": [
            {"places": [place], "demand": [int(instance.demand[node])]}]})
    # Every shift must end; without windows, no route is as long as all longest legs together.
    end = (int(instance.latest[0]) if instance.has_windows
           else int((instance.travel.max(axis=1) + instance.service).sum()))
    shift = {"start": {"earliest": _instant(int(instance.earliest[0])), "location": {"index": 0}},
             "end": {"latest": _instant(end), "location": {"index": 0}}}
    vehicles = [
        {"typeId": str(kind), "vehicleIds": [f"{kind}-{number}" for number in range(count)],
         "profile": {"matrix": "truck"}, "shifts": [shift], "capacity": [vehicle.capacity],
         "costs": {"fixed": vehicle.fixed_cost, "distance": vehicle.unit_cost, "time": 0}}
        for kind, (vehicle, count) in enumerate(
            zip(instance.vehicles, useful_counts(instance), strict=True))]
    return _whole(jobs, vehicles)


def _whole(jobs: list[dict[str, Any]], vehicles: list[dict[str, Any]]) -> dict[str, Any]:
    return {"plan": {"jobs": jobs},
            "fleet": {"vehicles": vehicles, "profiles": [{"name": "truck"}]},
            # By default it minimises vehicles before cost.
            "objectives": [[{"type": "minimize-unassigned"}], [{"type": "minimize-cost"}]]}


def _read_tour(tour: dict[str, Any]) -> PeerRoute:
    trip = [int(activity["jobId"]) for stop in tour["stops"] for activity in stop["activities"]
            if activity["type"] == "delivery"]
    return int(tour["typeId"]), [trip]
