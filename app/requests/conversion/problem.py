"""`PlanRequest` -> `Problem` and planning options; quantities are rounded here, once."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TypeVar

import numpy as np

from app.requests.conversion.amounts import counted, decimals_of
from app.requests.conversion.ground import Ground
from app.requests.conversion.groups import Group, groups_of, part_of
from app.requests.conversion.leaving_out import default_unassigned_cost
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.preparing import UNHURRIED, Preparing
from app.requests.conversion.service import with_service_durations
from app.requests.conversion.travels import Travels
from app.requests.conversion.units import by_name, optional_thousandths, thousandths
from app.requests.conversion.vehicle import to_vehicle_type
from app.schemas.customer import CustomerInput, place_name
from app.schemas.relation import RelationInput
from app.schemas.request import PlanRequest
from model.problem import (
    UNLIMITED, Balance, Customer, Depot, Fairness, FloatArray, IncompatibleGoods, IntArray, Part,
    Problem, Relation, Shipment,
)

Place = TypeVar("Place", Depot, Customer)


def to_problem(request: PlanRequest, preparing: Preparing = UNHURRIED,
               ground: Ground | None = None) -> Problem:
    """Convert a valid request, unless the work on it is to end; `ground` may be known already."""
    placed = PlacedRequest(request)
    return problem_of(placed, Travels(placed, preparing, ground))


def problem_of(placed: PlacedRequest, travels: Travels) -> Problem:
    """Convert a valid request, with its legs, unless the work on it is to end."""
    travels.expect_legs()
    request, depots, sites = placed.request, placed.depots, placed.sites
    decimals = decimals_of(request.customers, request.fleet)
    customers = tuple([
        to_customer(customer, decimals, site)
        for customer, site in zip(request.customers, sites[len(depots):], strict=True)])
    customers, shipments = _with_shipments(request, customers, len(depots))
    customers = _by_truck_across(customers, relations := _relations(request, len(depots)), depots)
    amounts = [amount for customer in customers for amount in (customer.demand, customer.taken_in)]
    vehicle_types = tuple([to_vehicle_type(stated, depots, travels, decimals, amounts)
                           for stated in request.fleet])
    vehicle_types = with_service_durations(vehicle_types, request.customers)
    groups = list(groups_of(request.fleet, [*request.customers, *request.launch_sites]))
    kinds = [group.type for group in groups] or list(range(len(request.fleet)))
    serves = np.array([group.serves for group in groups]) if groups else None
    costs = _serving_costs(request, groups, len(kinds))
    if groups:
        vehicle_types = tuple([part_of(vehicle_types[group.type], group) for group in groups])
    fairness = _fairness(request)
    unassigned_cost, fairness = _large_prices(request, fairness, lambda: default_unassigned_cost(
        customers, vehicle_types, travels.built(), decimals, fairness, relations) + _dearest(costs))
    zones = travels.zones()
    return Problem(
        depots=_in_zones([replace(depot, site=site)
                          for depot, site in zip(depots, sites, strict=False)], zones),
        customers=_in_zones(customers, None if zones is None else zones[len(depots):]),
        vehicle_types=vehicle_types,
        travel=travels.built(),
        coordinates=travels.coordinates(),
        unassigned_cost=unassigned_cost,
        amount_decimals=decimals,
        may_serve=None if serves is None else serves[:, :len(customers)],
        vehicle_costs=costs,
        may_stop=placed.may_stop(kinds, None if serves is None else serves[:, len(customers):]),
        must_serve=request.unassigned_cost is None,
        incompatible_goods=_apart(request),
        relations=relations,
        shipments=shipments, choices=_choices(request, len(depots)),
        fairness=fairness,
    )


def _in_zones(places: Sequence[Place], zones: IntArray | None) -> tuple[Place, ...]:
    """Return places with the zones with hours that hold them, if there are any."""
    if zones is None:
        return tuple(places)
    return tuple([replace(place, zones=held) if held else place
                  for place, held in zip(places, zones.tolist(), strict=False)])


def _serving_costs(request: PlanRequest, groups: Sequence[Group],
                   kinds: int) -> FloatArray | None:
    """Return what it costs to be served by each group, at each place; None if it costs nothing."""
    number = len(request.customers)
    stated = {place_name(customer.id, place.id): place.cost for customer in request.customers
              for place in customer.alternatives if place.cost}
    differ = any(group.costs.any() for group in groups)
    if not differ and not stated:
        return None
    costs = np.tile([stated.get(customer.id, 0.0) for customer in request.customers], (kinds, 1))
    return costs + [group.costs[:number] for group in groups] if differ else costs


def _large_prices(request: PlanRequest, fairness: Fairness,
                  dearest: Callable[[], float]) -> tuple[float, Fairness]:
    """Return what leaving somebody out costs, and prices with that of each vehicle that lacks.

    Where nothing is stated, both cost more than all else, and customers more than vehicles.
    """
    stated = request.unassigned_cost
    if stated is not None and not fairness.min_vehicles:
        return stated, fairness
    price = dearest() + _dearest_stops(request)
    if fairness.min_vehicles:
        fairness = replace(fairness, too_few_cost=price)
    return price * (1 + fairness.min_vehicles) if stated is None else stated, fairness


def _dearest(costs: FloatArray | None) -> float:
    """Return what vehicles cost most to serve everybody, on top: others may have to change theirs.
    """
    return 0.0 if costs is None else float(costs.max(axis=0).sum())


def _dearest_stops(request: PlanRequest) -> float:
    """Return what stops at launch sites cost most, two for each customer."""
    return 2 * len(request.customers) * max([site.cost for site in request.launch_sites],
                                            default=0.0)


def _fairness(request: PlanRequest) -> Fairness:
    """Return what the plan costs as a whole, but for what vehicles cost that lack."""
    stated = request.fairness
    balance, served = stated.balance, request.num_stated + len(request.shipments)
    return Fairness(stated.makespan_cost_per_hour,
                    None if balance is None else Balance(balance.measure, balance.cost),
                    min(stated.min_vehicles, served, sum([kind.count for kind in request.fleet])))


def _apart(request: PlanRequest) -> tuple[IncompatibleGoods, ...]:
    """Return the goods that are kept apart."""
    return tuple(IncompatibleGoods(frozenset(each.goods), each.scope)
                 for each in request.incompatible_goods)


def _choices(request: PlanRequest, num_depots: int) -> tuple[tuple[int, ...], ...]:
    """Return the places of customers who have several; others than their own come behind all."""
    choosy = [customer for customer in request.customers if customer.alternatives]
    if not choosy:
        return ()
    node = {customer.id: index for index, customer in enumerate(request.customers, num_depots)}
    return tuple((node[customer.id], *(node[place_name(customer.id, place.id)]
                                       for place in customer.alternatives))
                 for customer in choosy)


def _relations(request: PlanRequest, num_depots: int) -> tuple[Relation, ...]:
    """Return who goes with whom, at whichever place."""
    if not request.relations:
        return ()
    node = {customer.id: index for index, customer in enumerate(request.customers, num_depots)}
    places = {chosen[0]: chosen for chosen in _choices(request, num_depots)}
    unit = {name: each.named_ends()[0][0] for each in request.shipments
            for name, _ in each.named_ends()}

    def named(each: RelationInput) -> Iterable[str]:
        if each.kind == "before":
            return each.customers
        return dict.fromkeys([unit.get(name, name) for name in each.customers])

    return tuple(Relation(each.kind, tuple([
        place for name in named(each) for place in places.get(node[name], (node[name],))
    ]), each.scope, across=each.kind == "before" and not each.same_vehicle,
        **by_name(each, Relation))
        for each in request.relations)


def _by_truck_across(customers: tuple[Customer, ...], relations: Sequence[Relation],
                     depots: Sequence[object]) -> tuple[Customer, ...]:
    """Let trucks alone serve those of orders across vehicles, since drones can't wait."""
    bound = {node - len(depots) for each in relations if each.across for node in each.nodes}
    if not bound:
        return customers
    return tuple([replace(customer, served_by="truck") if index in bound else customer
                  for index, customer in enumerate(customers)])


