"""The limits that requests state by a number: a row each.

By these rows it is told what a unit more of one would save, what would have to be otherwise for
somebody to be served, where the request says so, and in which words. Whether one is kept, the judge
and the engine say, each by itself. What isn't a number of one owner has a function of its own where
it is told: windows, amounts of several dimensions, batteries by their weight.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal

from model.problem.quantities import MM_PER_KM, MS_PER_HOUR, UNLIMITED, units_of

Whose = Literal["customer", "shipment", "vehicle_type", "flyer", "drones"]
"""`flyer`: drones, or a vehicle that flies by itself; `drones`: those alone that a vehicle has."""


@dataclass(frozen=True)
class CountedIn:
    """What people count a limit in, and how many of the problem's own that is."""

    name: Literal["minute", "km", "unit"]
    size: int


MINUTE, KM = CountedIn("minute", MS_PER_HOUR // 60), CountedIn("km", MM_PER_KM)
ONE = CountedIn("unit", 1)


@dataclass(frozen=True)
class StatedLimit:
    """A limit."""

    whose: Whose
    path: str  # where requests have it, from its owner on
    step: CountedIn
    words: str = ""  # what suffices, by `quantity`, `of` whom, and `s` of several; "": not offered
    field: str = ""  # where problems have it, if it is named otherwise there
    is_total: bool = False  # what suffices is told as a whole, not how much more it is
    is_instant: bool = False

    def of(self, owner: Any) -> int | None:
        """Return how much it is; None: it isn't limited."""
        for name in self._names:
            owner = None if owner is None else getattr(owner, name)
        return None if owner is None or owner >= UNLIMITED else int(owner)

    def raised(self, owner: Any, more: int) -> Any:
        """Return its owner with so much more of it, as far as a problem may state that."""
        return _raised(owner, self._names, more)

    @property
    def _names(self) -> list[str]:
        return (self.field or self.path).split(".")


def _raised(owner: Any, names: list[str], more: int) -> Any:
    name, *inner = names
    value = getattr(owner, name)
    if inner:
        return replace(owner, **{name: _raised(value, inner, more)})
    kind: Any = type(owner)
    return replace(owner, **{name: min(value + more, int(units_of(kind)[name].most))})


LIMITS = {
    "time_aboard": StatedLimit("customer", "max_time_aboard", MINUTE,
                               "if it could be aboard {quantity} longer"),
    "time_between": StatedLimit("shipment", "max_time_between", MINUTE,
                                "if max_time_between were at least {quantity}", is_total=True),
    "shift": StatedLimit("vehicle_type", "shift.latest", MINUTE,
                         "if {of}'s shift ended {quantity} later", "latest", is_instant=True),
    "work": StatedLimit("vehicle_type", "max_working_duration", MINUTE,
                        "if {of} could work {quantity} longer"),
    "travel": StatedLimit("vehicle_type", "max_travel_duration", MINUTE,
                          "if {of} could travel {quantity} longer"),
    "overtime": StatedLimit("vehicle_type", "overtime.max_duration", MINUTE,
                            "if {of} could work {quantity} more overtime"),
    "stops": StatedLimit("vehicle_type", "max_stops", ONE,
                         "if {of} could make {quantity} stop{s}", is_total=True),
    "sorties": StatedLimit("vehicle_type", "max_sorties", ONE,
                           "if {of} could launch {quantity} sortie{s}", is_total=True),
    "driving": StatedLimit("vehicle_type", "driving_rules.max_driving", MINUTE,
                           "if {of}'s drivers could drive {quantity} without a rest",
                           "driving.max_driving", is_total=True),
    "work_spell": StatedLimit("vehicle_type", "driving_rules.max_work_before_break", MINUTE,
                              "if {of}'s drivers could work {quantity} without a rest",
                              "driving.max_work", is_total=True),
    "driving_day": StatedLimit("vehicle_type", "driving_rules.max_driving_per_day", MINUTE,
                               "if {of}'s drivers could drive {quantity} a day",
                               "driving.max_driving_per_day", is_total=True),
    "trip_distance": StatedLimit("vehicle_type", "max_trip_distance", KM,
                                 "if trips could be {quantity} longer"),
    "distance": StatedLimit("vehicle_type", "max_distance", KM,
                            "if {of} could drive {quantity} farther"),
    "endurance": StatedLimit("flyer", "endurance", MINUTE,
                             "if endurance{of} were {quantity} longer"),
    "range": StatedLimit("flyer", "max_range", KM, "if max_range{of} were {quantity} longer"),
    "batteries_aboard": StatedLimit("drones", "turnaround.batteries", ONE, field="batteries",
                                     is_total=True),
}
"""By what remedies call them."""


def limits_of(owner: Any, *whose: Whose) -> Iterator[tuple[str, StatedLimit, int]]:
    """Yield the limits that an owner states: their names, and how much each is."""
    for name, limit in LIMITS.items():
        if limit.whose in whose and (value := limit.of(owner)) is not None:
            yield name, limit, value
