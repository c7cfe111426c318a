"""What the schema can't tell of a customer."""

from itertools import pairwise

from app.conversion.units import thousandths
from app.requests.draft import Draft, Errors, Path, error_at
from app.schemas.customer import TimeWindowInput


def window_errors(draft: Draft) -> Errors:
    """Say which windows end before they start, or aren't one after another."""
    for path, customer in draft.known_customers():
        if customer.time_windows is None:
            yield from _order_errors((*path, "time_window"), customer.time_window)
            continue
        if customer.time_window != TimeWindowInput():
            yield error_at("TWO_KINDS_OF_WINDOWS", (*path, "time_windows"),
                           "There is a time_window, too: state one of both.")
        for index, window in enumerate(customer.time_windows):
            yield from _order_errors((*path, "time_windows", index), window)
        yield from _sequence_errors((*path, "time_windows"), customer.time_windows)


def _order_errors(path: Path, window: TimeWindowInput) -> Errors:
    if window.latest is not None and window.latest < window.earliest:
        yield error_at("WINDOW_ENDS_BEFORE_START", (*path, "latest"),
                       f"The window ends at {window.latest:g} s, before it starts at "
                       f"{window.earliest:g} s: raise latest or lower earliest.")


def _sequence_errors(path: Path, windows: list[TimeWindowInput]) -> Errors:
    """Say what is wrong with windows beside others."""
    for index, (window, following) in enumerate(pairwise(windows)):
        if window.latest is None:
            yield error_at("WINDOW_WITHOUT_END", (*path, index, "latest"),
                           "Only the last window may have no end: state when this one ends.")
        elif thousandths(following.earliest) <= thousandths(window.latest):
            yield error_at("WINDOWS_OVERLAP", (*path, index + 1, "earliest"),
                           f"The window starts at {following.earliest:g} s, and the one before "
                           f"ends at {window.latest:g} s: sort them, and join those that meet.")
        if window.late_cost_per_hour is not None:
            yield error_at("SOFT_WINDOW_BEFORE_ANOTHER", (*path, index, "late_cost_per_hour"),
                           "Only the last window may be soft: leave the cost out here.")
        if following.early_cost_per_hour != windows[0].early_cost_per_hour:
            yield error_at("EARLY_COSTS_DIFFER", (*path, index + 1, "early_cost_per_hour"),
                           "Waiting costs the same for all windows of a customer: state the "
                           "same cost for each.")
