"""What the schema can't tell of relations between customers."""

from collections.abc import Mapping
from itertools import combinations

from app.requests.draft import Draft, Errors, error_at
from app.schemas.relation import RelationInput
from model.problem import MOST_RELATIONS


def relation_errors(draft: Draft) -> Errors:
    """Say whom relations name who isn't there, and what they contradict."""
    yield from _count_errors(draft)
    known = {customer.id for _, customer in draft.known_customers()}
    are_known = draft.customers is not None and None not in draft.customers
    for index, relation in enumerate(draft.relations):
        seen = set[str]()
        for place, name in enumerate(relation.customers):
            path = ("relations", index, "customers", place)
            if name in draft.added:
                yield error_at("UNKNOWN_CUSTOMER", path,
                               f"{name!r} is an end of a shipment, or another place of a customer: "
                               "name customers alone, of whom relations say the same at any place.")
            elif are_known and name not in known:
                yield error_at("UNKNOWN_CUSTOMER", path,
                               f"The request has no customer {name!r}: use a customer's id.")
            if name in seen:
                yield error_at("DUPLICATE_ID", path,
                               f"{name!r} is named twice: name each customer once.")
            seen.add(name)
    yield from _contradictions(draft)


def _count_errors(draft: Draft) -> Errors:
    together = sum(relation.kind != "apart" for relation in draft.relations)
    apart = len(draft.relations) - together
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
    """Say where two customers are to be together by one relation, and apart by another."""
    apart: dict[frozenset[str], int] = {}
    for index, relation in enumerate(draft.relations):
        if relation.kind == "apart":
            for pair in combinations(sorted(set(relation.customers)), 2):
                apart[frozenset(pair)] = min(index, apart.get(frozenset(pair), index))
    for index, relation in enumerate(draft.relations):
        if relation.kind != "apart" and apart:
            found = _contradicted(draft, relation, apart)
            if found is not None:
                names, other = found
                yield error_at("CONTRADICTION", ("relations", index),
                               f"{' and '.join(names)} are kept apart by relations[{other}]: take "
                               "one of both away.")


def _contradicted(draft: Draft, relation: RelationInput,
                  apart: Mapping[frozenset[str], int]) -> tuple[list[str], int] | None:
    """Return two customers of a relation who can't both be served, and what keeps them apart."""
    for pair in combinations(sorted(set(relation.customers)), 2):
        other = apart.get(frozenset(pair))
        if other is not None and (relation.scope == "trip"
                                  or draft.relations[other].scope == "vehicle"):
            return [*pair], other
    return None
