"""What a timed route carries, drives and costs."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from model.judge.breaks import unpaid
from model.judge.clock import opening
from model.judge.energy import sortie_energy
from model.judge.flown_trips import trip_energy
from model.judge.freshness import first_departure
from model.judge.loads import highest, sortie_loads, trip_loads
from model.problem import MM_PER_KM, MS_PER_HOUR, DroneType, Problem, VehicleType
from model.solution import Cost, Route, Sortie, Trip


@dataclass(frozen=True)
class SortieMetrics:
    """One drone flight."""

    distance: int  # mm
    duration: int  # ms from take-off to the end of recovery
    loads: tuple[tuple[int, ...], ...]  # (1 + visit, dimension) at take-off, then on leaving each
    energy: int | None = None  # µJ; None where it is not known what flying takes


@dataclass(frozen=True)
class TripMetrics:
    """One trip; distance and duration are the truck's."""

    load: tuple[int, ...]  # (dimension,) parts at its beginning, drones' parcels too
    highest_load: tuple[int, ...]  # (dimension,) at any point
    load_rate: float  # highest load / capacity, the largest over dimensions
    distance: int  # mm
    load_distance: int  # parts of the first dimension times mm, leg by leg
    duration: int  # ms from the first departure or take-off to the end
    stop_loads: tuple[tuple[int, ...], ...]  # (stop, dimension) on the truck when it leaves
    sorties: tuple[SortieMetrics, ...]
    energy: int | None = None  # µJ of one that flies by itself; as for sorties


@dataclass(frozen=True)
class RouteMetrics:
    """One vehicle."""

    working_duration: int = 0  # ms from first departure to last return, without unpaid breaks
    working_rate: float | None = None  # of the longest without overtime; None without a limit
    overtime: int = 0  # ms past shift or working duration, the longer
    cost: float = 0.0
    trips: tuple[TripMetrics, ...] = ()


def _rate(amount: int, limit: int) -> float:
    if limit:
        return amount / limit
    return float("inf") if amount else 0.0


def flight_legs(trip: Trip, sortie: Sortie) -> Iterator[tuple[int, int]]:
    """Yield the legs of a sortie as pairs of nodes."""
    node = trip.stops[sortie.launch_stop].node
    for visit in sortie.visits:
        yield node, visit.node
        node = visit.node
    yield node, trip.stops[sortie.recovery_stop].node


def _measure_sorties(
    problem: Problem, kind: VehicleType, trip: Trip
) -> tuple[SortieMetrics, ...]:
    if kind.drones is None or not trip.sorties:
        return ()
    return tuple(_measure_sortie(problem, kind.drone_type(sortie.drone), trip, sortie)
                 for sortie in trip.sorties)


def _measure_sortie(problem: Problem, drones: DroneType, trip: Trip,
                    sortie: Sortie) -> SortieMetrics:
    distance = problem.travel[drones.travel].distance
    return SortieMetrics(
        sum([distance.item(*leg) for leg in flight_legs(trip, sortie)]),
        sortie.recovery_time - sortie.launch_time, tuple(sortie_loads(problem, sortie)),
        None if drones.energy is None
        else sortie_energy(problem, drones, drones.energy, trip, sortie))


def measure_trip(problem: Problem, vehicle_type: VehicleType, trip: Trip) -> TripMetrics:
    """Return a trip's metrics."""
    distance = problem.travel[vehicle_type.travel].distance
    load, *loads = trip_loads(problem, vehicle_type, trip)
    most = highest([load, *loads])
    nodes = [stop.node for stop in trip.stops]
    legs = list(map(distance.item, nodes, nodes[1:]))
    return TripMetrics(
        load=load,
        highest_load=most,
        load_rate=max(map(_rate, most, vehicle_type.capacity)),
        distance=sum(legs),
        load_distance=sum(aboard[0] * leg for aboard, leg in zip(loads, legs, strict=False)),
        duration=trip.stops[-1].departure - first_departure(vehicle_type, trip),
        stop_loads=tuple(loads),
        sorties=_measure_sorties(problem, vehicle_type, trip),
        energy=trip_energy(problem, vehicle_type, trip),
    )


