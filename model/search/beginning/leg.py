"""Trips of vehicles that fly by themselves, as others of their vehicles meet them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from model.problem import (
    Customer, Energy, Problem, Storms, VehicleType, barred, shares_chargers, zones_of,
)


@dataclass(frozen=True)
class TripLeg:
    """A trip as others of its vehicle meet it."""

    trip: Sequence[int]
    ready: int  # all its parcels are there
    latest: int  # start by which it is in time, if nobody waits
    busy: int  # how long its vehicle is until it may begin another
    storms: Storms = ()  # between which starts it would meet one, or a closed zone
    airborne: int = 0  # how long it takes
    charging: int = 0  # how long a battery is charged for it

    @property
    def slack(self) -> int:
        """For how long it may be put off."""
        return self.latest - self.ready

    @property
    def leeway(self) -> int:
        """The same, less for one that takes long."""
        return self.slack - self.busy

    def soonest(self, free: int) -> int:
        """Return its first start once its vehicle is free."""
        start = max(self.ready, free)
        for before, behind in self.storms:
            if before < start < behind:
                start = behind
        return start

    def last(self, bound: int) -> int:
        """Return its last start up to a bound."""
        start = min(self.latest, bound)
        for before, behind in reversed(self.storms):
            if before < start < behind:
                start = before
        return start


class Timing:
    """When trips of a type may begin, and how long they take."""

    def __init__(self, problem: Problem, kind: VehicleType, nodes: Sequence[int]) -> None:
        self._problem = problem
        self._nodes = nodes
        self._kind = kind
        self._duration = problem.travel[kind.travel].duration
        self._in_turn = shares_chargers(problem, kind)

    def leg(self, trip: Sequence[int]) -> TripLeg | None:
        """Return a trip as others meet it; None if it is never in time."""
        kind, customers = self._kind, [self._problem.customer_at(self._nodes[node])
                                       for node in trip]
        ready = max([kind.earliest, *[customer.release_time for customer in customers]])
        time, here, spent = ready + kind.launch_duration, kind.begins_at, kind.launch_duration
        latest = kind.latest
        for node, customer in zip(map(self._nodes.__getitem__, trip), customers, strict=True):
            leg = self._duration.item(here, node) + self._problem.setup_between(here, node)
            time, spent, here = time + leg, spent + leg, node
            latest = min(latest, customer.latest - spent)
            service = kind.service_at(customer)
            time, spent = max(time, customer.earliest) + service, spent + service
        home = self._duration.item(here, kind.ends_at) + kind.recovery_duration
        latest = min(latest, kind.latest - spent - home)
        airborne = time + home - ready
        zones = zones_of(self._problem, (kind.begins_at, kind.ends_at, *[
            self._nodes[node] for node in trip]))
        storms = tuple([(begin + kind.recovery_duration - airborne, end - kind.launch_duration)
                        for begin, end in barred(kind.storms, kind.closings, zones)])
        charging = self._charging(airborne)
        if self._in_turn:
            charging = self._charging_for(trip, customers, time - ready - spent)
        found = TripLeg(trip, ready, latest, airborne + max(kind.reload_duration, charging), storms,
                        airborne, charging)
        found = replace(found, ready=found.soonest(ready), latest=found.last(latest))
        is_late = found.ready > found.latest or found.ready + airborne > kind.latest
        return None if is_late else found

    def _charging(self, airborne: int) -> int:
        """Return how long a battery is charged at most after so long a trip; 0: it is full at once.
        """
        energy = self._kind.energy
        if energy is None or not energy.charge:
            return 0
        most = max(*energy.cruise, *energy.climb, *energy.descent, *energy.hover)
        return -(-min(airborne * most, energy.available) // energy.charge)

    def _charging_for(self, trip: Sequence[int], customers: Sequence[Customer],
                      waited: int) -> int:
        """Return how long a battery is charged for a trip that waits so long in the air."""
        energy, kind = self._kind.energy, self._kind
        if energy is None:
            return 0
        weight = sum([customer.demand[energy.dimension] for customer in customers])
        taken, here = 0.0, kind.begins_at
        for node, customer in zip([*map(self._nodes.__getitem__, trip), kind.ends_at],
                                  [*customers, None], strict=True):
            leg = self._duration.item(here, node) + self._problem.setup_between(here, node)
            taken += _flown(energy, leg, weight)
            if customer is not None and not energy.lands:
                taken += _power(energy, energy.hover, weight) * (
                    kind.service_at(customer) + waited)
                waited = 0
            if customer is not None:
                weight += customer.taken_in[energy.dimension] - customer.demand[energy.dimension]
            here = node
        return int(taken / energy.charge) + 1


def _power(energy: Energy, powers: Sequence[int], weight: int) -> float:
    return float(np.interp(weight, energy.weights, powers))


def _flown(energy: Energy, duration: int, weight: int) -> float:
    """Return what a leg takes of a battery."""
    flight = max(0, duration - energy.climb_duration - energy.descent_duration)
    return (_power(energy, energy.climb, weight) * energy.climb_duration
            + _power(energy, energy.cruise, weight) * flight
            + _power(energy, energy.descent, weight) * energy.descent_duration)
