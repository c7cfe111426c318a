"""Legs as the engine reads them: from tables, or computed from where nodes are."""

from typing import NamedTuple


from model.engine.records import Records
from model.problem import Int32Array, IntArray

LEG_DURATION, LEG_DISTANCE = range(2)
"""Last axis of a table of legs."""

GLOBE = -1
"""Stands for a way to round distances where nodes lie on a sphere."""

COMPUTED = -1
"""Stands for the table of a travel whose legs are computed."""


class ComputedLegs(NamedTuple):
    """Those of all travels, of which some are computed."""

    table: IntArray  # (direction, table, node, node, 2); one direction if they are the same back
    point: Records  # (node,) where it is as in `Points`, and the setup there
    law: Records  # (travel,) how legs of a travel are told


AllLegs = Int32Array | ComputedLegs
"""Those of all travels. Where none are computed and all fit 32 bits, (travel, origin, to, 2) with
`NO_LEG` for `UNREACHABLE`: most of the time of a search goes into getting them from memory."""


def are_the_same_back(legs: AllLegs, back: AllLegs) -> bool:
    """Tell whether all legs are those back as well."""
    return len(legs.table) == 1 if isinstance(legs, ComputedLegs) else legs is back
