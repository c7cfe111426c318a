"""Why drones fly nothing: the true reason, as flights that are tried tell it."""

from dataclasses import replace

import pytest

from model.counsel.bench import Setting
from model.counsel.idle_drones import idle_drones
from model.judge.past import Past
from model.judge.timing import SortieDecision
from model.solution import Vehicle
from tests.model.counsel.test_alternatives import A, B, C, D, plan, route

MINUTE = 60_000

# On a street: a at 1 km, b at 2, c at 3, d at 4; a truck takes two minutes each, a drone one.


@pytest.fixture
def street(tiny_problem, customers, truck, drones):
    """Return a problem of one truck with a drone, changed as is stated."""
    def changed(on_drones=None, on_truck=None, on_customers=None, on_depot=None):
        flying = replace(drones, **(on_drones or {}))
        carrier = replace(truck, **{"count": 1, "cost_per_km": 1.0, "drones": flying}
                          | (on_truck or {}))
        problem = tiny_problem(*[replace(each, **(on_customers or {})) for each in customers],
                               truck=carrier)
        return replace(problem, depots=tuple(replace(depot, **(on_depot or {}))
                                             for depot in problem.depots))
    return changed


def why(problem, *nodes, **named):
    (idle,) = idle_drones(problem, plan(problem, route(*(nodes or (A, B, C, D)))), **named)
    return idle


def test_no_flight_would_save_what_is_on_the_way(street):
    # The truck passes them in any case, so a flight only costs; d's from c costs 2 and saves 2.
    idle = why(street({"cost_per_km": 5.0}))
    assert (idle.code, idle.cost > 0) == ("COSTS_MORE", True)
    assert idle.message.startswith("No flight would save: the best, to ")


def test_flight_that_would_save_is_told(street):
    idle = why(street({"cost_per_km": 0.25}))
    # d is flown to from c and back, for 0.50 instead of 2.
    assert (idle.code, idle.node, idle.cost) == ("SAVES", D, pytest.approx(-1.5))


@pytest.mark.parametrize(("code", "changes"), [
    ("KIND", {"on_customers": {"served_by": "truck"}}),
    ("CAPACITY", {"on_drones": {"capacity": (999,)}}),
    ("RANGE", {"on_drones": {"endurance": 5 * MINUTE}}),  # the service alone takes as long
    ("SORTIES", {"on_truck": {"max_sorties": 0}}),
    ("SORTIES", {"on_drones": {"batteries": 0}}),
    ("LAUNCH", {"on_customers": {"launch": False}, "on_depot": {"launch": False}}),
])
def test_what_hinders_all_flights_is_told(street, code, changes):
    assert why(street(**changes)).code == code


def test_the_rule_that_flights_would_break_is_told(street):
    # The truck is back when its shift ends; whoever launches a drone stands still for long.
    problem = street(on_truck={"latest": 36 * MINUTE}, on_drones={"launch_duration": 30 * MINUTE})
    idle = why(problem)
    assert idle.code == "SHIFT"
    assert idle.message.startswith("No flight keeps all rules: to ")


def test_lost_drones_and_short_times_are_told(street):
    problem = street({"cost_per_km": 0.25})
    lost = Setting(Past(grounded={Vehicle(0, 0): frozenset({0})}))
    assert why(problem, setting=lost).code == "LOST"
    assert why(problem, until=0.0).code == "UNTRIED"


def test_who_flies_is_not_asked(street):
    problem = street()
    flown = plan(problem, route(A, B, C, sorties=(SortieDecision((D,), 3, 3),)))
    assert list(idle_drones(problem, flown)) == []
