"""What given routes violate, as VROOM tells it: by step, by route and of all."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from app.formats.vroom.schemas import VroomBreakInput, VroomRequest, VroomVehicleInput, Windows
from app.formats.vroom.tasks import VroomTask, tasks_of

Data = dict[str, Any]

TIMED = ("lead_time", "delay")
"""What is violated by some seconds."""

Name = tuple[str, int | None]
"""Kind and id of a step."""

Found = tuple[str, int]
"""A cause, and seconds if there are any."""


def add_violations(request: VroomRequest, reply: Data) -> None:
    """Tell in a reply with the routes that `steps` state what they violate. In place."""
    vehicles = {vehicle.id: vehicle for vehicle in request.vehicles}
    tasks: dict[Name, VroomTask] = {(task.kind, task.id): task for task in tasks_of(request)}
    every = []
    for route in reply["routes"]:
        found = _Route(request, vehicles[route["vehicle"]], tasks, route).find()
        every += found
        route["violations"] = _told(found)
    reply["summary"]["violations"] = _told(every)


class _Route:
    """Finds what one route violates."""

    def __init__(self, request: VroomRequest, vehicle: VroomVehicleInput,
                 tasks: Mapping[Name, VroomTask], route: Data) -> None:
        self._request = request
        self._vehicle = vehicle
        self._breaks = {each.id: each for each in vehicle.breaks}
        self._tasks = tasks
        self._ordered = list(tasks.values())
        self._steps: list[Data] = route["steps"]
        self._place = {(step["type"], step["id"]): place
                       for place, step in enumerate(self._steps) if "id" in step}

    def find(self) -> list[Found]:
        """Return what is violated, and tell it of each step. In place."""
        every, tasks = list[Found](), 0
        for place, step in enumerate(self._steps):
            tasks += (step["type"], step.get("id")) in self._tasks
            found = [*self._step(place, step, tasks)]
            step["violations"] = _told(found)
            every += found
        if any(("break", each) not in self._place for each in self._breaks):
            every.append(("missing_break", 0))
        return every

    def _step(self, place: int, step: Data, tasks: int) -> Iterator[Found]:
        vehicle, name = self._vehicle, (step["type"], step.get("id"))
        yield from self._times(step)
        if _exceeds(step.get("load", ()), vehicle.capacity or ()):
            yield "load", 0
        if vehicle.max_travel_time is not None and step["duration"] > vehicle.max_travel_time:
            yield "max_travel_time", 0
        if vehicle.max_distance is not None and step.get("distance", 0) > vehicle.max_distance:
            yield "max_distance", 0
        if name in self._tasks:
            task = self._tasks[name]
            if not set(task.skills) <= set(vehicle.skills):
                yield "skills", 0
            if vehicle.max_tasks is not None and tasks > vehicle.max_tasks:
                yield "max_tasks", 0
            if task.mate is not None and self._is_unpaired(task, place):
                yield "precedence", 0
        if step["type"] == "break":
            most = self._breaks[step["id"]].max_load
            if most is not None and _exceeds(step.get("load", ()), most):
                yield "max_load", 0

    def _times(self, step: Data) -> Iterator[Found]:
        """Yield by how much a step is too early, or too late."""
        time = step["arrival"] + step["waiting_time"]
        shift = self._vehicle.time_window
        if step["type"] in ("start", "end"):
            if shift is not None and step["type"] == "start" and time < shift[0]:
                yield "lead_time", shift[0] - time
            if shift is not None and step["type"] == "end" and time > shift[1]:
                yield "delay", time - shift[1]
            return
        stated: VroomBreakInput | Any = (self._breaks[step["id"]] if step["type"] == "break"
                                         else self._tasks[step["type"], step["id"]].stated)
        yield from _missed(time, stated.time_windows)

    def _is_unpaired(self, task: VroomTask, place: int) -> bool:
        """Tell whether a shipment's other end isn't on the route where it should be."""
        other = self._ordered[task.mate or 0]
        where = self._place.get((other.kind, other.id))
        return where is None or (where > place) != (task.kind == "pickup")


def _missed(time: int, windows: Windows | None) -> Iterator[Found]:
    """Yield by how much the nearest of some windows is missed, if all are."""
    if windows is None or any(begin <= time <= end for begin, end in windows):
        return
    yield min((("lead_time", begin - time) if time < begin else ("delay", time - end)
               for begin, end in windows), key=lambda found: found[1])


def _exceeds(load: Iterable[int], most: Iterable[int]) -> bool:
    return any(each > limit for each, limit in zip(load, most, strict=False))


def _told(found: Iterable[Found]) -> list[Data]:
    """Return each cause once, as VROOM tells it, with all its seconds."""
    seconds: dict[str, int] = {}
    for cause, more in found:
        seconds[cause] = seconds.get(cause, 0) + more
    return [{"duration": each, "cause": cause} if cause in TIMED else {"cause": cause}
            for cause, each in seconds.items()]
