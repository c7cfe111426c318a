"""How long the work on a request takes before its search, by what was measured on one core.

`benchmarks.punctuality` tells what came before the search. The constants are what it takes on
memory that was in use before; the first touch of new memory may take as long again, which the clock
sees.
"""

from model.travel.visibility import FEW_EDGES

DRIVE, FLIGHT = 2e-8, 3e-8
"""Seconds for each leg of a way to travel."""

PLANAR, GREAT_CIRCLE = 1e-8, 8e-8
"""Seconds for each leg's distance, once."""

EDGE, LOOK, LOOK_AT_FEW = 1e-7, 1e-7, 3e-8
"""Seconds for each edge seen from a place or corner, and for each line of sight between two of
these: the last where areas have few edges."""


def legs_seconds(places: int, drives: int, flights: int, geographic: bool) -> float:
    """Estimate how long the matrices take, without ways around no-fly areas."""
    each = drives * DRIVE + flights * FLIGHT + (GREAT_CIRCLE if geographic else PLANAR)
    return each * places**2


def sights_seconds(places: int, corners: int, edges: int) -> float:
    """Estimate how long it takes to find out which places and corners of areas see each other."""
    looks = places**2 / 2 + places * corners + corners**2 / 2
    each = LOOK_AT_FEW if edges <= FEW_EDGES else LOOK
    return (2 * places + corners) * edges * EDGE + looks * each
