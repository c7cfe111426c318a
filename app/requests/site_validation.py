"""What the schema can't tell of launch sites, and of trucks that come back to places."""

from itertools import chain

from app.requests.conversion.places import revisits
from app.requests.draft import Draft, Errors, error_at

MOST_REVISITED = 500
"""Most places, depots and customers, that trucks may come back to: each is there twice."""


def site_errors(draft: Draft) -> Errors:
    """Say which windows end before they start, and what can't be come back to."""
    for path, site in draft.known_launch_sites():
        window = site.time_window
        if window.latest is not None and window.latest < window.earliest:
            yield error_at("WINDOW_ENDS_BEFORE_START", (*path, "time_window"),
                           f"The window ends at {draft.told(window.latest)}, before it starts at "
                           f"{draft.told(window.earliest)}: correct one.")
    if any(revisits(kind) for _, kind in draft.vehicle_types()):
        yield from _revisit_errors(draft)


def _revisit_errors(draft: Draft) -> Errors:
    """Say whether there are too many places to come back to, and which share a name."""
    places = sum(len(entries or ()) for entries in (draft.depots, draft.customers))
    if places > MOST_REVISITED:
        yield error_at("TOO_MANY_REVISITS", ("fleet",), f"There are {places} depots and customers, "
                       f"and trucks with revisits come back to at most {MOST_REVISITED}: leave "
                       "revisits out, or state launch_sites.")
    seen: dict[str, str] = {}
    for name, index, entry in chain.from_iterable(
            [(name, index, entry) for index, entry in enumerate(entries or ())]
            for name, entries in (("depots", draft.depots), ("customers", draft.customers),
                                  ("launch_sites", draft.launch_sites))):
        if entry is None:
            continue
        first = seen.setdefault(entry.id, name)
        if first != name:
            yield error_at("DUPLICATE_ID", (name, index, "id"),
                           f"One of {first} has the same id, and trucks with revisits stop at "
                           "both: give each its own.")
