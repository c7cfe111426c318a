"""Tiny problems some of whose customers go together, or apart."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from model.problem import Problem, Relation

MINUTE = 60_000


def with_relations(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem with one relation between customers, or two."""
    ends = problem.shipment_at
    free = [node for node in range(problem.num_depots, problem.num_nodes) if node not in ends]
    if len(free) < 2:
        return problem

    def draw() -> Relation:
        number = int(rng.integers(2, min(4, len(free) + 1)))
        return Relation("together" if rng.random() < 0.6 else "apart",
                        tuple(rng.choice(free, number, replace=False).tolist()),
                        "trip" if rng.random() < 0.4 else "vehicle")

    return replace(problem, relations=tuple(draw() for _ in range(int(rng.integers(1, 3)))))


def companions(problem: Problem, nodes: Iterable[int]) -> set[int]:
    """Return who may be served by no other vehicle than that of some customers."""
    there = set(nodes)
    return {node for each in problem.relations if each.keeps_together
            and not there.isdisjoint(each.nodes) for node in each.nodes} - there


def with_order(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem some of whose customers are served before others."""
    ends = problem.shipment_at
    free = [node for node in range(problem.num_depots, problem.num_nodes) if node not in ends]
    if len(free) < 2:
        return problem

    def draw() -> Relation:
        number = int(rng.integers(2, min(4, len(free) + 1)))
        least = int(rng.integers(0, 20)) * MINUTE if rng.random() < 0.6 else 0
        most = least + int(rng.integers(0, 20)) * MINUTE if rng.random() < 0.5 else None
        return Relation("before", tuple(rng.choice(free, number, replace=False).tolist()),
                        "trip" if rng.random() < 0.3 else "vehicle", least, most)

    return replace(problem, relations=(*problem.relations, *(
        draw() for _ in range(int(rng.integers(1, 3))))))
