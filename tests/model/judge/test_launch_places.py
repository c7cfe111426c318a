"""Drones take off, and are recovered, where they may."""

from dataclasses import replace

import pytest

from model.judge.check import check
from tests.model.judge.test_check import A_THEN_B, C_BY_DRONE, codes, plan


@pytest.mark.parametrize(("stop", "what"), [(1, "takes off"), (2, "is recovered")])
def test_drones_take_off_and_are_recovered_where_they_may(stop, what, tiny_problem, customers,
                                                          truck, drones):
    def barred(*nodes):
        places = [replace(customer, launch=node not in nodes)
                  for node, customer in enumerate(customers[:3], 1)]
        return tiny_problem(*places, truck=replace(truck, drones=drones))

    solution = plan(barred(), C_BY_DRONE)
    assert codes(barred(3), solution) == []
    (violation,) = check(barred(stop), solution).violations
    assert (violation.code, violation.path) == ("LAUNCH", "routes[0].trips[0].sorties[0]")
    assert violation.message == f"no drone {what} at {'ab'[stop - 1]}"
    assert codes(barred(1, 2), plan(barred(), A_THEN_B)) == []
