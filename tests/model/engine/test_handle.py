"""What the engine owns is of use to what it was made for, and goes once nobody has it."""

from pathlib import Path

import numpy as np
import pytest

from model.engine.handle import Handle
from model.engine.header import interface
from model.engine.instance import pack
from model.engine.library import call
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.linked.layout import Linked
from model.search.problem_data import make_data
from model.search.route.engine import ANY, Scratch, anneal
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.solution import Solution
from training.instances import generate


MANY, MOMENT = 10_000_000, 24
"""Changes of times, and bytes that one takes."""


def mapped() -> int:
    """Return bytes of addresses that this process has."""
    return int(Path("/proc/self/statm").read_text().split()[0]) * 4096


def begun(size: int) -> tuple[ProblemData, Searcher]:
    """Return a search that has planned by insertion."""
    problem = generate(np.random.default_rng(5), size, "drone")
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(3))
    begin_anew(data, searcher, True)
    searcher.value.temperature = searcher.value.cost / size
    return data, searcher


def test_calls_that_share_a_scratch_do_what_each_does_alone() -> None:
    costs = []
    for is_shared in (False, True):
        data, searcher = begun(20)
        if is_shared:
            scratch = Scratch(data, searcher)
            for _ in range(5):
                anneal(data, searcher, 50, ANY, scratch)
        else:
            for _ in range(5):
                anneal(data, searcher, 50, ANY)
        costs.append((float(searcher.value.cost), float(searcher.value.best)))
    assert costs[0] == costs[1]


def test_what_nobody_has_is_given_back() -> None:
    data, searcher = begun(5)
    kept = Linked(data, searcher, True, moments=MANY)
    before = mapped()
    for _ in range(20):
        Linked(data, searcher, True, moments=MANY)
    assert mapped() - before < MANY * MOMENT
    del kept
    assert before - mapped() >= MANY * MOMENT


def test_a_scratch_of_a_smaller_search_is_refused() -> None:
    scratch = Scratch(*begun(5))
    with pytest.raises(RuntimeError, match="tandem_anneal failed with code -2"):
        anneal(*begun(20), 1, ANY, scratch)


@pytest.mark.parametrize("other", [None, 7, interface().new("tandem_node *")])
def test_a_pointer_of_another_type_is_refused(other: object) -> None:
    with pytest.raises(TypeError):
        call("tandem_anneal", *begun(5), other, 1, ANY)


def test_what_the_engine_does_not_know_can_not_be_opened() -> None:
    with pytest.raises(Exception, match="tandem_made_up"):
        Handle("made_up")
