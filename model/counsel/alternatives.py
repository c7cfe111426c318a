"""What it would cost to serve a customer, or bring a shipment, elsewhere, otherwise or not at all.

What is said of an alternative is true, since the judge has judged the whole plan; that it is the
cheapest of its kind is true of those tried.
"""

import math
import time
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from model.counsel.bench import Bench, Drafted, Trial
from model.counsel.group_moves import MovedUnit, companions_of, move_all
from model.counsel.screening import Wanted, best_first, of_any, share_over
from model.judge.clock import window_of
from model.judge.places import Means, Place
from model.judge.retiming import read_route
from model.judge.timing import RouteDecision
from model.problem import Customer, Problem
from model.problem.altered import with_customers
from model.solution import Stop, Vehicle, Visit

Kind = Literal["place", "by", "window", "vehicle", "unassigned"]

TRIES, MORE_TRIES = 3, 8
"""Places that are tried of a vehicle's best by truck, and so by drone; and more if none is legal.
"""

ALL_TRIES, ALL_MORE_TRIES = 120, 600
"""Places that are tried in all, if there are no more ways than that: small plans have all tried."""

SCREENING_SHARE = 0.5
"""Share of the time in which places are guessed at, before any is tried."""

ALONE_SHARE = 0.5
"""Share of the time in which a customer is put alone, before those who go with him are, too."""

EVERYWHERE = frozenset({"VEHICLE", "SKILLS", "SERVED_BY"})
"""Rules that whoever breaks them with a vehicle breaks at all its places."""

Group = tuple[Vehicle, Means]


@dataclass(frozen=True)
class Alternative:
    """The best trial of its kind."""

    kind: Kind
    trial: Trial
    companions: tuple[MovedUnit, ...] = ()  # who go along, by relations
    window: int | None = None  # which of several is the only one
    node: int | None = None  # whose window; None: nobody's


@dataclass(frozen=True)
class Findings:
    """What was found by trying."""

    alternatives: tuple[Alternative, ...]
    drafts: tuple[Drafted, ...]  # of all vehicles, at every place tried
    is_complete: bool  # no clock cut it short


def visit_of(trial: Trial, node: int) -> Stop | Visit | None:
    """Return when a plan serves a customer; None: it doesn't."""
    return next((visit for route in trial.solution.routes for visit in route.visits
                 if visit.node == node), None)


def find_alternatives(bench: Bench, until: float = math.inf) -> Findings:
    """Return what else could be done with a customer, as far as is found by an instant.

    `until` is on `time.perf_counter`.
    """
    companions, found = companions_of(bench), bench.found
    alone = share_over(ALONE_SHARE, until) if companions else until
    offers = bench.offers(share_over(SCREENING_SHARE, alone)) or {}
    by_group, is_complete = try_places(bench, alone)
    for group, some in offers.items():
        best = next((each.place for each in some if not is_here(bench, each.place)), None)
        if best is not None and time.perf_counter() < alone:
            by_group.setdefault(group, []).append(bench.draft(best))
    windows, all_windows = _windows(bench, alone)
    alternatives: list[Alternative] = []
    if found is not None:
        here = found.place
        alternatives += best_of(bench, "place", by_group.get((here.vehicle, here.by), ()))
        alternatives += best_of(bench, "by", [draft for (_, by), drafts in by_group.items()
                                            if by != here.by for draft in drafts])
    vehicles: dict[Vehicle, list[Drafted]] = {}
    for (vehicle, _), drafts in by_group.items():
        if found is None or vehicle != found.place.vehicle:
            vehicles.setdefault(vehicle, []).extend(drafts)
    if companions:
        moved, in_time = move_all(bench, dict.fromkeys(vehicles, companions), until)
        others = [Alternative("vehicle", trial, companions) for trial in moved.values()]
        is_complete &= in_time
    else:
        others = [each for some in vehicles.values() for each in best_of(bench, "vehicle", some)]
    alternatives += [*windows, *sorted(others, key=lambda each: each.trial.rank)]
    if found is not None:
        alternatives.append(Alternative("unassigned", bench.left_out))
    return Findings(tuple(alternatives),
                    tuple([draft for drafts in by_group.values() for draft in drafts]),
                    is_complete and all_windows)


def best_of(bench: Bench, kind: Kind, drafts: Sequence[Drafted],
          problem: Problem | None = None) -> Iterator[Alternative]:
    """Yield the best of some drafts, if there are any.

    One that is legal by itself may not be so in the plan: then the next best is looked at.
    """
    trials: list[Trial] = []
    for draft in sorted(drafts, key=lambda draft: draft.rank)[:TRIES]:
        trials.append(bench.finish(draft, problem))
        if draft.timed.judged.violations or trials[-1].evaluation.is_feasible:
            break
    if trials:
        yield Alternative(kind, min(trials, key=lambda trial: trial.rank))


