"""Trips of vehicles that fly, packed on them where they are charged in turn between trips."""

import math
from bisect import bisect_right, insort
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from model.problem import VehicleType
from model.search.beginning.leg import TripLeg
from model.solution import Charge

MOST_TRIED = 12
"""Vehicles tried for a trip, those first that are free last before it."""


class ChargingPlaces:
    """Places to charge at a depot, and when they are taken."""

    def __init__(self, number: int, charges: Iterable[Charge]) -> None:
        self._number = number
        self._starts: list[int] = []
        self._ends: list[int] = []
        for charge in charges:
            self.take(charge)

    def take(self, charge: Charge) -> None:
        """Take a place. In place."""
        insort(self._starts, charge.start)
        insort(self._ends, charge.end)

    def soonest(self, since: int, duration: int) -> int | None:
        """Return when a vehicle that is there from `since` on may begin to be charged for so long;
        None if never.
        """
        if self._number <= 0:
            return None
        starts, ends, begin = self._starts, self._ends, since
        start, end = bisect_right(starts, since), bisect_right(ends, since)
        while True:
            while start - end >= self._number:
                begin = ends[end]
                end = bisect_right(ends, begin, end)
                start = bisect_right(starts, begin, start)
            if start == len(starts) or starts[start] >= begin + duration:
                return begin
            # Places are given back before they are taken.
            end = bisect_right(ends, starts[start], end)
            start += 1


@dataclass
class TurnRow:
    """Trips of one vehicle in their order, and what there is behind them."""

    free: int  # when it may begin another
    there: int  # since when it is at the depot
    level: int  # of its battery, as how long that is charged
    legs: list[TripLeg] = field(default_factory=list)
    starts: list[int] = field(default_factory=list)
    charges: list[tuple[Charge, ...]] = field(default_factory=list)

    def offer(self, leg: TripLeg, places: ChargingPlaces) -> tuple[int, tuple[Charge, ...]] | None:
        """Return when a trip may begin behind the others, and be charged before; None if never."""
        lacking = leg.charging - self.level
        if lacking <= 0:
            start, charges = leg.soonest(self.free), tuple[Charge, ...]()
        else:
            begin = places.soonest(self.there, lacking)
            if begin is None:
                return None
            charges = (Charge(begin, begin + lacking),)
            start = leg.soonest(max(self.free, begin + lacking))
        return None if start > leg.latest else (start, charges)

    def put(self, leg: TripLeg, start: int, charges: tuple[Charge, ...], reload: int) -> None:
        """Put a trip behind the others. In place."""
        self.legs.append(leg)
        self.starts.append(start)
        self.charges.append(charges)
        self.level += sum(charge.end - charge.start for charge in charges) - leg.charging
        self.there = start + leg.airborne
        self.free = self.there + reload


def packed_in_turn(kind: VehicleType, legs: Sequence[TripLeg], number: int,
                   charges: Sequence[Charge]) -> list[TurnRow]:
    """Return trips on vehicles, put there in an order, where places to charge are shared.

    Each comes behind others of a vehicle that waits least for it; one that none can fly is left
    out. `number` places there are, which are taken during `charges`.
    """
    energy, places = kind.energy, ChargingPlaces(number, charges)
    if energy is None:
        raise ValueError(f"vehicle type {kind.id} energy: None is not allowed")
    full = (kind.charge_left[0] if kind.charge_left else energy.available) // energy.charge
    rows: list[TurnRow] = []
    for leg in legs:
        best, chosen = math.inf, None
        able = [row for row in rows if len(row.legs) < kind.max_trips and row.free <= leg.latest]
        able.sort(key=lambda row: abs(row.free - leg.ready))
        fresh = [TurnRow(kind.earliest, kind.earliest, full)] if len(rows) < kind.count else []
        for row in [*able[:MOST_TRIED], *able[-1:], *fresh]:
            found = row.offer(leg, places)
            if found is None or (row in fresh and chosen is not None):
                continue
            waited = found[0] - row.free
            if waited < best:
                best, chosen = waited, (row, *found)
        if chosen is None:
            continue
        row, start, taken = chosen
        if not row.legs:
            rows.append(row)
        row.put(leg, start, taken, kind.reload_duration)
        for charge in taken:
            places.take(charge)
    return rows
