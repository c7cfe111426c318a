"""Solvers in processes of their own, so that a crash or an overrun costs one plan."""

import gc
import multiprocessing
import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any

from benchmarks.clock import count_processor_time
from benchmarks.peers import hgs, ortools, pyvrp, vroom, vrpcli
from benchmarks.peers.answers import PeerAnswer
from benchmarks.peers.published import Published

Solve = Callable[[Published, float, int], PeerAnswer | None]
"""Plans an instance within seconds from a seed; None if it can't plan such instances."""

WARM_SECONDS, WARM_CALLS = 0.1, 3
"""Limit and number of the first calls for each set, which don't count: code is loaded in them. What
one has loaded may leave it no time for what comes behind."""

WARM_PATIENCE = 900.0
"""Seconds after which a solver that isn't warm is given up."""

GRACE_SECONDS = 30.0
"""Beside three times the limit, what a call may take before it is ended."""

CROWDED = 30
"""How many times longer all may take where limits are of processor time."""


class NoPlanError(Exception):
    """The solver crashed or was far too late."""


@dataclass(frozen=True)
class Solver:
    """A solver that can be chosen."""

    solve: Solve
    module: str  # without which it can't run
    threads: int = 1
    has_seed: bool = True  # without one, runs repeat each other


def _tandem(instance: Published, seconds: float, seed: int, threads: int) -> PeerAnswer | None:
    # Loaded here alone: the other processes needn't wait for it.
    return import_module("benchmarks.peers.tandem").solve(instance, seconds, seed, threads)


def _policy(instance: Published, seconds: float, seed: int, name: str) -> PeerAnswer | None:
    return import_module("benchmarks.peers.by_policy").solve(instance, seconds, seed, name)


SOLVERS = {
    "tandem": Solver(partial(_tandem, threads=1), "benchmarks.peers.tandem"),
    "tandem2": Solver(partial(_tandem, threads=2), "benchmarks.peers.tandem", threads=2),
    "attention": Solver(partial(_policy, name="attention"), "benchmarks.peers.by_policy"),
    "pointer": Solver(partial(_policy, name="pointer"), "benchmarks.peers.by_policy"),
    "pyvrp": Solver(pyvrp.solve, "pyvrp"),
    "hgs": Solver(hgs.solve, "hygese"),
    "vroom": Solver(vroom.solve, "vroom", has_seed=False),
    "ortools": Solver(ortools.solve, "ortools", has_seed=False),
    "vrp-cli": Solver(vrpcli.solve, "vrp_cli", has_seed=False),
}
"""All solvers by the name they have in tables."""


def require_installed(names: list[str]) -> None:
    """Raise `ValueError` if a solver is unknown or its package isn't installed."""
    for name in names:
        if name not in SOLVERS:
            raise ValueError(f"solvers: {name!r} is none of {', '.join(SOLVERS)}")
        if find_spec(SOLVERS[name].module) is None:
            raise ValueError(f"solvers: {name} needs the package {SOLVERS[name].module}")


class Worker:
    """One solver's process; after a crash or an overrun the next run starts it anew."""

    def __init__(self, solver: Solver, grace: float = GRACE_SECONDS,
                 by_processor_time: bool = False) -> None:
        self._solver = solver
        self._grace = grace
        self._by_processor_time = by_processor_time
        self._running: tuple[BaseProcess, Connection] | None = None

    def run(self, instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
        """Return the solver's answer; None if it can't plan such instances.

        Raises
        ------
        NoPlanError
            If it crashed, or took longer than three times its limit and the grace.
        """
        if self._running is None:
            self._running = self._start()
        process, pipe = self._running
        try:
            pipe.send((instance, seconds, seed))
            patience = CROWDED if self._by_processor_time else 1
            _receive(pipe, patience * WARM_PATIENCE)
            return _receive(pipe, patience * (3 * seconds + self._grace))
        except (EOFError, OSError, NoPlanError) as error:
            self.close()
            raise NoPlanError(str(error) or f"it ended with code {process.exitcode}") from error

    def close(self) -> None:
        """End the process, if there is one."""
        if self._running is not None:
            process, pipe = self._running
            self._running = None
            pipe.close()
            process.join(0.5)
            process.kill()
            process.join()

    def _start(self) -> tuple[BaseProcess, Connection]:
        context = multiprocessing.get_context("spawn")
        pipe, far_end = context.Pipe()
        process = context.Process(target=_serve, daemon=True,
                                  args=(self._solver, far_end, self._by_processor_time))
        process.start()
        far_end.close()  # or the process's end would go unnoticed
        return process, pipe


def _receive(pipe: Connection, patience: float) -> Any:
    if not pipe.poll(patience):
        raise NoPlanError(f"no answer within {patience:g} s")
    return pipe.recv()


def _serve(solver: Solver, pipe: Connection, by_processor_time: bool) -> None:
    """Answer calls until the other end is closed; say when a call begins to count."""
    if by_processor_time:
        count_processor_time()
    threads = str(solver.threads)
    os.environ.update(OMP_NUM_THREADS=threads, RAYON_NUM_THREADS=threads)
    warm: set[str] = set()
    while True:
        try:
            instance, seconds, seed = pipe.recv()
        except EOFError:
            return
        if instance.set_name not in warm:
            for _ in range(WARM_CALLS):
                solver.solve(instance, min(seconds, WARM_SECONDS), seed)
            warm.add(instance.set_name)
            # To look through what is loaded takes longer than some budgets.
            gc.collect()
            gc.freeze()
        pipe.send("warm")
        pipe.send(solver.solve(instance, seconds, seed))