def try_places(bench: Bench, until: float, wanted: Wanted = of_any, most: int | None = None
               ) -> tuple[dict[Group, list[Drafted]], bool]:
    """Try the best places of each vehicle and means, and tell whether there was time for all.

    Of each that is `wanted`, `most` of them, if stated. All have their first turn before any has
    its second.
    """
    screened = share_over(SCREENING_SHARE, until)
    guesses = {group: [guess for guess in some if not is_here(bench, guess.place)]
               for group, some in bench.guesses(until=screened, wanted=wanted).items()
               if group[0] != bench.done_by}
    is_complete = time.perf_counter() < screened
    order = sorted([group for group, some in guesses.items() if some],
                   key=lambda group: guesses[group][0].rank)
    tried: dict[Group, list[Drafted]] = {}
    enough = max(TRIES, ALL_TRIES // max(1, len(order)))
    most = max(MORE_TRIES, ALL_MORE_TRIES // max(1, len(order))) if most is None else most
    for turn in range(most):
        for group in order:
            if turn >= len(guesses[group]) or _is_settled(tried.get(group, ()), turn, enough):
                continue
            if time.perf_counter() >= until:
                return tried, False
            tried.setdefault(group, []).append(bench.draft(guesses[group][turn].place))
    return tried, is_complete


def _is_settled(drafts: Sequence[Drafted], turn: int, enough: int) -> bool:
    """Tell whether a vehicle's further places needn't be tried; `enough` are if any is legal."""
    if any(not draft.timed.judged.violations for draft in drafts):
        return turn >= enough
    return any(violation.code in EVERYWHERE
               for draft in drafts for violation in draft.timed.judged.violations)


def is_here(bench: Bench, place: Place) -> bool:
    """Tell whether a place is where the plan has the customer, or one that is just the same."""
    if bench.found is None:
        return False
    here = bench.found.place
    if bench.shipment is not None:
        route = read_route(bench.problem, bench.plan.solution.routes[bench.found.route])
        return (place.vehicle == here.vehicle or place.own_trip) and (
            _order_of(bench.decide(place)[1], bench.nodes) == _order_of(route, bench.nodes))
    if here.own_trip and len(bench.plan.solution.routes[bench.found.route].trips) == 1:
        # Alone with a vehicle, he may as well be so with another of its type.
        place = place._replace(vehicle=Vehicle(place.vehicle.type, here.vehicle.number))
    return place._replace(drone=here.drone) == here


def here_of(bench: Bench, until: float = math.inf) -> Place | None:
    """Return where a plan has the customer or shipment, as a place to put it.

    None if it has it nowhere, or if that isn't found until an instant, on `time.perf_counter`.
    """
    if bench.found is None or bench.shipment is None:
        return None if bench.found is None else bench.found.place
    some = bench.guesses(until=until)
    return next((guess.place for (vehicle, by), guesses in some.items()
                 if (vehicle.type, by) == (bench.found.place.vehicle.type, bench.found.place.by)
                 for guess in guesses if is_here(bench, guess.place)), None)


def _order_of(route: RouteDecision, nodes: Collection[int]) -> tuple[object, ...]:
    """Return whom a type of vehicle serves in which order, and from where drones fly to `nodes`."""
    return route.vehicle_type, *[
        (trip.nodes, sorted([
            (sortie.nodes, () if frozenset(sortie.nodes).isdisjoint(nodes)
             else (sortie.launch_stop, sortie.recovery_stop)) for sortie in trip.sorties]))
        for trip in route.trips]


def _windows(bench: Bench, until: float) -> tuple[list[Alternative], bool]:
    """Return the best place in each other window, and tell whether there was time for all."""
    found: list[Alternative] = []
    for node in bench.nodes:
        some, in_time = _windows_of(bench, node, until)
        found += some
        if not in_time:
            return found, False
    return found, True


def _windows_of(bench: Bench, node: int, until: float) -> tuple[list[Alternative], bool]:
    customer = bench.problem.customer_at(node)
    visit = visit_of(bench.plan, node)
    now = None if visit is None else window_of(customer, visit.service_start)
    found: list[Alternative] = []
    is_complete = True
    for window in range(len(customer.openings) if customer.gaps else 0):
        if window == now:
            continue
        problem = with_customers(bench.problem, {node: in_window(customer, window)})
        screened = share_over(SCREENING_SHARE, until)
        guesses = best_first(bench.guesses(problem, screened))
        is_complete &= time.perf_counter() < screened
        drafts: list[Drafted] = []
        for turn, guess in enumerate(guesses[:ALL_TRIES]):
            if time.perf_counter() >= until:
                return found, False
            if not _is_settled(drafts, turn, MORE_TRIES):
                drafts.append(bench.draft(guess.place, problem))
        found += [replace(each, window=window, node=node)
                  for each in best_of(bench, "window", drafts, problem)]
    return found, is_complete


def in_window(customer: Customer, window: int) -> Customer:
    """Return a customer with but one of several windows; only the last of them may be soft."""
    closes = [each for each, _ in customer.gaps]
    if window == len(closes):
        return replace(customer, earliest=customer.openings[window], gaps=())
    return replace(customer, earliest=customer.openings[window], latest=closes[window], gaps=(),
                   late_cost_per_hour=None)
