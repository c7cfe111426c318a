"""VROOM's documented examples, to both: `python -m benchmarks.peers.vroom_examples FILE...`.

The files are `example_*.json` of VROOM's repository. Both get what says who is served how, and
where an example has places on the map, the legs that Tandem finds between them. VROOM explores as
it does by default; Tandem has its default time limit.
"""

import json
import math
import statistics
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.peers.vroom_requests import by_tandem, by_vroom
from model.planner import load_planner
from model.travel.matrices import great_circle_distances

Data = dict[str, Any]

VEHICLE = ("start", "end", "start_index", "end_index", "capacity", "skills", "time_window",
           "breaks")
JOB = ("service", "delivery", "pickup", "location", "location_index", "skills", "time_windows")
SHIPMENT = ("pickup", "delivery", "amount", "skills")
"""What is taken of an example's vehicles, jobs and shipments, beside their ids."""

METRES_PER_SECOND = 3.6
"""km/h of a metre a second."""


def plannable(example: Data, speed_kmh: float) -> Data:
    """Return what both can plan of an example, by matrices."""
    matrices = {"car": {"durations": example["matrix"]}} if "matrix" in example else {}
    return with_legs({
        "vehicles": [_part(vehicle, ("id", *VEHICLE)) for vehicle in example["vehicles"]],
        "jobs": [_part(job, ("id", *JOB)) for job in example.get("jobs", ())],
        "shipments": [_part(each, SHIPMENT) for each in example.get("shipments", ())],
        "matrices": matrices or example.get("matrices")}, speed_kmh)


def _part(stated: Data, names: Iterable[str]) -> Data:
    return {name: stated[name] for name in names if name in stated}


def with_legs(request: Data, speed_kmh: float) -> Data:
    """Return a request with the legs between its places, if it has none."""
    if request["matrices"]:
        return request
    ends = [each[end] for each in request["shipments"] for end in ("pickup", "delivery")]
    stated = [(each, side) for each in (*request["vehicles"], *request["jobs"], *ends)
              for side in ("start", "end", "location") if side in each]
    places = list(dict.fromkeys(tuple(each[side]) for each, side in stated))
    for each, side in stated:
        each[f"{side}_index"] = places.index(tuple(each[side]))
    metres = great_circle_distances(np.array(places, np.float64))
    seconds = np.rint(metres * METRES_PER_SECOND / speed_kmh)
    return request | {"matrices": {"car": {"durations": seconds.astype(int).tolist(),
                                           "distances": np.rint(metres).astype(int).tolist()}}}


def main(files: Annotated[list[Path], typer.Argument(help="Examples, as JSON.")]) -> None:
    """Print the costs of Tandem's plans divided by those of VROOM's."""
    settings = Settings()
    planner = load_planner(settings.weights_dir, (DEFAULT_POLICY,))
    ratios = []
    for file in files:
        request = plannable(json.loads(file.read_text("utf-8")), settings.vroom_speeds["car"])
        theirs, seconds = by_vroom(request, None)
        ours = by_tandem(planner, request, settings.vroom_seconds)
        left = [reply["summary"]["unassigned"] for reply in (ours, theirs)]
        costs = [reply["summary"]["cost"] for reply in (ours, theirs)]
        ratios.append(costs[0] / costs[1] if left[0] == left[1] else math.nan)
        typer.echo(f"{file.name}: cost {costs[0]} to VROOM's {costs[1]} ({seconds:.3f} s), "
                   f"left out {left[0]} to {left[1]}, ratio {ratios[-1]:.4f}")
    typer.echo(f"Mean of {len(ratios)}: {statistics.fmean(ratios):.4f}")


if __name__ == "__main__":
    typer.run(main)
