"""The timeline of a plan: a row per vehicle and drone, activities as bars, windows as lines."""

from collections import defaultdict
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, MultipleLocator

from app.plans.pictures.activities import Activity, ActivityRow
from app.plans.pictures.colours import BLACK, GREY, INK, PALE, VERMILLION, YELLOW, trip_colour
from app.plans.pictures.scene import DrawnPlan, Point, label

STEPS = (60, 120, 300, 600, 900, 1800, 3600, 7200, 10_800, 14_400, 21_600, 43_200, 86_400)
"""Seconds between two ticks: the first that needs no more than MAX_TICKS."""

MAX_TICKS = 15
MAX_NAMED_ROWS = 150
"""With more rows only some have their name beside them."""

BAR, SPACE, LANE = 0.24, 0.10, 0.055
"""Inches: height of a bar, between rows, and from one window to the next."""

MAX_BAND = 0.66
"""Inches for all windows of a row; more of them lie closer."""

MAX_HEIGHT = 40.0
"""Inches; of more rows each is lower."""

_FIXED: dict[Activity, tuple[str, str]] = {
    "wait": (PALE, "Waiting"), "serve": (INK, "Serving"), "launch": (YELLOW, "Launch, recovery"),
    "reload": (GREY, "Reloading"), "rest": (GREY, "Break")}
"""Colour and name of what looks the same for all vehicles."""

_ORDER: dict[Activity, int] = {
    "drive": 2, "fly": 2, "reload": 2, "rest": 2, "wait": 3, "launch": 4, "serve": 5}


def row_tops(rows: Sequence[ActivityRow]) -> list[float]:
    """Return where each row begins, and where the last one ends, in inches from the top."""
    tops = [SPACE / 2]
    for row in rows:
        tops.append(tops[-1] + BAR + SPACE + min(LANE * _num_lanes(row), MAX_BAND))
    return tops


def _num_lanes(row: ActivityRow) -> int:
    return max(row.lanes, default=-1) + 1


def timeline_height(rows: Sequence[ActivityRow]) -> float:
    """Return how high a timeline should be in inches."""
    return min(max(row_tops(rows)[-1], 2 * (BAR + SPACE)), MAX_HEIGHT)


def draw_timeline(axes: Axes, rows: Sequence[ActivityRow], scene: DrawnPlan) -> None:
    """Draw onto empty axes. In place."""
    tops = row_tops(rows)
    span = _span(rows)
    _draw_bars(axes, rows, tops)
    _draw_windows(axes, rows, tops, span)
    _set_hours(axes, span, scene)
    step = -(-len(rows) // MAX_NAMED_ROWS) or 1
    named = range(0, len(rows), step)
    axes.set_yticks([tops[index] + BAR / 2 for index in named],
                    [_row_name(rows[index]) for index in named],
                    fontsize=8 if tops[-1] < MAX_HEIGHT else 5)
    axes.set_ylim(tops[-1], 0)
    axes.tick_params(axis="y", length=0)
    for side in ("top", "left", "right"):
        axes.spines[side].set_visible(False)
    _explain(axes, rows)


def _row_name(row: ActivityRow) -> str:
    return label(row.name.rpartition("/")[2] if row.is_drone else row.name)


def _span(rows: Sequence[ActivityRow]) -> tuple[float, float]:
    """Return when the first activity begins and the last ends, never the same."""
    bars = [bar for row in rows for bar in row.bars]
    start = min((bar.start for bar in bars), default=0.0)
    return start, max(max((bar.end for bar in bars), default=0.0), start + 60.0)


def _set_hours(axes: Axes, span: tuple[float, float], scene: DrawnPlan) -> None:
    start, end = span
    margin = 0.01 * (end - start)
    axes.set_xlim(start - margin, end + margin)
    ticks = [step for step in STEPS if (end - start) / step <= MAX_TICKS]
    midnight = 0.0 if scene.day is None else -scene.day.since_midnight
    axes.xaxis.set_major_locator(
        MultipleLocator(ticks[0] if ticks else (end - start) / MAX_TICKS, midnight))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda seconds, _: scene.clock(seconds)))
    axes.set_xlabel("Time since the plan's start, h:mm" if scene.day is None else
                    f"Time of day, {scene.day.start:%Y-%m-%d}")
    axes.grid(axis="x", color="#E4E4E4", linewidth=0.6)
    axes.set_axisbelow(True)


