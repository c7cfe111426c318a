"""The cheapest place of a customer under other windows of his, one after another.

The search prices the places of all slots at once, on the plan as it sees it. The judge says of the
cheapest of each whether it is legal and what it costs.
"""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from model.counsel.bench import MOST_LEGS, Bench, Drafted
from model.counsel.fitting import Fit, find_fits, new_violations
from model.counsel.priced import Offer, is_seen_by_search, slot_offers
from model.judge.past import Vehicle
from model.judge.places import Place
from model.problem import MM_PER_KM, Customer, Problem
from model.problem.altered import with_copies, with_customers
from model.solution import Solution

TRIED = 3
"""Places of a slot that are judged, the cheapest first, if the judge refuses the one before; and
vehicles on whose routes it is looked why there is none."""


ALIKE = 1e-6
"""Money by which places of two slots differ at most that are taken to be one."""


@dataclass(frozen=True)
class SearchedPlan:
    """A plan as the search sees it: what is left of it, if some has happened.

    It doesn't have the customer at `node`.
    """

    problem: Problem
    solution: Solution
    node: int
    kinds: Sequence[int]  # types that may begin trips
    whole: Callable[[Place], Place | None]  # a place of the plan as a whole; None: there is none


def view_of(bench: Bench) -> SearchedPlan:
    """Return how the search sees a plan of which nothing has happened."""
    return SearchedPlan(bench.problem, bench.left_out.solution, bench.node,
                range(len(bench.problem.vehicle_types)), lambda place: place)


def find_slots(bench: Bench, slots: Sequence[Customer],
               view: SearchedPlan | None) -> Iterator[Fit | None]:
    """Yield the cheapest place of each slot, as `find_fits` does; None: there is no vehicle.

    Parameters
    ----------
    bench
        Tries the customer, or shipment, whom the plan leaves out.
    slots
        The customer as he would be; of a shipment its delivery.
    view
        The plan as the search sees it; None: it isn't asked.
    """
    benches = [bench.under(with_customers(bench.problem, {bench.last: slot})) for slot in slots]
    if view is None or bench.setting.past.had or not _is_seen(bench, view):
        yield from [next(iter(find_fits(each, 1).places), None) for each in benches]
        return
    judged = list[tuple[Offer, Fit]]()
    for each, slot, offers in zip(benches, slots, _offers(view, slots), strict=True):
        fit = _alike(each, view, slot, offers, judged)
        if fit is None:
            fit = _judged(each, view, offers)
            judged += [(offer, fit) for offer in offers[:1] if fit is not None]
        yield fit or _refused(each, view)


def _is_seen(bench: Bench, view: SearchedPlan) -> bool:
    """Tell whether the search sees all places, and takes little time to be asked."""
    problem = bench.problem
    return (bench.shipment is None and len(problem.places_of(bench.node)) == 1
            and is_seen_by_search(view.problem) and not problem.fairness.is_stated
            and view.problem.num_nodes**2 * len(problem.travel) <= MOST_LEGS)


def _offers(view: SearchedPlan, slots: Sequence[Customer]) -> list[list[Offer]]:
    """Return the places of each slot on routes, the cheapest first, by one search for all."""
    problem, own = view.problem, view.node
    nodes = [own, *range(problem.num_nodes, problem.num_nodes + len(slots) - 1)]
    many = with_copies(with_customers(problem, {own: slots[0]}), own, slots[1:])
    solution = replace(view.solution, unassigned=(*view.solution.unassigned, *nodes[1:]))
    return slot_offers(many, solution, nodes)


def _alike(bench: Bench, view: SearchedPlan, slot: Customer, offers: Sequence[Offer],
           judged: Sequence[tuple[Offer, Fit]]) -> Fit | None:
    """Return the place of a slot that was judged for another, by the same times at the same cost.

    If the truck waits for neither, and comes in time for both, it is the same route.
    """
    for offer, fit in judged if offers else ():
        if (offer.place != offers[0].place or abs(offer.cost - offers[0].cost) > ALIKE
                or fit.trial.place != view.whole(offer.place)):
            continue
        stop = next((stop for route in fit.trial.solution.routes for trip in route.trips
                     for stop in trip.stops if stop.node == bench.node), None)
        if (stop is not None and stop.service_start == stop.ready
                and slot.gaps == () and slot.earliest <= stop.arrival
                and stop.service_start <= slot.latest):
            return Fit(bench, fit.trial)
    return None


def _judged(bench: Bench, view: SearchedPlan, offers: Sequence[Offer]) -> Fit | None:
    """Return the best place that the judge finds legal, on a route or with a vehicle more."""
    drafts = list[Drafted]()
    for offer in offers[:TRIED]:
        place = view.whole(offer.place)
        if place is not None:
            drafts.append(bench.draft(place))
            if not drafts[-1].timed.judged.violations:
                break
    least = min([each.added for each in drafts if not each.timed.judged.violations],
                default=float("inf"))
    drafts += [bench.draft(place) for place, bound in _spare(bench, view) if bound < least]
    for draft in sorted(drafts, key=lambda draft: draft.rank):
        if draft.timed.judged.violations:
            break
        trial = bench.finish(draft)
        if not new_violations(bench, trial):
            return Fit(bench, trial)
    return None


def _spare(bench: Bench, view: SearchedPlan) -> Iterator[tuple[Place, float]]:
    """Yield the places of vehicles that have no route, one of each type, and their least cost."""
    problem, node = view.problem, view.node
    used = Counter(route.vehicle_type for route in view.solution.routes)
    taken = {(route.vehicle_type, route.vehicle) for route in view.solution.routes}
    for index in view.kinds:
        kind = problem.vehicle_types[index]
        if used[index] >= kind.count:
            continue
        number = next(each for each in range(kind.count) if (index, each) not in taken)
        place = view.whole(Place(Vehicle(index, number), 0, "truck", 1, own_trip=True))
        distance = problem.travel[kind.travel].distance
        way = int(distance[kind.begins_at, node]) + int(distance[node, kind.ends_at])
        if place is not None and problem.allows(index, node):
            yield place, kind.fixed_cost + way * kind.cost_per_km / MM_PER_KM


def _refused(bench: Bench, view: SearchedPlan) -> Fit | None:
    """Return a place that breaks few rules of those on the nearest routes, or a new one.

    One broken rule is as few as there can be.
    """
    best: Drafted | None = None
    for place in _likely(bench, view):
        draft = bench.draft(place)
        best = draft if best is None else min(best, draft, key=lambda each: each.rank)
        if best.rank[0] <= 1:
            break
    return None if best is None else Fit(bench, bench.finish(best))


def _likely(bench: Bench, view: SearchedPlan) -> Iterator[Place]:
    """Yield places on the nearest routes, the likeliest of each first, and with a vehicle more."""
    distance = bench.problem.travel[0].distance
    near = sorted((min([int(distance[stop.node, bench.node]) for trip in route.trips
                        for stop in trip.stops]), route.vehicle_type, route.vehicle)
                  for route in bench.left_out.solution.routes)[:TRIED]
    vehicles = {Vehicle(kind, number) for _, kind, number in near}
    guesses = bench.guesses(wanted=lambda vehicle: vehicle in vehicles).values()
    for turn in range(TRIED):
        yield from [guess.place for guess in sorted(
            [some[turn] for some in guesses if turn < len(some)], key=lambda guess: guess.rank)]
    yield from [place for place, _ in _spare(bench, view)]
