from dataclasses import replace

import pytest

from model.counsel.worth import Worth, sorties_worth
from model.judge.timing import SortieDecision
from tests.model.counsel.test_alternatives import A, B, C, D, plan, route


def test_sortie_saves_what_the_truck_would_drive_more(tiny_problem, customers, truck, drones):
    carrier = replace(truck, count=1, cost_per_km=1.0, drones=replace(drones, cost_per_km=0.25))
    problem = tiny_problem(*customers, truck=carrier)
    flown = plan(problem, route(A, B, C, sorties=(SortieDecision((D,), 3, 3),)))
    assert list(sorties_worth(problem, flown)) == [Worth(0, 0, 0, pytest.approx(2 - 0.5))]
    # The truck passes b in any case: the flight from a and back only costs.
    flown = plan(problem, route(A, C, D, sorties=(SortieDecision((B,), 1, 2),)))
    assert list(sorties_worth(problem, flown)) == [Worth(0, 0, 0, pytest.approx(-0.5))]


def test_sortie_of_several_is_driven_altogether(tiny_problem, customers, truck, drones):
    flying = replace(drones, cost_per_km=0.25, max_customers_per_sortie=2)
    problem = tiny_problem(*customers, truck=replace(truck, cost_per_km=1.0, drones=flying))
    flown = plan(problem, route(A, B, sorties=(SortieDecision((C, D), 2, 2),)))
    assert list(sorties_worth(problem, flown)) == [Worth(0, 0, 0, pytest.approx(4 - 1))]


def test_nothing_is_said_where_no_truck_may_go_or_there_was_no_time(tiny_problem, customers, truck,
                                                                    drones):
    *others, d = customers
    problem = tiny_problem(*others, replace(d, served_by="drone"),
                           truck=replace(truck, drones=drones))
    flown = plan(problem, route(A, B, C, sorties=(SortieDecision((D,), 3, 3),)))
    assert list(sorties_worth(problem, flown)) == [Worth(0, 0, 0, None)]
    assert list(sorties_worth(problem, flown, until=0)) == [
        Worth(0, 0, 0, None, is_tried=False)]
