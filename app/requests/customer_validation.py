"""What the schema can't tell of a customer."""

from app.requests.draft import Draft, Errors, error_at


def window_errors(draft: Draft) -> Errors:
    """Say which windows end before they start."""
    for path, customer in draft.known_customers():
        window = customer.time_window
        if window.latest is not None and window.latest < window.earliest:
            yield error_at("WINDOW_ENDS_BEFORE_START", (*path, "time_window", "latest"),
                           f"The window ends at {window.latest:g} s, before it starts at "
                           f"{window.earliest:g} s: raise latest or lower earliest.")
