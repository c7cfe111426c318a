"""What is to be planned: depots, customers, a fleet and its travel matrices."""

from bisect import bisect_left
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain
from operator import add
from typing import TypeVar

import numpy as np

from model.problem.customer import Customer, Depot, IncompatibleGoods
from model.problem.fairness import UNPRICED, Fairness
from model.problem.fleet import VehicleType
from model.problem.quantities import (
    MAX_DIMENSIONS, MOST_INCOMPATIBLE, USUAL_DECIMALS, BoolArray, FloatArray, require, require_rate,
)
from model.problem.relation import MOST_RELATIONS, SINCE_PLAN_START, Lag, Relation, by_node
from model.problem.shipment import Shipment
from model.problem.travel import Travel

Told = TypeVar("Told")


@dataclass(frozen=True, eq=False)
class Problem:
    """A complete planning problem.

    Nodes are the depots, in order, then the customers, in order: with one depot, node 0 is the
    depot and nodes 1..n are the customers.
    """

    depots: tuple[Depot, ...]
    customers: tuple[Customer, ...]
    vehicle_types: tuple[VehicleType, ...]
    travel: tuple[Travel, ...]
    coordinates: FloatArray  # (node, 2) any planar unit, seen by the policy alone
    unassigned_cost: float  # per customer left out who states no other
    amount_decimals: tuple[int, ...] = ()  # (dimension,) of demands and capacities; for people
    may_serve: BoolArray | None = None  # (vehicle type, customer); None: any type anyone
    vehicle_costs: FloatArray | None = None  # (vehicle type, customer) of serving; None: nothing
    may_stop: BoolArray | None = None  # (vehicle type, depot) at launch sites; None: any at any
    must_serve: bool = False  # whoever states no cost of being left out; for people
    incompatible_goods: tuple[IncompatibleGoods, ...] = ()
    relations: tuple[Relation, ...] = ()
    shipments: tuple[Shipment, ...] = ()  # whose pickups are customers that ask for nothing else
    choices: tuple[tuple[int, ...], ...] = ()
    """Nodes of one customer's places, of which one is used, his own first. It alone has a cost of
    being left out."""
    fairness: Fairness = UNPRICED
    num_dimensions: int = field(init=False)

    def __post_init__(self) -> None:
        require(len(self.depots) >= 1, "depots", "none")
        require(len(self.vehicle_types) >= 1, "vehicle types", "none")
        require_rate("unassigned_cost", self.unassigned_cost)
        dimensions = len(self.vehicle_types[0].capacity)
        require(1 <= dimensions <= MAX_DIMENSIONS, "capacity dimensions", dimensions)
        object.__setattr__(self, "num_dimensions", dimensions)
        if not self.amount_decimals:
            object.__setattr__(self, "amount_decimals", (USUAL_DECIMALS,) * dimensions)
        require(len(self.amount_decimals) == dimensions, "amount decimals", self.amount_decimals)
        require(self.coordinates.shape == (self.num_nodes, 2), "coordinates shape",
                 self.coordinates.shape)
        require(bool(np.isfinite(self.coordinates).all()), "coordinates", "not finite")
        if self.may_serve is not None:
            require(self.may_serve.dtype == np.bool_, "may_serve dtype", self.may_serve.dtype)
            require(self.may_serve.shape == (len(self.vehicle_types), self.num_customers),
                     "may_serve shape", self.may_serve.shape)
        self._require_vehicle_costs()
        if self.may_stop is not None:
            require(self.may_stop.dtype == np.bool_, "may_stop dtype", self.may_stop.dtype)
            require(self.may_stop.shape == (len(self.vehicle_types), self.num_depots),
                    "may_stop shape", self.may_stop.shape)
        self._require_relations()
        for matrix in self.travel:
            require(matrix.duration.shape == (self.num_nodes, self.num_nodes), "travel shape",
                     matrix.duration.shape)
        for customer in self.customers:
            if len(customer.demand) != dimensions:
                require(False, f"customer {customer.id} demand", customer.demand)
        self._require_pairs()
        self._require_choices()
        for vehicle_type in self.vehicle_types:
            self._require_consistent(vehicle_type)
        for used in {kind.travel for kind in self.vehicle_types if not kind.flies}:
            require(self.travel[used].reaches_all(), "travel", "unreachable leg")
        points = [each.straight.points.at for each in self.travel if each.straight is not None]
        require(all(np.array_equal(each, points[0], equal_nan=True) for each in points), "travel",
                 "places differ")

    def _require_vehicle_costs(self) -> None:
        costs = self.vehicle_costs
        if costs is not None:
            require(costs.shape == (len(self.vehicle_types), self.num_customers),
                     "vehicle_costs shape", costs.shape)
            require_rate("vehicle_costs", float(costs.min(initial=0.0)))
            require_rate("vehicle_costs", float(costs.max(initial=0.0)))

    def _require_relations(self) -> None:
        named = frozenset().union(*(each.goods for each in self.incompatible_goods))
        require(len(named) <= MOST_INCOMPATIBLE, "incompatible goods", len(named))
        together = sum(each.keeps_together for each in self.relations)
        apart = sum(each.kind == "apart" for each in self.relations) + len(named)
        require(max(together, apart) <= MOST_RELATIONS, "relations", len(self.relations))
        for each in self.relations:
            require(self.num_depots <= min(each.nodes) and max(each.nodes) < self.num_nodes,
                    "relations", each.nodes)
        for node in self.lags_across:
            customer = self.customer_at(node)
            require(customer.served_by == "truck", f"customer {customer.id} served_by",
                    customer.served_by)

    def _require_pairs(self) -> None:
        ends = [node for each in self.shipments for node in each.nodes]
        require(len(set(ends)) == len(ends), "shipments' ends", ends)
        for each in self.shipments:
            each.require_ends([self.customer_at(node) for node in each.nodes])

    def _require_choices(self) -> None:
        nodes = [node for places in self.choices for node in places]
        require(len(set(nodes)) == len(nodes) and self.shipment_at.keys().isdisjoint(nodes),
                 "choices", nodes)
        for places in self.choices:
            require(len(places) > 1 and self.num_depots <= min(places)
                    and max(places) < self.num_nodes, "choices", places)
            for node in places[1:]:
                other = self.customer_at(node)
                require(other.unassigned_cost == 0.0, f"customer {other.id} unassigned_cost",
                        other.unassigned_cost)

    def _require_consistent(self, vehicle_type: VehicleType) -> None:
        name = f"vehicle type {vehicle_type.id}"
        require(len(vehicle_type.capacity) == self.num_dimensions, f"{name} capacity",
                 vehicle_type.capacity)
        for place in ("depot", "begins_at", "ends_at"):
            node = getattr(vehicle_type, place)
            require(0 <= node < self.num_depots, f"{name} {place}", node)
            require(not self.depots[node].is_launch_site, f"{name} {place}", node)
        require(set(vehicle_type.reload_places) <= set(range(self.num_depots)),
                 f"{name} reload_depots", vehicle_type.reload_depots)
        require(len(vehicle_type.initial_load) in (0, self.num_dimensions), f"{name} initial_load",
                 vehicle_type.initial_load)
        for travel in (vehicle_type.travel, vehicle_type.straight, vehicle_type.limited or 0):
            require(0 <= travel < len(self.travel), f"{name} travel", travel)
        require(vehicle_type.energy is None
                or vehicle_type.energy.dimension < self.num_dimensions, f"{name} energy",
                vehicle_type.energy)
        for drones in vehicle_type.drone_types:
            require(len(drones.capacity) == self.num_dimensions, f"{name} drone capacity",
                     drones.capacity)
            for travel in (drones.travel, drones.straight):
                require(0 <= travel < len(self.travel), f"{name} drone travel", travel)
            energy = drones.energy
            require(energy is None or energy.dimension < self.num_dimensions,
                     f"{name} drone energy", energy)

    @cached_property
    def num_depots(self) -> int:
        """Depots; the first customer's node."""
        return len(self.depots)

    @cached_property
    def num_customers(self) -> int:
        """Customers."""
        return len(self.customers)

    @cached_property
    def num_nodes(self) -> int:
        """Depots and customers."""
        return len(self.depots) + len(self.customers)

    def is_nowhere(self, node: int) -> bool:
        """Tell whether a node is no place: who begins or ends there does so at a customer."""
        return node < len(self.depots) and self.depots[node].kind == "nowhere"

    def allows(self, vehicle_type: int, node: int) -> bool:
        """Tell whether the table lets vehicles of a type serve the customer at a node."""
        return self.may_serve is None or bool(self.may_serve[vehicle_type, node - self.num_depots])

    def vehicle_cost(self, vehicle_type: int, node: int) -> float:
        """Return what it costs on top that vehicles of a type serve the customer at a node."""
        table = self.vehicle_costs
        return 0.0 if table is None else float(table[vehicle_type, node - self.num_depots])

    def vehicle_costs_of(self, kinds: Sequence[int],
                         nodes: Sequence[int]) -> FloatArray | None:
        """Return `vehicle_costs` of some types and of the customers at some nodes alone."""
        if self.vehicle_costs is None:
            return None
        columns = np.array(nodes, np.int64) - self.num_depots
        return self.vehicle_costs[np.ix_(np.array(kinds, np.int64), columns)]

    @cached_property
    def launch_sites(self) -> tuple[int, ...]:
        """Nodes where trucks may stop for their drones alone; they are among the depots."""
        return tuple([node for node, depot in enumerate(self.depots) if depot.is_launch_site])

    @cached_property
    def limits_hubs(self) -> bool:
        """Tell whether batteries, or places to charge, of who flies are limited at any depot."""
        return any(depot.batteries is not None or depot.chargers is not None
                   for depot in self.depots)

    def is_launch_site(self, node: int) -> bool:
        """Tell whether trucks may stop at a node for their drones alone."""
        return 0 <= node < self.num_depots and self.depots[node].is_launch_site

    def allows_stop(self, vehicle_type: int, node: int) -> bool:
        """Tell whether vehicles of a type may stop at a launch site."""
        return (self.vehicle_types[vehicle_type].drones is not None
                and (self.may_stop is None or bool(self.may_stop[vehicle_type, node])))

    def find_vehicle(self, type_id: str, number: int) -> tuple[int, int]:
        """Return the index of a vehicle's type, and its number there, from 0.

        A number that there isn't is one that the first type of that id hasn't either.

        Raises
        ------
        KeyError
            If there is no such type.
        """
        parts = [index for index, kind in enumerate(self.vehicle_types) if kind.type_id == type_id]
        for index in parts:
            numbers = self.vehicle_types[index].numbers
            place = bisect_left(numbers, number)
            if numbers[place:place + 1] == (number,):
                return index, place
        if not parts:
            raise KeyError(type_id)
        return parts[0], number

    @cached_property
    def limits_time_aboard(self) -> bool:
        """Tell whether any parcel may be aboard for so long and no longer."""
        return any(customer.max_time_aboard is not None for customer in self.customers)

    @cached_property
    def forbids_launches(self) -> bool:
        """Tell whether drones may not take off, nor be recovered, somewhere."""
        return not (all(depot.launch for depot in self.depots)
                    and all(customer.launch for customer in self.customers))

    def may_launch_at(self, node: int) -> bool:
        """Tell whether drones may take off, and be recovered, at a node."""
        return self.place_at(node).launch

    def place_at(self, node: int) -> Depot | Customer:
        """Return the depot or customer at a node."""
        first = self.num_depots
        return self.depots[node] if node < first else self.customers[node - first]

    @cached_property
    def shipment_at(self) -> dict[int, Shipment]:
        """The shipment of each node that is an end of one."""
        return {node: each for each in self.shipments for node in each.nodes}

    def unit_of(self, node: int) -> int:
        """Return the pickup of the shipment that a node is an end of; else the node."""
        return self.shipment_at[node].pickup if node in self.shipment_at else node

    def shipments_among(self, nodes: Sequence[int]) -> tuple[Shipment, ...]:
        """Return the shipments all ends of which are among some nodes, by their numbers there."""
        if not self.shipments:
            return ()
        number = {node: index for index, node in enumerate(nodes)}
        return tuple([each.renumbered(number) for each in self.shipments
                      if number.keys() >= {*each.nodes}])

    @cached_property
    def _places(self) -> dict[int, tuple[int, ...]]:
        """All places of a customer who has several, by each of them."""
        return {node: places for places in self.choices for node in places}

    @cached_property
    def other_nodes(self) -> frozenset[int]:
        """Nodes for which others stand: shipments' ends but the first, customers' other places."""
        return frozenset([node for each in self.shipments for node in each.nodes[1:]]).union(
            *(places[1:] for places in self.choices))

    def first_place(self, node: int) -> int:
        """Return the first place of the customer at a node."""
        return self.places_of(node)[0] if self.choices else node

    def places_of(self, node: int) -> tuple[int, ...]:
        """Return the places of the customer at a node, of which one is used."""
        return self._places.get(node, (node,))

    def at_all_places(self, told: Mapping[int, Told]) -> dict[int, Told]:
        """Return what is told of customers, by each of their places."""
        if not self.choices:
            return dict(told)
        return {place: what for node, what in told.items() for place in self.places_of(node)}

    def all_places(self, nodes: Iterable[int]) -> set[int]:
        """Return all places of the customers at some nodes."""
        return set(self.at_all_places(dict.fromkeys(nodes)))

    def choices_among(self, nodes: Sequence[int]) -> tuple[tuple[int, ...], ...]:
        """Return the choices between places that are among some nodes, by their numbers there."""
        if not self.choices:
            return ()
        number = {node: index for index, node in enumerate(nodes)}
        left = [tuple([number[node] for node in places if node in number])
                for places in self.choices]
        return tuple([places for places in left if len(places) > 1])

    def left_out(self, served: Collection[int]) -> tuple[int, ...]:
        """Return who isn't served, by their first places."""
        done = set(map(self.first_place, served))
        return tuple([node for node in range(self.num_depots, self.num_nodes)
                      if node not in done and self.first_place(node) == node])

    def relations_among(self, nodes: Sequence[int]) -> tuple[Relation, ...]:
        """Return what relations say of some nodes, by their numbers there."""
        if not self.relations:
            return ()
        number = {node: index for index, node in enumerate(nodes)}
        left = [each.among(number, self.first_place) for each in self.relations]
        return tuple([each for each in left if each is not None])

    @cached_property
    def limits_sharing(self) -> bool:
        """Tell whether it matters who goes with whom."""
        return bool(self.incompatible_goods
                    or any(not each.across for each in self.relations))

    @cached_property
    def keeps_together(self) -> bool:
        """Tell whether some customers go with others."""
        return any(each.keeps_together for each in self.relations)

    @cached_property
    def lags(self) -> dict[int, tuple[Lag, ...]]:
        """How much later than others each customer is served behind whom there are some."""
        return by_node(chain.from_iterable([
            each.lags(self.first_place) for each in self.relations]))

    @cached_property
    def lags_across(self) -> dict[int, tuple[Lag, ...]]:
        """How much later or sooner than others, on any vehicles, customers of orders are served."""
        since = [(node, Lag(SINCE_PLAN_START, *each.span)) for node, each
                 in enumerate(self.customers, self.num_depots) if each.span is not None]
        return by_node(chain(*[
            each.lags_across(self.first_place) for each in self.relations], since))

    @cached_property
    def limits_time_between(self) -> bool:
        """Tell whether any shipment may be under way for so long and no longer."""
        return any(each.is_limited for each in self.shipments)

    def asked_at(self, node: int) -> tuple[int, ...]:
        """Return the most that a customer alone asks to be aboard, by dimension."""
        each, customer = self.shipment_at.get(node), self.customer_at(node)
        if each is not None:
            return (tuple(map(add, each.total, customer.demand)) if node == each.delivery
                    else each.change_at(node))
        return tuple(map(max, customer.demand, customer.taken_in))

    def setup_between(self, origin: int, to: int) -> int:
        """Return how long whoever comes from one node to serve at another sets up there."""
        first = self.num_depots
        if to < first or not self.customers[to - first].setup_duration:
            return 0
        place = self.customers[to - first]
        before = self.depots[origin] if origin < first else self.customers[origin - first]
        same = origin == to or (place.site is not None and place.site == before.site)
        return 0 if same else place.setup_duration

    def cost_of_leaving_out(self, customer: Customer) -> float:
        """Return what leaving a customer out costs."""
        own = customer.unassigned_cost
        return self.unassigned_cost if own is None else own

    def must_be_served(self, customer: Customer) -> bool:
        """Tell whether no price was stated at which a customer may be left out."""
        return self.must_serve and customer.unassigned_cost is None

    def customer_at(self, node: int) -> Customer:
        """Return the customer at a node.

        Raises
        ------
        ValueError
            If `node` is a depot or no node.
        """
        first = self.num_depots
        if not first <= node < self.num_nodes:
            require(False, "customer node", node)
        return self.customers[node - first]
