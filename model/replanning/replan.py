"""Planning on: a plan is given, part of it has happened, and something has changed."""

import math
import time
from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType

from model.counsel.bench import Setting
from model.counsel.explain import Reason, explain_type, unexplained
from model.judge.changes import ChangePrices, EarlierPlan, PlanChanges, count_changes, earlier_plan
from model.judge.chargers import with_charging
from model.judge.check import Evaluation, check
from model.judge.memory import Memory
from model.judge.past import Past, known_trips, parcels_aboard
from model.judge.past_rules import PAST_RULES
from model.planner import (
    ALONE, Elapsed, Listener, PlanCheckError, Planner, PlanOptions, PlanResult,
)
from model.problem import Problem
from model.problem.altered import with_customers
from model.replanning.driven_on import as_it_stands, driven_on, going_through, kept_by
from model.replanning.handover import hand_over, settled
from model.replanning.kept import Kept, kept_routes
from model.replanning.late import as_late
from model.replanning.new_orders import NewOrder, all_nodes, new_orders, put_after
from model.replanning.order import by_order, orders_of
from model.replanning.parted import parted_shipments, with_parted
from model.replanning.reasons import barred_reason, bound_reasons
from model.replanning.refusing import as_given, gone_from, refuse
from model.replanning.remainder import held_back, what_is_left
from model.replanning.searching import Bridge, begin, joined, relayed, searches
from model.replanning.workers import find_workers
from model.solution import Route, Solution, Vehicle, renumbered

NOBODY_HELD: Mapping[int, int] = MappingProxyType({})

SEARCHED = 0.6
"""Share of the time limit that is searched, if new orders are put behind others then."""

UNREADABLE = frozenset({"UNKNOWN_TYPE", "UNKNOWN_NODE", "DEPOT", "COUNT",
                        "SORTIE_STOPS", "UNREACHABLE", "PAIR"})
"""Broken rules with which nothing that has happened can be read, or gone on from."""


@dataclass(frozen=True)
class Terms:
    """What a new plan has to keep to; customers of the plan given who are no more are node -1."""

    plan: Solution
    now: int | None = None  # ms; what has departed by then stays; None: nothing has
    pinned: frozenset[int] = frozenset()  # customers who stay with their vehicles
    unavailable: frozenset[Vehicle] = frozenset()  # do nothing more
    parcels_back: int | None = None  # ms; when theirs are at the depot again; None: now
    grounded: Mapping[Vehicle, frozenset[int]] = field(default_factory=dict)
    """Drones, by number on their truck, that are launched no more."""
    keeps_order: bool = False  # whether pinned customers keep their places in the order, too
    prices: ChangePrices | None = None  # of changes; None: they cost nothing
    promised: Mapping[int, int] = field(default_factory=dict)
    """When customers were told that they are reached, in ms; others by the plan given."""
    concerned: frozenset[Vehicle] | None = None
    """Whose orders may change places alone; of others all stay. None: anybody's."""
    behind: bool = False  # whether new orders come behind whom their vehicle had before


