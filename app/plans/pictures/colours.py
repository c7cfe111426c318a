"""Colours that colour-blind people tell apart, and how vehicles and trips get theirs.

References
----------
Okabe and Ito (2008), colour universal design.
"""

from matplotlib.colors import to_hex, to_rgb

VERMILLION, YELLOW = "#D55E00", "#F0E442"
VEHICLES = ("#0072B2", "#E69F00", "#009E73", VERMILLION, "#CC79A7")
"""Without black and sky blue: shades of the others come near."""

BLACK, INK, PALE, GREY = "#000000", "#222222", "#DDDDDD", "#999999"

ZONES = {"PROHIBITED": VERMILLION, "REQ_AUTHORISATION": "#E69F00", "CONDITIONAL": "#56B4E9"}
"""By what a zone asks for."""

MARKERS = ("o", "s", "^", "v", "P")
"""Vehicles beyond the fifth have the colours again, with another marker."""

_SHADES = (0.0, -0.4, 0.45)
"""Of first, second and third trips: below 0 towards black, above towards white."""


def trip_colour(route: int, trip: int) -> str:
    """Return the colour of a trip: that of its vehicle in a lightness of its own."""
    shade = _SHADES[trip % len(_SHADES)]
    red, green, blue = to_rgb(VEHICLES[route % len(VEHICLES)])
    goal = 1.0 if shade > 0 else 0.0
    share = abs(shade)
    return to_hex((red + (goal - red) * share, green + (goal - green) * share,
                   blue + (goal - blue) * share))


def vehicle_marker(route: int) -> str:
    """Return the marker of a vehicle's customers."""
    return MARKERS[route // len(VEHICLES) % len(MARKERS)]
