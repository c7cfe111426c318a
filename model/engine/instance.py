"""Problems as packed arrays for the engine, padded to a common size.

Rows are problems, so that one call can run rollouts of a whole training batch. `tandem.h` says what
rows of nodes, types and so on hold.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from model.engine.amount_rows import (
    DIMENSIONS_PER_TIER, num_tiers, padded, write_amounts,
)
from model.engine.asked import (
    clash_by_themselves, has_setups, most_asked_for, setup_rows, sharing_rows, weight_rows,
)
from model.engine.drone_types import NO_ROW, Kind, all_kinds
from model.engine.hour_rows import write_hours
from model.engine.library import dtype_of
from model.engine.nearest import write_nearest
from model.engine.pair_rows import (
    empty_limits, empty_pairs, lag_rows, write_aboard, write_choices, write_limits, write_pairs,
)
from model.engine.pausing import Pause, go_on
from model.engine.records import Records
from model.engine.serving import in_range, vehicle_costs
from model.engine.structs import Struct
from model.engine.type_rows import limit, most_sorties, rate_row, write_shares, write_type
from model.engine.variants import (
    Variant, Variation, durations_of, variant_of, ways_of, weighed_variant_of, write_legs,
)
from model.problem import (
    Customer, IntArray, Problem, has_timed_zones, shares_chargers,
)

SIZE = np.dtype((np.record, [
    (name, np.int64) for name in ("depots", "customers", "types", "dimensions")]))
"""How many of each a problem has."""

MAX_NEIGHBOURS = 24
"""How many nearest customers of each node are kept."""

FAR = 2**58
"""An instant later than any that occurs."""

AMOUNTS = 2 * DIMENSIONS_PER_TIER + 2
"""Of a tier at a node: what is delivered, what is picked up, and both sums over all dimensions."""


class ProblemTables(Struct):
    """What is packed of one problem, for policies and the search alike."""


class Instance(Struct):
    """Packed problems."""

    @property
    def problem(self) -> list[ProblemTables]:
        """Return each problem's tables."""
        return [self.tables(row) for row in range(len(self.size))]

    def tables(self, row: int) -> ProblemTables:
        """Return the tables of one problem."""
        depots, customers, types, _ = self.size[row].tolist()
        return ProblemTables(num_depots=depots, num_nodes=depots + customers, num_types=types,
                             **{name: getattr(self, name)[row] for name in BY_PROBLEM})


SIZES = {"num_depots", "num_nodes", "num_types"}
BY_PROBLEM = set(ProblemTables._fields) - SIZES
"""Arrays of which each problem has a row."""


def pack(problems: Sequence[Problem], legs: bool = True, pause: Pause = go_on) -> Instance:
    """Pack problems into common arrays, padded with zeros and False.

    `legs` and neighbours are what policies alone look at; without them there are none. `pause` may
    end it.

    Raises
    ------
    ValueError
        If `problems` is empty.
    """
    if not problems:
        raise ValueError("problems: need at least one")
    durations = [durations_of(problem) for problem in problems]
    ways = [ways_of(problem) for problem in problems]
    kinds = [all_kinds(problem) for problem in problems]
    instance = _empty(problems, max(map(len, kinds)), max(map(len, durations)),
                      max(map(len, ways)), legs)
    for row, problem in enumerate(problems):
        _pack_row(instance, row, problem, kinds[row], durations[row], ways[row], legs)
        if legs:
            write_legs(problem, ways[row], instance.setup[row], instance.duration[row],
                       instance.distance[row], pause)
            write_nearest(problem, instance.neighbour[row], pause)
    return instance


