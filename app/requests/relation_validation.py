"""What the schema can't tell of relations between customers."""

from collections.abc import Mapping
from itertools import combinations

from app.requests.draft import Draft, Errors, Path, error_at
from app.requests.ends import named_otherwise
from app.schemas.relation import RelationInput
from model.problem import MOST_IN_ORDER, MOST_RELATIONS


def relation_errors(draft: Draft) -> Errors:
    """Say whom relations name who isn't there, and what they contradict."""
    yield from _count_errors(draft)
    known = {customer.id for _, customer in draft.known_customers()}
    are_known = draft.customers is not None and None not in draft.customers
    for index, relation in enumerate(draft.relations):
        seen = set[str]()
        for place, name in enumerate(relation.customers):
            path = ("relations", index, "customers", place)
            if name in draft.added - draft.shipment_ends:
                yield error_at("UNKNOWN_CUSTOMER", path,
                               f"{name!r} is another place of a customer: name customers, of whom "
                               "relations say the same at any place.")
            elif are_known and name not in known:
                yield error_at("UNKNOWN_CUSTOMER", path,
                               named_otherwise(name, draft.shipment_ends)
                               or f"The request has no customer {name!r}: use a customer's id.")
            if name in seen:
                yield error_at("DUPLICATE_ID", path,
                               f"{name!r} is named twice: name each customer once.")
            seen.add(name)
        yield from _shipment_errors(draft, relation, ("relations", index, "customers"))
        yield from _lag_errors(draft, relation, ("relations", index))
    yield from _contradictions(draft)


def _unit_of(draft: Draft, name: str) -> str:
    """Return the delivery of the shipment whose end is named; else the name."""
    return draft.delivery_of.get(name, name)


def _units(draft: Draft, relation: RelationInput) -> list[str]:
    return sorted({_unit_of(draft, name) for name in relation.customers})


def _shipment_errors(draft: Draft, relation: RelationInput, path: Path) -> Errors:
    """Say which relations name several ends of a shipment in vain."""
    units = dict[str, str]()
    for place, name in enumerate(relation.customers):
        unit = _unit_of(draft, name)
        other = units.setdefault(unit, name)
        is_brought = unit != name and unit in relation.customers[:place]
        if other != name and (relation.kind == "apart"
                              or (relation.kind == "before" and is_brought)):
            yield error_at("CONTRADICTION", (*path, place),
                           "One trip fetches a shipment, and then brings it: leave "
                           f"{name!r} out, or {unit if is_brought else other!r}.")
    if relation.kind == "together" and len(units) < 2:
        yield error_at("WRONG_LENGTH", path, "It names one shipment alone, whose ends go together "
                       "anyhow: name more, or leave it out.")


def _lag_errors(draft: Draft, relation: RelationInput, path: Path) -> Errors:
    """Say what isn't told of an order, or contradicts itself."""
    if relation.kind != "before":
        for name in ("min_lag", "max_lag", "same_vehicle"):
            if getattr(relation, name) != RelationInput.model_fields[name].default:
                yield error_at("RELATION_WITH", (*path, name),
                               f"{name} says something of an order: leave it out, or let kind be "
                               "before.")
        return
    if relation.max_lag is not None and relation.max_lag < relation.min_lag:
        yield error_at("OUT_OF_RANGE", (*path, "max_lag"),
                       f"{relation.max_lag:g} is less than min_lag, {relation.min_lag:g}.")
    if len(relation.customers) > MOST_IN_ORDER:
        yield error_at("WRONG_LENGTH", (*path, "customers"),
                       f"At most {MOST_IN_ORDER} customers are served in an order: name fewer.")
    if not relation.same_vehicle:
        yield from _across_errors(draft, relation, path)


def _across_errors(draft: Draft, relation: RelationInput, path: Path) -> Errors:
    """Say what contradicts that any trucks serve those of an order."""
    if relation.scope == "trip":
        yield error_at("RELATION_WITH", (*path, "scope"),
                       "Whom one trip serves one vehicle does: leave scope out, or same_vehicle.")
    flown = {customer.id for _, customer in draft.known_customers()
             if customer.served_by == "drone"}
    for place, name in enumerate(relation.customers):
        if name in flown:
            yield error_at("RELATION_WITH", (*path, "customers", place),
                           f"Only a drone may serve {name!r}, and trucks alone wait for whoever "
                           "other vehicles serve: let either serve it, or one vehicle all of them.")


def _count_errors(draft: Draft) -> Errors:
    together = sum(map(_keeps_together, draft.relations))
    apart = sum(relation.kind == "apart" for relation in draft.relations)
    goods = len({goods for each in draft.incompatible_goods for goods in each.goods})
    if together > MOST_RELATIONS:
        yield error_at("WRONG_LENGTH", ("relations",),
                       f"{together} relations keep customers together and at most "
                       f"{MOST_RELATIONS} may: join those that share customers.")
    if apart > 0 and apart + goods > MOST_RELATIONS:
        yield error_at("WRONG_LENGTH", ("relations",),
                       f"{apart} relations and {goods} incompatible goods keep customers apart "
                       f"and at most {MOST_RELATIONS} may: join those that share customers.")


def _contradictions(draft: Draft) -> Errors:
    """Say where two customers are apart by one relation, and together by another, or each is before
    the other.
    """
    apart: dict[frozenset[str], int] = {}
    for index, relation in enumerate(draft.relations):
        if relation.kind == "apart":
            for pair in combinations(_units(draft, relation), 2):
                apart[frozenset(pair)] = min(index, apart.get(frozenset(pair), index))
    behind: dict[tuple[str, str], int] = {}
    for index, relation in enumerate(draft.relations):
        if relation.kind == "before" and len(relation.customers) <= MOST_IN_ORDER:
            for pair in combinations(relation.customers, 2):
                behind.setdefault(pair, index)
                if behind.get((pair[1], pair[0]), index) != index:
                    yield error_at("CONTRADICTION", ("relations", index),
                                   f"{pair[1]} is to be served before {pair[0]} by "
                                   f"relations[{behind[pair[1], pair[0]]}]: take one of both away.")
                    break
    for index, relation in enumerate(draft.relations):
        if _keeps_together(relation) and apart:
            found = _contradicted(draft, relation, apart)
            if found is not None:
                names, other = found
                yield error_at("CONTRADICTION", ("relations", index),
                               f"{' and '.join(names)} are kept apart by relations[{other}]: take "
                               "one of both away.")


def _keeps_together(relation: RelationInput) -> bool:
    """Tell whether one vehicle serves those whom a relation names."""
    return relation.kind == "together" or (relation.kind == "before" and relation.same_vehicle)


def _contradicted(draft: Draft, relation: RelationInput,
                  apart: Mapping[frozenset[str], int]) -> tuple[list[str], int] | None:
    """Return two customers of a relation who can't both be served, and what keeps them apart."""
    for pair in combinations(_units(draft, relation), 2):
        other = apart.get(frozenset(pair))
        if other is not None and (relation.scope == "trip"
                                  or draft.relations[other].scope == "vehicle"):
            return [*pair], other
    return None
