"""What vehicles and drones do when: rows of bars. Times in seconds since plan start."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import inf
from typing import Literal

from app.plans.pictures.scene import DrawnPlan
from app.requests.conversion.launches import drones_of_sortie, launch_durations
from app.requests.conversion.names import number_in
from app.requests.conversion.units import whole
from app.schemas.drones import DronesInput
from app.schemas.plan import RouteInput, SortieInput, StopInput, TripInput
from app.schemas.vehicle import VehicleTypeInput

Activity = Literal["drive", "wait", "serve", "fly", "launch", "reload", "rest"]


@dataclass(frozen=True)
class Bar:
    """One activity."""

    activity: Activity
    start: float
    end: float
    trip: int


@dataclass(frozen=True)
class Window:
    """A customer's time window, as far as it is stated, and when service began."""

    earliest: float
    latest: float | None
    service_start: float
    is_late: bool


@dataclass(frozen=True)
class ActivityRow:
    """One vehicle's or drone's day."""

    name: str
    route: int
    is_drone: bool
    bars: tuple[Bar, ...]
    windows: tuple[Window, ...]

    @cached_property
    def lanes(self) -> tuple[int, ...]:
        """A lane for each window, so that none covers another."""
        lanes = [0] * len(self.windows)
        taken_until: list[float] = []
        for index in sorted(range(len(lanes)), key=lambda index: self.windows[index].earliest):
            window = self.windows[index]
            lane = next((lane for lane, time in enumerate(taken_until)
                         if time < window.earliest), len(taken_until))
            latest = inf if window.latest is None else window.latest
            taken_until[lane:lane + 1] = [max(latest, window.service_start)]
            lanes[index] = lane
        return tuple(lanes)


def rows_of(scene: DrawnPlan) -> list[ActivityRow]:
    """Return a row per vehicle used, each followed by one per drone that it carries."""
    rows = []
    for index, route in enumerate(scene.plan.routes):
        kind = scene.types[route.type]
        bars = tuple(bar for bar in _truck_bars(scene, route, kind) if bar.end >= bar.start)
        windows = [_window(scene, stop.id, stop.ready, stop.service_start)
                   for trip in route.trips for stop in trip.stops if stop.kind == "customer"]
        rows.append(ActivityRow(scene.called(route.vehicle), index, False, bars, _stated(windows)))
        rows += [_drone_row(scene, index, route, drone, kind)
                 for drone in range(_num_drones(route, kind))]
    return rows


def _num_drones(route: RouteInput, kind: VehicleTypeInput) -> int:
    """Return how many drones a vehicle carries, or flies if a plan has more."""
    used = [number_in(f"{route.vehicle}/drone-", sortie.drone) or 0
            for trip in route.trips for sortie in trip.sorties]
    return max([sum(drones.count for drones in kind.drone_types),
                *(number + 1 for number in used)])


def _truck_bars(scene: DrawnPlan, route: RouteInput, kind: VehicleTypeInput) -> Iterator[Bar]:
    end: float | None = None
    for number, trip in enumerate(route.trips):
        loaded = trip.stops[0].arrival
        if end is not None:
            yield Bar("reload", max(end, loaded - kind.reload_duration), loaded, number)
        for before, stop in pairwise(trip.stops):
            yield Bar("drive", before.departure, stop.arrival, number)
        for stop in trip.stops:
            yield from _halt_bars(scene, kind.id, stop, number)
        yield from _handling_bars(trip, number, kind)
        end = trip.stops[-1].departure


def _halt_bars(scene: DrawnPlan, kind: str, stop: StopInput, trip: int) -> Iterator[Bar]:
    if stop.kind == "break":
        yield Bar("rest", stop.service_start, stop.departure, trip)
    elif stop.departure > stop.arrival:
        yield Bar("wait", stop.arrival, stop.departure, trip)
    if stop.kind == "customer":
        customer = scene.customers[stop.id]
        duration = customer.service_duration_by_type.get(kind, customer.service_duration)
        yield Bar("serve", stop.service_start,
                  min(stop.service_start + duration, stop.departure), trip)


def _handling_bars(trip: TripInput, number: int, kind: VehicleTypeInput) -> Iterator[Bar]:
    for sortie, launch in zip(trip.sorties, launch_durations(kind, trip), strict=True):
        drones = drones_of_sortie(kind, sortie)
        if drones is not None:
            yield from _ends(sortie, number, drones, whole(launch))


def _ends(sortie: SortieInput, trip: int, drones: DronesInput, launch: float) -> Iterator[Bar]:
    """Yield launch, which takes so long, and recovery."""
    yield Bar("launch", sortie.launch_time - launch, sortie.launch_time, trip)
    yield Bar("launch", sortie.recovery_time - drones.recovery_duration, sortie.recovery_time,
              trip)


def _drone_row(scene: DrawnPlan, index: int, route: RouteInput, drone: int,
               kind: VehicleTypeInput) -> ActivityRow:
    name = f"{route.vehicle}/drone-{drone + 1}"
    bars: list[Bar] = []
    windows = []
    for number, trip in enumerate(route.trips):
        for sortie, launch in zip(trip.sorties, launch_durations(kind, trip), strict=True):
            if sortie.drone == name:
                drones = drones_of_sortie(kind, sortie)
                bars += _flight_bars(sortie, number, drones, whole(launch))
                windows += [_window(scene, visit.id, visit.ready, visit.service_start)
                            for visit in sortie.customers]
    return ActivityRow(name, index, True, tuple(bar for bar in bars if bar.end >= bar.start),
                       _stated(windows))


def _flight_bars(sortie: SortieInput, trip: int, drones: DronesInput | None,
                 launch: float) -> Iterator[Bar]:
    recovery = 0.0 if drones is None else drones.recovery_duration
    yield Bar("fly", sortie.launch_time, sortie.recovery_time - recovery, trip)
    for visit in sortie.customers:
        if visit.service_start > visit.arrival:
            yield Bar("wait", visit.arrival, visit.service_start, trip)
        yield Bar("serve", visit.service_start, visit.departure, trip)
    if drones is not None:
        yield from _ends(sortie, trip, drones, launch)


def _window(scene: DrawnPlan, customer: str, ready: float, service_start: float) -> Window | None:
    """Return the customer's window in which service began, if any is stated."""
    windows = scene.customers[customer].windows
    window = next((window for window in reversed(windows) if window.earliest <= service_start),
                  windows[0])
    if window.latest is None and not window.earliest:
        return None
    is_late = window.latest is not None and ready > window.latest
    return Window(window.earliest, window.latest, service_start, is_late)


def _stated(windows: list[Window | None]) -> tuple[Window, ...]:
    return tuple(window for window in windows if window is not None)
