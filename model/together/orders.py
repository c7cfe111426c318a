"""Every order in which a truck may serve some customers, as far as no bound forbids it."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from model.judge.network import Network
from model.judge.timing import TripDecision
from model.problem import MM_PER_KM, MS_PER_HOUR

LOOKS = 256
"""Orders between two looks at the clock."""


class RouteOrder(NamedTuple):
    """A route in one order, and what it costs at least."""

    bound: float
    trips: tuple[TripDecision, ...]


class TooManyOrdersError(Exception):
    """There are more orders than are to be tried."""


@dataclass
class AllOrders:
    """Tries all orders of the customers of a network.

    Parameters
    ----------
    net
        The places.
    most
        How many ways on are tried.
    should_stop
        Asked now and then.

    Raises
    ------
    TooManyError
        If there are more ways on, or it is told to stop.
    """

    net: Network
    most: int
    should_stop: Callable[[], bool]
    tried: int = field(default=0, init=False)

    def by_group(self) -> dict[int, list[RouteOrder]]:
        """Return the orders of each group, as bits by the customers' numbers."""
        found: dict[int, list[RouteOrder]] = {}
        for group, order in self._begin():
            found.setdefault(group, []).append(order)
        return found

    def _begin(self) -> Iterator[tuple[int, RouteOrder]]:
        net = self.net
        self._ride, self._far = net.ride.tolist(), net.far.tolist()
        self._nodes: list[int] = net.nodes.tolist()
        self._stay, self._rest = net.stay.tolist(), net.rest.tolist()
        self._opens, self._closes = net.opens.tolist(), net.closes.tolist()
        self._far_back = net.far_back.tolist()
        first = net.problem.num_depots
        self._release = [0 if node < first else net.problem.customers[node - first].release_time
                         for node in self._nodes]
        self._demand = [() if node < first else net.problem.customers[node - first].demand
                        for node in self._nodes]
        self._taken = [() if node < first else net.problem.customers[node - first].taken_in
                       for node in self._nodes]
        self._is_plain = _is_plain(net)
        self._wholes = [_bits(each.nodes) for each in net.problem.shipments]
        self._needs = {each.delivery: _bits(each.pickups) for each in net.problem.shipments}
        self._known: dict[tuple[int, ...], list[tuple[int, ...]]] = {}
        start = _Path((net.begin,), (), net.vehicle_type.earliest, 0, 0, 0, 0, 0)
        none = (0,) * net.problem.num_dimensions
        yield from self._onward(start, none, none)

    def _onward(self, path: "_Path", given: tuple[int, ...],
                taken: tuple[int, ...]) -> Iterator[tuple[int, RouteOrder]]:
        """Yield the path as a route, then all that begin with it."""
        here = path.places[-1]
        if len(path.places) > 1:
            yield from self._ended(path)
        stops, capacity = self.net.vehicle_type.max_stops, self.net.vehicle_type.capacity
        if stops is not None and len(path.places) > stops:
            return
        for place in range(self.net.num_depots, len(self._nodes)):
            needs = self._needs.get(self._nodes[place], 0)
            if path.group >> self._nodes[place] & 1 or path.group & needs != needs:
                continue
            self._count()
            longer = self._with(path, here, place)
            if longer is None or (self._is_plain and self._is_worse(longer)):
                continue
            more = tuple(map(sum, zip(given, self._demand[place], strict=True)))
            load = tuple(map(sum, zip(taken, self._taken[place], strict=True)))
            if all(map(_at_most, more, capacity)) and all(map(_at_most, load, capacity)):
                yield from self._onward(longer, more, load)

    def _count(self) -> None:
        self.tried += 1
        if self.tried > self.most or (self.tried % LOOKS == 0 and self.should_stop()):
            raise TooManyOrdersError

    def _is_worse(self, path: "_Path") -> bool:
        """Tell whether a path known serves the same, ends at the same place, and is no worse.

        In place: else it is known from now on.
        """
        trip = sum([1 << place for place in path.places[1:]])
        known = self._known.setdefault((path.group, trip, path.places[-1], len(path.trips)), [])
        own = path.time, path.span, path.far, path.gone
        if any(all(map(_at_most, other, own)) for other in known):
            return True
        known.append(own)
        return False

    def _with(self, path: "_Path", here: int, place: int) -> "_Path | None":
        """Return a path with one more customer; None if a bound forbids it."""
        net, ride = self.net, self._ride[here][place]
        arrival = max(path.time + ride, self._release[place] + path.since + ride)
        if arrival > self._closes[place]:
            return None
        leave = max(arrival, self._opens[place]) + self._stay[place]
        span = path.span + ride + self._stay[place]
        far = path.far + self._far[here][place]
        if (leave + self._rest[place] > net.latest_end
                or span + self._rest[place] > net.longest_work
                or far + self._far_back[place] > net.longest_trip):
            return None
        return path._replace(places=(*path.places, place), time=leave, span=span, far=far,
                             since=path.since + ride + self._stay[place],
                             group=path.group | 1 << self._nodes[place])

    def _ended(self, path: "_Path") -> Iterator[tuple[int, RouteOrder]]:
        """Yield the route that ends here, then those that go on with another trip."""
        if any(path.group & whole not in (0, whole) for whole in self._wholes):
            return
        net, here = self.net, path.places[-1]
        home, far = self._ride[here][net.end], path.far + self._far[here][net.end]
        if (path.time + home <= net.latest_end and path.span + home <= net.longest_work
                and far <= net.longest_trip):
            yield path.group, self._order(path, net.end, path.span + home, path.gone + far)
        if len(path.trips) + 1 >= net.vehicle_type.max_trips:
            return
        none = (0,) * net.problem.num_dimensions
        for depot in net.reloads:
            ride, far = self._ride[here][depot], path.far + self._far[here][depot]
            if far <= net.longest_trip:
                away = ride + net.vehicle_type.reload_duration
                yield from self._onward(_Path(
                    (depot,), (*path.trips, self._trip(path, depot)), path.time + away,
                    path.span + away, 0, path.gone + far, 0, path.group), none, none)

    def _order(self, path: "_Path", end: int, span: int, gone: int) -> RouteOrder:
        kind = self.net.vehicle_type
        bound = (kind.fixed_cost + gone * kind.cost_per_km / MM_PER_KM
                 + path.group.bit_count() * kind.cost_per_stop
                 + span * kind.cost_per_hour / MS_PER_HOUR)
        return RouteOrder(bound, (*path.trips, self._trip(path, end)))

    def _trip(self, path: "_Path", end: int) -> TripDecision:
        nodes = self._nodes
        return TripDecision((*[nodes[place] for place in path.places], nodes[end]))


def _is_plain(net: Network) -> bool:
    """Tell whether what a route may still do, and costs, hangs on no more than how it goes by now.

    So it does where nobody waits, and no customer asks for more than to be reached in time.
    """
    problem = net.problem
    return (net.vehicle_type.speed_profile is None and not problem.incompatible_goods
            and not problem.shipments
            and not net.vehicle_type.cost_per_load_km
            and not any(each.earliest or each.gaps or each.release_time or any(each.pickup)
                        or each.late_cost_per_hour is not None or each.setup_duration
                        or each.max_time_aboard is not None for each in problem.customers))


class _Path(NamedTuple):
    """Where a route has come to."""

    places: tuple[int, ...]  # of the trip that it is on
    trips: tuple[TripDecision, ...]  # those before
    time: int  # when it may leave
    span: int  # worked since it began, without waiting
    far: int  # on this trip
    gone: int  # on those before
    since: int  # of the span, on this trip
    group: int  # served, as bits by node


def _bits(nodes: Iterable[int]) -> int:
    return sum([1 << node for node in nodes])


def _at_most(amount: int, limit: int) -> bool:
    return amount <= limit


