"""What trucks of a type can reach at best, going there and back through others.

Where legs are shorter by way of others than directly, who can't be served alone may be served
together with them. All here are bounds: what they leave out no trip can do; what they let through
is for `check` to judge. Times in ms as if nobody drove slower at any hour, distances in mm.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from model.judge.metrics import allowed_overtime
from model.problem import UNLIMITED, BoolArray, IntArray, Problem, VehicleType

NEVER = 2**60
"""Later than any plan, and longer than any way."""

MOST_NODES = 1200
"""So many customers are looked at at most, first those who can't be served alone."""


@dataclass(frozen=True, eq=False)
class Network:
    """The places where trucks of a type may be, and the legs between them.

    Places are those where trips begin and end, then customers that such trucks may serve.
    """

    problem: Problem
    kind: int
    nodes: IntArray  # (place,) of the problem
    num_depots: int  # so many of the places are where trips begin and end
    ride: IntArray  # (place, place) from leaving one to being set up at another
    far: IntArray  # (place, place)
    service: IntArray  # (place,)
    opens: IntArray  # (place,) when service begins at the soonest
    closes: IntArray  # (place,) when it must be reached

    @property
    def vehicle_type(self) -> VehicleType:
        """The type of the trucks."""
        return self.problem.vehicle_types[self.kind]

    @cached_property
    def begin(self) -> int:
        """The place where the first trip begins."""
        return self._place(self.vehicle_type.begins_at)

    @cached_property
    def end(self) -> int:
        """The place where the last trip ends."""
        return self._place(self.vehicle_type.ends_at)

    @cached_property
    def reloads(self) -> tuple[int, ...]:
        """The places between two trips."""
        if self.vehicle_type.max_trips == 1:
            return ()
        return tuple(map(self._place, dict.fromkeys(self.vehicle_type.reload_places)))

    @cached_property
    def latest_end(self) -> int:
        """When the last trip must have ended."""
        return self.vehicle_type.latest + allowed_overtime(self.vehicle_type)

    @cached_property
    def longest_work(self) -> int:
        """How long a vehicle may work."""
        limit = self.vehicle_type.max_working_duration
        return NEVER if limit is None else limit + allowed_overtime(self.vehicle_type)

    @cached_property
    def longest_trip(self) -> int:
        """How far a trip may go."""
        limit = self.vehicle_type.max_trip_distance
        return NEVER if limit is None else limit

    def _place(self, node: int) -> int:
        return self.nodes.tolist().index(node)

    @cached_property
    def stay(self) -> IntArray:
        """(place,) how long a truck that goes on from there to others is there."""
        stay = self.service.copy()
        stay[list(self.reloads)] = self.vehicle_type.reload_duration
        return stay

    @cached_property
    def through(self) -> BoolArray:
        """(place,) where a truck may go on to others."""
        through = np.arange(len(self.nodes)) >= self.num_depots
        through[list(self.reloads)] = True
        return through

    @cached_property
    def left_from(self) -> IntArray:
        """(place,) when a truck leaves there at the soonest; `NEVER`: it can't come there."""
        leave = np.full(len(self.nodes), NEVER)
        leave[self.begin] = self.vehicle_type.earliest
        onward = self.through.copy()
        onward[self.begin] = True
        while True:
            going = np.where(onward, leave, NEVER)
            arrival = (going[:, None] + self.ride).min(axis=0)
            reached = np.maximum(arrival, self.opens) + self.stay
            reached[arrival > self.closes] = NEVER
            sooner = np.minimum(leave, reached)
            if (sooner == leave).all():
                return leave
            leave = sooner

    def rest_to(self, end: int, through: BoolArray | None = None) -> IntArray:
        """Return (place,) how long it takes from leaving each to being at one, at least."""
        return self._ways(self.ride, self.stay, end, self.through if through is None else through)

    @cached_property
    def rest(self) -> IntArray:
        """(place,) how long it takes from leaving there to the end of the last trip, at least."""
        return self.rest_to(self.end)

    @cached_property
    def way_there(self) -> IntArray:
        """(place,) how long it takes from the beginning of a trip to being there, at least."""
        return self._from_begins(self.ride, self.stay)

    @cached_property
    def far_back(self) -> IntArray:
        """(place,) how far it is from there to where a trip may end, at least."""
        inner = np.arange(len(self.nodes)) >= self.num_depots
        none = np.zeros(len(self.nodes), np.int64)
        ends = dict.fromkeys((self.end, *self.reloads))
        found: IntArray = np.min([self._ways(self.far, none, end, inner) for end in ends], axis=0)
        return found

    @cached_property
    def far_there(self) -> IntArray:
        """(place,) how far it is there from where a trip may begin, at least."""
        return self._from_begins(self.far, np.zeros(len(self.nodes), np.int64))

    def _from_begins(self, legs: IntArray, stay: IntArray) -> IntArray:
        """Return the shortest way to each place from where a trip may begin."""
        inner = np.arange(len(self.nodes)) >= self.num_depots
        there = np.full(len(self.nodes), NEVER)
        begins = [self.begin, *self.reloads]
        there[:] = legs[begins].min(axis=0)
        while True:
            onward = np.where(inner, there + stay, NEVER)
            shorter = np.minimum(there, (onward[:, None] + legs).min(axis=0))
            if (shorter == there).all():
                return there
            there = shorter

    @staticmethod
    def _ways(legs: IntArray, stay: IntArray, end: int, through: BoolArray) -> IntArray:
        """Return the shortest way from each place to one, staying wherever it goes through."""
        rest: IntArray = legs[:, end].copy()
        while True:
            onward = np.where(through, stay + rest, NEVER)
            shorter = np.minimum(rest, (legs + onward).min(axis=1))
            if (shorter == rest).all():
                return rest
            rest = shorter

    @cached_property
    def alone(self) -> BoolArray:
        """(place,) mark customers whom no bound keeps from being served alone."""
        return self._allowed(self.vehicle_type.earliest + self.ride[self.begin],
                             self.ride[self.begin], self.ride[:, self.end],
                             self.far[self.begin] + self.far[:, self.end])

    @cached_property
    def together(self) -> BoolArray:
        """(place,) mark customers whom no bound keeps from being served among others."""
        arrival = self.left_from - self.stay
        return self._allowed(arrival, self.way_there, self.rest,
                             self.far_there + self.far_back) & (self.left_from < NEVER)

    def _allowed(self, arrival: IntArray, there: IntArray, back: IntArray,
                 far: IntArray) -> BoolArray:
        """Mark customers who are reached, left and aboard in time, and not too far away."""
        leave = np.maximum(arrival, self.opens) + self.service
        found: BoolArray = ((arrival <= self.closes) & (leave + back <= self.latest_end)
                            & (there + self.service + back <= self.longest_work)
                            & (far <= self.longest_trip) & (there <= self._aboard))
        found[:self.num_depots] = False
        return found

    @cached_property
    def _aboard(self) -> IntArray:
        """(place,) how long a parcel may be aboard."""
        first, limits = self.problem.num_depots, np.full(len(self.nodes), NEVER)
        for place, node in enumerate(self.nodes.tolist()):
            if node >= first:
                most = self.problem.customers[node - first].max_time_aboard
                limits[place] = NEVER if most is None else most
        return limits