def _with_shipments(request: PlanRequest, customers: tuple[Customer, ...],
                    num_depots: int) -> tuple[tuple[Customer, ...], tuple[Shipment, ...]]:
    """Return the shipments, and customers of whom their ends ask for nothing else."""
    if not request.shipments:
        return customers, ()
    place = {customer.id: index for index, customer in enumerate(customers)}
    changed, shipments = list(customers), list[Shipment]()
    for stated in request.shipments:
        *pickups, delivery = (place[name] for name, _ in stated.named_ends())
        for index in (*pickups, delivery):
            changed[index] = replace(customers[index],
                                     demand=(0,) * len(customers[index].demand))
        first, *more = (Part(num_depots + index, customers[index].demand) for index in pickups)
        shipments.append(Shipment(
            stated.id, first.pickup, num_depots + delivery, first.amount,
            max_detour=optional_thousandths(stated.max_detour), more=tuple(more),
            **by_name(stated, Shipment)))
    return tuple(changed), tuple(shipments)


def to_customer(stated: CustomerInput, decimals: Sequence[int],
                site: int | None = None) -> Customer:
    """Convert a valid customer; `decimals` by dimension, `site` as `sites_of` numbers it."""
    windows = stated.windows
    first, last = windows[0], windows[-1]
    return Customer(
        **by_name(stated, Customer),
        id=stated.id,
        demand=counted(stated.demand, decimals),
        pickup=() if stated.pickup is None else counted(stated.pickup, decimals),
        earliest=thousandths(first.earliest),
        latest=UNLIMITED if last.latest is None else thousandths(last.latest),
        late_cost_per_hour=last.late_cost_per_hour,
        late_cost=last.late_cost,
        early_cost_per_hour=first.early_cost_per_hour,
        served_by=stated.served_by,
        skills=frozenset(stated.skills),
        gaps=() if first is last else tuple(
            [(thousandths(window.latest or 0.0), thousandths(following.earliest))
             for window, following in pairwise(windows)]),
        goods=frozenset(stated.goods),
        site=site,
    )
