"""Whom vehicles may still serve, by who has been served with whom."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from model.judge.timing import RouteDecision
from model.problem import BoolArray, Problem, Relation
from model.replanning.amend import customers_of, without
from model.replanning.kept import Kept
from model.replanning.workers import VehicleWorker
from model.solution import Vehicle


def relations_left(problem: Problem, owners: Mapping[int, VehicleWorker],
                   number: Mapping[int, int]) -> tuple[Relation, ...]:
    """Return what relations say of those who are left, by their numbers there.

    Whose parcel is aboard a vehicle is served by it in any case, though by a type of its own. So
    orders among them and others are as if any vehicles served them. Others who go with them are
    kept together by whom the vehicle's other type may serve: no more relations are left than there
    were.
    """
    aboard = problem.all_places(node for owner in owners.values() for node in owner.aboard)
    found = []
    for each in problem.relations:
        parts: list[Relation | None] = [each]
        if each.keeps_together and each.scope == "vehicle":
            inside = tuple([node for node in each.nodes if node in aboard])
            if inside:
                parts = [each.among({node: node for node in inside}, problem.first_place)]
            if each.kind == "before" and 0 < len(inside) < len(each.nodes):
                parts.append(replace(each, across=True))
        left = [part.among(number, problem.first_place) for part in parts if part is not None]
        found += [part for part in left if part is not None]
    return tuple(dict.fromkeys(found))


def relations_table(problem: Problem, kept: Mapping[Vehicle, Kept], kinds: Sequence[int],
                  owners: Mapping[int, VehicleWorker], nodes: Sequence[int]) -> BoolArray:
    """Return (type, customer) whom relations let each vehicle serve, by who is settled."""
    table = np.ones((len(kinds), len(nodes)), np.bool_)
    for relation in problem.relations:
        for kind in range(len(kinds)):
            if (relation.keeps_together or kind in owners) and not _may_join(
                    problem, kept, relation, owners.get(kind)):
                units = set(map(problem.unit_of, relation.nodes))
                table[kind] &= [problem.unit_of(node) not in units for node in nodes]
        if relation.keeps_together and relation.scope == "vehicle":
            _keep_by_carriers(problem, relation, kept, owners, nodes, table)
    return table


def _may_join(problem: Problem, kept: Mapping[Vehicle, Kept], relation: Relation,
              owner: VehicleWorker | None) -> bool:
    """Tell whether a type, which is one vehicle's if it has an owner, may serve more of them."""
    those = frozenset(relation.nodes)
    there = {vehicle for vehicle, route in kept.items() if not those.isdisjoint(route.served)}
    if relation.keeps_together and not there:
        return True
    if owner is None:
        return False
    own = kept.get(owner.vehicle)
    joins = owner.vehicle in there
    if own is not None and relation.scope == "trip":
        joins = owner.is_under_way and not those.isdisjoint(
            customers_of(problem, own.decision.trips[-1]))
    elif own is not None and own.way_on is not None and not owner.is_under_way:
        joins = joins or (not relation.keeps_together and not those.isdisjoint(own.way_on.aboard))
    return joins == relation.keeps_together and (
        not relation.keeps_together or there == {owner.vehicle})


def _keep_by_carriers(problem: Problem, relation: Relation, kept: Mapping[Vehicle, Kept],
                      owners: Mapping[int, VehicleWorker], nodes: Sequence[int],
                      table: BoolArray) -> None:
    """Let those who go with others whose parcels are aboard be served by that vehicle. In place."""
    those = frozenset(relation.nodes)
    aboard = {owner.vehicle: owner.aboard for owner in owners.values()
              if not those.isdisjoint(owner.aboard)}
    if not aboard or any(not those.isdisjoint(route.served) for route in kept.values()):
        return
    laden = problem.all_places(node for loaded in aboard.values() for node in loaded)
    for kind in range(len(table)):
        owner = owners.get(kind)
        if owner is None or {owner.vehicle} != set(aboard):
            table[kind] &= [node not in those or node in laden for node in nodes]


def in_relation(problem: Problem, decisions: Sequence[RouteDecision]) -> list[RouteDecision]:
    """Return routes without those who go with others of a route before."""
    if not problem.keeps_together:
        return list(decisions)
    found: list[RouteDecision] = []
    served: set[int] = set()
    for decision in decisions:
        own = {node for trip in decision.trips for node in customers_of(problem, trip)}
        gone = {node for each in problem.relations if each.keeps_together
                and not served.isdisjoint(each.nodes) for node in own.intersection(each.nodes)}
        found.append(replace(decision, trips=tuple([
            without(trip, gone) for trip in decision.trips])) if gone else decision)
        served |= own - gone
    return found
