"""Warnings about matrices whose units don't go together."""

import numpy as np

from app.requests.warnings.survey import METRES_A_SECOND, Survey
from app.requests.warnings.warning import Warnings, amount_text, warning_at

SLOW_KMH, FAST_KMH = 0.5, 400.0
"""Speeds that half of all legs have at least, and at most."""

SAMPLE_ROWS = 10


def matrix_warnings(survey: Survey) -> Warnings:
    """Yield warnings about matrices by whose legs nothing drives."""
    for name, matrix in (survey.request.matrices or {}).items():
        if matrix.distances is None:
            continue
        rows = range(0, len(matrix.durations), max(1, len(matrix.durations) // SAMPLE_ROWS))
        seconds = np.concatenate([matrix.durations[row] for row in rows] or [np.empty(0)])
        metres = np.concatenate([matrix.distances[row] for row in rows] or [np.empty(0)])
        some = (seconds > 0) & (metres > 0)
        if not some.any():
            continue
        speed = float(np.median(metres[some] / seconds[some])) * METRES_A_SECOND
        if not SLOW_KMH <= speed <= FAST_KMH:
            hint = ("durations that are in minutes or hours" if speed > FAST_KMH
                    else "distances that are in kilometres or miles")
            yield warning_at(
                "MATRIX_UNITS", ("matrices", name),
                f"By this matrix, half of all legs are driven at {amount_text(speed)} km/h: "
                f"durations are seconds and distances metres, so look for {hint}.")
