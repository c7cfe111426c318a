"""The example requests beside the code are valid and as described."""

from pathlib import Path

import pytest

from app.requests.conversion.problem import to_problem
from app.requests.reading import read_request
from app.schemas.limits import DEFAULT_POLICY
from app.schemas.openapi import EXAMPLES as DOCUMENTED
from app.schemas.openapi import EXAMPLES_DIR
from model.problem import UNREACHABLE, Problem

EXAMPLES = Path(__file__).parents[3] / "examples"


def _problem(name: str) -> Problem:
    body = (EXAMPLES / f"{name}.json").read_bytes()
    return to_problem(read_request(body, (DEFAULT_POLICY,)))


@pytest.mark.parametrize("name", ["table1", "table1_windows", "hetero_day", "city_day"])
def test_example_is_valid(name: str) -> None:
    assert _problem(name).num_customers >= 40


@pytest.mark.parametrize("name", ["table1", "hetero_day", "city_day"])
def test_documented_example_is_the_same_file(name: str) -> None:
    assert name in DOCUMENTED
    assert (EXAMPLES_DIR / f"{name}.json").read_bytes() == (EXAMPLES / f"{name}.json").read_bytes()


def test_table1_needs_nearly_all_capacity_and_costs_length() -> None:
    problem = _problem("table1")
    (truck,) = problem.vehicle_types
    assert sum(customer.demand[0] for customer in problem.customers) == 1_560_000
    assert truck.count * truck.capacity[0] == 1_600_000
    assert truck.drones is not None
    assert truck.cost_per_km == truck.drones.cost_per_km == 1
    # Customer 0 lies 11 to the west and 4 to the north of the depot.
    assert problem.travel[0].distance[0, 1] == round(1e6 * (11**2 + 4**2) ** 0.5)


def test_table1_windows_mixes_hard_and_soft() -> None:
    problem = _problem("table1_windows")
    hard = [c for c in problem.customers if c.earliest and c.late_cost_per_hour is None]
    soft = [c for c in problem.customers if c.late_cost_per_hour is not None]
    assert len(hard) > 30
    assert len(soft) > 15


def test_city_day_can_fly_to_every_customer_that_needs_a_drone() -> None:
    problem = _problem("city_day")
    drones = next(kind.drones for kind in problem.vehicle_types if kind.drones)
    flights = problem.travel[drones.travel].duration[0, 1:]
    needs_drone = [customer.served_by == "drone" for customer in problem.customers]
    assert any(needs_drone)
    assert (flights == UNREACHABLE).any()
    assert (flights[needs_drone] < UNREACHABLE).all()
