"""How many random cases tests draw: a third in the suite, all of them in `make fuzz`."""

import os

SHARE = 1 if "EVERY_SEED" in os.environ else 3


def seeds(count: int) -> range:
    """Return the seeds of random cases, of which `make fuzz` has so many."""
    return range(0, count, SHARE)


def often(count: int) -> int:
    """Return how often something is done, or met at least, that is so often in `make fuzz`."""
    return count // SHARE
