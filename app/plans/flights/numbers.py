"""Numbers as text files have them."""


def plain(value: float) -> str:
    """Return a number to the thousandth, without noughts behind it."""
    return f"{value:.3f}".rstrip("0").rstrip(".")
