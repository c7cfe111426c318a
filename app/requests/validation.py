"""What the schema can't tell of a request: references, orders and sizes across fields."""

from collections.abc import Collection, Sequence
from itertools import islice

import numpy as np

from app.requests.airspace_validation import airspace_errors
from app.requests.conversion.amounts import amount_errors
from app.requests.customer_validation import (
    group_errors, place_errors, service_errors, vehicle_errors, window_errors,
)
from app.requests.draft import Draft, Errors, Path, are_right, error_at, point_errors
from app.requests.fleet_validation import (
    break_errors, depot_errors, driving_errors, drone_errors, energy_errors, flight_errors,
    hours_errors, shift_errors, speed_errors, turnaround_errors,
)
from app.requests.plan_names import Names
from app.requests.plan_validation import replan_errors
from app.requests.relation_validation import relation_errors
from app.requests.site_validation import site_errors
from app.requests.wind_validation import wind_errors
from app.schemas.customer import CustomerInput
from app.schemas.drones import DronesInput
from app.schemas.errors import InputError, json_path
from app.schemas.fields import point_of
from app.schemas.launch_site import LaunchSiteInput
from app.schemas.request import DepotInput
from app.schemas.rows import Row
from app.schemas.vehicle import VehicleTypeInput
from model.problem import MOST_INCOMPATIBLE

MAX_MATRIX_ERRORS = 20
"""Wrong entries listed per matrix."""

MAX_VEHICLE_ERRORS = 20_000
"""Names of vehicles listed that aren't there: each customer may have hundreds."""


def semantic_errors(draft: Draft, policies: Collection[str] | None) -> list[InputError]:
    """Return every error that the schema can't tell."""
    of_vehicles = list(islice(vehicle_errors(draft), MAX_VEHICLE_ERRORS))
    return [
        *_id_errors("depots", draft.depots),
        *_id_errors("customers", draft.customers),
        *_id_errors("fleet", draft.fleet),
        *_id_errors("launch_sites", draft.launch_sites),
        *site_errors(draft),
        *_emptiness_errors(draft),
        *window_errors(draft),
        *(of_vehicles or group_errors(draft)),
        *service_errors(draft),
        *place_errors(draft),
        *_goods_errors(draft),
        *_fairness_errors(draft),
        *relation_errors(draft),
        *shift_errors(draft),
        *hours_errors(draft),
        *break_errors(draft),
        *driving_errors(draft),
        *_dimension_errors(draft),
        *amount_errors(draft.customers or (), draft.fleet or ()),
        *depot_errors(draft),
        *_matrix_errors(draft),
        *_location_errors(draft),
        *_rounding_errors(draft),
        *_index_errors(draft),
        *speed_errors(draft),
        *drone_errors(draft),
        *energy_errors(draft),
        *turnaround_errors(draft),
        *flight_errors(draft),
        *airspace_errors(draft),
        *wind_errors(draft),
        *_policy_errors(draft, policies),
        *_day_errors(draft),
        *replan_errors(draft.replan, Names.of(draft.depots, draft.customers, draft.fleet,
                                              draft.shipment_ends, draft.launch_sites)),
    ]


def _id_errors(name: str,
               entries: Sequence[DepotInput | CustomerInput | VehicleTypeInput | LaunchSiteInput
                                 | None] | None,
               ) -> Errors:
    seen: dict[str, int] = {}
    for index, entry in enumerate(entries or ()):
        if entry is None:
            continue
        first = seen.setdefault(entry.id, index)
        if first != index:
            yield error_at("DUPLICATE_ID", (name, index, "id"),
                           f"{name}[{first}] has the same id: give each its own.")


def _emptiness_errors(draft: Draft) -> Errors:
    if draft.depots is not None and not draft.depots:
        yield error_at("NO_DEPOT", ("depots",), "There is no depot: add at least one.")
    if draft.fleet is not None and not draft.fleet:
        yield error_at("EMPTY_FLEET", ("fleet",), "There is no vehicle type: add at least one.")


