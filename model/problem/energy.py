"""What a drone's battery holds, and what flying takes of it.

Energies are integer microjoules, powers milliwatts, so that power times milliseconds is energy.
"""

from dataclasses import dataclass
from itertools import pairwise

from model.problem.quantities import Microjoules, Milliseconds, Parts, require_units

MAX_POINTS = 24
"""Most weights at which powers are stated."""

MAX_POWER = 10**9
"""Largest power in mW."""

MAX_RISE = 2**62
"""Bound of a rise in power times that in weight, whose product has to fit 64 bits."""

MICROJOULES_PER_WH = 3_600_000_000

MAX_BATTERY = 1_000_000
"""Largest battery in Wh that a request states."""


@dataclass(frozen=True)
class Energy:
    """A battery, and powers by the weight aboard: linear between points, and on beyond the last."""

    available: Microjoules  # what a sortie may take, without the reserve
    usable_share: float  # of the battery; for people
    weights: tuple[Parts, ...]  # (point,) ascending from 0, of the dimension that weighs
    cruise: tuple[int, ...]  # (point,) power in level flight
    hover: tuple[int, ...]  # (point,)
    climb: tuple[int, ...]  # (point,)
    descent: tuple[int, ...]  # (point,)
    climb_duration: Milliseconds = 0  # of each leg
    descent_duration: Milliseconds = 0
    dimension: int = 0  # of demands, which weighs
    lands: bool = True  # at customers; else it hovers there
    preset: str | None = None  # name of the published model that the powers are from; for people
    charge: int = 0  # mW that a drone gains aboard; 0: each launch has a full battery
    per_wh: float = 0.0  # mW in the air for the weight of each Wh of battery more; for people

    def __post_init__(self) -> None:
        if not 2 <= len(self.weights) <= MAX_POINTS or self.weights[0] != 0:
            raise ValueError(f"energy weights: {self.weights!r} is not allowed")
        if any(upper <= lower for lower, upper in pairwise(self.weights)):
            raise ValueError(f"energy weights: {self.weights!r} is not allowed")
        require_units(self, "energy")
        if self.dimension < 0:
            raise ValueError(f"energy dimension: {self.dimension!r} is not allowed")
        if not 0 < self.usable_share <= 1:
            raise ValueError(f"energy usable_share: {self.usable_share!r} is not allowed")
        if not 0 <= self.charge <= MAX_POWER:
            raise ValueError(f"energy charge: {self.charge!r} is not allowed")
        for name in ("cruise", "hover", "climb", "descent"):
            self._require_powers(name, getattr(self, name))

    def _require_powers(self, name: str, powers: tuple[int, ...]) -> None:
        if len(powers) != len(self.weights) or min(powers) < 0 or max(powers) > MAX_POWER:
            raise ValueError(f"energy {name}: {powers!r} is not allowed")
        if (max(powers) - min(powers)) * self.weights[-1] >= MAX_RISE:
            raise ValueError(f"energy {name}: {powers!r} is too finely weighed")