def _draw_bars(axes: Axes, rows: Sequence[ActivityRow], tops: Sequence[float]) -> None:
    """Draw all bars that look alike together: thousands are drawn so in no time. In place."""
    alike: dict[tuple[Activity, str], list[list[Point]]] = defaultdict(list)
    for row, top in zip(rows, tops, strict=False):
        low, high = top + BAR, top
        for bar in row.bars:
            colour = (_FIXED[bar.activity][0] if bar.activity in _FIXED
                      else trip_colour(row.route, bar.trip))
            alike[bar.activity, colour].append(
                [(bar.start, low), (bar.end, low), (bar.end, high), (bar.start, high)])
    for (activity, colour), shapes in alike.items():
        # What takes no time is seen by its outline.
        axes.add_collection(PolyCollection(
            shapes, facecolors=colour, zorder=_ORDER[activity],
            edgecolors="white" if activity == "fly" else _outline(activity, colour),
            linewidths=0.8 if activity == "serve" else 0.4,
            hatch="////" if activity == "fly" else None), autolim=False)


def _outline(activity: Activity, colour: str) -> str:
    return GREY if activity in ("launch", "wait") else colour


def _draw_windows(axes: Axes, rows: Sequence[ActivityRow], tops: Sequence[float],
                  span: tuple[float, float]) -> None:
    """Draw windows under the bars, with a dot where service begins, late ones apart. In place."""
    lines: dict[bool, list[list[Point]]] = defaultdict(list)
    dots: dict[bool, list[Point]] = defaultdict(list)
    for row, top in zip(rows, tops, strict=False):
        gap = min(LANE, MAX_BAND / max(_num_lanes(row), 1))
        for window, lane in zip(row.windows, row.lanes, strict=True):
            y = top + BAR + gap * (lane + 0.8)
            latest = span[1] if window.latest is None else window.latest
            lines[window.is_late].append([(window.earliest, y), (latest, y)])
            dots[window.is_late].append((window.service_start, y))
    for is_late, segments in lines.items():
        colour = VERMILLION if is_late else INK
        axes.add_collection(LineCollection(segments, colors=VERMILLION if is_late else GREY,
                                           linewidths=0.6, zorder=3), autolim=False)
        xs, ys = zip(*dots[is_late], strict=True)
        axes.plot(xs, ys, linestyle="none", marker="D" if is_late else "o",
                  markersize=3.4 if is_late else 2.6, color=colour, zorder=4 + is_late)


def _explain(axes: Axes, rows: Sequence[ActivityRow]) -> None:
    """Add the legend above the timeline. In place."""
    seen = {bar.activity for row in rows for bar in row.bars if bar.end > bar.start}
    handles: list[Patch | Line2D] = []
    if "drive" in seen:
        handles.append(Patch(facecolor=trip_colour(0, 0), label="Driving, in the trip's colour"))
    if "fly" in seen:
        handles.append(Patch(facecolor=trip_colour(0, 0), edgecolor="white", hatch="////",
                             label="Flying"))
    handles += [Patch(facecolor=colour, edgecolor=_outline(activity, colour), label=name)
                for activity, (colour, name) in _FIXED.items() if activity in seen]
    if "serve" not in seen and rows:
        handles.append(Line2D([], [], color=BLACK, marker="|", markersize=8, linestyle="none",
                              label="Serving"))
    if any(row.windows for row in rows):
        handles.append(Line2D([], [], color=GREY, marker="o", markersize=3, linewidth=0.8,
                              markerfacecolor=INK, markeredgecolor=INK,
                              label="Window, start of service"))
    if any(window.is_late for row in rows for window in row.windows):
        handles.append(Line2D([], [], color=VERMILLION, marker="D", markersize=4, linewidth=0.8,
                              label="Late"))
    if handles:
        axes.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=8,
                    frameon=False, fontsize=8, borderaxespad=0.2, columnspacing=1.4)
    else:
        axes.text(0.5, 0.5, "No vehicle is used.", transform=axes.transAxes, ha="center")
