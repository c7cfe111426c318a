"""What the schema can't tell of a customer."""

from collections.abc import Sequence
from itertools import islice, pairwise
from typing import TypeVar

from app.requests.conversion.groups import Roster, groups_of
from app.requests.conversion.names import drones_of
from app.requests.conversion.units import thousandths
from app.requests.draft import Draft, Errors, Path, error_at
from app.schemas.customer import TimeWindowInput, VehiclesInput, place_name

Entry = TypeVar("Entry")

MAX_GROUPS = 200
"""Most groups of vehicles that customers tell apart; memory and time grow by them."""


def window_errors(draft: Draft) -> Errors:
    """Say which windows end before they start, or aren't one after another."""
    for path, customer in draft.known_customers():
        if customer.time_windows is None:
            if _ends_early(customer.time_window):
                yield from _order_errors(draft, (*path, "time_window"), customer.time_window)
            yield from _price_errors((*path, "time_window"), customer.time_window)
            continue
        if customer.time_window != TimeWindowInput():
            yield error_at("TWO_KINDS_OF_WINDOWS", (*path, "time_windows"),
                           "There is a time_window, too: state one of both.")
        for index, window in enumerate(customer.time_windows):
            yield from _order_errors(draft, (*path, "time_windows", index), window)
            yield from _price_errors((*path, "time_windows", index), window)
        yield from _sequence_errors(draft, (*path, "time_windows"), customer.time_windows)


def place_errors(draft: Draft) -> Errors:
    """Say which other places can't be told from customers by their names."""
    for path, customer in draft.known_customers():
        for index, place in enumerate(customer.alternatives):
            if customer.id.endswith(place_name("", place.id)):
                yield error_at("DUPLICATE_ID", (*path, "alternatives", index, "id"),
                               f"The customer's own id ends in {place_name('', place.id)!r}: give "
                               "the place another.")


def vehicle_errors(draft: Draft) -> Errors:
    """Say which vehicles that customers name aren't there, and which are told in two ways."""
    fleet = _whole(draft.fleet)
    roster = None if fleet is None else Roster(fleet)
    choosy: list[tuple[Path, VehiclesInput | None]] = [
        *((path, customer.vehicles) for path, customer in draft.known_customers()),
        *((path, site.vehicles) for path, site in draft.known_launch_sites())]
    for path, vehicles in choosy:
        if vehicles is None:
            continue
        if vehicles.allowed is not None and vehicles.forbidden is not None:
            yield error_at("TWO_LISTS_OF_VEHICLES", (*path, "vehicles"),
                           "Vehicles are either allowed or forbidden: state one of both.")
            continue
        listed = "forbidden" if vehicles.allowed is None else "allowed"
        for index, name in enumerate(vehicles.names):
            if roster is not None and roster.find(name) is None:
                yield error_at("UNKNOWN_VEHICLE", (*path, "vehicles", listed, index),
                               _unknown(name))
    for path, customer in draft.known_customers():
        for name in customer.vehicle_costs:
            if roster is not None and roster.find(name) is None:
                yield error_at("UNKNOWN_VEHICLE", (*path, "vehicle_costs", name), _unknown(name))


def _unknown(name: str) -> str:
    return (f"The fleet has no type or vehicle {name!r}: use a type's id, or that, '-' and a "
            "number from 1 to its count.")


def group_errors(draft: Draft) -> Errors:
    """Say whether customers tell too many groups of vehicles apart, if all else is right."""
    fleet, customers = _whole(draft.fleet), _whole(draft.customers)
    sites = _whole(draft.launch_sites)
    if fleet is None or customers is None or sites is None:
        return
    groups = groups_of(fleet, [*customers, *sites])
    if sum(1 for _ in islice(groups, MAX_GROUPS + 1)) > MAX_GROUPS:
        yield error_at("TOO_MANY_GROUPS", ("customers",),
                       f"By their vehicles, customers tell more than {MAX_GROUPS} groups of "
                       "vehicles apart: name types, or fewer vehicles.")


def _whole(entries: Sequence[Entry | None] | None) -> list[Entry] | None:
    """Return entries, if none is broken."""
    known = [entry for entry in entries or () if entry is not None]
    return known if entries is not None and len(known) == len(entries) else None


def _ends_early(window: TimeWindowInput) -> bool:
    return window.latest is not None and window.latest < window.earliest


def _order_errors(draft: Draft, path: Path, window: TimeWindowInput) -> Errors:
    earliest, latest = window.earliest, window.latest
    if latest is not None and latest < earliest:
        yield error_at("WINDOW_ENDS_BEFORE_START", (*path, "latest"),
                       f"The window ends at {draft.told(latest)}, before it starts at "
                       f"{draft.told(earliest)}: {draft.next_day(earliest, latest)}raise latest "
                       "or lower earliest.")


def _price_errors(path: Path, window: TimeWindowInput) -> Errors:
    if window.late_cost > 0 and window.late_cost_per_hour is None:
        yield error_at("LATE_COST_OF_HARD_WINDOW", (*path, "late_cost"),
                       "Nobody may be late where late_cost_per_hour isn't stated: state it too, 0 "
                       "if only being late at all costs.")


def _sequence_errors(draft: Draft, path: Path, windows: list[TimeWindowInput]) -> Errors:
    """Say what is wrong with windows beside others."""
    for index, (window, following) in enumerate(pairwise(windows)):
        if window.latest is None:
            yield error_at("WINDOW_WITHOUT_END", (*path, index, "latest"),
                           "Only the last window may have no end: state when this one ends.")
        elif thousandths(following.earliest) <= thousandths(window.latest):
            yield error_at("WINDOWS_OVERLAP", (*path, index + 1, "earliest"),
                           f"The window starts at {draft.told(following.earliest)}, and the one "
                           f"before ends at {draft.told(window.latest)}: sort them, and join "
                           "those that meet.")
        if window.late_cost_per_hour is not None:
            yield error_at("SOFT_WINDOW_BEFORE_ANOTHER", (*path, index, "late_cost_per_hour"),
                           "Only the last window may be soft: leave the cost out here.")
        if following.early_cost_per_hour != windows[0].early_cost_per_hour:
            yield error_at("EARLY_COSTS_DIFFER", (*path, index + 1, "early_cost_per_hour"),
                           "Waiting costs the same for all windows of a customer: state the "
                           "same cost for each.")


def service_errors(draft: Draft) -> Errors:
    """Say which durations are stated for vehicle types that aren't there."""
    if draft.fleet is None or None in draft.fleet:
        return
    kinds = [kind for _, kind in draft.vehicle_types()]
    known = {kind.id for kind in kinds}
    known |= {drones_of(kind.id, drones.id) for kind in kinds for drones in kind.drone_types}
    # Who has no drones may be told of them, for another day.
    known |= {drones_of(kind.id, None) for kind in kinds if not kind.drone_types}
    for path, customer in draft.known_customers():
        for name in customer.service_duration_by_type:
            if name not in known:
                yield error_at("UNKNOWN_VEHICLE_TYPE", (*path, "service_duration_by_type", name),
                               f"No vehicle type is called {name!r}: use the id of one in fleet, "
                               "or that and /drone for its drones, or / and their id.")
