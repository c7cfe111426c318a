"""How fast a drone is over the ground: the wind triangle."""

from dataclasses import dataclass

import numpy as np

from model.problem import FloatArray


Breeze = tuple[float, float]
"""Speed in km/h, and where it blows from in degrees clockwise from north."""


@dataclass(frozen=True)
class Wind:
    """What the air does to one drone. Speeds in metres per second."""

    airspeed: float
    x: float  # the way the air moves
    y: float

    @classmethod
    def blowing(cls, speed_kmh: float, direction_deg: float, airspeed_kmh: float) -> "Wind":
        """Return the wind from a direction, clockwise from north, for a drone's airspeed."""
        speed = speed_kmh / 3.6
        direction = np.radians(direction_deg)
        return cls(airspeed_kmh / 3.6, -speed * float(np.sin(direction)),
                   -speed * float(np.cos(direction)))

    @property
    def is_calm(self) -> bool:
        """Tell whether a flight back takes as long as the flight there."""
        return self.x == 0 and self.y == 0

    def durations(self, x: FloatArray, y: FloatArray, lengths: FloatArray) -> FloatArray:
        """Return the seconds of straight flights, infinite against too strong a wind.

        The drone heads into the wind so far that the drift across its course cancels.

        Parameters
        ----------
        x, y
            Metres east and north from origin to target.
        lengths
            Metres to be flown that way.
        """
        if self.is_calm:
            return lengths / self.airspeed
        planar = np.hypot(x, y)
        planar[planar == 0] = 1.0
        across = (self.x * y - self.y * x) / planar
        forward = np.sqrt(np.maximum(self.airspeed**2 - across**2, 0.0))
        ground_speed = (self.x * x + self.y * y) / planar + forward
        flyable = (np.abs(across) < self.airspeed) & (ground_speed > 0)
        ground_speed[~flyable] = 1.0
        durations: FloatArray = np.where(flyable, lengths / ground_speed, np.inf)
        durations[lengths == 0] = 0.0
        return durations
