"""The legs that the search sees, and whom it tries beside a customer, are those of the problem."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.engine.leg import ComputedLegs
from model.engine.variants import Variation, index_of, ways_of
from model.problem import UNREACHABLE, IntArray, Problem, Travel
from model.problem.quantities import LONGEST_NARROW, NO_LEG
from model.search.neighbourhood.neighbourhood import NEAR_INSERTION, make_neighbourhood
from training.instances import generate

SOME = 90


def one_way() -> Problem:
    """Return a problem with windows whose legs there and back differ."""
    problem = generate(np.random.default_rng(8), SOME, "vrptw")
    rng = np.random.default_rng(9)
    longer = rng.integers(1, 1000, problem.travel[0].duration.shape)
    np.fill_diagonal(longer, 0)
    travel = tuple(Travel(legs.duration[:] + longer, legs.distance[:] + longer)
                   for legs in problem.travel)
    return replace(problem, travel=travel)


@pytest.mark.parametrize("column_first", [False, True])
def test_legs_are_numbered_like_customers(column_first: bool) -> None:
    problem = one_way()
    if column_first:
        problem = replace(problem, travel=tuple(
            Travel(np.asfortranarray(legs.duration[:]), np.asfortranarray(legs.distance[:]))
            for legs in problem.travel))
    neighbourhood = make_neighbourhood(problem, pack([problem]), along=True)
    node = neighbourhood.numbering.node
    assert node.tolist() != list(range(problem.num_nodes))
    for index, legs in enumerate(problem.travel):
        stated = np.stack([legs.duration[:], legs.distance[:]], axis=-1)[node][:, node]
        assert (neighbourhood.leg[index] == stated).all()
        assert (neighbourhood.back[index] == stated.transpose(1, 0, 2)).all()


def test_neighbours_who_fit_are_those_with_the_least_driving_waiting_and_lateness() -> None:
    problem = one_way()
    neighbourhood = make_neighbourhood(problem, pack([problem]))
    drive, depots = problem.travel[0].duration[:], problem.num_depots

    def misfit(origin: int, to: int) -> float:
        one, other = (problem.customers[node - depots] for node in (origin, to))
        way = int(drive[origin, to])
        wait = other.earliest - (one.latest + one.service_duration) - way
        late = one.earliest + one.service_duration + way - other.latest
        return way + 0.2 * max(wait, 0) + 1.0 * max(late, 0)

    for node in range(depots, problem.num_nodes, 7):
        ranked = sorted(min(misfit(node, int(other)), misfit(int(other), node))
                        for other in neighbourhood.near[node] if other >= 0)
        found = [min(misfit(node, int(other)), misfit(int(other), node))
                 for other in neighbourhood.granular[node]]
        assert found == pytest.approx(ranked[:NEAR_INSERTION])


@pytest.mark.parametrize("closed", [False, True])
def test_setups_are_added_to_legs_that_there_are(closed: bool) -> None:
    problem = generate(np.random.default_rng(8), SOME, "drone")
    drones = problem.vehicle_types[0].drones
    assert drones is not None
    fly, depots, legs = drones.travel, problem.num_depots, problem.travel[drones.travel]
    flight = legs.duration[:]
    if closed:
        flight[3, 4] = UNREACHABLE
    travel = [Travel(flight, legs.distance) if index == fly else each
              for index, each in enumerate(problem.travel)]
    longest = max(each.longest()[0] for each in travel)

    def with_setup(duration: int) -> Problem:
        return replace(problem, travel=tuple(travel), customers=tuple(
            replace(customer, setup_duration=duration) for customer in problem.customers))

    def expected(setup: int) -> IntArray:
        durations = flight.copy()
        durations[:, depots:] += setup
        np.fill_diagonal(durations, 0)
        return np.minimum(durations, UNREACHABLE)

    fits = LONGEST_NARROW - longest
    for setup, kind in ((1000, np.int32), (fits, np.int32), (fits + 1, np.int64)):
        large = with_setup(setup)
        table = make_neighbourhood(large, pack([large])).leg
        if isinstance(table, ComputedLegs):
            table = table.table[0]
        found = table[index_of(ways_of(large), Variation(fly, True)), :, :, 0]
        assert found.dtype == kind
        if kind == np.int32:
            found = np.where(found == NO_LEG, UNREACHABLE, found.astype(np.int64))
        assert (np.minimum(found, UNREACHABLE) == expected(setup)).all()
