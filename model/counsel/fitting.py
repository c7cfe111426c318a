"""The best places of a customer or shipment in a plan whose others stay, and why not elsewhere.

Each is a whole plan that was judged. They are the best of those tried: in small plans of all, else
of each vehicle's likeliest, by truck and by drone.
"""

import math
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import chain, islice, takewhile

from model.counsel.alternatives import ALONE_SHARE, best_of, is_here, try_places
from model.counsel.bench import Bench, Drafted, Trial
from model.counsel.priced import is_seen_by_search
from model.counsel.group_moves import MovedUnit, companions_to, move_all, not_with
from model.counsel.screening import share_over
from model.judge.past_rules import PAST_RULES
from model.judge.places import Place, find_place
from model.judge.rules import Violation
from model.solution import Vehicle

SPARE = 8
"""So many more places than asked for are judged with the whole plan if these break rules there."""

ROUTES_SHARE = 0.9
"""Share of the time in which routes are tried, before plans with the best ones are judged."""

OFFERS_SHARE = 0.3
"""Share of the time in which the search says what it knows, before anything is tried."""

FEW_TRIES = 3
"""Places that are tried of a vehicle for which the search finds none legal, by truck and so by
drone: enough to say why not."""


def spot_of(place: Place) -> tuple[object, ...]:
    """Return what places have in common that differ only in where a drone is recovered."""
    own = place.vehicle, place.trip, place.by, place.stop, place.sortie, place.own_trip
    return *own, *[(node, each.by, each.stop, each.sortie, each.flown_on)
                   for node, each in place.ends]


def vehicle_of(place: Place) -> tuple[object, ...]:
    """Return what the places of one vehicle have in common."""
    return (place.vehicle,)


@dataclass(frozen=True)
class Fit:
    """A plan with the customer or shipment, and who is served by that vehicle, too, by relations.
    """

    bench: Bench  # by which it was tried: the customer's at that place of his
    trial: Trial
    companions: tuple[MovedUnit, ...] = ()

    @property
    def rank(self) -> tuple[int, float]:
        """What is smaller for a better one."""
        return self.trial.rank


@dataclass(frozen=True)
class Fits:
    """What was found by trying."""

    places: tuple[Fit, ...]  # the best first
    others: tuple[Fit, ...]  # the best of each vehicle that has none of these, the best first
    is_complete: bool  # no clock cut it short


def find_fits(bench: Bench, count: int, until: float = math.inf,
              spot: Callable[[Place], tuple[object, ...]] = spot_of) -> Fits:
    """Return the best places found by an instant, `count` at most.

    `until` is on `time.perf_counter`; of places that are one `spot`, the best counts. Of what was
    tried by then, one place is told in any case. A customer of several places is put at each.
    """
    places = bench.problem.places_of(bench.node) if bench.done_by is None else ()
    benches = [bench, *[bench.at_place(place) for place in places if place != bench.node]]
    found = [_fits_at(each, count, share_over(1 / (len(benches) - number), until), spot)
             for number, each in enumerate(benches)]
    if len(found) == 1:
        return found[0]
    return _joined([fit for each in found for fit in (*each.places, *each.others)], bench, count,
                   spot, all(each.is_complete for each in found))


def _fits_at(bench: Bench, count: int, until: float,
             spot: Callable[[Place], tuple[object, ...]]) -> Fits:
    """Return the best places where the customer is served at one place of his."""
    companions = companions_to(bench)
    fits, vehicles = _alone(bench, count, share_over(ALONE_SHARE, until) if companions else until,
                            spot)
    if not companions:
        return fits
    along = {vehicle: not_with(bench, companions, vehicle) for vehicle in vehicles}
    moved, in_time = move_all(bench, {vehicle: units for vehicle, units in along.items() if units},
                              until)
    together = [Fit(bench, trial, along[vehicle]) for vehicle, trial in moved.items()]
    is_complete = fits.is_complete and in_time
    if all(find_place(bench.plan.solution, unit.node) for unit in companions):
        return _joined([*together, *fits.places, *fits.others], bench, count, spot, is_complete)
    if any(not new_violations(bench, each.trial) for each in together):
        return _joined(together, bench, count, spot, is_complete)
    return replace(fits, is_complete=is_complete)


def _joined(fits: Iterable[Fit], bench: Bench, count: int,
            spot: Callable[[Place], tuple[object, ...]], is_complete: bool) -> Fits:
    """Return the best of some fits, and the best of each vehicle that has none of these."""
    ranked = sorted(fits, key=lambda fit: fit.rank)
    allowed = [fit for fit in ranked if not new_violations(bench, fit.trial)]
    spots: dict[tuple[object, ...], Fit] = {}
    for fit in allowed or ranked:
        if fit.trial.place is not None:
            at = () if spot is vehicle_of else (fit.bench.node,)
            spots.setdefault((*at, *spot(fit.trial.place)), fit)
    places = [*spots.values()][:count]
    seen = {_vehicle(fit) for fit in places}
    others: dict[Vehicle | None, Fit] = {}
    for fit in ranked:
        if _vehicle(fit) not in seen:
            others.setdefault(_vehicle(fit), fit)
    return Fits(tuple(places), tuple(others.values()), is_complete)


