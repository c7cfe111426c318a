"""Fixtures of the tests of replanning."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from model.planner import Planner
from model.problem import Customer, Problem, VehicleType
from tests.model.street import NO_POLICY


@pytest.fixture(scope="module")
def planner() -> Planner:
    """Return a planner that never asks its policy."""
    return Planner(NO_POLICY)


@pytest.fixture
def street(tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...],
           truck: VehicleType) -> Problem:
    """Four customers along a street, two trucks that cost a unit each km."""
    return tiny_problem(*customers, truck=replace(truck, cost_per_km=1.0))
