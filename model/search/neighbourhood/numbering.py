"""The search's own numbers for customers: those near each other are so in memory, too."""

from typing import NamedTuple

import numpy as np

from model.engine.instance import Instance
from model.engine.library import call
from model.problem import Int32Array, IntArray


class Numbering(NamedTuple):
    """Numbers of nodes, depots first as ever."""

    node: IntArray  # (number,) the problem's
    number: IntArray  # (node,) the search's


def as_stated(num_nodes: int) -> Numbering:
    """Return the problem's own numbers."""
    nodes = np.arange(num_nodes)
    return Numbering(nodes, nodes)


def along_neighbours(near: Int32Array, num_depots: int) -> Numbering:
    """Number customers along a walk that goes on to the nearest who has no number yet.

    An insertion looks at a customer's legs to its neighbours. Where their numbers are close, so are
    these legs, in a few lines of the processor's cache: that is most of the time of large problems.
    `near` as in `ProblemData`.
    """
    node = np.arange(len(near))
    call("tandem_walk", near, num_depots, node)
    return Numbering(node, np.argsort(node))


def renumbered(instance: Instance, numbering: Numbering) -> Instance:
    """Return one packed problem with all that is said of nodes in the search's order, but legs."""
    node = numbering.node
    by_node = {
        name: np.take(getattr(instance, name), node, axis)
        for name, axis in (("node", 2), ("amount", 1), ("price", 1), ("reload", 2),
                           ("can_drive", 2), ("can_fly", 2), ("unassigned_more", 1))}
    by_node |= {name: np.take(table, node, 1)
                for name in ("goods", "setup", "max_time_aboard", "no_launch", "zones")
                if (table := getattr(instance, name)).shape[1]}
    if instance.pair.shape[1]:
        by_node["pair"] = pair = np.take(instance.pair, node, 1)
        paired = pair["partner"] >= 0
        pair["partner"][paired] = numbering.number[pair["partner"][paired]]
        for name in ("unit", "next_place"):
            pair[name] = numbering.number[pair[name]]
    for name, rows in (("lag", instance.lag), ("across", instance.across)):
        if rows.shape[1]:
            by_node[name] = lag = np.take(rows, node, 1)
            behind = lag["node"] >= 0
            lag["node"][behind] = numbering.number[lag["node"][behind]]
    if instance.max_between.shape[2]:
        by_node["max_between"] = np.take(instance.max_between, node, 2)
    if instance.vehicle_cost.shape[2]:
        by_node["vehicle_cost"] = np.take(instance.vehicle_cost, node, 2)
    return instance._replace(**by_node)