def _vehicle(fit: Fit) -> Vehicle | None:
    return None if fit.trial.place is None else fit.trial.place.vehicle


def _alone(bench: Bench, count: int, until: float,
           spot: Callable[[Place], tuple[object, ...]]) -> tuple[Fits, list[Vehicle]]:
    """Return the best places with all others staying, and all vehicles that were tried."""
    drafts, is_complete = _drafts(bench, count, spot, share_over(ROUTES_SHARE, until))
    places = _best(bench, sorted(drafts, key=lambda draft: draft.rank), count, spot, until)
    chosen = {trial.place.vehicle for trial in places if trial.place is not None}
    vehicles: dict[Vehicle, list[Drafted]] = {}
    for draft in drafts:
        vehicles.setdefault(draft.place.vehicle, []).append(draft)
    some = takewhile(lambda _: time.perf_counter() < until,
                     [some for vehicle, some in vehicles.items() if vehicle not in chosen])
    others = [Fit(bench, each.trial) for each in chain.from_iterable(
        best_of(bench, "vehicle", drafts) for drafts in some)]
    return Fits(tuple([Fit(bench, trial) for trial in places]),
                tuple(sorted(others, key=lambda fit: fit.rank)),
                is_complete and time.perf_counter() < until), [*vehicles]


def _drafts(bench: Bench, count: int, spot: Callable[[Place], tuple[object, ...]],
            until: float) -> tuple[list[Drafted], bool]:
    """Return routes with the customer at the places tried, and whether there was time for all.

    Where the search finds places legal, the cheapest of these. Of other vehicles a few more if it
    sees all that the judge sees; if it doesn't, or none of all is legal, as many of all vehicles as
    if it weren't asked.
    """
    known = bench.offers(share_over(OFFERS_SHARE, until)) or {}
    offers = {group: [offer for offer in some if not is_here(bench, offer.place)]
              for group, some in known.items()}
    cheapest: dict[tuple[object, ...], Place] = {}
    for offer in sorted(chain.from_iterable(offers.values()), key=lambda offer: offer.cost):
        cheapest.setdefault(spot(offer.place), offer.place)
    places = dict.fromkeys([*islice(cheapest.values(), count + SPARE),
                            *[some[0].place for some in offers.values() if some]])
    drafts = [bench.draft(place) for place in takewhile(
        lambda _: time.perf_counter() < until, places)]
    if len(drafts) < len(places):
        return drafts, False
    served = _served(drafts)
    broken = [index for index, draft in enumerate(drafts) if draft.place.vehicle not in served]
    for index in takewhile(lambda _: time.perf_counter() < until, broken):
        drafts[index] = bench.as_searched(drafts[index])
    served = _served(drafts) if is_seen_by_search(bench.problem) else set()
    others, is_complete = try_places(bench, until, lambda vehicle: vehicle not in served,
                                     FEW_TRIES if served else None)
    return [*drafts, *chain.from_iterable(others.values())], is_complete


def _served(drafts: Iterable[Drafted]) -> set[Vehicle]:
    """Return the vehicles that a legal one is of."""
    return {draft.place.vehicle for draft in drafts if not draft.timed.judged.violations}


def new_violations(bench: Bench, trial: Trial) -> list[Violation]:
    """Return the rules that a plan breaks and that it doesn't without the customer.

    What breaks only because he is missed excuses no other trip, so that in a plan without broken
    rules none are excused; nor is what one end of a shipment breaks without the other, nor that a
    plan without whoever was served already isn't what has happened.
    """
    is_end = bench.shipment is None and bench.node in bench.problem.shipment_at
    given = {(each.code, each.message) for each in bench.plan.evaluation.violations}
    codes = {code for code, _ in given} - ({"PAIR"} if is_end else set())
    before = {(each.code, each.message) for each in bench.left_out.evaluation.violations
              if each.code in codes}
    before -= {each for each in before - given if each[0] in PAST_RULES}
    return [each for each in trial.evaluation.violations
            if (each.code, each.message) not in before]


def _best(bench: Bench, drafts: Iterable[Drafted], count: int,
          spot_of: Callable[[Place], tuple[object, ...]], until: float) -> Sequence[Trial]:
    """Return the plans with the first of some drafts, the best first; others if none is allowed.

    After an instant no more than one.
    """
    seen: set[tuple[object, ...]] = set()
    allowed: list[Trial] = []
    broken: list[Trial] = []
    for draft in drafts:
        if len(allowed) >= count or len(broken) >= count + SPARE or (
                seen and time.perf_counter() >= until):
            break
        spot = spot_of(draft.place)
        if spot not in seen:
            seen.add(spot)
            trial = bench.finish(draft)
            (broken if new_violations(bench, trial) else allowed).append(trial)
    return sorted(allowed or broken, key=lambda trial: trial.rank)[:count]
