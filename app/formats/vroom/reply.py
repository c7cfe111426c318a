"""Routes -> VROOM's reply, as plain data."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import polyline

from app.formats.vroom.places import StatedPlaces
from app.formats.vroom.schemas import VroomBreakInput, VroomPlaceInput, VroomRequest
from app.formats.vroom.tasks import tasks_of
from app.formats.vroom.translate import breaks_of
from model.dialects.vroom.places import NOWHERE
from model.dialects.vroom.timing import COST_SCALE, TimedVroomRoute
from model.dialects.vroom.windows import TIME_SCALE

Data = dict[str, Any]

SECONDS_PER_HOUR = 3600
METRES_PER_KM = 1000


class ReplyWriter:
    """Writes the reply to one request."""

    def __init__(self, request: VroomRequest, places: StatedPlaces, is_timed: bool,
                 reasons: Mapping[int, list[str]] | None = None) -> None:
        """Begin with what is asked for.

        Parameters
        ----------
        is_timed
            Whether anything in it has a time window.
        reasons
            Why tasks are left out, as far as it is known.
        """
        self._reasons = reasons or {}
        self._request = request
        self._places = places
        self._tasks = tasks_of(request)
        self._num_amounts = len(request.vehicles[0].capacity or ())
        self._is_timed = is_timed

    def reply(self, routes: Sequence[TimedVroomRoute], loading: int, solving: int) -> Data:
        """Return the reply.

        Parameters
        ----------
        routes
            Of the vehicles used, in the request's order.
        loading, solving
            Milliseconds for the reply to report.
        """
        written = [self._route(route) for route in routes]
        served = {job for route in routes for job in route.jobs}
        unassigned = [self._unassigned(job) for job in range(len(self._tasks))
                      if job not in served]
        return {
            "code": 0,
            "summary": {
                **_totals(written, ("cost",)),
                "routes": len(written),
                "unassigned": len(unassigned),
                **self._amounts(served),
                **_totals(written, ("setup", "service", "duration", "waiting_time", "priority")),
                **(_totals(written, ("distance",)) if self._places.tells_distances else {}),
                "violations": [],
                "computing_times": {"loading": loading, "solving": solving, "routing": 0},
            },
            "unassigned": unassigned,
            "routes": written,
        }

    def _route(self, route: TimedVroomRoute) -> Data:
        vehicle = self._request.vehicles[route.vehicle]
        steps = self._steps(route)
        setup = sum(step.setup for step in route.steps)
        service = (sum(step.service for step in route.steps)
                   + sum(rest.duration for rest in route.rests))
        return {
            "vehicle": vehicle.id,
            "cost": self._cost(route, steps[-1]["duration"], setup + service),
            **_described(vehicle.description),
            **self._amounts(route.jobs),
            "setup": setup // TIME_SCALE,
            "service": service // TIME_SCALE,
            "duration": steps[-1]["duration"],
            "waiting_time": sum(step["waiting_time"] for step in steps),
            "priority": sum(self._tasks[job].priority for job in route.jobs),
            **self._distance(route.distances[-1]),
            "steps": steps,
            "violations": [],
            **self._geometry(steps),
        }

    def _cost(self, route: TimedVroomRoute, duration: int, task_time: int) -> int:
        """Return a route's cost, rounded where VROOM rounds."""
        costs = self._request.vehicles[route.vehicle].costs
        legs = self._places.legs[self._request.vehicles[route.vehicle].profile]
        travel = route.travel_cost // COST_SCALE
        if self._is_timed and legs.costs is None:
            travel = int(duration * costs.per_hour / SECONDS_PER_HOUR
                         + route.distances[-1] * costs.per_km / METRES_PER_KM + 0.5)
        return costs.fixed + travel + costs.per_task_hour * task_time // COST_SCALE

    def _steps(self, route: TimedVroomRoute) -> list[Data]:
        places, vehicle = self._places, route.vehicle
        sites = [int(places.jobs[job]) for job in route.jobs]
        known = [site for site in (int(places.starts[vehicle]), *sites, int(places.ends[vehicle]))
                 if site != NOWHERE]
        loads = self._loads(route.jobs)
        start = self._step("start", known[0], loads[0], route.departure // TIME_SCALE)
        steps = [{**start, "duration": 0, "violations": [], **self._distance(0)}]
        for gap, load in enumerate(loads):
            steps += self._rests(route, gap, load, steps[-1])
            if gap < len(sites):
                served = route.steps[gap]
                task = self._tasks[served.job]
                arrival, begin = served.arrival // TIME_SCALE, served.start // TIME_SCALE
                times = (served.setup // TIME_SCALE, served.service // TIME_SCALE, begin - arrival)
                step = self._step(task.kind, sites[gap], loads[gap + 1], arrival, task.stated,
                                  times)
            else:
                step = self._step("end", known[-1], load, route.end // TIME_SCALE)
            steps.append({**step, "duration": self._duration(steps[-1], step, route.travels[gap]),
                          "violations": [], **self._distance(route.distances[gap])})
        return steps

    def _rests(self, route: TimedVroomRoute, gap: int, load: Sequence[int],
               before: Data) -> Iterator[Data]:
        """Yield the breaks in a gap of a route, behind the step before."""
        breaks = breaks_of(self._request.vehicles[route.vehicle])
        travelled, way = ((route.travels[gap - 1], route.distances[gap - 1]) if gap else (0, 0))
        leg, metres = route.travels[gap] - travelled, route.distances[gap] - way
        for rest in route.rests:
            if rest.gap == gap:
                arrival = rest.arrival // TIME_SCALE
                times = (0, rest.duration // TIME_SCALE, rest.start // TIME_SCALE - arrival)
                step = self._step("break", None, load, arrival, breaks[rest.number], times)
                driven = metres * rest.travel / leg if leg else 0.0
                before = {**step, "duration": self._duration(before, step, 0), "violations": [],
                          **self._distance(way + math.floor(driven + 0.5))}
                yield before

    def _loads(self, jobs: Sequence[int]) -> list[list[int]]:
        """Return what is aboard at the start, and behind each job."""
        tasks = [self._tasks[job] for job in jobs]
        loads = [self._sum(task.delivery for task in tasks if task.kind == "job")]
        for task in tasks:
            loads.append([amount + taken - brought for amount, taken, brought
                          in zip(loads[-1], self._amount(task.pickup),
                                 self._amount(task.delivery), strict=True)])
        return loads

    def _duration(self, before: Data, step: Data, travel: int) -> int:
        """Return the travel time up to a step; with windows, what makes all seconds add up."""
        if not self._is_timed:
            return travel // TIME_SCALE
        left = before["arrival"] + before["waiting_time"] + before["setup"] + before["service"]
        duration: int = before["duration"] + step["arrival"] - left
        return duration

    def _step(self, kind: str, site: int | None, load: Sequence[int], arrival: int,
              stated: VroomPlaceInput | VroomBreakInput | None = None,
              times: tuple[int, int, int] = (0, 0, 0)) -> Data:
        setup, service, waiting = times
        return {
            "type": kind,
            **_described("" if stated is None else stated.description),
            **({} if site is None else self._place(site)),
            **({} if stated is None else {"id": stated.id}),
            "setup": setup,
            "service": service,
            "waiting_time": waiting,
            **({} if stated is None or kind == "break" else {"job": stated.id}),
            **({"load": list(load)} if self._num_amounts else {}),
            "arrival": arrival,
        }

    def _unassigned(self, index: int) -> Data:
        task = self._tasks[index]
        return {"id": task.id, **self._place(int(self._places.jobs[index])), "type": task.kind,
                **_described(task.stated.description),
                **({"reasons": self._reasons[index]} if index in self._reasons else {})}

    def _place(self, site: int) -> Data:
        point, index = self._places.coordinates[site], self._places.indices[site]
        return {**({} if point is None else {"location": list(point)}),
                **({} if index is None else {"location_index": index})}

    def _amounts(self, jobs: Iterable[int]) -> Data:
        if not self._num_amounts:
            return {}
        tasks = [self._tasks[job] for job in jobs]
        delivery = self._sum(task.delivery for task in tasks)
        return {"delivery": delivery, "amount": delivery,
                "pickup": self._sum(task.pickup for task in tasks)}

    def _sum(self, amounts: Iterable[Sequence[int]]) -> list[int]:
        return [sum(column) for column in
                zip([0] * self._num_amounts, *map(self._amount, amounts), strict=True)]

    def _amount(self, stated: Sequence[int]) -> Sequence[int]:
        return stated or [0] * self._num_amounts

    def _distance(self, metres: int) -> Data:
        return {"distance": metres} if self._places.tells_distances else {}

    def _geometry(self, steps: list[Data]) -> Data:
        """Return straight lines between the steps, if they are asked for."""
        if not self._request.options.g:
            return {}
        points = [(latitude, longitude) for longitude, latitude
                  in (step["location"] for step in steps if "location" in step)]
        return {"geometry": polyline.encode(points)}


def _totals(routes: list[Data], names: tuple[str, ...]) -> Data:
    return {name: sum(route[name] for route in routes) for name in names}


def _described(text: str) -> Data:
    return {"description": text} if text else {}
