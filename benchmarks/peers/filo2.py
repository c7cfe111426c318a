"""FILO2, as built from its source, on problems of one depot and trucks all alike.

It ends after a number of iterations, not of seconds. How many take as long as it may is told by
short runs before, which don't count.

References
----------
Accorsi and Vigo (2024), routing one million customers in a handful of minutes, Computers &
Operations Research 164.
"""

import math
import resource
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from vrplib import read_solution, write_instance  # type: ignore[import-untyped]

from model.problem import FloatArray, IntArray

SHORT = 100
"""Iterations of the longest of these for each second; mostly a tenth of what it has time for."""

STEP = 4
"""How many times as many these are as those of the run before."""

QUICKEST, MOST_POWER = 1e-5, 1.4
"""Seconds of an iteration at least, and how the time of all rises with their number at most: short
runs are hard to tell from what comes before them."""


def solve(binary: Path, place: FloatArray, demand: IntArray, capacity: int, seconds: float,
          seed: int) -> tuple[list[list[int]], float]:
    """Plan in about a number of seconds of processor time, all that it does included.

    Parameters
    ----------
    binary
        The program.
    place
        (node, 2), the depot first, between which distances are rounded to whole numbers.
    demand
        (node,).
    capacity
        Of each truck.
    seconds
        It may take.
    seed
        Of its random numbers.

    Returns
    -------
    The nodes of each route, and the seconds of processor time that it took.
    """
    with TemporaryDirectory() as name:
        folder = Path(name)
        instance = folder / "problem.vrp"
        # In the order in which FILO2 reads them.
        write_instance(instance, {
            "NAME": "problem", "COMMENT": "none", "TYPE": "CVRP", "DIMENSION": len(place),
            "EDGE_WEIGHT_TYPE": "EUC_2D", "CAPACITY": capacity,
            "NODE_COORD_SECTION": np.rint(place).astype(np.int64), "DEMAND_SECTION": demand,
            "DEPOT_SECTION": [1, -1]})
        short = max(STEP, round(SHORT * seconds))
        begun = _run(binary, instance, 1, seed)
        shorter, longer = (max(_run(binary, instance, count, seed) - begun, QUICKEST * count)
                           for count in (short // STEP, short))
        # Iterations take the longer the better the plan is.
        power = min(max(math.log(longer / shorter) / math.log(STEP), 1.0), MOST_POWER)
        wanted = max(seconds - begun, seconds / 2)
        took = _run(binary, instance, round(short * (wanted / longer) ** (1 / power)), seed)
        solution, = folder.glob("*.sol")
        return read_solution(solution)["routes"], took


def _run(binary: Path, instance: Path, iterations: int, seed: int) -> float:
    """Plan an instance into its folder; return the seconds of processor time."""
    before = _used()
    subprocess.run([binary.resolve(), instance, "--outpath", f"{instance.parent}/", "--seed",
                    str(seed), "--coreopt-iterations", str(iterations)],
                   check=True, stdout=subprocess.DEVNULL)
    return _used() - before


def _used() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime
