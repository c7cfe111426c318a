"""A policy on the uniform VRPTW test sets that papers on learned solvers use.

`python -m benchmarks.quality.published_vrptw` prints for each set what plans cost in the mean, with
the standard error, how far that is above the best known, and the seconds a plan took: greedily, by
the best of 128 samples, and with a search. Papers tell the mean over all 1,000 instances of which a
set has the first 100.
"""

import time
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from tqdm import tqdm

from app.serving.settings import Settings
from benchmarks.peers.instances import load_vrptw_uniform
from model.planner import PlanOptions, load_planner

SETS = ("vrptw50", "vrptw100")


def main(data: Path = Path("../shared/data/routefinder_vrptw"), policy: str = "attention",
         seconds: Annotated[float, typer.Option(help="of the search, for each plan")] = 1.0,
         instances: Annotated[int, typer.Option(help="of each set")] = 100) -> None:
    """Print the table in Markdown."""
    planner = load_planner(Settings().weights_dir, [policy])
    ways = {"greedy": PlanOptions(policy, time_limit=0.0),
            "best of 128 samples": PlanOptions(policy, "sample", 128, time_limit=0.0),
            f"greedy, then {seconds:g} s of search": PlanOptions(policy, time_limit=seconds)}
    print("| set | way | mean cost | above the best known | seconds |")
    print("| --- | --- | ---: | ---: | ---: |")
    for name in SETS:
        read = load_vrptw_uniform(data / f"{name}.jsonl")[:instances]
        known = np.array([reference for _, _, reference in read])
        for way, options in ways.items():
            began = time.perf_counter()
            costs = np.array([planner.plan(problem, options).final_cost
                              for _, problem, _ in tqdm(read, disable=None)])
            each = (time.perf_counter() - began) / len(read)
            error = costs.std(ddof=1) / np.sqrt(len(read)) if len(read) > 1 else np.nan
            above = 100 * (costs.mean() / known.mean() - 1)
            print(f"| {name} | {way} | {costs.mean():.3f} ± {error:.3f} | {above:.2f} % | "
                  f"{each:.3f} |", flush=True)


if __name__ == "__main__":
    typer.run(main)
