"""Ways to round straight distances, each of which some published instances are defined with."""

from app.schemas.fields import Rounding
from model.problem import FloatArray
from model.problem.distances import DIMACS, EXACT, ROUND, THOUSANDTHS, TRUNC, rounded_as

ROUNDINGS: dict[Rounding, int] = {
    "exact": EXACT,
    "round": ROUND,  # CVRPLIB's capacitated instances
    "trunc": TRUNC,
    "dimacs": DIMACS,  # time windows, 12th DIMACS challenge
    "thousandths": THOUSANDTHS,  # heterogeneous fleets
}


def rounded(distances: FloatArray, rounding: Rounding) -> FloatArray:
    """Return what distances become, in their unit."""
    return rounded_as(distances, ROUNDINGS[rounding])