def _empty(problems: Sequence[Problem], types: int, variants: int, travels: int,
           legs: bool) -> Instance:
    """Allocate arrays for problems with so many types and tables of nodes and of `legs`, if any."""
    rows, nodes = len(problems), max(each.num_nodes for each in problems)
    depots = max(problem.num_depots for problem in problems)
    ends, changes = nodes if legs else 0, _num_changes(problems)
    gaps = max((len(c.gaps) for problem in problems for c in problem.customers), default=0)
    limited = any(problem.limits_time_aboard for problem in problems)
    apart = any(problem.limits_sharing for problem in problems)
    forbidden = any(each.forbids_launches for each in problems)
    instance = Instance(
        size=np.zeros(rows, SIZE),
        node=np.zeros((rows, variants, nodes, 1 + gaps), dtype_of("tandem_node")),
        amount=np.zeros((rows, nodes, num_tiers(problems, DIMENSIONS_PER_TIER), AMOUNTS), np.int64),
        price=np.zeros((rows, nodes), dtype_of("tandem_price")),
        goods=np.zeros((rows, nodes if apart else 0), dtype_of("tandem_goods")),
        setup=np.zeros((rows, nodes if any(map(has_setups, problems)) else 0),
                       dtype_of("tandem_setup")),
        max_time_aboard=np.full((rows, nodes if limited else 0), FAR, np.int64),
        pair=empty_pairs(problems, nodes),
        max_between=empty_limits(problems, types, nodes, FAR),
        **lag_rows(problems, nodes),
        vehicle_cost=vehicle_costs(problems, types, nodes),
        no_launch=np.zeros((rows, nodes if forbidden else 0), np.bool_),
        zones=_zones(problems, nodes),
        hub=np.zeros((rows, depots if any(problem.limits_hubs for problem in problems) else 0),
                     dtype_of("tandem_hub")),
        type=np.zeros((rows, types), dtype_of("tandem_vehicle_type")),
        rate=np.zeros((rows, types), dtype_of("tandem_rate")),
        reload=np.zeros((rows, types, nodes), np.bool_),
        can_drive=np.zeros((rows, types, nodes), np.bool_),
        can_fly=np.zeros((rows, types, nodes), np.bool_),
        profile_time=np.zeros((rows, types, changes), np.int64),
        profile_factor=np.ones((rows, types, changes + 1), np.int64),
        duration=np.zeros((rows, travels, ends, ends), np.int64),
        distance=np.zeros((rows, travels, ends, ends), np.int64),
        unassigned_cost=np.array([problem.unassigned_cost for problem in problems]),
        unassigned_more=np.zeros((rows, nodes)),
        neighbour=np.full((rows, nodes, MAX_NEIGHBOURS if legs else 0), -1, np.int64),
    )
    instance.node["arrival_limit"] = FAR
    instance.node[..., 1:]["window_latest"] = FAR
    return instance


def _zones(problems: Sequence[Problem], nodes: int) -> IntArray:
    """Return the (problem, node) zones with hours that hold each node, or (problem, 0)."""
    if not any(map(has_timed_zones, problems)):
        return np.zeros((len(problems), 0), np.int64)
    held = np.zeros((len(problems), nodes), np.int64)
    for row, problem in zip(held, problems, strict=True):
        row[:problem.num_nodes] = [problem.place_at(node).zones
                                   for node in range(problem.num_nodes)]
    return held


def _num_changes(problems: Sequence[Problem]) -> int:
    profiles = [kind.speed_profile for each in problems for kind in each.vehicle_types]
    return max([len(profile.times) for profile in profiles if profile], default=0)


def _pack_row(instance: Instance, row: int, problem: Problem, kinds: Sequence[Kind],
              durations: dict[Variant, IntArray], ways: Sequence[Variation],
              for_policies: bool) -> None:
    """Write one problem. In place."""
    instance.size[row] = (problem.num_depots, problem.num_customers, len(problem.vehicle_types),
                          problem.num_dimensions)
    if problem.customers:
        _pack_customers(instance, row, problem, durations)
    for index, (kind, part_of, drone_row) in enumerate(kinds):
        variants = [variant_of(each, problem, durations) for each in (kind, kind.drones)]
        if kind.flies:
            variants[1] = weighed_variant_of(kind, problem, durations)
        write_type(instance.type[row, index], kind, ways, drone_row=drone_row,
                   variant=variants[0], drone_variant=variants[1],
                   shares_chargers=shares_chargers(problem, kind))
        if charge_left := problem.vehicle_types[part_of].charge_left:
            instance.type[row, index].first_charge[: len(charge_left)] = charge_left
        instance.reload[row, index, list(kind.reload_places)] = True
        instance.rate[row, index] = rate_row(kind, 10**problem.amount_decimals[0])
        if kind.speed_profile is not None:
            changes = len(kind.speed_profile.times)
            instance.profile_time[row, index, :changes] = kind.speed_profile.times
            instance.profile_factor[row, index, : changes + 1] = kind.speed_profile.factors
    write_hours(problem, [kind for kind, _, _ in kinds], instance.node[row, :, :, 0],
                instance.type[row])
    if instance.hub.shape[1]:
        instance.hub[row, :problem.num_depots] = [
            (limit(depot.batteries), limit(depot.chargers)) for depot in problem.depots]
    if problem.forbids_launches:
        instance.no_launch[row, :problem.num_nodes] = [
            not problem.may_launch_at(node) for node in range(problem.num_nodes)]
    _pack_compatibility(instance, row, problem, kinds, for_policies)
    if problem.shipments:
        _pack_pairs(instance, row, problem, kinds)
    write_choices(problem, instance.pair[row])
    write_shares(problem, instance.type[row])


