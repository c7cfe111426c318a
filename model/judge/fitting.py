"""The best places of a customer or shipment in a plan whose others stay, and why not elsewhere.

Each is a whole plan that was judged. They are the best of those tried: in small plans of all, else
of each vehicle's likeliest, by truck and by drone.
"""

import math
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import takewhile

from model.judge.alternatives import best_of, try_places
from model.judge.bench import Bench, Draft, Trial
from model.judge.past import Vehicle
from model.judge.past_rules import PAST_RULES
from model.judge.places import Place
from model.judge.rules import Violation
from model.judge.screening import share_over

SPARE = 8
"""So many more places than asked for are judged with the whole plan if these break rules there."""

TRYING_SHARE = 0.9
"""Share of the time in which routes are tried, before plans with the best ones are judged."""


def spot_of(place: Place) -> tuple[object, ...]:
    """Return what places have in common that differ only in where a drone is recovered."""
    own = place.vehicle, place.trip, place.by, place.stop, place.sortie, place.own_trip
    return *own, *[(node, each.by, each.stop, each.sortie) for node, each in place.ends]


def vehicle_of(place: Place) -> tuple[object, ...]:
    """Return what the places of one vehicle have in common."""
    return (place.vehicle,)


@dataclass(frozen=True)
class Fits:
    """What was found by trying."""

    places: tuple[Trial, ...]  # the best first
    others: tuple[Trial, ...]  # the best of each vehicle that has none of these, the best first
    is_complete: bool  # no clock cut it short


def find_fits(bench: Bench, count: int, until: float = math.inf,
              spot: Callable[[Place], tuple[object, ...]] = spot_of) -> Fits:
    """Return the best places found by an instant, `count` at most.

    `until` is on `time.perf_counter`; of places that are one `spot`, the best counts. Of what was
    tried by then, one place is told in any case.
    """
    by_group, is_complete = try_places(bench, share_over(TRYING_SHARE, until))
    drafts = [draft for some in by_group.values() for draft in some]
    places = _best(bench, sorted(drafts, key=lambda draft: draft.rank), count, spot, until)
    chosen = {trial.place.vehicle for trial in places if trial.place is not None}
    vehicles: dict[Vehicle, list[Draft]] = {}
    for draft in drafts:
        if draft.place.vehicle not in chosen:
            vehicles.setdefault(draft.place.vehicle, []).append(draft)
    others = [each.trial for some in takewhile(lambda _: time.perf_counter() < until,
                                               vehicles.values())
              for each in best_of(bench, "vehicle", some)]
    return Fits(tuple(places), tuple(sorted(others, key=lambda trial: trial.rank)),
                is_complete and time.perf_counter() < until)


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


def _best(bench: Bench, drafts: Iterable[Draft], count: int,
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
