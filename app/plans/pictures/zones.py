"""The zones of the airspace on a map: those that drones of the request meet."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path

from app.maps.airspace.zone import Restriction
from app.plans.pictures.colours import INK, ZONES
from app.plans.pictures.scene import DrawnPlan, Layout, Point, label
from app.requests.conversion.zones import ZoneVolume, ZonesMet

MAX_NAMED = 40
"""With more zones than this their names would cover each other."""

ASKS_FOR: dict[Restriction, str] = {
    "PROHIBITED": "zone: flying is prohibited",
    "REQ_AUTHORISATION": "zone: flying takes an authorisation",
    "CONDITIONAL": "zone: flying takes conditions",
}


class Drawn(NamedTuple):
    """A volume of a zone within the map, in km east and north."""

    part: ZoneVolume
    area: shapely.Polygon
    is_flown_over: bool


def zones_on(scene: DrawnPlan, layout: Layout, corners: tuple[Point, Point]) -> list[Drawn]:
    """Return the zones between two corners of a map that drones meet at any of their altitudes."""
    window = shapely.box(*corners[0], *corners[1])
    return [drawn for drawn in _met(scene, layout) if drawn.area.intersects(window)]


def _met(scene: DrawnPlan, layout: Layout) -> Iterator[Drawn]:
    met = ZonesMet(scene.request, scene.published)
    altitudes = sorted({flyer.altitude for kind in scene.request.fleet for flyer in kind.flyers})
    seen: set[ZoneVolume] = set()
    for is_flown_over in (False, True):
        parts = dict.fromkeys(part for altitude in altitudes
                              for part in met.at(altitude)[int(is_flown_over)])
        for part in parts:
            if part not in seen:
                seen.add(part)
                yield Drawn(part, shapely.transform(part.volume.area, layout.project),
                            is_flown_over)


def draw_zones(axes: Axes, zones: Sequence[Drawn], corners: tuple[Point, Point]) -> None:
    """Draw zones, filled unless drones may fly over them, and their names if there are few.

    In place.
    """
    for index, (part, area, is_flown_over) in enumerate(zones):
        colour = ZONES[part.zone.restriction]
        patch = PathPatch(_outline(area), edgecolor=colour, linewidth=1.0, zorder=1,
                          facecolor="none" if is_flown_over else (colour, 0.2),
                          linestyle="dotted" if is_flown_over else "solid")
        patch.set_gid(f"zone-{index}")
        axes.add_patch(patch)
    if len(zones) > MAX_NAMED:
        return
    window = shapely.box(*corners[0], *corners[1])
    for part, area, _ in {drawn.part.zone: drawn for drawn in reversed(zones)}.values():
        at = area.intersection(window).representative_point()
        axes.annotate(label(part.zone.title), (at.x, at.y), ha="center", va="center", fontsize=6.5,
                      fontstyle="italic", color=INK, zorder=2, annotation_clip=True)


def zone_handles(zones: Sequence[Drawn]) -> list[Patch]:
    """Return what a legend says of zones."""
    restrictions = {drawn.part.zone.restriction for drawn in zones if not drawn.is_flown_over}
    handles = [Patch(facecolor=(ZONES[restriction], 0.2), edgecolor=ZONES[restriction], label=words)
               for restriction, words in ASKS_FOR.items() if restriction in restrictions]
    if any(drawn.is_flown_over for drawn in zones):
        handles.append(Patch(facecolor="none", edgecolor=INK, linestyle="dotted",
                             label="zone below the drones: nobody lands in it"))
    return handles


def _outline(area: shapely.Polygon) -> Path:
    """Return an area's rings, holes the other way round."""
    oriented = shapely.orient_polygons(area)
    return Path.make_compound_path(*[
        Path(np.asarray(ring.coords), closed=True)
        for ring in (oriented.exterior, *oriented.interiors)])
