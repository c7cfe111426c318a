"""Random numbers from a state of one word, the same on every machine and in every thread."""

import numpy as np

from model.kernel.compiled import spliced
from model.problem import UIntArray

STEP = np.uint64(0x9E3779B97F4A7C15)
FIRST = np.uint64(0xBF58476D1CE4E5B9)
SECOND = np.uint64(0x94D049BB133111EB)
UNIT = 1.0 / 2.0**53


@spliced
def uniform(state: UIntArray) -> float:
    """Draw from [0, 1). In place.

    References
    ----------
    Steele, Lea and Flood (2014), fast splittable pseudorandom number generators, OOPSLA: SplitMix.
    """
    state[0] += STEP
    z = state[0]
    z = (z ^ (z >> np.uint64(30))) * FIRST
    z = (z ^ (z >> np.uint64(27))) * SECOND
    z = z ^ (z >> np.uint64(31))
    return (z >> np.uint64(11)) * UNIT


@spliced
def below(state: UIntArray, bound: int) -> int:
    """Draw a whole number from 0 to `bound - 1`. In place."""
    return int(uniform(state) * bound)
