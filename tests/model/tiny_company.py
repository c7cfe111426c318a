"""Tiny problems some of whose customers go together, or apart."""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from model.problem import Problem, Relation

MINUTE = 60_000


def with_relations(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem with one relation between customers, or two."""
    def draw(some: Callable[[], tuple[int, ...]]) -> Relation:
        return Relation("together" if rng.random() < 0.6 else "apart", some(),
                        "trip" if rng.random() < 0.4 else "vehicle")

    return _with_drawn(rng, replace(problem, relations=()), draw, False)


def companions(problem: Problem, nodes: Iterable[int]) -> set[int]:
    """Return who may be served by no other vehicle than that of some customers."""
    there = set(nodes)
    return {node for each in problem.relations if each.keeps_together
            and not there.isdisjoint(each.nodes) for node in each.nodes} - there


def with_order(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem some of whose customers are served before others."""
    def draw(some: Callable[[], tuple[int, ...]]) -> Relation:
        least = int(rng.integers(0, 20)) * MINUTE if rng.random() < 0.6 else 0
        most = least + int(rng.integers(0, 20)) * MINUTE if rng.random() < 0.5 else None
        return Relation("before", some(), "trip" if rng.random() < 0.3 else "vehicle", least, most)

    return _with_drawn(rng, problem, draw)


def with_order_across(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem some of whose customers any trucks serve before others."""
    def draw(some: Callable[[], tuple[int, ...]]) -> Relation:
        least = int(rng.integers(0, 12)) * MINUTE if rng.random() < 0.6 else 0
        most = least + int(rng.integers(0, 12)) * MINUTE if rng.random() < 0.5 else None
        return Relation("before", some(), "vehicle", least, most, across=True)

    by_truck = tuple([replace(each, served_by="truck") for each in problem.customers])
    return _with_drawn(rng, replace(problem, customers=by_truck), draw)


def _with_drawn(rng: np.random.Generator, problem: Problem,
                draw: Callable[[Callable[[], tuple[int, ...]]], Relation],
                is_ordered: bool = True) -> Problem:
    """Return a problem with one relation more, or two, between two or three of its customers.

    Where there is no order, pickups stand for shipments.
    """
    free = [node for node in range(problem.num_depots, problem.num_nodes)
            if is_ordered or problem.unit_of(node) == node]
    if len(free) < 2:
        return problem

    def drawn() -> Relation:
        number = int(rng.integers(2, min(4, len(free) + 1)))
        return draw(lambda: tuple(rng.choice(free, number, replace=False).tolist()))

    more = [drawn() for _ in range(int(rng.integers(1, 3)))]
    return replace(problem, relations=(*problem.relations, *more))
