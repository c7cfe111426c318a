"""The parts of a request that fit the schema, and what is said of those that don't make sense."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from app.requests.conversion.places import Place, stands_of
from app.schemas.airspace import AirspaceInput
from app.schemas.customer import CustomerInput
from app.schemas.day import Day
from app.schemas.drones import DronesInput, Flyer
from app.schemas.errors import ErrorCode, InputError, json_path
from app.schemas.fairness import FairnessInput
from app.schemas.fields import Location
from app.schemas.launch_site import LaunchSiteInput
from app.schemas.relation import RelationInput
from app.schemas.request import (
    DepotInput, IncompatibleGoodsInput, LoadDimensionInput, MatrixInput, OptionsInput,
    ReplanInput,
)
from app.schemas.vehicle import VehicleTypeInput
from model.problem import FloatArray

MAX_COORDINATE_M = 1e7
"""Farthest planar coordinate from the origin in metres, a quarter of the way round the earth."""

DAY_SECONDS = 86_400

LEAST_NIGHT = 6 * 3600
"""Seconds by which an end lies before its start that may be meant for the next day's."""

Path = tuple[str | int, ...]
Errors = Iterator[InputError]


class Placed(NamedTuple):
    """A place of a request, and the paths of where it is."""

    place: Place
    location: Path
    location_index: Path


@dataclass(frozen=True)
class Draft:
    """The parts of a request that fit the schema; None stands for one that doesn't.

    `matrices` is None if there are none, or if `matrices_known` is False.
    """

    coordinate_system: str | None
    planar_unit: float
    depots: Sequence[DepotInput | None] | None
    customers: Sequence[CustomerInput | None] | None
    fleet: Sequence[VehicleTypeInput | None] | None
    matrices: Mapping[str, MatrixInput | None] | None
    matrices_known: bool
    airspace: AirspaceInput | None
    options: OptionsInput | None
    replan: ReplanInput | None = None
    planar_rounding: str = "exact"
    load_dimensions: Sequence[LoadDimensionInput] | None = None
    day: Day | None = None
    incompatible_goods: Sequence[IncompatibleGoodsInput] = ()
    launch_sites: Sequence[LaunchSiteInput | None] | None = ()
    fairness: FairnessInput | None = None
    relations: Sequence[RelationInput] = ()
    shipment_ends: frozenset[str] = frozenset()  # names among customers
    delivery_of: Mapping[str, str] = field(default_factory=dict)  # by name of any end
    added: frozenset[str] = frozenset()  # names among customers of ends, and of other places

    def places(self, customers: bool = True) -> Iterator[Placed]:
        """Yield depots, launch sites, customers unless they are not asked for, and where vehicles
        start and end.
        """
        asked = self.customers if customers else ()
        for name, entries in (("depots", self.depots), ("launch_sites", self.launch_sites),
                              ("customers", asked)):
            for index, entry in enumerate(entries or ()):
                if entry is not None:
                    yield Placed(entry, (name, index, "location"), (name, index, "location_index"))
        for path, kind in self.vehicle_types():
            for stand in stands_of(kind):
                yield Placed(stand.place, (*path, *stand.location), (*path, *stand.location_index))

    def known_customers(self) -> Iterator[tuple[Path, CustomerInput]]:
        """Yield customers with their paths."""
        for index, entry in enumerate(self.customers or ()):
            if entry is not None:
                yield ("customers", index), entry

    def known_launch_sites(self) -> Iterator[tuple[Path, LaunchSiteInput]]:
        """Yield launch sites with their paths."""
        for index, entry in enumerate(self.launch_sites or ()):
            if entry is not None:
                yield ("launch_sites", index), entry

    def vehicle_types(self) -> Iterator[tuple[Path, VehicleTypeInput]]:
        """Yield vehicle types with their paths."""
        for index, entry in enumerate(self.fleet or ()):
            if entry is not None:
                yield ("fleet", index), entry

    def drone_types(self) -> Iterator[tuple[Path, DronesInput]]:
        """Yield types of drones with their paths."""
        for path, kind in self.vehicle_types():
            for inner, drones in kind.drones_by_path:
                yield (*path, *inner), drones

    def flyers(self) -> Iterator[tuple[Path, Flyer]]:
        """Yield what flies, types of drones and of vehicles, with their paths."""
        yield from self.drone_types()
        for path, kind in self.vehicle_types():
            if kind.flies:
                yield path, kind

    def told(self, seconds: float) -> str:
        """Return an instant in words: a time of the plan's day if it has one, beside its seconds.
        """
        stated = f"{seconds:g} s"
        return stated if self.day is None else f"{self.day.on_the_clock(seconds)} ({stated})"

    def next_day(self, earliest: float, latest: float) -> str:
        """Return how what ends before it starts is written if it ends on the day after; or nothing.
        """
        if not earliest < latest + DAY_SECONDS:
            return ""
        if self.day is not None:
            return f"if it ends on the next day, state {self.day.a_day_after(latest)}, else "
        if earliest - latest < LEAST_NIGHT:
            return ""
        return (f"if it ends on the next day, state {latest + DAY_SECONDS:g} (+1 and a time of day "
                "where there is a plan_start), else ")


def error_at(code: ErrorCode, path: Path, message: str) -> InputError:
    """Return an error of a part of a request."""
    return InputError(code=code, path=json_path(path), message=message)


def are_right(draft: Draft, points: FloatArray) -> bool:
    """Tell whether nothing is wrong with any of some (point, 2), as `point_errors` would say it."""
    if draft.coordinate_system == "geographic":
        return bool((np.abs(points) <= (180.0, 90.0)).all())
    return (draft.coordinate_system != "planar"
            or bool((np.abs(points) * draft.planar_unit <= MAX_COORDINATE_M).all()))


def point_errors(draft: Draft, path: Path, point: Location) -> Errors:
    """Say what is wrong with a point, if anything is."""
    if draft.coordinate_system == "geographic":
        longitude, latitude = point
        if not (-180 <= longitude <= 180 and -90 <= latitude <= 90):
            yield error_at("LOCATION_OFF_GLOBE", path,
                           "A geographic location is [longitude, latitude] with longitude in "
                           "-180..180 and latitude in -90..90: correct it, or swap the two.")
    elif (draft.coordinate_system == "planar"
          and max(abs(point[0]), abs(point[1])) * draft.planar_unit > MAX_COORDINATE_M):
        yield error_at("LOCATION_TOO_FAR", path,
                       f"A planar coordinate lies within {MAX_COORDINATE_M:g} m of the origin: "
                       "check planar_unit, or move the origin nearer.")
