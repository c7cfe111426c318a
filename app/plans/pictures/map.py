"""The map of a plan: places, routes by vehicle and trip, flights, no-fly areas."""

from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch, Polygon
from matplotlib.path import Path

from app.plans.pictures.colours import BLACK, GREY, INK, VERMILLION, trip_colour, vehicle_marker
from app.plans.pictures.lines import driven_lines, flown_lines, places_of
from app.plans.pictures.scene import DrawnPlan, Layout, Place, Point, all_trips, counted, label
from app.plans.pictures.zones import draw_zones, zone_handles, zones_on

MAX_LABELLED = 150
"""With more customers than this their ids would cover each other."""

MAX_LEGEND = 26
"""Trips in the legend."""

BULGE = 0.16
"""How far an arc leaves the straight line, as a share of its length."""

DASHES = (0, (3.0, 1.8))
TIP = 0.06
"""Length of an arrow as a share of its leg."""


def draw_map(axes: Axes, scene: DrawnPlan, layout: Layout) -> None:
    """Draw onto empty axes. In place."""
    many = len(scene.request.customers) > MAX_LABELLED
    corners = extent(layout)
    zones = zones_on(scene, layout, corners)
    draw_zones(axes, zones, corners)
    _draw_no_fly(axes, layout)
    _draw_trips(axes, scene, layout, thin=many)
    _draw_sorties(axes, scene, layout, thin=many)
    _draw_places(axes, scene, layout, size=2.5 if many else 5.0)
    _draw_unassigned(axes, scene, layout)
    if not many:
        for customer in scene.request.customers:
            _write(axes, layout.points["customer", customer.id], customer.id, 6.5)
    for depot in scene.request.depots:
        _write(axes, layout.points["depot", depot.id], depot.id, 9.0, weight="bold")
    for site in scene.request.launch_sites:
        _write(axes, layout.points["launch_site", site.id], site.id, 6.5)
    _set_scale(axes, corners)
    _explain(axes, scene, layout, zone_handles(zones))


def extent(layout: Layout) -> tuple[Point, Point]:
    """Return the corners of what a map shows, never a line or a point."""
    points = np.vstack([np.array(list(layout.points.values())), *layout.no_fly])
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.04 * max(float((high - low).max()), 0.1)
    # A street is drawn as a strip.
    spare = np.maximum(0.35 * (high - low).max() - (high - low), 0.0) / 2
    low, high = low - margin - spare, high + margin + spare
    return (float(low[0]), float(low[1])), (float(high[0]), float(high[1]))


def _set_scale(axes: Axes, corners: tuple[Point, Point]) -> None:
    (left, bottom), (right, top) = corners
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_aspect("equal", adjustable="box", anchor="NW")
    axes.set_xlabel("km east")
    axes.set_ylabel("km north")
    axes.grid(color="#EEEEEE", linewidth=0.6)
    axes.set_axisbelow(True)


def _draw_no_fly(axes: Axes, layout: Layout) -> None:
    for index, ring in enumerate(layout.no_fly):
        area = Polygon(ring, closed=True, facecolor="#F6F6F6", edgecolor=GREY, hatch="////",
                       linewidth=1.0, zorder=1)
        area.set_gid(f"no-fly-{index}")
        axes.add_patch(area)


def _draw_trips(axes: Axes, scene: DrawnPlan, layout: Layout, thin: bool) -> None:
    for index, number, _, trip in all_trips(scene.plan.routes):
        colour = trip_colour(index, number)
        legs = list(driven_lines(layout, trip))
        points = [point for leg in legs for point in leg] or [
            layout.points[stop.kind, stop.id] for stop in places_of(trip)]
        xs, ys = zip(*points, strict=True)
        axes.plot(xs, ys, color=colour, linewidth=1.0 if thin else 1.6, zorder=3,
                  solid_joinstyle="round", gid=f"trip-{index}-{number}")
        if not thin and legs:
            for leg in (legs[0], legs[-1]):
                middle = (len(leg) - 1) // 2
                _draw_arrow(axes, leg[middle], leg[middle + 1], colour)


def _draw_arrow(axes: Axes, start: Point, end: Point, colour: str) -> None:
    """Say which way a leg is driven. In place."""
    if start == end:
        return
    tail, tip = (_between(start, end, share) for share in (0.5, 0.5 + TIP))
    axes.annotate("", xy=tip, xytext=tail, zorder=3,
                  arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 0.0,
                              "mutation_scale": 15})


def _between(start: Point, end: Point, share: float) -> Point:
    return (start[0] + (end[0] - start[0]) * share, start[1] + (end[1] - start[1]) * share)


def _draw_sorties(axes: Axes, scene: DrawnPlan, layout: Layout, thin: bool) -> None:
    for index, number, _, trip in all_trips(scene.plan.routes):
        for flight, sortie in enumerate(trip.sorties):
            path = _flight(flown_lines(layout, trip, sortie))
            arc = PathPatch(path, fill=False, edgecolor=trip_colour(index, number),
                            linestyle=DASHES, linewidth=0.9 if thin else 1.3, zorder=4)
            arc.set_gid(f"sortie-{index}-{number}-{flight}")
            axes.add_patch(arc)