def _pack_customers(instance: Instance, row: int, problem: Problem,
                    durations: dict[Variant, IntArray]) -> None:
    """Write what the customers of one problem ask for, and the setups at all nodes. In place."""
    depots, nodes = problem.num_depots, problem.num_nodes
    served = instance.node[row, :, depots:nodes]
    served[0, :, 0] = [customer_row(customer) for customer in problem.customers]
    _pack_gaps(served[0, :, 1:], problem.customers)
    for variant, ((_, weighs), duration) in enumerate(durations.items()):
        served[variant] = served[0]
        served[variant, :, 0]["service_duration"] = duration
        if weighs is not None:
            served[variant, :, 0]["demand"] = weight_rows(problem, weighs, DIMENSIONS_PER_TIER)
    write_amounts(instance.amount[row, depots:nodes], problem.customers, DIMENSIONS_PER_TIER)
    instance.price[row, depots:nodes] = [
        (customer.late_cost_per_hour or 0.0, customer.early_cost_per_hour, customer.late_cost)
        for customer in problem.customers]
    costs = np.array([problem.cost_of_leaving_out(customer) for customer in problem.customers])
    others = [node - depots for node in problem.other_nodes]
    instance.unassigned_cost[row] = np.delete(costs, others).min()
    instance.unassigned_more[row, depots:nodes] = costs - instance.unassigned_cost[row]
    if problem.limits_time_aboard:
        instance.max_time_aboard[row, depots:nodes] = [
            FAR if customer.max_time_aboard is None else customer.max_time_aboard
            for customer in problem.customers]
    if problem.limits_sharing:
        instance.goods[row, depots:nodes] = sharing_rows(problem)
    if has_setups(problem):
        instance.setup[row, :nodes] = setup_rows(problem)


def _pack_pairs(instance: Instance, row: int, problem: Problem, kinds: Sequence[Kind]) -> None:
    """Write who belongs together; nobody serves one end alone, nor a drone from a stack. In place.

    What a drone fetches, its truck may always deliver.
    """
    nodes, number, is_delivery = write_pairs(problem, instance.pair[row]).T
    write_aboard(problem, instance.amount[row], DIMENSIONS_PER_TIER)
    write_limits(problem, [kind for kind, _, _ in kinds], instance.max_between[row])
    drives = instance.can_drive[row]
    firsts = np.flatnonzero(np.diff(number, prepend=-1))
    drives[:, nodes] = np.logical_and.reduceat(drives[:, nodes], firsts, axis=1)[:, number]
    stacked = np.array([kind.lifo for kind, _, _ in kinds])
    instance.can_fly[row][np.ix_(stacked, nodes)] = False
    driven, pickups = drives[[part_of for _, part_of, _ in kinds]], nodes[is_delivery == 0]
    instance.can_fly[row][:, pickups] &= driven[:, pickups]


def _pack_gaps(rows: Records, customers: Sequence[Customer]) -> None:
    """Write what lies between windows, (customer, gap). In place."""
    for row, customer in zip(rows, customers, strict=True):
        for gap, (closes, opens) in enumerate(customer.gaps):
            row[gap].window_latest, row[gap].window_earliest = closes, opens


def customer_row(customer: Customer) -> tuple[Any, ...]:
    """Return what `tandem_node` holds of a customer, in its order; times in ms."""
    limit = customer.latest if customer.late_cost_per_hour is None else FAR
    return (customer.earliest, limit, customer.service_duration, customer.release_time,
            customer.latest, padded(customer.demand, DIMENSIONS_PER_TIER))


def _pack_compatibility(instance: Instance, row: int, problem: Problem,
                        kinds: Sequence[Kind], anywhere: bool) -> None:
    """Write which types may serve which customers, by truck and by drone. In place.

    `anywhere`: by who flies, wherever its trips begin and end, as policies take for granted.
    """
    customers = slice(problem.num_depots, problem.num_nodes)
    most = most_asked_for(problem)
    by_truck = np.array([c.served_by != "drone" for c in problem.customers], np.bool_)
    by_drone = np.array([c.served_by != "truck" for c in problem.customers], np.bool_)
    asking: dict[frozenset[str], list[int]] = {}
    for customer, skills in enumerate(c.skills for c in problem.customers):
        if skills:
            asking.setdefault(skills, []).append(customer)
    for index, (kind, part_of, drone_row) in enumerate(kinds):
        dimensions = slice(most.shape[1])
        fits = np.all(most <= instance.type[row, index].capacity[dimensions], axis=1)
        for skills, customers_asking in asking.items():
            if not skills <= kind.skills:
                fits[customers_asking] = False
        if problem.may_serve is not None:
            fits &= problem.may_serve[part_of]
        if kind.max_range is not None:
            fits &= in_range(problem, kind, kind.max_range, anywhere)
        if problem.incompatible_goods:
            fits &= ~clash_by_themselves(problem)
        if index == part_of:
            served = fits & (by_drone if kind.flies else by_truck)
            instance.can_drive[row, index, customers] = served & (kind.max_stops != 0)
        can_launch = most_sorties(kind) > 0 and problem.vehicle_types[part_of].max_sorties != 0
        if kind.drones is not None and can_launch and (index != part_of or drone_row == NO_ROW):
            payload = instance.type[row, index].payload[dimensions]
            fits &= by_drone & (most <= payload).all(axis=1)
            instance.can_fly[row, index, customers] = fits
            instance.can_fly[row, part_of, customers] |= fits
