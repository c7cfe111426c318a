"""What can't be a problem."""

from dataclasses import replace

import numpy as np
import pytest

from model.problem import Customer, Depot, Overtime, VehicleType
from model.problem.quantities import units_of

STATED = (Customer("a", (1,)), Depot("a"), VehicleType("a", 1, (1,), 0), Overtime(1.0))


@pytest.mark.parametrize(("stated", "field"), [
    (each, field) for each in STATED for field in units_of(type(each))])
def test_no_number_is_less_than_nothing_or_more_than_can_be_counted(stated, field):
    for number in (-1, units_of(type(stated))[field].most * 2, float("nan")):
        several = isinstance(getattr(stated, field), tuple | dict)
        with pytest.raises(ValueError, match=f" {field}: "):
            replace(stated, **{field: (number,) if several else number})


def test_a_table_has_a_row_a_type_and_a_column_a_customer(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    for table in (np.ones((1, 3), np.bool_), np.ones((2, 4), np.bool_), np.ones((1, 4))):
        with pytest.raises(ValueError, match="may_serve"):
            replace(problem, may_serve=table)


@pytest.mark.parametrize("gaps", [((4, 6),), ((6, 6),), ((7, 6),), ((6, 11),), ((6, 8), (7, 9))])
def test_several_windows_come_one_after_another(gaps, customers):
    fine = replace(customers[0], earliest=5, gaps=((5, 6), (7, 8)), latest=10)
    assert fine.openings == (5, 6, 8)
    with pytest.raises(ValueError, match="customer a gaps"):
        replace(fine, gaps=gaps)


@pytest.mark.parametrize("cost", [-1.0, float("nan"), float("inf")])
def test_leaving_a_customer_out_costs_no_less_than_nothing(cost, customers):
    with pytest.raises(ValueError, match="customer a unassigned_cost"):
        replace(customers[0], unassigned_cost=cost)


@pytest.mark.parametrize("field", [{"initial_load": (1,)}, {"busy_until": 1}])
def test_a_beginning_of_its_own_is_for_one_trip(field, truck):
    replace(truck, **field)
    with pytest.raises(ValueError, match="max_trips: 2"):
        replace(truck, max_trips=2, **field)
