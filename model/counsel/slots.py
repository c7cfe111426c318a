"""The cheapest place of a customer under other windows of his, one after another.

A search of some milliseconds looks near him, others making room; where it finds nothing that the
judge calls legal, the cheapest places between others are judged.
"""

import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import NamedTuple

from model.counsel.alternatives import visit_of
from model.counsel.bench import MOST_LEGS, Bench, Drafted, Trial
from model.counsel.fitting import Fit, find_fits, new_violations
from model.counsel.priced import Offer, is_seen_by_search, offers_of
from model.counsel.screening import share_over
from model.judge.places import Place, find_place
from model.problem import MM_PER_KM, Customer, Problem
from model.problem.altered import with_customers
from model.problem.quantities import UNLIMITED
from model.search.one_order import OrderSearch
from model.solution import Route, Solution, Vehicle

TRIED = 3
"""Places of a slot that are judged, the cheapest first, if the judge refuses the one before; and
vehicles on whose routes it is looked why there is none."""

TURNS, MOST_TURNS, FEWEST_TURNS = 1000, 400, 50
"""Turns of the search for all slots together, more for dearer ones; for one at most, and at least
where the search doesn't see each place between others."""

TRYING = 4.0
"""Seconds in which places between others are tried for all slots where the search doesn't price
them, or says that there is none: one of each slot is in any case."""

AS_CHEAP = 0.005
"""A slot that costs at most so much more than the cheapest of all, by what the plan costs, isn't
searched for."""

ALIKE = 1e-6
"""Money by which what costs the same differs at most."""


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
    joined: Callable[[Solution, Customer], Solution]
    """A plan that was found for the customer as he would be, as a plan of the whole."""


def view_of(bench: Bench) -> SearchedPlan:
    """Return how the search sees a plan of which nothing has happened."""
    return SearchedPlan(
        bench.problem, bench.left_out.solution, bench.node, range(len(bench.problem.vehicle_types)),
        lambda place: place, lambda found, _: found)


def find_slots(bench: Bench, slots: Sequence[Customer],
               view: SearchedPlan | None, searches: bool = True) -> Iterator[Fit | None]:
    """Yield the cheapest place of each slot, as `find_fits` does; None: there is no vehicle.

    Parameters
    ----------
    bench
        Tries the customer, or shipment, whom the plan leaves out.
    slots
        The customer as he would be; of a shipment its delivery.
    view
        The plan as the search sees it; None: it isn't asked.
    searches
        Whether others may make room. If not, each slot costs as the cheapest of `find_fits`.
    """
    benches = [bench.under(with_customers(bench.problem, {bench.last: slot})) for slot in slots]
    until = time.perf_counter() + TRYING
    if view is None or not _is_searched(bench, view):
        for number, each in enumerate(benches):
            yield _between(each, share_over(1 / (len(benches) - number), until))
        return
    search = _SlotSearch(bench, view, slots, TURNS if searches else 0)
    trials = search.trials(benches)
    for number, (each, trial) in enumerate(zip(benches, trials, strict=True)):
        fit = None if trial is None else Fit(each, trial)
        mine = share_over(1 / (len(benches) - number), until)
        if not search.prices:
            others = _between(each, mine)
            fit = min([one for one in (fit, others) if one], key=lambda one: one.rank, default=None)
        yield fit or _refused(each, view, mine)


def _between(bench: Bench, until: float) -> Fit | None:
    """Return the cheapest place between others, who stay where they are, found by an instant."""
    return next(iter(find_fits(bench, 1, until).places), None)


def _is_searched(bench: Bench, view: SearchedPlan) -> bool:
    """Tell whether a search may put the customer anywhere, and takes little time to be opened."""
    problem = bench.problem
    return (bench.shipment is None and len(problem.places_of(bench.node)) == 1
            and not bench.setting.past.had
            and view.problem.num_nodes**2 * len(problem.travel) <= MOST_LEGS)


class _Found(NamedTuple):
    """A legal plan with the customer."""

    trial: Trial
    begins: int  # his service

    @property
    def cost(self) -> float:
        """What it costs."""
        return self.trial.evaluation.cost.total

    def keeps(self, slot: Customer) -> bool:
        """Tell whether it keeps a slot, too."""
        means = "either" if self.trial.place is None else self.trial.place.by
        return (slot.earliest <= self.begins <= slot.latest and not slot.gaps
                and slot.served_by in ("either", means))


