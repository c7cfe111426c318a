"""Ways to round straight distances, each of which some published instances are defined with."""

from collections.abc import Callable

import numpy as np

from app.schemas.fields import Rounding
from model.problem import FloatArray


def rounded(distances: FloatArray, rounding: Rounding) -> FloatArray:
    """Return what distances become, in their unit."""
    return ROUNDINGS[rounding](distances)


def _exact(weights: FloatArray) -> FloatArray:
    return weights


def _round(weights: FloatArray) -> FloatArray:
    """Round to the nearest integer, halves up."""
    return np.floor(weights + 0.5)


def _dimacs(weights: FloatArray) -> FloatArray:
    return np.trunc(weights * 10) / 10


def _thousandths(weights: FloatArray) -> FloatArray:
    return _round(weights * 1000) / 1000


ROUNDINGS: dict[Rounding, Callable[[FloatArray], FloatArray]] = {
    "exact": _exact,
    "round": _round,  # CVRPLIB's capacitated instances
    "trunc": np.trunc,
    "dimacs": _dimacs,  # time windows, 12th DIMACS challenge
    "thousandths": _thousandths,  # heterogeneous fleets
}
