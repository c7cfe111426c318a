"""Where trips begin and end."""

from dataclasses import replace

import pytest

from model.judge.check import check
from model.judge.ends import with_ends
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.solution import Solution


@pytest.mark.parametrize(("trips", "broken"), [
    (((1, 3, 2),), []), (((0, 3, 2),), ["stops[0]"]), (((1, 3, 0),), ["stops[2]"]),
    (((1, 3, 0), (0, 4, 2)), []), (((1, 3, 1), (1, 4, 2)), []),
    (((1, 3, 2), (2, 4, 2)), ["trips[0].stops[2]"]),
    (((1, 3, 0), (1, 4, 2)), ["trips[1].stops[0]"]),
    (((1, 3, 0), (0, 4, 0)), ["trips[1].stops[2]"]),
])
def test_routes_have_ends_and_trips_meet_at_depots_between(trips, broken, tiny_problem, customers,
                                                           truck):
    # From 1 by the depot 0, or 1 again, to 2.
    there = replace(truck, max_trips=2, start=1, end=2, reload_depots=(1,))
    problem = tiny_problem(*customers[:2], truck=there, places=(0, 3, 4, 1, 2), num_depots=3)
    route = schedule(problem, RouteDecision(0, 0, tuple(map(TripDecision, trips))))
    left_out = () if len(trips) == 2 else (4,)
    found = check(problem, Solution((route,), left_out)).violations
    assert [violation.code for violation in found] == ["DEPOT"] * len(broken)
    assert all(place in violation.path
               for place, violation in zip(broken, found, strict=True))


def test_trips_are_given_their_ends_by_position(truck):
    there = replace(truck, max_trips=3, start=1, end=2, reload_depots=(1,))
    trips = [TripDecision((2, 3, 2)), TripDecision((0, 4, 1)), TripDecision((0, 5, 0))]
    assert [trip.nodes for trip in with_ends(there, trips)] == [(1, 3, 0), (0, 4, 1), (1, 5, 2)]
    assert with_ends(there, trips[:1]) == (TripDecision((1, 3, 2)),)