class _SlotSearch:
    """Plans with a customer in one slot after another."""

    def __init__(self, bench: Bench, view: SearchedPlan, slots: Sequence[Customer],
                 turns: int) -> None:
        self._view = view
        self._slots = slots
        # What limits anybody is found out when the search is opened.
        tightest = max(slots, key=lambda slot: (slot.earliest > 0, slot.latest < UNLIMITED))
        problem = with_customers(view.problem, {
            view.node: replace(tightest, served_by="either")})
        self._search = OrderSearch(problem, view.solution, view.node)
        sees_all = is_seen_by_search(problem)
        self._turns, self._fewest = turns, 0 if sees_all else min(turns, FEWEST_TURNS)
        self._lists = sees_all or turns > 0  # places between others, or `find_fits` tries all
        self.prices = self._lists and not problem.fairness.is_stated
        """Whether what it says of places between others is enough: where work is to be fair, that
        of others counts, too."""
        self._node, self._without = bench.node, bench.without
        self._as_cheap = AS_CHEAP * abs(bench.without)
        self._found = list[_Found]()

    def trials(self, benches: Sequence[Bench]) -> list[Trial | None]:
        """Return the cheapest legal plan found with each slot; None: none was.

        The cheapest slots come first: what is found for them may keep others.
        """
        asked = [self._asked(slot) for slot in self._slots]
        costs = [cost for cost, _ in asked]
        least = min(costs) + self._as_cheap
        dearer = sum([cost - least for cost in costs if least < cost < inf])
        for at in sorted(range(len(benches)), key=costs.__getitem__):
            slot, (cost, offers) = self._slots[at], asked[at]
            between = offers[0].cost if offers else inf
            if cost < inf and self._more(slot) > least:
                share = max(0.0, cost - least) / dearer if dearer else 0.0
                turns = max(self._fewest, min(MOST_TURNS, int(self._turns * share)))
                self._look(benches[at], slot, turns, between)
            if self._lists and (self._cheapest(slot) is None
                                or self._more(slot) > between + ALIKE):
                self._keep(_judged(benches[at], self._view, offers))
        best = [self._cheapest(slot) for slot in self._slots]
        return [None if each is None else each.trial for each in best]

    def _asked(self, slot: Customer) -> tuple[float, list[Offer]]:
        """Return what a slot costs more at once, and its places on routes, the cheapest first."""
        cost = self._search.ask(slot)
        offers = offers_of(self._search, self._view.solution, self._view.node
                           ) if self._lists else []
        return min([cost, *[offer.cost for offer in offers[:1]]]), offers

    def _look(self, bench: Bench, slot: Customer, turns: int, between: float) -> None:
        """Search for a slot, and keep what is found if nothing known costs less. In place."""
        if not self._search.is_read:
            return
        more = self._search.ask(slot)
        if turns and more < inf:
            more = self._search.improve(turns)
        if more < self._more(slot) - ALIKE and more <= between + ALIKE:
            self._keep(_trial(bench, self._view.joined(self._search.plan(), slot)))

    def _keep(self, trial: Trial | None) -> None:
        visit = None if trial is None else visit_of(trial, self._node)
        if trial is not None and visit is not None:
            self._found.append(_Found(trial, visit.service_start))

    def _more(self, slot: Customer) -> float:
        """Return what the cheapest plan found that keeps a slot costs more; infinite: none does."""
        known = self._cheapest(slot)
        return inf if known is None else known.cost - self._without

    def _cheapest(self, slot: Customer) -> _Found | None:
        """Return the cheapest plan found that keeps a slot."""
        return min([each for each in self._found if each.keeps(slot)],
                   key=lambda each: each.cost, default=None)


def _trial(bench: Bench, plan: Solution) -> Trial | None:
    """Judge a plan, whose routes are mostly those without the customer; None: it is illegal."""
    before = bench.left_out.solution
    if not {*plan.unassigned} <= {*before.unassigned} - {*bench.nodes}:
        return None
    known = {_way(route): index for index, route in enumerate(before.routes)}
    indices = [known.get(_way(route)) for route in plan.routes]
    routes = tuple([route if index is None else before.routes[index]
                    for route, index in zip(plan.routes, indices, strict=True)])
    judged = {number: bench.judged[index] for number, index in enumerate(indices)
              if index is not None}
    whole, found = Solution(routes, plan.unassigned), find_place(plan, bench.node)
    trial = Trial(None if found is None else found.place, whole,
                  bench.setting.judge(bench.problem, whole, judged))
    return None if found is None or new_violations(bench, trial) else trial


def _way(route: Route) -> tuple[object, ...]:
    """Return what routes have in common that differ in times alone."""
    return route.vehicle_type, route.vehicle, *[
        (tuple([stop.node for stop in trip.stops]), len(trip.breaks), *[
            (each.drone, each.launch_stop, each.recovery_stop, each.nodes)
            for each in trip.sorties]) for trip in route.trips]


def _judged(bench: Bench, view: SearchedPlan, offers: Sequence[Offer]) -> Trial | None:
    """Return the plan with the best legal place between others, or with a vehicle more."""
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
            return trial
    return None


def _spare(bench: Bench, view: SearchedPlan) -> Iterator[tuple[Place, float]]:
    """Yield the places of vehicles that have no route, one of each type, and their least cost."""
    problem, node = view.problem, view.node
    used = Counter(route.vehicle_type for route in view.solution.routes)
    taken = {route.driven_by for route in view.solution.routes}
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


def _refused(bench: Bench, view: SearchedPlan, until: float) -> Fit | None:
    """Return a place that breaks few rules of those on the nearest routes, or a new one.

    One broken rule is as few as there can be; after an instant the best so far will do.
    """
    best: Drafted | None = None
    for place in _likely(bench, view):
        draft = bench.draft(place)
        best = draft if best is None else min(best, draft, key=lambda each: each.rank)
        if best.rank[0] <= 1 or time.perf_counter() >= until:
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
