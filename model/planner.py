"""The planner: decode, improve, check."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from model.check import Evaluation, check
from model.decode import DecodeConfig, Policy, decode, load_policy, prepare
from model.extract import extract
from model.instance import pack
from model.problem import Customer, Depot, DroneType, Problem, Travel, VehicleType
from model.solution import Solution


class PlanCheckError(Exception):
    """A finished plan failed the independent check: an error of the planner, never an answer."""


@dataclass(frozen=True)
class PlanOptions:
    """How to plan."""

    policy: str
    decoding: Literal["greedy", "sample"] = "greedy"
    num_samples: int = 64
    temperature: float = 1.0
    seed: int = 0
    time_limit: float = 1.0  # seconds; 0: the decoded plan as it is, all samples of it
    search_iterations: int | None = None


@dataclass(frozen=True)
class Elapsed:
    """Seconds by phase."""

    decode: float
    search: float
    check: float


@dataclass(frozen=True)
class PlanResult:
    """A checked plan and how it came about."""

    solution: Solution
    evaluation: Evaluation
    decoded_cost: float
    final_cost: float
    search_iterations: int
    elapsed: Elapsed


class Planner:
    """Plans problems by named policies. Safe to call from several threads."""

    def __init__(self, policies: Mapping[str, Policy]) -> None:
        self._policies = dict(policies)

    @property
    def policies(self) -> tuple[str, ...]:
        """Names of the loaded policies."""
        return tuple(self._policies)

    def warm(self, progress: Callable[[str], None] | None = None) -> None:
        """Plan a small problem by each policy, so that everything is compiled. In place."""
        tell = progress or (lambda _: None)
        for index, name in enumerate(self._policies, 1):
            tell(f"compiling and warming policy {name} ({index} of {len(self._policies)})")
            began = time.perf_counter()
            self.plan(small_problem(), PlanOptions(name))
            self.plan(small_problem(), PlanOptions(name, "sample", num_samples=4))
            tell(f"policy {name} is warm after {time.perf_counter() - began:.1f} s")

    def plan(self, problem: Problem, options: PlanOptions,
             received_at: float | None = None) -> PlanResult:
        """Plan a problem.

        Parameters
        ----------
        problem
            At least one customer.
        options
            How to plan.
        received_at
            When the time limit began to run, on `time.perf_counter`; None: now.

        Raises
        ------
        ValueError
            If the policy is not loaded.
        PlanCheckError
            If the plan fails the independent check.
        """
        if options.policy not in self._policies:
            raise ValueError(f"policy: {options.policy!r} is not one of {', '.join(self.policies)}")
        began = time.perf_counter()
        deadline = None
        if options.time_limit > 0:
            deadline = (began if received_at is None else received_at) + options.time_limit
        instance = pack([problem])
        policy = self._policies[options.policy]
        scene = prepare(policy, problem, instance)
        config = DecodeConfig(options.decoding, options.num_samples, options.temperature,
                              options.seed)
        decoded = decode(policy, scene, config, deadline)
        solution = extract(problem, instance, decoded.actions)
        ready = time.perf_counter()
        evaluation = check(problem, solution)
        if evaluation.violations:
            raise PlanCheckError("; ".join(f"{violation.path}: {violation.message}"
                                           for violation in evaluation.violations))
        cost = evaluation.cost.total
        return PlanResult(solution, evaluation, cost, cost, 0,
                          Elapsed(ready - began, 0.0, time.perf_counter() - ready))


def load_planner(weights: Path, names: Sequence[str]) -> Planner:
    """Load policies from their folders under `weights`.

    Raises
    ------
    ValueError
        If a policy is missing or can't be read.
    """
    return Planner({name: load_policy(weights / name) for name in names})


def small_problem() -> Problem:
    """Return three customers for a truck with a drone."""
    places = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
    distance = np.rint(np.linalg.norm(places[:, None] - places, axis=2) * 1e6).astype(np.int64)
    customers = tuple(Customer(str(number), (1000,)) for number in range(3))
    drones = DroneType(count=1, capacity=(1000,), travel=0)
    truck = VehicleType("truck", 1, (3000,), 0, cost_per_km=1.0, drones=drones)
    return Problem((Depot("depot"),), customers, (truck,), (Travel(distance, distance),), places,
                   1000.0)
