"""How many processor cores there are to use."""

import loky


def num_cores() -> int:
    """Return how many cores this process may use, by its affinity and its container's quota."""
    return int(loky.cpu_count())