class Replanning:
    """Plans a problem anew from a plan given."""

    def __init__(self, problem: Problem, terms: Terms) -> None:
        """Find out what stays as it is.

        Raises
        ------
        SettledPartError
            If that doesn't fit the problem.
        TooManyTypesError
            If more vehicles are under way than can be planned for.
        """
        parted = [] if terms.now is None else parted_shipments(
            problem, terms.plan, terms.now, terms.unavailable)
        problem = with_parted(problem, parted)
        earlier = _earlier(problem, terms)
        plan = with_charging(problem, terms.plan)
        if terms.now is not None:
            plan = as_late(problem, plan, terms.now, terms.unavailable)
        terms = replace(terms, plan=plan)
        self._plan = plan
        past = replace(_past(problem, terms), earlier=earlier)
        refuse(gone_from(terms.plan, past))
        self.problem = problem = _released(problem, past)
        self._kept, self._through = kept_by(problem, terms.plan, past)
        self._settled = settled(problem, self._kept)
        broken = check(problem, self._settled, past).violations
        refuse(as_given(terms.plan, self._settled, broken, UNREADABLE))
        on_the_way = {*past.carriers(), *(
            node for kept in self._kept.values() for node in kept.served)}
        self.stranded = {each.left[-1]: each.vehicle for each in parted
                         if each.left[-1] not in on_the_way} | _stranded(
                             problem, self._kept, terms)
        """Whose parcels vehicles have aboard that are unavailable, and which."""
        back = past.now if terms.parcels_back is None else terms.parcels_back
        # What is yet to be fetched of a shipment is so on the trip that brings the rest.
        waiting = {node for each in parted for node in each.left if each.left[-1] in self.stranded}
        self.past = replace(past, returned=dict.fromkeys(
            problem.all_places({*self.stranded, *waiting}), back))
        workers = find_workers(problem, self.past, self._kept)
        through = going_through(problem, terms.plan, self.past, self._kept, workers)
        if through:
            self._through |= through
            self._kept |= through
            self._settled = settled(problem, self._kept)
            broken = check(problem, self._settled, past).violations
            workers = find_workers(problem, self.past, self._kept)
        refuse(as_given(terms.plan, self._settled, broken, PAST_RULES))
        self.left = what_is_left(problem, self.past, self._kept, workers)
        self._workers, self._judge = workers, Memory(problem, self.past)
        self.excused = tuple(item for item in broken if item.code not in PAST_RULES)
        """Rules that are broken already, which no plan can mend."""

    def with_last(self, problem: Problem) -> "Replanning":
        """Return the same of a problem that differs in its last customer alone, who is new."""
        other = copy(self)
        vars(other).pop("_new", None)
        other.problem = _released(problem, self.past)
        other.left = what_is_left(other.problem, self.past, self._kept, self._workers)
        other._judge = Memory(other.problem, self.past)
        return other

    @cached_property
    def _new(self) -> list[NewOrder]:
        """Orders that come behind all whom their vehicles had."""
        return new_orders(self.problem, self.past)

    @property
    def kept(self) -> tuple[Kept, ...]:
        """What vehicles do in any case that have departed, in the order of a plan's routes."""
        return tuple(self._kept.values())

    def changes(self, solution: Solution) -> PlanChanges | None:
        """Return how much a plan changes of the one given; None if that costs nothing."""
        earlier = self.past.earlier
        return None if earlier is None else count_changes(self.problem, solution, earlier)

    def check(self, solution: Solution) -> Evaluation:
        """Judge a plan; what is excused is no violation."""
        evaluation = self._judge.check(solution)
        excused = set(self.excused)
        return replace(evaluation, violations=tuple(
            violation for violation in evaluation.violations if violation not in excused))

    def plan(self, planner: Planner, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None,
             held: Mapping[int, int] = NOBODY_HELD) -> PlanResult:
        """Plan what is left; arguments and errors are those of `Planner.plan`.

        `start` is an earlier result to go on from, in place of the plan given. Customers in `held`
        are on no trip that begins before an instant, in ms. The result is the whole plan, its costs
        those of the whole.
        """
        began = time.perf_counter()
        plan = self._plan if start is None else start
        kept = self._kept if start is None else self._kept_of(start)
        if self.left is None:
            return self._nothing_left(plan, kept, options)
        new = self._new if start is None else []
        left = self.left.holding(held).without(all_nodes(new))
        since = began if received_at is None else received_at
        until = since + options.time_limit
        if new:
            options = replace(options, time_limit=SEARCHED * options.time_limit)
        bridge = Bridge(self.problem, self.past, plan, kept, left)
        handed = hand_over(self.problem, plan, kept, left)
        filled = begin(left, handed, options, listener.should_stop, bool(self.past.orders))
        first, begun, evaluation = self._beginning(bridge, handed, filled.solution)
        known = self._best_known(plan, kept, (begun, evaluation), bool(held))
        before = known[1]

        def cost(plan: Solution) -> float:
            nonlocal known
            other = begun if plan is first else by_order(bridge.whole(plan), self.past.orders)
            evaluation = self.check(other)
            if evaluation.violations:
                return math.inf
            if evaluation.cost.total <= known[1].cost.total:
                known = other, evaluation
            return evaluation.cost.total

        relaying = relayed(listener, evaluation.cost.total, bridge)
        results = [each.find(planner, since, relaying, handed, first, cost)
                   for each in searches(left, self.past, first, options)]
        if new:
            known = put_after(held_back(self.problem, held), Setting(self.past, self.excused),
                               known, new, until)
        return joined(results, known, before.cost.total, filled.whole, began)

    def reasons(self, solution: Solution, node: int,
                until: float = math.inf) -> tuple[Reason, ...]:
        """Return one reason per vehicle type why the customer at `node` is unassigned.

        After `until`, on `time.perf_counter`, no more than that the search found no room.
        """
        carriers = self.problem.at_all_places(self.past.carriers())
        vehicle = carriers.get(node) or self.past.pinned.get(node)
        if vehicle is not None:
            return bound_reasons(self.problem, vehicle, node in carriers)
        if time.perf_counter() >= until:
            return unexplained(self.problem)
        plan = self._later(solution)
        return tuple(self._reason(solution, plan, kind, node, until)
                     for kind in range(len(self.problem.vehicle_types)))

    def _best_known(self, plan: Solution, kept: Mapping[Vehicle, Kept],
                    begun: tuple[Solution, Evaluation],
                    is_held: bool) -> tuple[Solution, Evaluation]:
        """Return the cheapest plan before any search: as begun, or as the one given goes on."""
        if is_held:
            return begun
        known = self._cheapest(begun, as_it_stands(self.problem, plan, kept))
        # It takes a while in large plans, and would do no better where nobody is lost, and no
        # truck waits for all its drones before it is planned on.
        lost = self.problem.all_places(plan.served).intersection(begun[0].unassigned)
        if lost or _has_flights(self.past):
            known = self._cheapest(known, driven_on(self.problem, plan, kept, self.past))
        return known

    def _beginning(self, bridge: Bridge, handed: Solution,
                   first: Solution) -> tuple[Solution, Solution, Evaluation]:
        """Return where the search begins, of what is left and as a whole, and its judgement."""
        solution = bridge.whole(first)
        if self.past.orders and self.check(solution).violations:
            # Who came in between was at another place before.
            first, solution = handed, bridge.whole(handed)
        if self.check(solution).violations:
            # Breaks may be due on a day as a whole that aren't on what is left of it, and whoever
            # waits where a trip goes on serves others later than it will.
            solution = self._settled
        return first, solution, self._legal(solution)

    def _legal(self, solution: Solution) -> Evaluation:
        evaluation = self.check(solution)
        if evaluation.violations:
            raise PlanCheckError("; ".join(f"{violation.path}: {violation.message}"
                                           for violation in evaluation.violations))
        return evaluation

    def _cheapest(self, known: tuple[Solution, Evaluation],
                  other: Solution) -> tuple[Solution, Evaluation]:
        """Return the other of two plans, judged, if it is legal and no dearer than the known."""
        evaluation = self.check(other)
        if evaluation.is_feasible and evaluation.cost.total <= known[1].cost.total:
            return other, evaluation
        return known

    def _nothing_left(self, plan: Solution, kept: Mapping[Vehicle, Kept],
                      options: PlanOptions) -> PlanResult:
        began = time.perf_counter()
        solution, evaluation = self._settled, self._legal(self._settled)
        for other in (as_it_stands(self.problem, plan, kept),
                      driven_on(self.problem, plan, kept, self.past)):
            solution, evaluation = self._cheapest((solution, evaluation), other)
        cost = evaluation.cost.total
        return PlanResult(solution, evaluation, "given", cost, cost, 0, options.threads, True,
                          Elapsed(0.0, 0.0, time.perf_counter() - began))

    def _kept_of(self, plan: Solution) -> dict[Vehicle, Kept]:
        """Return what vehicles do in any case, of a plan that went on from the one given."""
        return {**kept_routes(self.problem, plan, self.past), **self._through}

    def _trips_kept(self, vehicle: Vehicle) -> int:
        """Return how many trips a vehicle has begun."""
        kept = self._kept.get(vehicle)
        return 0 if kept is None else len(kept.route.trips)

    def _later(self, solution: Solution) -> Solution:
        """Return what vehicles do on trips that are yet to begin, as a plan of what is left."""
        left = self.left
        if left is None:
            return Solution(())
        vehicles = [route.driven_by for route in solution.routes]
        routes = [Route(own, vehicle.number, route.trips[self._trips_kept(vehicle):])
                  for vehicle, route in zip(vehicles, solution.routes, strict=True)
                  if (own := left.later(vehicle)) is not None
                  and (own >= left.num_plain or vehicle not in self._kept)]
        here = left.numbers
        return renumbered(Solution(tuple(routes)), lambda there: here.get(there, there))

    def _reason(self, solution: Solution, plan: Solution, kind: int, node: int,
                until: float) -> Reason:
        """Return why vehicles of a type don't serve a customer who is free to be served by any.

        `plan` is of what is left.
        """
        name = self.problem.vehicle_types[kind].id
        left = self.left
        types = [] if left is None else left.from_depot(kind, node)
        if left is None or not types:
            return Reason(kind, "FLEET_EXHAUSTED", f"No vehicle of {name} can begin another trip.")
        barred = barred_reason(self.problem, self.past, left, solution, plan, (kind, node), until)
        if barred is not None:
            return barred
        reason = explain_type(left.problem, plan, types[0], left.numbers[node], until)
        return replace(reason, vehicle_type=kind)