def _goods_errors(draft: Draft) -> Errors:
    named = {goods for each in draft.incompatible_goods for goods in each.goods}
    if len(named) > MOST_INCOMPATIBLE:
        yield error_at("WRONG_LENGTH", ("incompatible_goods",),
                       f"{len(named)} goods are named and at most {MOST_INCOMPATIBLE} are allowed: "
                       "name only those that can't be carried with others.")


def _fairness_errors(draft: Draft) -> Errors:
    if draft.fairness is not None and draft.fleet is not None and None not in draft.fleet:
        count = sum([kind.count for _, kind in draft.vehicle_types()])
        if 0 < count < draft.fairness.min_vehicles:
            yield error_at("TOO_FEW_VEHICLES", ("fairness", "min_vehicles"), f"The fleet has "
                           f"{count} vehicles: state no more, or add some.")


def _dimension_errors(draft: Draft) -> Errors:
    """Compare every amount with the first vehicle type's capacity."""
    amounts: list[tuple[Path, int]] = []
    for path, vehicle_type in draft.vehicle_types():
        amounts.append(((*path, "capacity"), len(vehicle_type.capacity)))
        amounts += [((*path, *inner, "capacity"), len(drones.capacity))
                    for inner, drones in vehicle_type.drones_by_path]
        amounts += [((*path, "breaks", number, "max_load"), len(each.max_load))
                    for number, each in enumerate(vehicle_type.breaks) if each.max_load is not None]
    if not amounts:
        return
    reference, dimensions = amounts[0]
    amounts += [(("customers", index, "demand"), len(customer.demand))
                for index, customer in enumerate(draft.customers or ()) if customer is not None]
    amounts += [(("customers", index, "pickup"), len(customer.pickup))
                for index, customer in enumerate(draft.customers or ())
                if customer is not None and customer.pickup is not None]
    if draft.load_dimensions is not None:
        amounts.append((("load_dimensions",), len(draft.load_dimensions)))
    for path, count in amounts:
        if count != dimensions:
            yield error_at("DIMENSION_MISMATCH", path,
                           f"There are {count} amounts here and {dimensions} in "
                           f"{json_path(reference)}: state as many everywhere.")


def _matrix_errors(draft: Draft) -> Errors:
    for name, matrix in (draft.matrices or {}).items():
        if matrix is None:
            continue
        path: Path = ("matrices", name)
        yield from _table_errors((*path, "durations"), matrix.durations)
        if matrix.distances is not None:
            yield from _table_errors((*path, "distances"), matrix.distances)
            if len(matrix.distances) != len(matrix.durations):
                yield error_at("MATRIX_SIZE", (*path, "distances"),
                               f"There are {len(matrix.distances)} rows here and "
                               f"{len(matrix.durations)} in durations: send both for the same "
                               "places.")
            else:
                yield from _null_errors(path, matrix.durations, matrix.distances)


def _null_errors(path: Path, durations: Sequence[Row], distances: Sequence[Row]) -> Errors:
    """Tell of legs that one table has and the other has not."""
    for index, (seconds, metres) in enumerate(zip(durations, distances, strict=True)):
        if len(seconds) == len(metres):
            unlike = np.flatnonzero(np.isnan(seconds) != np.isnan(metres))
            unlike = unlike[unlike != index]
            if len(unlike):
                yield error_at("MATRIX_NULL", (*path, "distances", index, int(unlike[0])),
                               "durations and distances don't agree on whether there is such a "
                               "leg: state null in both, or in neither.")
                return


def _table_errors(path: Path, table: Sequence[Row]) -> Errors:
    size = len(table)
    if any(len(row) != size for row in table):
        for index, row in enumerate(table):
            if len(row) != size:
                yield error_at("MATRIX_SIZE", (*path, index),
                               f"The matrix has {size} rows and this one has {len(row)} entries: "
                               "make it square, one row and one column per place.")
                return
    if size and any((row < 0).any() for row in table):
        negative = [(i, j) for i, row in enumerate(table)
                    for j in np.flatnonzero(row < 0).tolist()]
        more = f" ({len(negative)} entries of this matrix are.)"
        for i, j in negative[:MAX_MATRIX_ERRORS]:
            yield error_at("MATRIX_NEGATIVE", (*path, i, j),
                           "The entry is negative: state a duration or distance of at least 0."
                           + (more if len(negative) > MAX_MATRIX_ERRORS else ""))