def _window_costs(problem: Problem, route: Route) -> tuple[float, float]:
    """Return the costs of lateness and of earliness."""
    customers, first = problem.customers, len(problem.depots)
    lateness = earliness = 0.0
    for visit in route.visits:
        customer = customers[visit.node - first]
        waiting = opening(customer, visit.ready) - visit.ready
        if waiting > 0:
            earliness += waiting * customer.early_cost_per_hour / MS_PER_HOUR
        late = visit.service_start - customer.latest
        if late > 0 and customer.late_cost_per_hour is not None:
            lateness += late * customer.late_cost_per_hour / MS_PER_HOUR + customer.late_cost
    return lateness, earliness


def overtime(kind: VehicleType, end: int, working: int) -> int:
    """Return how long a vehicle works past its shift or its longest working duration.

    The longer of both, whether that is allowed or not.
    """
    limit = kind.max_working_duration
    return max(0, end - kind.latest, 0 if limit is None else working - limit)


def allowed_overtime(kind: VehicleType) -> int:
    """Return how far a vehicle may work past its shift, and its longest working duration."""
    return 0 if kind.overtime is None else kind.overtime.max_duration


def unassigned_cost(problem: Problem, nodes: Sequence[int]) -> float:
    """Return what leaving out the customers at some nodes costs; others there cost as most do."""
    first, end = problem.num_depots, problem.num_nodes
    if problem.choices:
        nodes = [problem.first_place(node) for node in nodes]
    own = [problem.customers[node - first].unassigned_cost for node in nodes if first <= node < end]
    stated = [cost for cost in own if cost is not None]
    return (len(nodes) - len(stated)) * problem.unassigned_cost + sum(stated)


def _flown_by(kind: VehicleType, index: int, route: Route,
              trips: tuple[TripMetrics, ...]) -> list[SortieMetrics]:
    """Return the flights of drones of one of a vehicle's types."""
    return [measured for trip, metrics in zip(route.trips, trips, strict=True)
            for sortie, measured in zip(trip.sorties, metrics.sorties, strict=True)
            if kind.drone_index(sortie.drone) == index]


def working_duration(kind: VehicleType, route: Route) -> int:
    """Return how long a vehicle works, without unpaid breaks."""
    begin = kind.works_since
    if begin is None:
        begin = first_departure(kind, route.trips[0])
    return route.trips[-1].stops[-1].departure - begin - unpaid(kind, route.trips)


def measure_route(
    problem: Problem, route: Route, trips: tuple[TripMetrics, ...]
) -> tuple[RouteMetrics, Cost]:
    """Return a route's metrics, made from those of its trips, and what it costs."""
    vehicle_type = problem.vehicle_types[route.vehicle_type]
    working, end = working_duration(vehicle_type, route), route.trips[-1].stops[-1].departure
    over = overtime(vehicle_type, end, working)
    over_rate = vehicle_type.overtime.cost_per_hour if vehicle_type.overtime else 0.0
    stops = sum([len(trip.customer_stops) for trip in route.trips]) * vehicle_type.cost_per_stop
    if problem.launch_sites:
        stops += sum([problem.depots[stop.node].stop_cost for trip in route.trips
                      for stop in trip.stops if stop.is_launch_site])
    if problem.vehicle_costs is not None:
        stops += sum([problem.vehicle_cost(route.vehicle_type, node) for node in route.served])
    distance = sum([trip.distance for trip in trips]) * vehicle_type.cost_per_km
    time = working * vehicle_type.cost_per_hour
    if vehicle_type.cost_per_load_km:
        carried = sum([trip.load_distance for trip in trips]) / 10**problem.amount_decimals[0]
        distance += carried * vehicle_type.cost_per_load_km
    for index, drones in enumerate(vehicle_type.drone_types):
        flights = _flown_by(vehicle_type, index, route, trips)
        distance += sum([flight.distance for flight in flights]) * drones.cost_per_km
        time += sum([flight.duration for flight in flights]) * drones.cost_per_hour
    lateness, earliness = _window_costs(problem, route)
    cost = Cost(
        fixed=vehicle_type.fixed_cost, distance=distance / MM_PER_KM,
        stops=stops, time=time / MS_PER_HOUR,
        overtime=over * over_rate / MS_PER_HOUR, lateness=lateness, earliness=earliness)
    limit = vehicle_type.max_working_duration
    rate = None if limit is None else _rate(working, limit)
    return RouteMetrics(working, rate, over, cost.total, trips), cost
