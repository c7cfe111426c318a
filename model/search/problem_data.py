"""The search's arrays for a problem, and plans to and from its routes."""

from collections.abc import Hashable

import numpy as np

from model.engine.alarm import Alarm
from model.engine.instance import Instance
from model.engine.leg import are_the_same_back
from model.engine.library import dtype_of
from model.engine.records import Records
from model.engine.type_rows import WORK_RATES
from model.problem import (
    MM_PER_KM, MS_PER_HOUR, UNLIMITED, BoolArray, IntArray, Problem, limits_chargers,
)
from model.search.evaluation import evaluate
from model.search.halts import Halts, halts_of
from model.search.needless_flights import without_needless_flights
from model.search.neighbourhood.neighbourhood import Neighbourhood, make_neighbourhood
from model.search.neighbourhood.numbering import renumbered
from model.search.route.layout import MEASURES, PlanPrices, ProblemData
from model.search.strategy import ALL_MOVES, Moves, grounded, strategy_of, visits_of
from model.search.ways import with_ways_priced

TURNED_FROM = 2000
"""Number of customers from which on routes of the first plan are turned round as needed. With fewer
the search has soon made more of any plan."""


def make_data(problem: Problem, instance: Instance, moves: Moves = ALL_MOVES,
              neighbourhood: Neighbourhood | None = None,
              deadline: IntArray | None = None) -> ProblemData:
    """Lay out a problem for the search.

    `neighbourhood` is that of the same problem, if it is there already; `deadline` an alarm's
    setting.
    """
    if neighbourhood is None:
        neighbourhood = make_neighbourhood(problem, instance)
    instance = renumbered(instance, neighbourhood.numbering)
    if moves.flights:
        instance, moves = without_needless_flights(problem, instance, moves)
    else:
        instance = grounded(instance)
    instance = with_ways_priced(problem, instance)
    types, evaluation = instance.type[0], evaluate(instance)
    if problem.fairness.is_stated:
        evaluation["by_distance"] = False
    swap, visits = _swaps(problem, types, evaluation), visits_of(problem)
    most_visits = max(1, int(visits.max()))
    halts = halts_of(problem, neighbourhood.numbering)
    must_serve, more = _must_serve(problem, instance), instance.unassigned_more[0]
    tables = instance.tables(0)._replace(
        price=_per_ms(instance.price[0]), rate=_per_unit(instance.rate[0]))
    return ProblemData(
        **vars(tables), max_visits=most_visits,
        strategy=strategy_of(problem, instance, moves, evaluation, swap, most_visits),
        fairness=_plan_prices(problem), all_optional=not bool(must_serve.any()),
        unassigned_costs_differ=bool((more > 0.0).any()), must_serve=must_serve,
        span=np.zeros(instance.across.shape[1], dtype_of("tandem_span")),
        plugging=np.zeros(2 * problem.num_nodes + 1 if limits_chargers(problem) else 0,
                          dtype_of("tandem_plugging")),
        **halts._asdict(), evaluation=evaluation, visits=visits, can=_can(instance, halts),
        swap=swap, splice=_splices(problem, instance.rate[0], swap),
        leg=neighbourhood.leg, back=neighbourhood.back,
        near=neighbourhood.near, granular=neighbourhood.granular,
        deadline=Alarm().setting if deadline is None else deadline,
    )


def _plan_prices(problem: Problem) -> PlanPrices:
    """Return what the plan as a whole costs, per ms, stop, part or mm."""
    fairness = problem.fairness
    per_ms, balance = fairness.makespan_cost_per_hour / MS_PER_HOUR, fairness.balance
    shares = [float(each.share) for each in fairness.before]
    least = (fairness.min_vehicles, fairness.too_few_cost, float(len(shares)), sum(shares),
             sum([share * share for share in shares]), fairness.last_end)
    if balance is None:
        return PlanPrices(per_ms, 0.0, 0, *least)
    unit = {"duration": MS_PER_HOUR, "stops": 1, "load": 10**problem.amount_decimals[0],
            "distance": MM_PER_KM}[balance.measure]
    return PlanPrices(per_ms, balance.cost / unit, MEASURES.index(balance.measure), *least)


def _can(instance: Instance, halts: Halts) -> BoolArray:
    """Return (row, 2, node): whom trucks may serve, or where they may stop, and whom drones may."""
    can = np.ascontiguousarray(np.stack([instance.can_drive[0], instance.can_fly[0]], axis=1))
    types, depots = halts.halts.shape
    can[:types, 0, :depots] |= halts.halts
    return can


def _per_unit(rates: Records) -> Records:
    """Return rates per mm and per ms."""
    rate = rates.copy()
    for name in ("distance", "drone_distance", "load"):
        rate[name] = rates[name] / MM_PER_KM
    for name in (*WORK_RATES, "drone_time"):
        rate[name] = rates[name] / MS_PER_HOUR
    return rate


