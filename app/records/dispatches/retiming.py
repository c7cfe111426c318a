"""When a vehicle was where, and will be, by what its driver told.

What was told counts; what lies between is reckoned with the plan's durations. A customer of whom
nothing was told isn't served yet, though one behind was. If the trip has no drones, whose stops
hang together, the driver goes in another order.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from app.records.dispatches.schemas import StepKind
from app.records.dispatches.standing import Standing
from app.records.dispatches.steps import flight_id, stop_ids
from app.schemas.plan import RouteInput, SortieInput, StopInput, TripInput

MOMENT = 60.0
"""Seconds that something takes still which should be over, but of which nothing was told."""

Durations = Mapping[str, float]
"""How long steps take in seconds, by id."""


@dataclass(frozen=True)
class Retimed:
    """A trip in the order and at the times in which it is driven."""

    trip: TripInput
    is_over: bool


def retime(route: RouteInput, standing: Standing, durations: Durations, now: float,
           is_broken: bool = False) -> list[Retimed]:
    """Return the trips of a route as they were and will be driven, seen from `now`.

    A vehicle that has broken down serves nobody of whom it didn't tell.
    """
    begun = [TripTold(index, trip, standing).begun_at for index, trip in enumerate(route.trips)]
    trips, late, end = list[Retimed](), 0.0, 0.0
    for index, trip in enumerate(route.trips):
        later = [time for time in begun[index + 1:] if time is not None]
        told = TripTold(index, trip, standing, is_over=bool(later))
        retimed = _Retiming(told, durations, now, late, is_broken).trip()
        # A trip was over when the next began, whatever was told of it.
        between = _between(retimed.trip, end, min(later, default=math.inf))
        trips.append(Retimed(between, retimed.is_over))
        end = between.stops[-1].departure
        late = max(0.0, end - trip.stops[-1].departure)
    return trips


def _between(trip: TripInput, earliest: float, latest: float) -> TripInput:
    """Return a trip all of whose times lie between two."""
    def moved(entry: Any, *names: str) -> Any:
        times = {name: min(max(getattr(entry, name), earliest), latest) for name in names}
        return entry.model_copy(update=times)

    at_place = "arrival", "service_start", "departure"
    return trip.model_copy(update={
        "stops": tuple([moved(stop, *at_place) for stop in trip.stops]),
        "sorties": tuple([moved(sortie, "launch_time", "recovery_time").model_copy(update={
            "customers": tuple([moved(visit, *at_place) for visit in sortie.customers])})
            for sortie in trip.sorties])})


class TripTold:
    """What was told of a trip. Its stops are numbered as in the plan."""

    def __init__(self, index: int, trip: TripInput, standing: Standing,
                 is_over: bool = False) -> None:
        self.index = index
        self.planned = trip
        self._standing = standing
        ids = [stop_ids(index, trip, number) for number in range(len(trip.stops))]
        for sortie in trip.sorties:
            ids[sortie.launch_stop].append(flight_id(index, "launch", sortie))
            if not self._has_stayed(sortie):
                ids[sortie.recovery_stop].append(flight_id(index, "recover", sortie))
        self._times = [[standing[step].time for step in steps if step in standing]
                       for steps in ids]
        self._is_complete = [len(times) == len(steps)
                             for times, steps in zip(self._times, ids, strict=True)]
        self.is_begun = any(self._times)
        self.begun_at = min((time for times in self._times for time in times), default=None)
        self.order = self._order()
        last = max((place for place, number in enumerate(self.order) if self._times[number]),
                   default=-1)
        # How many stops of that order the truck has left.
        self.left = (len(self.order) if is_over
                     else last + (last >= 0 and self._is_complete[self.order[last]]))

    def has_left(self, number: int) -> bool:
        """Tell whether the truck has left a stop by what was told of others."""
        return self.order.index(number) < self.left

    def is_told(self, number: int) -> bool:
        """Tell whether anything was told of a stop itself, beside its drones."""
        return any(step in self._standing for step in stop_ids(self.index, self.planned, number))

    def latest(self, number: int, otherwise: float) -> float:
        """Return when the truck was elsewhere than at a stop, by what was told of later ones."""
        later = self.order[self.order.index(number) + 1:]
        times = (self.time_at(other) for other in later)
        return min((time for time in times if time is not None), default=otherwise)

    def time_at(self, number: int) -> float | None:
        """Return when the last thing told of a stop was over."""
        return max(self._times[number], default=None)

    def time_of(self, kind: StepKind, sortie: SortieInput) -> float | None:
        """Return when a launch or a recovery was over."""
        told = self._standing.get(flight_id(self.index, kind, sortie))
        return None if told is None else told.time

    def _has_stayed(self, sortie: SortieInput) -> bool:
        """Tell whether a drone was not launched, so that nobody waits for it."""
        launch = self._standing.get(flight_id(self.index, "launch", sortie))
        return launch is not None and launch.outcome == "failed"

    def _order(self) -> list[int]:
        """Return the stops in the order in which they are visited, as far as that was told."""
        stops = self.planned.stops
        plain = list(range(len(stops)))
        if self.planned.sorties or any(stop.kind == "break" for stop in stops):
            return plain
        inner = [number for number in plain if stops[number].kind in ("customer", "launch_site")]
        visited = sorted((number for number in inner if self._times[number]),
                         key=lambda number: max(self._times[number]))
        rest = [number for number in inner if not self._times[number]]
        after = [number for number in plain[1:] if number not in inner]
        if after and self._times[after[-1]]:
            # Back without a word of some: they were visited where the plan has them.
            return plain
        return [0, *visited, *rest, *after]


class _Retiming:
    """Times a trip anew."""

    def __init__(self, told: TripTold, durations: Durations, now: float, late: float,
                 is_broken: bool) -> None:
        self._told = told
        self._durations = durations
        self._now = now
        self._late = late
        self._is_broken = is_broken

    def trip(self) -> Retimed:
        """Return the trip as it is driven."""
        told = self._told
        stops = list[StopInput]()
        for place, number in enumerate(told.order):
            stops.append(self._stop(place, number, stops[-1].departure if stops else None))
        sorties = tuple(self._sortie(sortie, stops) for sortie in told.planned.sorties)
        trip = told.planned.model_copy(update={"stops": tuple(stops), "sorties": sorties})
        return Retimed(trip, told.left == len(stops))

    def _stop(self, place: int, number: int, before: float | None) -> StopInput:
        """Return a stop at the times when it is visited, after the departure before it."""
        stop, told = self._told.planned.stops[number], self._told
        earliest = 0.0 if before is None else before
        if before is None:
            arrival = service = stop.arrival + self._late
        else:
            arrival = before + self._leg(number)
            # Where a window is waited for, it still is.
            opens = stop.service_start if stop.service_start > stop.ready else 0.0
            service = max(arrival + stop.ready - stop.arrival, opens)
        if self._is_broken and place >= told.left and not told.is_told(number):
            service = max(service, self._now + MOMENT)
        departure = service + stop.departure - stop.service_start
        if place < told.left:
            time = told.time_at(number)
            departure = min(departure, told.latest(number, self._now)) if time is None else time
        else:
            departure = max(departure, self._now + MOMENT)
            if stop is told.planned.stops[-1] and stop.kind != "customer":
                arrival = service = departure
        departure = max(departure, earliest)
        # A drone can't take off before it was made ready.
        busy = self._launching(number)
        arrival = max(earliest, min(arrival, departure - busy))
        departure = max(departure, arrival + busy)
        service = max(arrival, min(service, departure))
        return stop.model_copy(update={"arrival": arrival, "service_start": service,
                                       "departure": departure})

    def _sortie(self, sortie: SortieInput, stops: Sequence[StopInput]) -> SortieInput:
        """Return a flight at the times at which it is flown; a truck waits where it says."""
        told = self._told
        launch, recover = told.time_of("launch", sortie), told.time_of("recover", sortie)
        place = stops[sortie.launch_stop]
        lasts = self._launch_duration(sortie)
        has_left = sortie.launch_stop < told.left
        planned = told.planned.stops[sortie.launch_stop]
        time = sortie.launch_time + place.arrival - planned.arrival if launch is None else launch
        if launch is None and recover is None and not has_left:
            time = max(time, self._now + MOMENT + lasts)
        elif recover is not None:
            time = min(time, recover)
        time = max(time, place.arrival + lasts)
        if has_left:
            time = min(time, place.departure)
        shift = time - sortie.launch_time
        recovery = sortie.recovery_time + shift if recover is None else max(recover, time)
        if recover is None and sortie.recovery_stop < told.left:
            recovery = max(time, min(recovery, stops[sortie.recovery_stop].departure))
        visits = tuple(visit.model_copy(update={
            name: max(time, min(getattr(visit, name) + shift, recovery))
            for name in ("arrival", "service_start", "departure")}) for visit in sortie.customers)
        return sortie.model_copy(update={
            "launch_time": time, "recovery_time": recovery, "customers": visits})

    def _leg(self, number: int) -> float:
        """Return how long the way to a stop is, from where the plan comes from."""
        stops = self._told.planned.stops
        return stops[number].arrival - stops[number - 1].departure

    def _launching(self, number: int) -> float:
        """Return how long the longest launch at a stop takes."""
        return max((self._launch_duration(sortie) for sortie in self._told.planned.sorties
                    if sortie.launch_stop == number), default=0.0)

    def _launch_duration(self, sortie: SortieInput) -> float:
        return self._durations.get(flight_id(self._told.index, "launch", sortie), 0.0)
