"""How routes are timed and priced is what the page on times says, rule by rule."""

import pytest

from model.engine.instance import pack
from model.search.problem_data import make_data
from tests.model.search.pages import table
from tests.model.search.stated_rules import plain, stating

ASPECTS = ("timed", "priced", "held back", "retimed", "lasting", "by detour")


@pytest.mark.parametrize(("stated", "told"), table("what holds").items())
def test_routes_are_evaluated_as_the_page_says(stated: str, told: set[str]) -> None:
    problem = stating([] if stated == "nothing" else stated.split(", "), plain())
    evaluation = make_data(problem, pack([problem])).evaluation[0]
    assert {name for name in ASPECTS if evaluation[name.replace(" ", "_")]} == told
