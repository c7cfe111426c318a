"""A day in Munich: two trucks, one of them with a drone, planned by hand."""

import hashlib
from typing import Any

import httpx

Data = dict[str, Any]

PHONE, ADDRESS = "+49 (0)89 12345", "Tal 1, München"

PROBLEM: Data = {
    "coordinate_system": "geographic",
    "depots": [{"id": "hub", "location": [11.5, 48.1]}],
    "customers": [
        {"id": "A", "location": [11.51, 48.1], "demand": [2], "service_duration": 60,
         "time_window": {"earliest": 30_000, "latest": 40_000},
         "info": {"address": ADDRESS, "phone": PHONE, "notes": "Ring twice", "order": "4711"}},
        {"id": "B", "location": [11.52, 48.1], "demand": [0.1], "pickup": [3],
         "service_duration": 60},
        {"id": "C", "location": [11.53, 48.1], "demand": [0.2], "service_duration": 60},
        {"id": "D", "location": [11.5, 48.12], "demand": [4], "service_duration": 60,
         "info": {"address": "Secret Street 9"}},
        {"id": "E", "location": [11.5, 48.13], "demand": [5], "service_duration": 60},
    ],
    "fleet": [
        {"id": "truck", "count": 1, "capacity": [10], "speed_kmh": 60,
         "drones": {"count": 1, "capacity": [3], "launch_duration": 30, "recovery_duration": 30,
                    "endurance": 3600}},
        {"id": "van", "count": 2, "capacity": [10], "speed_kmh": 60},
    ],
}


def step_of(kind: str, *served: str, trip: int = 1) -> str:
    """Return the id of a step, which is for a depot or for customers."""
    return f"{trip}-{kind}-{hashlib.sha256(chr(10).join(served).encode()).hexdigest()[:16]}"


DEPART, FIRST, SECOND = step_of("depart", "hub"), step_of("stop", "A"), step_of("stop", "B")
LAUNCH, RECOVER, RETURN = step_of("launch", "C"), step_of("recover", "C"), step_of("return", "hub")
DOOR, NEXT_DOOR = step_of("stop", "D"), step_of("stop", "E")


def stop(kind: str, name: str, arrival: float, departure: float) -> Data:
    """Return a stop without a wait."""
    return {"kind": kind, "id": name, "arrival": arrival, "service_start": arrival,
            "departure": departure}


PLAN: Data = {"routes": [
    {"vehicle": "truck-1", "type": "truck", "trips": [{
        "stops": [stop("depot", "hub", 30_000, 30_000), stop("customer", "A", 30_100, 30_160),
                  stop("customer", "B", 30_260, 30_460), stop("depot", "hub", 30_700, 30_700)],
        "sorties": [{"drone": "truck-1/drone-1", "launch_stop": 1, "recovery_stop": 2,
                     "launch_time": 30_130, "recovery_time": 30_460, "customers": [
                         {"id": "C", "arrival": 30_250, "service_start": 30_250,
                          "departure": 30_310}]}]}]},
    {"vehicle": "van-1", "type": "van", "trips": [{
        "stops": [stop("depot", "hub", 30_000, 30_000), stop("customer", "D", 30_140, 30_200),
                  stop("customer", "E", 30_300, 30_360), stop("depot", "hub", 30_600, 30_600)],
        "sorties": []}]},
]}
"""Without `waiting`, costs and all else that is computed anew."""


def dispatched(client: httpx.Client, **changes: Any) -> Data:
    """Send the plan out and return the reply."""
    reply = client.post("/dispatches", json={"problem": PROBLEM, "plan": PLAN} | changes)
    assert reply.status_code == 201, reply.text
    return dict(reply.json())


def token_of(link: Data) -> str:
    """Return the token of a link that was just made."""
    return str(link["url"].partition("#")[2])


def holding(token: str) -> dict[str, str]:
    """Return the headers that send a token."""
    return {"Authorization": f"Bearer {token}"}


def event(name: str, step: str, time: str, kind: str = "done", **more: str) -> Data:
    """Return something that a driver tells."""
    return {"id": name, "step": step, "kind": kind, "time": time, **more}
