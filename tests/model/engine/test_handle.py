"""What the engine owns is of use to what it was made for, and goes once nobody has it."""

import gc
from pathlib import Path

import numpy as np
import pytest

from model.engine.handle import Handle
from model.engine.header import interface
from model.engine.instance import pack
from model.engine.library import call
from model.search.beginning.construct import begin_anew
from model.search.route.room import Room
from model.search.beginning.translate import make_searcher
from model.search.linked.layout import Linked
from model.search.problem_data import make_data
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.solution import Solution
from training.instances import generate


MANY, MOMENT = 10_000_000, 24
"""Changes of times, and bytes that one takes."""


def mapped() -> int:
    """Return bytes of addresses that this process has."""
    return int(Path("/proc/self/statm").read_text().split()[0]) * 4096


def resident() -> int:
    """Return bytes of memory that this process holds."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


def begun(size: int) -> tuple[ProblemData, Searcher]:
    """Return a search that has planned by insertion."""
    problem = generate(np.random.default_rng(5), size, "drone")
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(3))
    begin_anew(data, searcher, True)
    searcher.value.temperature = searcher.value.cost / size
    return data, searcher


def test_what_nobody_has_is_given_back() -> None:
    data, searcher = begun(5)
    kept = Linked(data, searcher, True, moments=MANY)
    before = mapped()
    for _ in range(20):
        Linked(data, searcher, True, moments=MANY)
    assert mapped() - before < MANY * MOMENT
    del kept
    assert before - mapped() >= MANY * MOMENT


def test_rows_are_there_as_long_as_anybody_has_one() -> None:
    _, searcher = begun(5)
    alone, count = searcher.alone, searcher.count
    served = alone.copy()
    del searcher
    gc.collect()
    begun(50)
    assert (alone == served).all()
    assert count.customers == 5


def test_memory_is_taken_where_something_is_written() -> None:
    problem = generate(np.random.default_rng(5), 5, "drone")
    data = make_data(problem, pack([problem]))
    before, had = resident(), mapped()
    searcher = Searcher(data, Room(100_000, 10_000, 100, 100), np.random.SeedSequence(0))
    assert mapped() - had > 200_000_000_000
    searcher.cost[::1000] = 7
    assert searcher.cost[99_000] == 7
    assert resident() - before < 100_000_000


@pytest.mark.parametrize("other", [None, 7, interface().new("tandem_node *")])
def test_a_pointer_of_another_type_is_refused(other: object) -> None:
    with pytest.raises(TypeError):
        call("tandem_tie", *begun(5), other)


def test_what_the_engine_does_not_know_can_not_be_opened() -> None:
    with pytest.raises(Exception, match="tandem_made_up"):
        Handle("made_up")
