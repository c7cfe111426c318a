"""What the schema can't tell of a request: references, orders and sizes across fields."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from app.conversion.amounts import amount_errors
from app.conversion.units import thousandths
from app.errors import ErrorCode, InputError, json_path
from app.requests.plan_validation import Names, replan_errors
from app.schemas.request import (
    AirspaceInput,
    CustomerInput,
    DepotInput,
    Location,
    MatrixInput,
    OptionsInput,
    ReplanInput,
    SpeedChangeInput,
    VehicleTypeInput,
)
from model.travel.airspace import Ring, invalid_polygon_reason
from model.travel.matrices import LocalProjection
from model.travel.obstacles import count_crossings

MAX_COORDINATE_M = 1e7
"""Farthest planar coordinate from the origin in metres, a quarter of the way round the earth."""

MAX_AIRSPACE_CORNERS = 1000
"""Most corners of all no-fly areas together."""

MAX_AIRSPACE_CROSSINGS = 10_000
"""How often edges of different no-fly areas may meet: to merge areas takes time for each."""

MAX_MATRIX_ERRORS = 20
"""Wrong entries listed per matrix."""

Path = tuple[str | int, ...]
Place = DepotInput | CustomerInput
Errors = Iterator[InputError]


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

    def places(self) -> Iterator[tuple[Path, Place]]:
        """Yield depots and customers with their paths."""
        for name, entries in (("depots", self.depots), ("customers", self.customers)):
            for index, entry in enumerate(entries or ()):
                if entry is not None:
                    yield (name, index), entry

    def vehicle_types(self) -> Iterator[tuple[Path, VehicleTypeInput]]:
        """Yield vehicle types with their paths."""
        for index, entry in enumerate(self.fleet or ()):
            if entry is not None:
                yield ("fleet", index), entry


def semantic_errors(draft: Draft, policies: Collection[str] | None) -> list[InputError]:
    """Return every error that the schema can't tell."""
    return [
        *_id_errors("depots", draft.depots),
        *_id_errors("customers", draft.customers),
        *_id_errors("fleet", draft.fleet),
        *_emptiness_errors(draft),
        *_window_errors(draft),
        *_dimension_errors(draft),
        *amount_errors(draft.customers or (), draft.fleet or ()),
        *_depot_errors(draft),
        *_matrix_errors(draft),
        *_location_errors(draft),
        *_index_errors(draft),
        *_speed_errors(draft),
        *_airspace_errors(draft),
        *_policy_errors(draft, policies),
        *replan_errors(draft.replan, Names.of(draft.depots, draft.customers, draft.fleet)),
    ]


def _error(code: ErrorCode, path: Path, message: str) -> InputError:
    return InputError(code=code, path=json_path(path), message=message)


def _id_errors(name: str, entries: Sequence[Place | VehicleTypeInput | None] | None) -> Errors:
    seen: dict[str, int] = {}
    for index, entry in enumerate(entries or ()):
        if entry is None:
            continue
        first = seen.setdefault(entry.id, index)
        if first != index:
            yield _error("DUPLICATE_ID", (name, index, "id"),
                         f"{name}[{first}] has the same id: give each its own.")


def _emptiness_errors(draft: Draft) -> Errors:
    if draft.depots is not None and not draft.depots:
        yield _error("NO_DEPOT", ("depots",), "There is no depot: add at least one.")
    if draft.fleet is not None and not draft.fleet:
        yield _error("EMPTY_FLEET", ("fleet",), "There is no vehicle type: add at least one.")


def _window_errors(draft: Draft) -> Errors:
    for index, customer in enumerate(draft.customers or ()):
        if customer is None:
            continue
        window = customer.time_window
        if window.latest is not None and window.latest < window.earliest:
            yield _error("WINDOW_ENDS_BEFORE_START", ("customers", index, "time_window", "latest"),
                         f"The window ends at {window.latest:g} s, before it starts at "
                         f"{window.earliest:g} s: raise latest or lower earliest.")
    for path, vehicle_type in draft.vehicle_types():
        shift = vehicle_type.shift
        if shift.latest is not None and shift.latest < shift.earliest:
            yield _error("SHIFT_ENDS_BEFORE_START", (*path, "shift", "latest"),
                         f"The shift ends at {shift.latest:g} s, before it starts at "
                         f"{shift.earliest:g} s: raise latest or lower earliest.")


