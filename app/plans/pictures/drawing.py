"""A plan drawn as SVG or PNG: the map, and the timeline under it.

Drawing needs about half a second, and settings of matplotlib that are one for all threads: so one
picture is drawn at a time.
"""

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure

from app.plans.pictures.activities import rows_of
from app.plans.pictures.colours import VERMILLION
from app.plans.pictures.map import draw_map, extent
from app.plans.pictures.scene import DrawnPlan, Layout
from app.plans.pictures.timeline import draw_timeline, timeline_height

WIDTH, LEFT, RIGHT, LEGEND = 13.0, 1.35, 0.35, 2.5
HEADER, GAP, FOOTER = 0.85, 0.95, 0.6
"""Lengths in inches."""

MAP_HEIGHT = (3.5, 9.0)
DOTS_PER_INCH = 130

SETTINGS: dict[Any, Any] = {
    "font.family": ["DejaVu Sans"],
    "hatch.linewidth": 0.7,
    # Text stays text, and none of it is taken for a formula.
    "svg.fonttype": "none",
    "text.parse_math": False,
    "text.usetex": False,
    # The same plan is the same picture, to the byte.
    "svg.hashsalt": "tandem",
}

_LOCK = threading.Lock()


def draw_svg(scene: DrawnPlan) -> bytes:
    """Return a picture as SVG that refers to nothing outside of it."""
    content = _drawn(scene, format="svg",
                     metadata=dict.fromkeys(("Creator", "Date", "Format", "Type")))
    # Without the document type, which names an address, and which careful readers refuse.
    return b'<?xml version="1.0" encoding="utf-8"?>\n' + content[content.index(b"<svg"):]


def draw_png(scene: DrawnPlan) -> bytes:
    """Return a picture as PNG."""
    return _drawn(scene, format="png", dpi=DOTS_PER_INCH, metadata={"Software": None})


def _drawn(scene: DrawnPlan, **options: Any) -> bytes:
    content = BytesIO()
    with _drawing_alone():
        _figure(scene).savefig(content, **options)
    return content.getvalue()


@contextmanager
def _drawing_alone() -> Iterator[None]:
    """Hold matplotlib's settings, and its warnings of letters that its font lacks."""
    with _LOCK, rc_context(SETTINGS), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing from", UserWarning)
        yield


def _figure(scene: DrawnPlan) -> Figure:
    rows = rows_of(scene)
    layout = scene.layout
    below = timeline_height(rows)
    map_height = 0.0 if layout is None else _map_height(layout)
    map_space = 0.0 if layout is None else map_height + GAP
    height = HEADER + map_space + below + FOOTER
    figure = Figure(figsize=(WIDTH, height), facecolor="white")
    figure.text(LEFT / WIDTH, 1 - 0.36 / height, scene.headline, fontsize=15, fontweight="bold")
    figure.text(LEFT / WIDTH, 1 - 0.64 / height, scene.subline, fontsize=9.5,
                color=VERMILLION if scene.num_violations else "#444444")
    if layout is not None:
        bottom = height - HEADER - map_height
        axes = figure.add_axes((LEFT / WIDTH, bottom / height,
                                (WIDTH - LEFT - RIGHT - LEGEND) / WIDTH, map_height / height))
        draw_map(axes, scene, layout)
    axes = figure.add_axes((LEFT / WIDTH, FOOTER / height, (WIDTH - LEFT - RIGHT) / WIDTH,
                            below / height))
    draw_timeline(axes, rows, scene)
    return figure


def _map_height(layout: Layout) -> float:
    """Return a height that suits what the map shows."""
    (left, bottom), (right, top) = extent(layout)
    width = WIDTH - LEFT - RIGHT - LEGEND
    low, high = MAP_HEIGHT
    return min(max(width * (top - bottom) / (right - left), low), high)
