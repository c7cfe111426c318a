"""Set partitioning: the cheapest columns that meet each row once, by HiGHS; of few by trying.

With linear prices first, which mostly say all; else by branch and bound over those columns that the
prices don't rule out.
"""

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from model.engine.alarm import has_rung
from model.policy.few_columns import FEW, TooManyColumnsError, cheapest_by_trying
from model.problem import BoolArray, FloatArray, IntArray

if TYPE_CHECKING:
    import highspy

KNOWN = 100.0
"""What the choice known costs in the units of a program: tolerances are absolute."""

MOST_NODES = 20
"""Of the tree of a choice that prices leave open, so that its time is bounded."""

FEASIBLE = 2
"""HiGHS's status of a solution that keeps all bounds."""

WHOLE = 1e-6
"""How far from a whole number a variable may be, and above a bound that isn't to be missed."""


def cheapest_partition(columns: Sequence[IntArray], cost: FloatArray, room: IntArray,
                       known: float, alarm: IntArray) -> BoolArray | None:
    """Return which columns to choose, (column,), or None if none are found.

    Parameters
    ----------
    columns
        (row,) rows that each column meets.
    cost
        (column,) of each.
    room
        (row,) how often each row may be met at most; below zero: it is met just once.
    known
        Cost of a choice that is known, above zero: dearer ones aren't looked for.
    alarm
        Setting of an alarm at which nothing more is looked for.
    """
    if has_rung(alarm):
        return None
    if sum([len(column) > 1 for column in columns]) <= FEW:
        with suppress(TooManyColumnsError):
            return cheapest_by_trying(columns, cost, room, known)
    chosen = _chosen(columns, cost * (KNOWN / known), room, alarm)
    # A solver's word isn't taken for it.
    if chosen is not None:
        rows = [columns[index] for index in np.flatnonzero(chosen).tolist()]
        met = np.bincount(np.concatenate([np.zeros(0, np.int64), *rows]), minlength=len(room))
        if not np.where(room < 0, met == 1, met <= room).all():
            return None
    return chosen


def _chosen(columns: Sequence[IntArray], cost: FloatArray, room: IntArray,
            alarm: IntArray) -> BoolArray | None:
    relaxed = _program(columns, cost, room, False)
    share = _solved(relaxed, alarm)
    if share is None:
        return None
    chosen: BoolArray = share > 0.5
    if np.abs(share - chosen).max(initial=0.0) < WHOLE:
        return chosen
    gap = KNOWN - relaxed.getInfo().objective_function_value
    open_yet = np.flatnonzero(np.array(relaxed.getSolution().col_dual) <= gap + WHOLE)
    tempting = [columns[index] for index in open_yet.tolist()]
    share = _solved(_program(tempting, cost[open_yet], room, True), alarm)
    if share is None:
        return None
    chosen = np.zeros(len(columns), np.bool_)
    chosen[open_yet[share > 0.5]] = True
    return chosen


def _program(columns: Sequence[IntArray], cost: FloatArray, room: IntArray,
             is_whole: bool) -> "highspy.Highs":
    """Return the program of a choice, of whole columns or of shares of them."""
    # Not before it is needed: OR-Tools, which benchmarks load, has another library by its name.
    import highspy

    program = highspy.HighsLp()
    program.num_col_, program.num_row_ = len(columns), len(room)
    program.col_cost_ = cost
    program.col_lower_ = np.zeros(len(columns))
    # Shares are bounded by the rows.
    program.col_upper_ = np.full(len(columns), 1.0 if is_whole else highspy.kHighsInf)
    program.row_lower_ = np.where(room < 0, 1.0, 0.0)
    program.row_upper_ = np.where(room < 0, 1.0, room)
    rows = np.concatenate(columns)
    matrix = program.a_matrix_
    matrix.format_ = highspy.MatrixFormat.kColwise
    matrix.start_ = np.cumsum([0, *map(len, columns)]).astype(np.int32)
    matrix.index_ = rows.astype(np.int32)
    matrix.value_ = np.ones(len(rows))
    if is_whole:
        program.integrality_ = [highspy.HighsVarType.kInteger] * len(columns)
    solver = highspy.Highs()  # type: ignore[no-untyped-call]
    solver.setOptionValue("output_flag", False)
    solver.setOptionValue("threads", 1)
    solver.setOptionValue("mip_max_nodes", MOST_NODES)
    if not is_whole:
        solver.setOptionValue("presolve", "off")
    solver.passModel(program)
    return solver


def _solved(solver: "highspy.Highs", alarm: IntArray) -> FloatArray | None:
    """Return the solution of a program, (column,), or None if none is found."""

    def look(event: "highspy.highs.HighsCallbackEvent") -> None:
        if has_rung(alarm):
            event.interrupt()

    solver.cbSimplexInterrupt += look
    solver.cbMipInterrupt += look
    solver.run()
    if has_rung(alarm) or solver.getInfo().primal_solution_status != FEASIBLE:
        return None
    return np.array(solver.getSolution().col_value)
