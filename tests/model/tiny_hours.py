"""Tiny problems whose depots open and close."""

from dataclasses import replace

import numpy as np

from model.judge.driving import travel_duration
from model.problem import Problem, within_hours
from model.solution import Route
from tests.model.fliers import with_fliers
from tests.model.tiny import (
    MINUTE, with_duty, with_gaps, with_open_ends, with_open_reloads, with_pickups, with_places,
    with_reloads,
)


def with_hours(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose vehicles work while the depots where they begin and end are open."""
    depots = tuple([replace(depot, earliest=int(rng.integers(9)) * MINUTE,
                            latest=int(rng.integers(20, 51)) * MINUTE)
                    for depot in problem.depots])
    kinds = [kind for kind in problem.vehicle_types
             if kind.earliest <= depots[kind.ends_at].latest]
    if len(kinds) < len(problem.vehicle_types):
        return problem
    return replace(problem, depots=depots,
                   vehicle_types=tuple([within_hours(depots, kind) for kind in kinds]))


def with_hours_apart(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose vehicles use several depots, or leave one for good; mostly with more.
    """
    change = (with_reloads, with_open_reloads, with_open_ends, with_places)[int(rng.integers(4))]
    problem = change(rng, problem)
    for more in (with_gaps, with_duty, with_pickups):
        problem = more(rng, problem) if rng.random() < 0.4 else problem
    return with_hours(rng, problem)


def with_closing_hubs(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose depots close, from which some vehicles fly by themselves."""
    problem = with_fliers(rng, with_reloads(rng, problem))
    depots = tuple([replace(depot, latest=int(rng.integers(15, 45)) * MINUTE)
                    for depot in problem.depots])
    if any(kind.earliest > depots[kind.ends_at].latest for kind in problem.vehicle_types):
        return problem
    return replace(problem, depots=depots, vehicle_types=tuple(
        [within_hours(depots, kind) for kind in problem.vehicle_types]))


def keeps_day(problem: Problem, route: Route) -> bool:
    """Tell whether a route's trips leave depots before those close, and travel as long as allowed.
    """
    most = problem.vehicle_types[route.vehicle_type].max_travel_duration
    return (most is None or travel_duration(route.trips) <= most) and all(
        trip.stops[0].departure <= problem.depots[trip.stops[0].node].latest
        for trip in route.trips)