def _dimension_errors(draft: Draft) -> Errors:
    """Compare every amount with the first vehicle type's capacity."""
    amounts: list[tuple[Path, int]] = []
    for path, vehicle_type in draft.vehicle_types():
        amounts.append(((*path, "capacity"), len(vehicle_type.capacity)))
        if vehicle_type.drones is not None:
            amounts.append(((*path, "drones", "capacity"), len(vehicle_type.drones.capacity)))
    if not amounts:
        return
    reference, dimensions = amounts[0]
    amounts += [(("customers", index, "demand"), len(customer.demand))
                for index, customer in enumerate(draft.customers or ()) if customer is not None]
    for path, count in amounts:
        if count != dimensions:
            yield _error("DIMENSION_MISMATCH", path,
                         f"There are {count} amounts here and {dimensions} in "
                         f"{json_path(reference)}: state as many everywhere.")


def _depot_errors(draft: Draft) -> Errors:
    if draft.depots is None or None in draft.depots:
        return
    known = {depot.id for depot in draft.depots if depot is not None}
    for path, vehicle_type in draft.vehicle_types():
        if vehicle_type.depot is not None and vehicle_type.depot not in known:
            yield _error("UNKNOWN_DEPOT", (*path, "depot"),
                         f"No depot has the id {vehicle_type.depot!r}: use the id of one in "
                         "depots, or add it there.")


def _matrix_errors(draft: Draft) -> Errors:
    for name, matrix in (draft.matrices or {}).items():
        if matrix is None:
            continue
        path: Path = ("matrices", name)
        yield from _table_errors((*path, "durations"), matrix.durations)
        if matrix.distances is not None:
            yield from _table_errors((*path, "distances"), matrix.distances)
            if len(matrix.distances) != len(matrix.durations):
                yield _error("MATRIX_SIZE", (*path, "distances"),
                             f"There are {len(matrix.distances)} rows here and "
                             f"{len(matrix.durations)} in durations: send both for the same "
                             "places.")


def _table_errors(path: Path, table: list[list[float]]) -> Errors:
    size = len(table)
    if any(len(row) != size for row in table):
        for index, row in enumerate(table):
            if len(row) != size:
                yield _error("MATRIX_SIZE", (*path, index),
                             f"The matrix has {size} rows and this one has {len(row)} entries: "
                             "make it square, one row and one column per place.")
                return
    if size and min(map(min, table)) < 0:
        negative = [(i, j) for i, row in enumerate(table) for j, x in enumerate(row) if x < 0]
        more = f" ({len(negative)} entries of this matrix are.)"
        for i, j in negative[:MAX_MATRIX_ERRORS]:
            yield _error("MATRIX_NEGATIVE", (*path, i, j),
                         "The entry is negative: state a duration or distance of at least 0."
                         + (more if len(negative) > MAX_MATRIX_ERRORS else ""))


def _location_errors(draft: Draft) -> Errors:
    needed_for = _profile_without_matrix(draft) if draft.matrices_known else None
    for path, place in draft.places():
        if place.location is not None:
            yield from _point_errors(draft, (*path, "location"), place.location)
        elif needed_for is not None:
            yield _error("MISSING_LOCATION", (*path, "location"),
                         f"{needed_for}: add a location, or the matrix.")


def _profile_without_matrix(draft: Draft) -> str | None:
    """Say which profile needs locations, or None if none is known to."""
    if draft.matrices is None:
        return "Without matrices, every depot and customer needs a location"
    for _, vehicle_type in draft.vehicle_types():
        for profile in _profiles(vehicle_type):
            if profile not in draft.matrices:
                return f"matrices has no {profile!r}, so legs are computed from locations"
    for name, matrix in draft.matrices.items():
        if matrix is not None and matrix.distances is None:
            return f"matrices.{name} has no distances, so they are computed from locations"
    return None


def _profiles(vehicle_type: VehicleTypeInput) -> list[str]:
    drones = vehicle_type.drones
    flying = [drones.profile] if drones is not None and drones.count > 0 else []
    return [vehicle_type.profile, *flying]


def _point_errors(draft: Draft, path: Path, point: Location) -> Errors:
    if draft.coordinate_system == "geographic":
        longitude, latitude = point
        if not (-180 <= longitude <= 180 and -90 <= latitude <= 90):
            yield _error("LOCATION_OFF_GLOBE", path,
                         "A geographic location is [longitude, latitude] with longitude in "
                         "-180..180 and latitude in -90..90: correct it, or swap the two.")
    elif (draft.coordinate_system == "planar"
          and max(abs(point[0]), abs(point[1])) * draft.planar_unit > MAX_COORDINATE_M):
        yield _error("LOCATION_TOO_FAR", path,
                     f"A planar coordinate lies within {MAX_COORDINATE_M:g} m of the origin: "
                     "check planar_unit, or move the origin nearer.")


