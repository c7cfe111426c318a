"""The search finds the cheapest plan of tiny problems whose batteries limit what is flown."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from model.problem import Energy, Problem
from tests.model.search.mixed_rules import all_rules, all_rules_on_batteries
from tests.model.search.test_optimum import DRONES, MINUTE, SHARE, few_sorties, missed_seeds
from tests.model.tiny import (
    with_beginnings, with_charging, with_dimensions, with_energy, with_gaps, with_pickups,
)

pytestmark = pytest.mark.slow


def charged_batteries(rng: np.random.Generator) -> Problem:
    """A drone or two, charged aboard as fast as they fly, or much slower."""
    problem = few_sorties(rng)
    power = (1,) * 2
    energy = Energy(
        available=int(rng.integers(4, 12)) * MINUTE, usable_share=1.0, weights=(0, 1000),
        cruise=power, hover=power, climb=power, descent=power, charge=int(rng.integers(1, 3)))
    kind, = problem.vehicle_types
    return replace(problem, vehicle_types=(replace(kind, max_stops=None, max_sorties=None, drones=(
        replace(DRONES, energy=energy, count=int(rng.integers(1, 3))))),))


def all_rules_flown_both_ways(rng: np.random.Generator) -> Problem:
    problem = with_pickups(rng, all_rules_on_batteries(rng))
    return with_energy(rng, with_dimensions(rng, problem) if rng.random() < 0.3 else problem)


def all_rules_charging(rng: np.random.Generator) -> Problem:
    """Return problems half of which have pickups, windows or vehicles under way as well."""
    while True:
        problem = all_rules(rng)
        if rng.random() < 0.5:
            change = (with_pickups, with_gaps, with_beginnings)[int(rng.integers(3))]
            problem = change(rng, problem)
        problem = with_charging(rng, problem)
        if any(kind.drones for kind in problem.vehicle_types):
            return problem


@pytest.mark.thorough
@pytest.mark.parametrize(("draw", "number"), [
    (charged_batteries, 2), (all_rules_flown_both_ways, SHARE), (all_rules_charging, SHARE)],
    ids=lambda draw: getattr(draw, "__name__", ""))
def test_search_finds_the_cheapest_plan_that_batteries_allow(
        draw: Callable[[np.random.Generator], Problem], number: int) -> None:
    assert missed_seeds(draw, range(number)) == []
