"""The map's own coordinates: Web Mercator, from 0 to 1 eastwards and southwards."""

import numpy as np

from model.problem import FloatArray

MOST_LATITUDE = 85.05112878


def on_map(lon_lat: FloatArray) -> FloatArray:
    """Return where (place, 2) degrees are on the map."""
    latitude = np.radians(np.clip(lon_lat[:, 1], -MOST_LATITUDE, MOST_LATITUDE))
    return np.column_stack((lon_lat[:, 0] / 360 + 0.5,
                            0.5 - np.arcsinh(np.tan(latitude)) / (2 * np.pi)))
