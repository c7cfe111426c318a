"""Reading a request takes as much longer as it is larger, and no more."""

from collections.abc import Callable
from typing import Any

import pytest
from pydantic_core import to_json

from app.requests.conversion.problem import to_problem
from app.requests.reading import read_request
from app.requests.warnings.finding import warnings_of
from tests.growth import growth_of

Request = dict[str, Any]


def _body(number: int, **more: Any) -> bytes:
    """Return a request of so many customers with a bit of everything."""
    return to_json({
        "depots": [{"id": "depot", "location": [0, 0]}],
        "customers": [
            {"id": f"c{index}", "location": [index % 31, index % 37], "demand": [1 + index % 3],
             "service_duration": 60, "setup_duration": 5, "skills": ["lift"],
             "service_duration_by_type": {"truck": 30},
             "time_windows": [{"earliest": 0, "latest": 600 + index},
                              {"earliest": 2000 + index, "latest": 20_000}],
             "vehicles": {"forbidden": ["van"]}, "info": {"address": f"Street {index}"}, **more}
            for index in range(number)],
        "fleet": [{"id": "truck", "count": 90, "capacity": [10], "skills": ["lift"]},
                  {"id": "van", "count": 3, "capacity": [5]}],
    })


def _reading(number: int) -> Callable[[], object]:
    body = _body(number)
    return lambda: read_request(body, None)


def _refusing(number: int) -> Callable[[], object]:
    """Return what refuses a request all of whose customers are late, lost and far too fine."""
    body = _body(number, demand=[1e-10], location=[1e9, 1e9], vehicles={"allowed": ["ship"]},
                 time_window={"earliest": 9, "latest": 8})

    def refuse() -> None:
        with pytest.raises(ValueError, match=r"The request has [0-9]{4} errors"):
            read_request(body, None)

    return refuse


def _warning(number: int) -> Callable[[], object]:
    request = read_request(_body(number), None)
    return lambda: warnings_of(request)


def _converting(number: int) -> Callable[[], object]:
    request = read_request(_body(number), None)
    return lambda: to_problem(request)


@pytest.mark.thorough
@pytest.mark.parametrize("work", [_reading, _refusing, _warning, _converting])
def test_four_times_the_customers_are_four_times_the_work(
        work: Callable[[int], Callable[[], object]]) -> None:
    assert growth_of(work, 250) < 5
