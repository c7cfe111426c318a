"""Plans in which somebody isn't served any more."""

from itertools import product

import pytest

from model.judge.breaks import BreakDecision
from model.judge.places import Found, Place, routes_without
from model.judge.timing import RouteDecision, TripDecision
from model.problem import REST
from model.solution import BreakPlace, Vehicle

PLACES: tuple[BreakPlace, ...] = "departure", "way", "arrival"


@pytest.mark.parametrize(("before", "behind"), [*product(PLACES, PLACES)])
def test_breaks_of_two_legs_that_become_one_lie_in_order(before: BreakPlace,
                                                         behind: BreakPlace) -> None:
    """Who drives on before the first of them doesn't take the next where the leg began."""
    breaks = (BreakDecision(REST, 1, before, 60_000, 60_000), BreakDecision(0, 2, behind))
    route = RouteDecision(0, 0, (TripDecision((0, 1, 2, 3, 0), breaks=breaks),))
    found = Found(0, Place(Vehicle(0, 0), 0, "truck", 2))
    (trip,), = [each.trips for each in routes_without(route, found)]
    assert trip.nodes == (0, 1, 3, 0)
    assert [each.stop for each in trip.breaks] == [1, 1]
    assert trip.breaks[0].place == before
    places = [PLACES.index(each.place) for each in trip.breaks]
    assert places == sorted(places)