def _index_errors(draft: Draft) -> Errors:
    if not draft.matrices:
        return
    sizes = [len(matrix.durations) for matrix in draft.matrices.values() if matrix is not None]
    for path, place in draft.places():
        index = place.location_index
        if index is None:
            yield _error("MISSING_LOCATION_INDEX", (*path, "location_index"),
                         "With matrices, every depot and customer needs its row: add "
                         "location_index.")
        elif sizes and index >= min(sizes):
            yield _error("MATRIX_SIZE", (*path, "location_index"),
                         f"The smallest matrix has {min(sizes)} rows, numbered from 0: use a "
                         "smaller index, or send larger matrices.")


def _speed_errors(draft: Draft) -> Errors:
    for path, vehicle_type in draft.vehicle_types():
        previous = -1
        for index, change in enumerate(vehicle_type.speed_profile):
            here = (*path, "speed_profile", index)
            start = thousandths(change.from_time)
            if start <= previous:
                yield _error("SPEED_PROFILE_ORDER", (*here, "from"),
                             "The entry begins no later than the one before it: sort the entries "
                             "by from, each time once.")
            previous = start
            yield from _speed_change_errors(draft, here, vehicle_type, change)


def _speed_change_errors(draft: Draft, path: Path, vehicle_type: VehicleTypeInput,
                         change: SpeedChangeInput) -> Errors:
    if (change.speed_kmh is None) == (change.factor is None):
        yield _error("MISSING_SPEED" if change.factor is None else "TWO_SPEEDS", path,
                     "An entry has either speed_kmh or factor: state exactly one.")
    elif (change.speed_kmh is not None and vehicle_type.speed_kmh is None
          and vehicle_type.profile in (draft.matrices or {})):
        yield _error("MISSING_SPEED", (*path, "speed_kmh"),
                     "The legs come from a matrix, whose speed is not known: use factor, or state "
                     "speed_kmh of the vehicle type.")


def _airspace_errors(draft: Draft) -> Errors:
    if draft.airspace is None or not draft.airspace.no_fly:
        return
    corners = sum(map(len, draft.airspace.no_fly))
    if corners > MAX_AIRSPACE_CORNERS:
        yield _error("TOO_MANY_CORNERS", ("airspace", "no_fly"),
                     f"The no-fly areas have {corners} corners and at most "
                     f"{MAX_AIRSPACE_CORNERS} are allowed: simplify them.")
        return
    wrong = [error for index, ring in enumerate(draft.airspace.no_fly)
             for number, corner in enumerate(ring)
             for error in _point_errors(draft, ("airspace", "no_fly", index, number), corner)]
    yield from wrong
    if draft.coordinate_system is None or wrong:
        return
    rings = _rings_m(draft, draft.airspace.no_fly)
    invalid = [error for index, ring in enumerate(rings) for error in _ring_errors(index, ring)]
    yield from invalid or _crossing_errors(rings)


def _rings_m(draft: Draft, no_fly: list[list[Location]]) -> list[Ring]:
    """Return the areas' corners in planar metres."""
    corners = np.array([corner for ring in no_fly for corner in ring]) * draft.planar_unit
    if draft.coordinate_system == "geographic":
        places = [place.location for _, place in draft.places() if place.location is not None]
        on_globe = [(x, y) for x, y in places if abs(x) <= 180 and abs(y) <= 90]
        projection = LocalProjection.around(np.array(on_globe or no_fly[0]))
        corners = projection.project(corners / draft.planar_unit)
    together = iter(corners.tolist())
    return [tuple((x, y) for x, y in islice(together, len(ring))) for ring in no_fly]


def _ring_errors(index: int, ring: Ring) -> Errors:
    reason = invalid_polygon_reason(ring)
    if reason is not None:
        yield _error("POLYGON_CROSSES_ITSELF" if "itself" in reason else "POLYGON_WITHOUT_AREA",
                     ("airspace", "no_fly", index),
                     f"{reason[0].upper()}{reason[1:]}: list its corners once each, in order "
                     "around the area.")


def _crossing_errors(rings: list[Ring]) -> Errors:
    crossings = count_crossings(rings)
    if crossings > MAX_AIRSPACE_CROSSINGS:
        yield _error("TOO_MANY_CORNERS", ("airspace", "no_fly"),
                     f"The no-fly areas' edges meet {crossings} times, and at most "
                     f"{MAX_AIRSPACE_CROSSINGS} times are allowed: merge areas that overlap.")


def _policy_errors(draft: Draft, policies: Collection[str] | None) -> Errors:
    if policies is None or draft.options is None:
        return
    if draft.options.policy not in policies:
        yield _error("UNKNOWN_POLICY", ("options", "policy"),
                     f"No policy has this name: use one of {', '.join(sorted(policies))}.")
