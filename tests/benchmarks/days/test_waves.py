"""Days of waves, drawn here as the competition draws them, and the rules that routes keep there."""

import csv
import gzip
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from benchmarks.days.dispatching import Method, Outcome, deciding, run
from benchmarks.days.waves import EPOCH, Day, Request, Routes, cost_of, read_day, replay
from model.search.waves.decide import WaveConfig

LAST = 8 * EPOCH
FEW = WaveConfig(futures=2, turns=100, last_turns=300)


def small_day(seed: int = 1, orders: int = 12) -> Day:
    """Return a day of few orders, whose places lie in a square an hour wide."""
    rng = np.random.default_rng(seed)
    at = rng.integers(0, 2400, (9, 2))
    legs = np.ceil(np.linalg.norm(at[:, None] - at, axis=2)).astype(np.int64)
    opens = rng.integers(1, 5, 9) * EPOCH
    window = np.stack([opens, opens + 3 * EPOCH], axis=1)
    window[0] = 0, LAST
    day = Day("small", legs, rng.integers(1, 5, 9), np.full(9, 300), window, 10, ())
    drawn = [each for epoch in day.epochs for each in day.drawn(epoch, rng)[:orders // 3]]
    numbered = [Request(number, each.epoch, each.node, each.earliest, each.latest, each.service,
                        each.demand) for number, each in enumerate(drawn, 1)]
    return Day("small", legs, day.demand, day.service, window, 10, tuple(numbered))


def write(day: Day, folder: Path, hindsight: int) -> None:
    """Write a day as the competition's instances are."""
    rows = {"NAME": day.name, "TYPE": "VRPTW", "DIMENSION": len(day.legs), "CAPACITY": day.capacity,
            "EDGE_WEIGHT_TYPE": "EXPLICIT", "EDGE_WEIGHT_FORMAT": "FULL_MATRIX"}
    text = "".join(f"{key} : {value}\n" for key, value in rows.items())
    text += "EDGE_WEIGHT_SECTION\n" + "".join(
        "\t".join(map(str, row)) + "\n" for row in day.legs.tolist())
    for name, column in (("DEMAND", day.demand[:, None]), ("SERVICE_TIME", day.service[:, None]),
                         ("TIME_WINDOW", day.window)):
        text += f"{name}_SECTION\n" + "".join(
            f"{node}\t" + "\t".join(map(str, row)) + "\n"
            for node, row in enumerate(column.tolist(), 1))
    (folder / "requests").mkdir()
    with gzip.open(folder / f"{day.name}.txt.gz", "wt", encoding="utf-8") as file:
        file.write(text + "EOF\n")
    with (folder / "requests" / f"{day.name}.csv").open("w", newline="") as table:
        writer = csv.writer(table)
        writer.writerow(("request", "epoch", "customer", "tw_early", "tw_late", "service",
                         "demand"))
        writer.writerows((each.number, each.epoch, each.node, each.earliest, each.latest,
                          each.service, each.demand) for each in day.requests)
    (folder / "best_known.csv").write_text(
        f"instance,hindsight_published\n{day.name},{hindsight}\n")


def alone(day: Day, epoch: int, waiting: Sequence[Request]) -> Routes:
    return [[each] for each in waiting]


def test_each_order_alone_costs_its_way_there_and_back() -> None:
    day = small_day()
    assert replay(day, alone) == sum(
        int(day.legs[0, each.node] + day.legs[each.node, 0]) for each in day.requests)


@pytest.mark.parametrize("method", list(Method))
def test_each_method_keeps_the_rules(method: Method) -> None:
    day = small_day()
    assert 0 < replay(day, deciding(method, FEW, 1)) <= replay(day, alone)


def test_orders_that_wait_leave_as_late_as_they_can() -> None:
    day, left = small_day(), dict[int, int]()
    lazy = deciding(Method.LAZY, FEW, 1)

    def decide(day: Day, epoch: int, waiting: Sequence[Request]) -> Routes:
        routes = lazy(day, epoch, waiting)
        left.update({each.number: epoch for route in routes for each in route})
        return routes

    replay(day, decide)
    assert left.keys() == {each.number for each in day.requests}
    assert all(day.must_leave(left[each.number], each) for each in day.requests)
    assert any(left[each.number] > each.epoch for each in day.requests)


def test_orders_that_are_not_open_go_twice_or_are_left_are_refused() -> None:
    day = small_day()
    for wrong, message in (
            (lambda day, epoch, waiting: [[each] for each in day.requests], "aren't open"),
            (lambda day, epoch, waiting: [[each] for each in (*waiting, *waiting)], "twice"),
            (lambda day, epoch, waiting: [], "must go")):
        with pytest.raises(ValueError, match=message):
            replay(day, wrong)


def test_routes_that_break_a_rule_are_refused() -> None:
    legs = np.array([[0, 600, 600], [600, 0, 600], [600, 600, 0]])
    window = np.array([[0, 3 * EPOCH], [0, LAST], [0, LAST]])
    day = Day("two", legs, np.ones(3, np.int64), np.zeros(3, np.int64), window, 3, ())
    first, second = (Request(node, 0, node, 0, 2 * EPOCH, 300, 1) for node in (1, 2))
    assert cost_of(day, 0, [first, second]) == 1800
    for number, values, message in (
            (1, (0, LAST, 300, 3), "too much"), (2, (0, EPOCH + 1499, 300, 1), "after 5099"),
            (3, (0, LAST, EPOCH * 2 - 2099, 1), "back at")):
        with pytest.raises(ValueError, match=message):
            cost_of(day, 0, [first, Request(number, 0, 2, *values)])


def test_written_days_are_read_and_compared(tmp_path: Path) -> None:
    day = small_day()
    write(day, tmp_path, 1000)
    found = read_day(tmp_path, "small")
    assert found.requests == day.requests
    assert (found.legs == day.legs).all()
    assert (found.window == day.window).all()
    row, = run(tmp_path, (), Method.GREEDY, FEW, 1)
    assert isinstance(row, Outcome)
    assert row.gap_percent == pytest.approx(row.cost / 10 - 100)
