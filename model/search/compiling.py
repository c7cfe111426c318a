"""What is compiled of the search before it is needed."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from model.kernel.compiled import compiled_folder, first_to_compile, is_cold
from model.kernel.instance import pack
from model.kernel.variants import are_stated, ways_of
from model.problem import (
    Customer, Depot, DroneType, Points, Problem, StraightLegs, Travel, VehicleType,
)
from model.search.improve import SearchConfig, improve
from model.search.world import states_rarer_rules
from model.solution import Solution

PLAIN, RARER, LARGE, LARGE_RARER = "plain", "rarer", "large", "large-rarer"
"""Parts of all that is compiled: for problems that state no rarer rules and for those that do, with
legs from tables of 32 bits each, and with computed ones or any."""

COMPUTED = (LARGE, LARGE_RARER)
"""Those with computed legs, compiled apart from the others. Legs that don't fit 32 bits are seldom
enough that they have no parts of their own."""

STATING = (RARER, LARGE_RARER)
"""Those for rarer rules."""

COMPILE_SEARCH = """
from model.kernel.compiled import counting
from model.search.compiling import compile_search
with counting():
    compile_search({!r})
"""
"""What a second process does while everything else is compiled."""

COMPILE_LARGE = """
import os
from model.search.compiling import compile_large
os.nice(19)
compile_large()
"""
"""What a process does for problems to come, while others are planned: whatever else there is to do
comes first."""


def parts_for(problem: Problem | None) -> tuple[str, ...]:
    """Return the parts that the search for a problem needs; the usual ones if there is none yet.

    What takes longest comes last.
    """
    if problem is None:
        return PLAIN, RARER
    plain, rarer = ((PLAIN, RARER) if are_stated(problem, ways_of(problem))
                    else (LARGE, LARGE_RARER))
    return (rarer if states_rarer_rules(problem) else plain,)


def is_compiled(part: str) -> bool:
    """Tell whether a part is there, for this process to load."""
    return compiled_folder() is not None and not is_cold((part,))


def compile_large() -> None:
    """Compile the searches for computed legs, or wait for another process that does."""
    for part in COMPUTED:
        if compiled_folder() is None:
            compile_search(part)
            continue
        with first_to_compile((part,)) as has_to:
            if has_to:
                compile_search(part)


def compile_search(part: str) -> None:
    """Search for a better plan of a small problem, so that most of the search is compiled."""
    by_truck = small_problem(part, drones=False)
    improve(by_truck, pack([by_truck]), Solution((), ()), SearchConfig(turns=4))


def small_problem(part: str = PLAIN, drones: bool = True) -> Problem:
    """Return three customers for a truck, with a drone or alone, that needs a part."""
    places = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
    distance = np.rint(np.linalg.norm(places[:, None] - places, axis=2) * 1e6).astype(np.int64)
    customers = tuple(Customer(str(number), (1000,)) for number in range(3))
    drone = DroneType(count=1, capacity=(1000,), travel=0) if drones else None
    truck = VehicleType("truck", 1, (3000,), 0, cost_per_km=1.0, drones=drone,
                        max_stops=2 if part in STATING else None)
    travel = [Travel(distance, distance)]
    if part in COMPUTED:
        travel.insert(0, Travel.along(StraightLegs(Points(places * 1000.0), 3.6)))
    return Problem((Depot("depot"),), customers, (truck,), tuple(travel), places, 1000.0)


@contextmanager
def beside(statement: str) -> Iterator[None]:
    """Let another Python do something meanwhile, and wait for its end, whatever it comes to."""
    with subprocess.Popen([sys.executable, "-c", statement], stdin=subprocess.DEVNULL,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL):
        yield
