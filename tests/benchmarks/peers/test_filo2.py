"""FILO2 is told what to plan as it reads it, and how long; its answer is read back.

A program that takes FILO2's arguments stands for it.
"""

import os
import sys
from pathlib import Path

import numpy as np
import pytest

from benchmarks.peers.answers import cost_of_all, timed_plan
from benchmarks.peers.filo2 import solve
from benchmarks.quality.large import as_problem, drawn, read

pytestmark = pytest.mark.slow

PROGRAM = """#!{python}
import pathlib, sys
options = dict(zip(sys.argv[2::2], sys.argv[3::2]))
iterations = int(options["--coreopt-iterations"])
sum(range(2000 * iterations))
folder = pathlib.Path(options["--outpath"])
with pathlib.Path("{log}").open("a") as log:
    print(iterations, options["--seed"], file=log)
instance = pathlib.Path(sys.argv[1]).read_text()
pathlib.Path("{copy}").write_text(instance)
number = int(instance.split("DIMENSION:")[1].split()[0])
routes = [f"Route #{{node}}: {{node}}" for node in range(1, number)]
(folder / f"problem.vrp_seed-{{options['--seed']}}.vrp.sol").write_text(
    "\\n".join([*routes, "Cost 0"]))
"""


def test_what_it_plans_is_judged(tmp_path: Path) -> None:
    program, log, copy = (tmp_path / name for name in ("filo2", "log", "copy.vrp"))
    program.write_text(PROGRAM.format(python=sys.executable, log=log, copy=copy))
    program.chmod(0o700)
    stated = drawn("drawn-1-60-30-central")
    before = sum(os.times()[2:4])
    routes, took = solve(program, stated.place, stated.demand, stated.capacity, 0.4, 7)
    assert sorted(routes) == [[node] for node in range(1, 61)]
    assert 0.0 < took < sum(os.times()[2:4]) - before
    problem = as_problem(stated)
    there_and_back = 2 * np.rint(np.hypot(*(stated.place[1:] - stated.place[0]).T)).sum()
    plan = timed_plan(problem, [(0, [nodes]) for nodes in routes])
    assert cost_of_all("drawn", problem, plan) == there_and_back
    again = read(copy)
    assert (again.place == stated.place).all()
    assert (again.demand == stated.demand).all()
    assert again.capacity == stated.capacity
    counts, seeds = np.array([line.split() for line in log.read_text().splitlines()], int).T
    assert set(seeds.tolist()) == {7}
    assert counts[0] == 1
    assert counts[2] == 4 * counts[1]
    assert len(counts) == 4
