"""Rows are laid out in C as NumPy has them."""

import numpy as np
import pytest

from model.engine.header import dtype_of, interface, is_laid_out_as, is_row
from model.kernel import instance, leg
from model.kernel.load import HALT
from model.policy import tokens
from model.policy.observation import ACTION, VEHICLE_STATE
from model.search.beginning import savings
from model.search.linked import layout as linked
from model.search.moves.split import LINE
from model.search.route import layout
from model.search.route.block import SUMS
from model.search.route.edit import MOVE
from model.search.route.state import COUNTS, VALUES

ROWS = {
    "size": instance.SIZE, "node": instance.NODE, "setup": instance.SETUP,
    "price": instance.PRICE, "goods": instance.GOODS, "vehicle_type": instance.TYPE,
    "rate": instance.RATE, "leg_law": leg.LAW, "point": leg.POINT, "halt": HALT,
    "node_features": tokens.NODE, "type_features": tokens.TYPE, "action_features": ACTION,
    "vehicle_features": VEHICLE_STATE,
    "stop": layout.STOP, "sortie": layout.SORTIE, "trip": layout.TRIP, "route": layout.ROUTE,
    "kept": layout.KEPT, "bound": layout.BOUND, "place": layout.PLACE, "move": MOVE,
    "block_sums": SUMS, "search_counts": COUNTS, "search_values": VALUES, "line": LINE,
    "chain": savings.CHAIN, "chain_cargo": savings.CARGO, "link": linked.LINK,
    "run": linked.RUN, "piece": linked.PIECE, "entry": linked.ENTRY, "moment": linked.MOMENT,
    "noted": linked.NOTED, "least": linked.LEAST,
}
"""By name in C, without `tandem_`."""


@pytest.mark.parametrize("name", ROWS)
def test_rows_are_the_same_in_both_languages(name: str) -> None:
    row = dtype_of(f"tandem_{name}")
    assert is_laid_out_as(ROWS[name], row)
    assert row.type is np.record


def test_no_rows_are_left_out() -> None:
    ffi = interface()
    names = {name for name in ffi.list_types()[0] if is_row(ffi.typeof(name))}
    assert names >= {f"tandem_{name}" for name in ROWS}


def test_rows_with_other_fields_are_told_apart() -> None:
    assert not is_laid_out_as(instance.SETUP, dtype_of("tandem_outlook"))
    assert not is_laid_out_as(leg.LAW, dtype_of("tandem_place"))


def test_what_points_to_others_is_no_row() -> None:
    with pytest.raises(TypeError, match="tandem_cells is no row of numbers"):
        dtype_of("tandem_cells")