def _earlier(problem: Problem, terms: Terms) -> EarlierPlan | None:
    """Return what changes are counted from, as the plan was given."""
    if terms.prices is None:
        return None
    return earlier_plan(problem, terms.plan, terms.prices, terms.promised, terms.unavailable)


def _past(problem: Problem, terms: Terms) -> Past:
    """Return what has happened, but for parcels that come back."""
    known = {}
    if terms.now is not None:
        known = known_trips(problem, terms.plan, terms.now, terms.unavailable)
    there = {node: route.driven_by
             for route in terms.plan.routes for node in route.served
             if node >= 0 and route.driven_by not in terms.unavailable}
    pinned = {node: vehicle for node, vehicle in there.items() if node in terms.pinned
              or (terms.concerned is not None and _may_serve(problem, vehicle, node))}
    orders = {}
    if pinned and (terms.keeps_order or terms.concerned is not None):
        orders = {vehicle: order for vehicle, order in orders_of(terms.plan).items()
                  if terms.keeps_order or vehicle not in (terms.concerned or ())}
    had: dict[Vehicle, frozenset[int]] = {}
    for node, vehicle in there.items() if terms.behind else ():
        had[vehicle] = had.get(vehicle, frozenset()) | {problem.first_place(node)}
    grounded = {vehicle: drones for vehicle, drones in terms.grounded.items()
                if vehicle not in terms.unavailable}
    return Past(terms.now or 0, known, terms.unavailable, grounded,
                problem.at_all_places(pinned), orders=orders, had=had)


def _may_serve(problem: Problem, vehicle: Vehicle, node: int) -> bool:
    table = problem.may_serve
    return table is None or bool(table[vehicle.type, node - problem.num_depots])


def _has_flights(past: Past) -> bool:
    """Tell whether any drone is in the air."""
    return any(sortie.recovery_start is None
               for trips in past.trips.values() for sortie in trips[-1].sorties)


def _released(problem: Problem, past: Past) -> Problem:
    """Return the problem in which every parcel is there that was loaded."""
    loaded = {node for trips in past.trips.values() for trip in trips for node in trip.aboard}
    return with_customers(problem, {node: replace(problem.customer_at(node), release_time=0)
                                    for node in problem.all_places(loaded)})


def _stranded(problem: Problem, kept: Mapping[Vehicle, Kept],
              terms: Terms) -> dict[int, Vehicle]:
    """Return whose parcels are aboard vehicles that are unavailable, and which."""
    if terms.now is None:
        return {}
    loaded = parcels_aboard(problem, terms.plan, terms.now, terms.unavailable)
    served = {vehicle: route.served for vehicle, route in kept.items() if vehicle in loaded}
    return {node: vehicle for vehicle, nodes in loaded.items()
            for node in sorted(nodes - served.get(vehicle, set()))}