def _location_errors(draft: Draft) -> Errors:
    needed_for = _profile_without_matrix(draft) if draft.matrices_known else None
    for place, path, _ in draft.places(customers=not _are_customers_right(draft)):
        point = point_of(place.location)
        if point is not None:
            yield from point_errors(draft, path, point)
        elif place.location is not None:
            if draft.coordinate_system == "planar":
                yield error_at("ADDRESS_ON_PLANE", path, "Addresses are on the globe: state "
                               "coordinate_system geographic, or [x, y].")
        elif needed_for is not None:
            yield error_at("MISSING_LOCATION", path, f"{needed_for}.")


def _are_customers_right(draft: Draft) -> bool:
    """Tell whether all customers state points, and right ones: quicker than one by one."""
    locations = [customer.location for customer in draft.customers or () if customer is not None]
    if {type(location) for location in locations} != {tuple}:
        return False
    return are_right(draft, np.array(locations))


def _rounding_errors(draft: Draft) -> Errors:
    if draft.coordinate_system == "geographic" and draft.planar_rounding != "exact":
        yield error_at("ROUNDED_ON_GLOBE", ("planar_rounding",),
                       "Distances between geographic locations are not rounded: leave it out, or "
                       "state exact.")


def _profile_without_matrix(draft: Draft) -> str | None:
    """Say which profile needs locations, or None if none is known to."""
    if draft.matrices is None:
        return "Without matrices, every place needs a location: add a location, or the matrix"
    for _, vehicle_type in draft.vehicle_types():
        for profile in _profiles(vehicle_type):
            if profile not in draft.matrices:
                return (f"matrices has no {profile!r}, so legs are computed from locations: add a "
                        "location, or the matrix")
    for path, flyer in draft.flyers():
        is_there = not isinstance(flyer, DronesInput) or flyer.count > 0
        if is_there and flyer.max_range is not None:
            return ("A max_range is measured straight between locations: add a location, or leave "
                    f"out {json_path((*path, 'max_range'))}")
    for name, matrix in draft.matrices.items():
        if matrix is not None and matrix.distances is None:
            return (f"matrices.{name} has no distances, so they are computed from locations: add a "
                    "location, or the matrix")
    return None


def _profiles(vehicle_type: VehicleTypeInput) -> list[str]:
    flying = [drones.profile for drones in vehicle_type.drone_types if drones.count > 0]
    return [vehicle_type.profile, *flying]


def _index_errors(draft: Draft) -> Errors:
    if not draft.matrices:
        return
    sizes = [len(matrix.durations) for matrix in draft.matrices.values() if matrix is not None]
    for place, _, path in draft.places():
        index = place.location_index
        if index is None:
            yield error_at("MISSING_LOCATION_INDEX", path,
                           f"With matrices, every place needs its row: add {path[-1]}.")
        elif sizes and index >= min(sizes):
            yield error_at("MATRIX_SIZE", path,
                           f"The smallest matrix has {min(sizes)} rows, numbered from 0: use a "
                           "smaller index, or send larger matrices.")


def _policy_errors(draft: Draft, policies: Collection[str] | None) -> Errors:
    if policies is None or draft.options is None:
        return
    if draft.options.policy not in policies:
        yield error_at("UNKNOWN_POLICY", ("options", "policy"),
                       f"No policy has this name: use one of {', '.join(sorted(policies))}.")


def _day_errors(draft: Draft) -> Errors:
    if draft.options is not None and draft.options.times in ("iso", "clock") and draft.day is None:
        yield error_at("MISSING_PLAN_START", ("options", "times"),
                       "Without plan_start instants are seconds: add it, or ask for seconds.")
