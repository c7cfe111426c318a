"""What the search does is what its page says, for one kind of problem after another."""

import re

import pytest

from model.engine.instance import pack
from model.search.problem_data import can_be_linked, make_data
from model.search.route.layout import ProblemData
from model.search.strategy import ALL_MOVES, Moves
from tests.model.search.pages import table
from tests.model.search.stated_rules import RULES, plain, stating

CUSTOMERS = 30
"""Of a problem that states no number."""

CHOSEN = ("swap vehicles", "change vehicles", "resplit", "small moves", "scan all", "keep places",
          "give up early")
LINKED = "linked stops"
PLAIN = "loads, windows and distance alone"


def searched(kind: str, moves: Moves = ALL_MOVES) -> ProblemData:
    """Return a problem of a kind as it is laid out for the search."""
    number, rules = CUSTOMERS, []
    for rule in [] if kind == PLAIN else kind.split(", "):
        if match := re.fullmatch(r"(\d+) customers", rule):
            number = int(match[1])
        else:
            rules.append(rule)
    problem = stating(rules, plain(number))
    return make_data(problem, pack([problem], legs=False), moves)


@pytest.mark.parametrize(("kind", "told"), table("what is chosen").items())
def test_the_search_does_what_the_page_says(kind: str, told: set[str]) -> None:
    data = searched(kind)
    done = {name for name in CHOSEN if getattr(data.strategy, name.replace(" ", "_"))}
    assert done | ({LINKED} if can_be_linked(data) else set()) == told


def test_the_pages_tell_of_each_rule() -> None:
    told = {rule for column in ("what is chosen", "what holds")
            for kind in table(column) for rule in kind.split(", ")}
    assert set(RULES) <= told


def test_what_the_search_may_not_do_it_does_not() -> None:
    kind = "types that drive alike, one drone a truck, working time costs"
    names = ("two_opt_star", "loops", "crossings", "resplit", "change_vehicles")
    everything = searched(kind).strategy
    nothing = searched(kind, Moves(False, False, False, False, False)).strategy
    assert all(getattr(everything, name) for name in names)
    assert not any(getattr(nothing, name) for name in names)


@pytest.mark.parametrize(("kind", "blink"), [
    ("5 customers", 0.2), ("10 customers", 0.06), ("10 customers, sorties of several", 0.03),
    ("30 customers", 0.01)])
def test_better_places_are_overlooked_more_often_where_they_are_few(
        kind: str, blink: float) -> None:
    assert searched(kind).strategy.blink == pytest.approx(blink)