def network_of(problem: Problem, kind: int, customers: IntArray) -> Network:
    """Return the network of a type's trucks among those of some customers, nodes, they may serve.
    """
    vehicle_type, first = problem.vehicle_types[kind], problem.num_depots
    depots = dict.fromkeys((vehicle_type.begins_at, vehicle_type.ends_at))
    if vehicle_type.max_trips > 1:
        depots |= dict.fromkeys(vehicle_type.reload_places)
    served = [node for node in customers.tolist() if may_stop(problem, kind, node)]
    nodes = np.array([*depots, *served])
    travel = problem.travel[vehicle_type.travel]
    rows = nodes[:, None]
    ride: IntArray = travel.duration[rows, nodes].astype(np.int64)
    some = [problem.customers[node - first] for node in served]
    if any(customer.setup_duration for customer in some):
        setups = np.array([[problem.setup_between(origin, node) for node in nodes.tolist()]
                           for origin in nodes.tolist()])
        ride = ride + setups
    none = [0] * len(depots)
    return Network(
        problem, kind, nodes, len(depots), ride, travel.distance[rows, nodes].astype(np.int64),
        np.array([*none, *map(vehicle_type.service_at, some)]),
        np.array([*none, *[customer.earliest for customer in some]]),
        np.array([*[NEVER] * len(depots),
                  *[NEVER if customer.late_cost_per_hour is not None
                    or customer.latest >= UNLIMITED else customer.latest for customer in some]]))


def may_stop(problem: Problem, kind: int, node: int) -> bool:
    """Tell whether trucks of a type may serve a customer, as far as it is about who comes."""
    customer = problem.customer_at(node)
    barred = "truck" if problem.vehicle_types[kind].flies else "drone"
    return (customer.served_by != barred and problem.allows(kind, node)
            and customer.skills <= problem.vehicle_types[kind].skills)
