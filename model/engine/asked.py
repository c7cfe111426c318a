"""What some customers ask for, as rows of numbers: goods, relations, setups, weights."""

import numpy as np

from model.problem import BoolArray, Customer, IntArray, Problem


def sharing_rows(problem: Problem) -> list[tuple[int, int, int, int, int]]:
    """Return for all customers what goods they have, and who goes with them, as bits."""
    rows = [list(row) for row in _goods_rows(problem)]
    first, next_bit = problem.num_depots, {False: 1 << len(_named(problem)), True: 1}
    for relation in problem.relations:
        kept, on_trip = relation.keeps_together, relation.scope == "trip"
        if relation.across:
            continue
        # Apart: whoever is held bars all others like him.
        fields = (3 if on_trip else 4,) if kept else (0, 1 if on_trip else 2)
        # Whoever brings a shipment fetches it: its pickup stands for both ends.
        for node in set(map(problem.unit_of, relation.nodes)):
            for field in fields:
                rows[node - first][field] |= next_bit[kept]
        next_bit[kept] <<= 1
    return [(held, barred, all_day, trip, vehicle)
            for held, barred, all_day, trip, vehicle in rows]


def clash_by_themselves(problem: Problem) -> BoolArray:
    """Mark the customers whose own goods are kept apart."""
    return np.array([bool(held & (on_trip | on_vehicle))
                     for held, on_trip, on_vehicle, *_ in _goods_rows(problem)], np.bool_)


def _named(problem: Problem) -> list[str]:
    return sorted(frozenset().union(*(each.goods for each in problem.incompatible_goods)))


def _goods_rows(problem: Problem) -> list[tuple[int, int, int, int, int]]:
    """Return the goods at all customers; nobody goes with anybody."""
    named = _named(problem)
    bit = {goods: 1 << index for index, goods in enumerate(named)}
    barred = {(scope, goods): sum(bit[other] for other in frozenset().union(
                  *(each.goods for each in problem.incompatible_goods
                    if each.scope == scope and goods in each.goods)) - {goods})
              for scope in ("trip", "vehicle") for goods in named}

    def row(customer: Customer) -> tuple[int, int, int, int, int]:
        held = on_trip = on_vehicle = 0
        for goods in customer.goods & bit.keys():
            held |= bit[goods]
            on_trip |= barred["trip", goods]
            on_vehicle |= barred["vehicle", goods]
        return held, on_trip, on_vehicle, 0, 0

    return [row(customer) for customer in problem.customers]


def setup_rows(problem: Problem) -> list[tuple[int, int]]:
    """Return the setup at all nodes."""
    places = [(depot.site, 0) for depot in problem.depots]
    places += [(each.site, each.setup_duration) for each in problem.customers]
    # Whoever states no place is at one alone.
    return [(-1 - node if site is None else site, duration)
            for node, (site, duration) in enumerate(places)]


def has_setups(problem: Problem) -> bool:
    """Tell whether anybody asks for a setup."""
    return any(customer.setup_duration for customer in problem.customers)


def weight_rows(problem: Problem, dimension: int, length: int) -> IntArray:
    """Return what weighs of what each customer is brought, and gives, padded to so many columns."""
    rows = np.zeros((problem.num_customers, length), np.int64)
    rows[:, :2] = [(customer.demand[dimension], customer.taken_in[dimension])
                   for customer in problem.customers]
    for each in problem.shipments:
        for node in each.nodes:
            rows[node - problem.num_depots, 1] = each.change_at(node)[dimension]
    return rows


def most_asked_for(problem: Problem) -> IntArray:
    """Return the most that each customer alone asks to be aboard, (customer, dimension)."""
    asked = [[customer.demand for customer in problem.customers]]
    if any(customer.pickup for customer in problem.customers):
        asked.append([customer.taken_in for customer in problem.customers])
    shape = len(asked), problem.num_customers, problem.num_dimensions
    amounts = np.array(asked, np.int64).reshape(shape)
    most: IntArray = amounts.max(axis=0)
    for each in problem.shipments:
        for node in each.nodes:
            most[node - problem.num_depots] = problem.asked_at(node)
    return most
