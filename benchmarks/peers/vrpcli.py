"""The Rust solver vrp-cli, by its Python package, on a published instance."""

import json
import time
from datetime import UTC, datetime, timedelta
from importlib import import_module
from importlib.metadata import version
from typing import Any

from benchmarks.peers.answers import PeerAnswer, PeerRoute, has_rare_rules, useful_counts
from benchmarks.peers.published import Published

ONE_THREAD = {"numThreadPools": 1, "threadsPerPool": 1}


def solve(instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
    """Plan within a limit of whole seconds, on one thread.

    None where vehicles may reload or the limit isn't a number of seconds. The solver takes no
    seed: each run is another.
    """
    if has_rare_rules(instance) or seconds < 1 or seconds != int(seconds):
        return None
    vrp_cli: Any = import_module("vrp_cli")
    config = {
        "termination": {"maxTime": int(seconds)},
        "environment": {"parallelism": ONE_THREAD, "logging": {"enabled": False}}}
    documents = (json.dumps(_to_pragmatic(instance)), [json.dumps(_to_matrix(instance))],
                 json.dumps(config))
    began = time.perf_counter()
    reply = vrp_cli.solve_pragmatic(*documents)
    elapsed = time.perf_counter() - began
    routes = [_read_tour(tour) for tour in json.loads(reply)["tours"]]
    return PeerAnswer(routes, elapsed, version("vrp-cli"))


def _instant(seconds: int) -> str:
    return (datetime(2000, 1, 1, tzinfo=UTC) + timedelta(seconds=seconds)).isoformat()


def _to_matrix(instance: Published) -> dict[str, Any]:
    legs = instance.travel.ravel().tolist()
    return {"profile": "truck", "travelTimes": legs, "distances": legs}


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
    return {"plan": {"jobs": jobs},
            "fleet": {"vehicles": vehicles, "profiles": [{"name": "truck"}]},
            # By default it minimises vehicles before cost.
            "objectives": [[{"type": "minimize-unassigned"}], [{"type": "minimize-cost"}]]}


def _read_tour(tour: dict[str, Any]) -> PeerRoute:
    trip = [int(activity["jobId"]) for stop in tour["stops"] for activity in stop["activities"]
            if activity["type"] == "delivery"]
    return int(tour["typeId"]), [trip]