def _flight(lines: Iterable[Sequence[Point]]) -> Path:
    """Return a line over all places: of a straight flight an arc, so that there and back differ."""
    vertices: list[Point] = []
    codes: list[int] = []
    for line in lines:
        if not vertices:
            vertices, codes = [line[0]], [int(Path.MOVETO)]
        if len(line) > 2:
            vertices += line[1:]
            codes += [int(Path.LINETO)] * (len(line) - 1)
        else:
            (x, y), (to_x, to_y) = line
            bend = ((x + to_x) / 2 - (to_y - y) * BULGE, (y + to_y) / 2 + (to_x - x) * BULGE)
            vertices += [bend, (to_x, to_y)]
            codes += [int(Path.CURVE3)] * 2
    return Path(vertices, codes)


def _draw_places(axes: Axes, scene: DrawnPlan, layout: Layout, size: float) -> None:
    """Draw depots, and customers filled if a truck serves them, hollow if a drone does."""
    for index, number, _, trip in all_trips(scene.plan.routes):
        colour, marker = trip_colour(index, number), vehicle_marker(index)
        driven: list[Place] = [("customer", stop.id) for stop in trip.stops
                               if stop.kind == "customer"]
        flown: list[Place] = [("customer", visit.id) for sortie in trip.sorties
                              for visit in sortie.customers]
        for places, fill in ((driven, colour), (flown, "white")):
            if places:
                xs, ys = zip(*(layout.points[place] for place in places), strict=True)
                axes.plot(xs, ys, linestyle="none", marker=marker, markersize=size,
                          markerfacecolor=fill, markeredgecolor=colour, zorder=5)
    for (kind, _), (x, y) in layout.points.items():
        if kind != "customer":
            axes.plot([x], [y], marker="s", markersize=10 if kind == "depot" else 6, color=BLACK,
                      markeredgecolor="white", zorder=6)


def _draw_unassigned(axes: Axes, scene: DrawnPlan, layout: Layout) -> None:
    for index, left_out in enumerate(scene.plan.unassigned):
        x, y = layout.points["customer", left_out.id]
        axes.plot([x], [y], marker="X", markersize=9, color=VERMILLION, markeredgecolor=BLACK,
                  linestyle="none", zorder=6, gid=f"unassigned-{index}")


def _write(axes: Axes, point: Point, name: str, size: float, weight: str = "normal") -> None:
    axes.annotate(label(name), point, xytext=(4, 4), textcoords="offset points", fontsize=size,
                  fontweight=weight, color=INK, zorder=7, annotation_clip=True)


def _explain(axes: Axes, scene: DrawnPlan, layout: Layout, zones: Sequence[Patch]) -> None:
    """Add the legend beside the map, zones' entries among it. In place."""
    handles: list[Line2D | Patch] = [
        Line2D([], [], color=BLACK, marker="s", markersize=8, linestyle="none", label="depot")]
    if scene.request.launch_sites:
        handles.append(Line2D([], [], color=BLACK, marker="s", markersize=5, linestyle="none",
                              label="launch site"))
    if any(trip.sorties for _, _, _, trip in all_trips(scene.plan.routes)):
        handles.append(Line2D([], [], color=INK, linestyle=DASHES, linewidth=1.3, marker="o",
                              markersize=5, markerfacecolor="white",
                              label="sortie, customer served by drone"))
    if layout.no_fly:
        handles.append(Patch(facecolor="#F6F6F6", edgecolor=GREY, hatch="////",
                             label="no-fly area: drones fly around it"))
    handles += zones
    if scene.plan.unassigned:
        handles.append(Line2D([], [], color=VERMILLION, marker="X", markersize=8,
                              markeredgecolor=BLACK, linestyle="none", label="unassigned"))
    handles += _trip_handles(scene)
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False,
                fontsize=8, borderaxespad=0.0, handlelength=2.6)


def _trip_handles(scene: DrawnPlan) -> list[Line2D]:
    trips = list(all_trips(scene.plan.routes))
    handles = []
    for index, number, route, trip in trips[:MAX_LEGEND]:
        served = sum(stop.kind == "customer" for stop in trip.stops)
        served += sum(len(sortie.customers) for sortie in trip.sorties)
        name = label(scene.called(route.vehicle))
        if len(route.trips) > 1:
            name += f", trip {number + 1}"
        handles.append(Line2D([], [], color=trip_colour(index, number), linewidth=1.8,
                              marker=vehicle_marker(index), markersize=5,
                              label=f"{name}: {counted(served, 'customer')}"))
    if len(trips) > MAX_LEGEND:
        handles.append(Line2D([], [], linestyle="none",
                              label=f"and {counted(len(trips) - MAX_LEGEND, 'more trip')}"))
    return handles