def _per_ms(prices: Records) -> Records:
    """Return prices per ms."""
    price = prices.copy()
    for field in ("lateness", "waiting"):
        price[field] = prices[field] / MS_PER_HOUR
    return price


def are_alike(data: ProblemData) -> bool:
    """Tell whether all vehicles hold and cost the same, wherever and whenever they drive."""
    kinds, rates = data.type[:data.num_types], data.rate[:data.num_types]
    return bool((rates == rates[:1]).all()) and all(
        bool((kinds[field] == kinds[:1][field]).all())
        for field in ("travel", "capacity", "pickup_order", "lifo"))


def from_one_place(data: ProblemData) -> bool:
    """Tell whether all vehicles begin at one place and end at one."""
    kinds = data.type[:data.num_types]
    return all(bool((kinds[field] == kinds[0][field]).all()) for field in ("begins_at", "ends_at"))


def only_loads_limit(data: ProblemData) -> bool:
    """Tell whether trucks make one trip each, whenever they like."""
    served = data.node[0, data.num_depots:, 0]
    return can_be_linked(data) and not bool(
        served["window_earliest"].any() or (served["window_latest"] < UNLIMITED).any())


def can_be_linked(data: ProblemData) -> bool:
    """Tell whether the search may go by linked stops.

    Vehicles then make one trip each, and distance alone costs.
    """
    return bool(data.evaluation["by_distance"].all())


def are_timed(data: ProblemData) -> bool:
    """Tell whether windows or shifts limit when vehicles that can be linked serve anybody."""
    shifts = data.type["shift_latest"][:data.num_types]
    return not only_loads_limit(data) or bool((shifts < UNLIMITED).any())


def may_be_turned(data: ProblemData) -> bool:
    """Tell whether routes may as well be driven the other way, where so many are served."""
    kind = data.type[0]
    return (data.num_nodes - data.num_depots >= TURNED_FROM and only_loads_limit(data)
            and data.num_types == 1 and len(data.amount[0]) == 0
            and kind.begins_at == kind.ends_at and kind.shift_latest >= UNLIMITED
            and are_the_same_back(data.leg, data.back))


def _must_serve(problem: Problem, instance: Instance) -> BoolArray:
    """Mark the nodes that cost more to leave out than the longest drive there and back."""
    dearest = 0.0
    longest: dict[tuple[int, int, int], float] = {}
    for kind in problem.vehicle_types:
        ends = kind.travel, kind.begins_at, kind.ends_at
        if ends not in longest:
            distance = problem.travel[kind.travel].distance
            longest[ends] = float(distance[kind.begins_at].max() + distance[:, kind.ends_at].max())
        dearest = max(dearest, kind.fixed_cost + kind.cost_per_stop
                      + longest[ends] / MM_PER_KM * kind.cost_per_km)
    if problem.vehicle_costs is not None:
        dearest += float(problem.vehicle_costs.max(initial=0.0))
    must_serve: BoolArray = instance.unassigned_cost[0] + instance.unassigned_more[0] > dearest
    return must_serve


def _swaps(problem: Problem, types: Records, evaluation: Records) -> BoolArray:
    """Mark the pairs of types whose vehicles may drive each other's routes."""
    table = problem.may_serve
    group = _numbered([(kind.travel, kind.begins_at, kind.ends_at, kind.earliest,
                        int(types["shift_latest"][index]), kind.skills, kind.pickups,
                        kind.has_delivered, kind.lifo, int(types["variant"][index]),
                        None if table is None else table[index].tobytes())
                       for index, kind in enumerate(problem.vehicle_types)])
    alone = evaluation["by_distance"][:len(group)]
    swaps: BoolArray = (group == group[:, None]) & alone & alone[:, None]
    np.fill_diagonal(swaps, False)
    return swaps


def _numbered(keys: list[Hashable]) -> IntArray:
    """Return numbers that are equal where keys are."""
    numbers: dict[Hashable, int] = {}
    return np.array([numbers.setdefault(key, len(numbers)) for key in keys])


def _splices(problem: Problem, rates: Records, swap: BoolArray) -> BoolArray:
    """Mark the pairs of types whose vehicles may end each other's routes.

    They hold and cost the same, so that distance tells what that saves.
    """
    kinds, priced = problem.vehicle_types, problem.vehicle_costs
    # What a vehicle has worked before it may begin costs as if it were fixed.
    names = [name for name in rates.dtype.names or () if name != "fixed"]
    group = _numbered([(kind.travel, kind.capacity, kind.fixed_cost, kind.pickups, kind.lifo,
                        tuple(rates[names][index].tolist()),
                        None if priced is None else priced[index].tobytes())
                       for index, kind in enumerate(kinds)])
    plain = np.array([kind.drones is None and kind.max_trips == 1 for kind in kinds])
    splices: BoolArray = (group[:, None] == group) & plain & plain[:, None]
    return splices | swap
