"""Whether customers may be served together who can't be served one after another."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from model.judge.metrics import allowed_overtime
from model.judge.network import MOST_NODES, NEVER, may_stop, network_of
from model.problem import UNLIMITED, BoolArray, IntArray, Problem
from model.together.strings import TruckNetwork

LOOKS, FEWEST_SOURCES = 200_000, 4
"""So many legs are compared with ways by one other place, from so many places at least."""

SHORTER = 1.1
"""Where ways by another place are so much shorter, legs are taken for those of few streets."""


FEW = 100
"""For so many customers looking takes no time."""


@dataclass(frozen=True)
class Joint:
    """Trucks' ways through others, where these may be shorter than those directly there and back.
    """

    problem: Problem
    is_sure: bool  # vehicles of a type can't serve somebody alone, but may among others
    _streets: dict[int, TruckNetwork | None] = field(default_factory=dict)

    def streets(self, kind: int) -> TruckNetwork | None:
        """Return where trucks of a type may go; None if they may stop nowhere."""
        if kind not in self._streets:
            net = network_of(self.problem, kind, _nearest(self.problem, kind))
            self._streets[kind] = TruckNetwork(net) if len(net.nodes) > net.num_depots else None
        return self._streets[kind]


def find_joint(problem: Problem,
               should_stop: Callable[[], bool] = lambda: False) -> Joint | None:
    """Return trucks' ways through others; None where ways are shortest directly."""
    travels = {kind.travel for kind in problem.vehicle_types}
    if all(problem.travel[travel].straight is not None for travel in travels):
        return None
    joint = Joint(problem, True)
    lonely = _lonely(problem)
    for kind, nodes in enumerate(lonely):
        if len(nodes) and (problem.num_customers <= FEW or not should_stop()):
            streets = joint.streets(kind)
            if streets is not None and streets.net.together[
                    np.isin(streets.net.nodes, nodes)].any():
                return joint
    if any(_has_few_streets(problem, kind) for kind in travels):
        return Joint(problem, False)
    return None


def _lonely(problem: Problem) -> list[IntArray]:
    """Return by type of vehicle the customers whom its trucks may serve, but none alone."""
    places, first = _Places.of(problem), problem.num_depots
    return [np.array([node for node in (np.flatnonzero(~places.alone(problem, kind))
                                        + first).tolist() if may_stop(problem, kind, node)],
                     np.int64) for kind in range(len(problem.vehicle_types))]


def _has_few_streets(problem: Problem, travel: int) -> bool:
    """Tell whether some legs are longer than ways by another place, at which customers are served.
    """
    if problem.num_nodes > MOST_NODES or problem.travel[travel].straight is not None:
        return False
    first = problem.num_depots
    places = np.arange(first, problem.num_nodes)
    service = np.array([customer.service_duration for customer in problem.customers])
    legs = problem.travel[travel].duration[:, :]
    among = legs[first:, first:] + service[:, None]
    begins = [kind.begins_at for kind in problem.vehicle_types if kind.travel == travel]
    count = max(FEWEST_SOURCES, LOOKS // legs.size)
    for source in dict.fromkeys([*begins[:1], *places[::max(1, len(places) // count)].tolist()]):
        ways = (legs[source, first:, None] + among).min(axis=0)
        if (legs[source, first:] > SHORTER * ways).any():
            return True
    return False


def _nearest(problem: Problem, kind: int) -> IntArray:
    """Return all customers, or as many as are looked at: those nearest, there and back."""
    first, vehicles = problem.num_depots, problem.vehicle_types[kind]
    if problem.num_customers <= MOST_NODES:
        return np.arange(first, problem.num_nodes)
    duration = problem.travel[vehicles.travel].duration
    there = np.asarray(duration[vehicles.begins_at, first:])
    away = np.minimum(there, np.asarray(duration[first:, vehicles.ends_at]))
    found: IntArray = np.sort(np.argsort(away, kind="stable")[:MOST_NODES]) + first
    return found


@dataclass(frozen=True)
class _Places:
    """Customers' own limits, by customer."""

    opens: IntArray
    closes: IntArray
    service: IntArray
    aboard: IntArray

    @classmethod
    def of(cls, problem: Problem) -> "_Places":
        """Read them once for all types."""
        some = problem.customers
        return cls(
            np.array([each.earliest for each in some]),
            np.array([NEVER if each.late_cost_per_hour is not None or each.latest >= UNLIMITED
                      else each.latest for each in some]),
            np.array([each.service_duration for each in some]),
            np.array([NEVER if each.max_time_aboard is None else each.max_time_aboard
                      for each in some]))

    def alone(self, problem: Problem, kind: int) -> BoolArray:
        """Mark the customers whom nothing that is looked at keeps a vehicle from serving alone."""
        vehicles, first = problem.vehicle_types[kind], problem.num_depots
        travel = problem.travel[vehicles.travel]
        there = np.asarray(travel.duration[vehicles.begins_at, first:])
        back = np.asarray(travel.duration[first:, vehicles.ends_at])
        service = self.service
        if vehicles.service_durations:
            service = np.array([vehicles.service_at(each) for each in problem.customers])
        arrival = vehicles.earliest + there
        end, more = np.maximum(arrival, self.opens) + service + back, allowed_overtime(vehicles)
        alone: BoolArray = ((arrival <= self.closes) & (end <= vehicles.latest + more)
                            & (there <= self.aboard))
        if vehicles.max_working_duration is not None:
            alone &= there + service + back <= vehicles.max_working_duration + more
        if vehicles.max_trip_distance is not None:
            far = (np.asarray(travel.distance[vehicles.begins_at, first:])
                   + np.asarray(travel.distance[first:, vehicles.ends_at]))
            alone &= far <= vehicles.max_trip_distance
        return alone
