"""Ways to decode, side by side."""

import pytest

from benchmarks.quality.decodings import WAYS, plan_costs
from benchmarks.quality.weights import Case

pytestmark = pytest.mark.slow


def test_each_way_costs_at_most_what_the_one_before_does() -> None:
    one_view, greedy, samples = plan_costs(Case("cvrp", 1, 0), "attention", 0)
    assert len(WAYS) == 3
    assert one_view >= greedy >= samples > 0
