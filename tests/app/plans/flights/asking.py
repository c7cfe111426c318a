"""Requests with flights, and what comes back."""

import io
import json
import zipfile
from pathlib import Path
from typing import Any

import httpx
from pymavlink.mavwp import MAVWPLoader

Data = dict[str, Any]

ZONE = [[24.931, 60.170], [24.937, 60.170], [24.937, 60.176], [24.931, 60.176]]


def city(**changes: Any) -> Data:
    """Return a request whose drone flies to three customers, one of them behind a zone."""
    drones = {"count": 1, "capacity": [2], "speed_kmh": 50, "launch_duration": 30,
              "recovery_duration": 20, **changes.pop("drones", {})}
    return {
        "coordinate_system": "geographic",
        "depots": [{"id": "hub", "location": [24.9415, 60.1708]}],
        "customers": [
            {"id": "shop", "location": [24.9522, 60.1675], "demand": [4], "service_duration": 300,
             "served_by": "truck"},
            *({"id": name, "location": place, "demand": [1], "service_duration": 60,
               "served_by": "drone"} for name, place in (
                   ("park", [24.927, 60.176]), ("quay", [24.962, 60.166]),
                   ("pier", [24.960, 60.169])))],
        "fleet": [{"id": "van", "count": 1, "capacity": [10], "costs": {"per_km": 1},
                   "drones": drones}],
        "airspace": {"no_fly": [ZONE]}, "options": {"time_limit": 0}, **changes}


def planned(client: httpx.Client, problem: Data) -> Data:
    """Return the service's plan."""
    reply = client.post("/plan", json=problem)
    assert reply.status_code == 200, reply.text
    plan: Data = reply.json()
    assert plan["summary"]["sorties"] > 0
    return plan


def sent(client: httpx.Client, problem: Data, plan: Data, file_format: str,
         per: str = "sortie") -> httpx.Response:
    """Return the reply with a plan's flights."""
    return client.post("/flights", json={
        "problem": problem, "plan": plan, "format": file_format, "per": per})


def files_of(reply: httpx.Response) -> dict[str, bytes]:
    """Return the files of a reply by their names, without what a ZIP says of itself."""
    assert reply.status_code == 200, reply.text
    name = reply.headers["content-disposition"].removeprefix('attachment; filename="')[:-1]
    if not name.endswith(".zip"):
        return {name: reply.content}
    assert reply.headers["content-type"] == "application/zip"
    with zipfile.ZipFile(io.BytesIO(reply.content)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    assert b"no permission" in files.pop("README.txt")
    return files


def plan_file(files: dict[str, bytes], name: str) -> Data:
    """Return a file of JSON."""
    content: Data = json.loads(files[name])
    return content


def way_points(folder: Path, content: bytes) -> list[Any]:
    """Return the items that MAVLink's own reader finds in a file."""
    path = folder / "read.waypoints"
    path.write_bytes(content)
    loader = MAVWPLoader()
    loader.load(str(path))
    return [loader.wp(index) for index in range(loader.count())]
