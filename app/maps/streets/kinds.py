"""What of OpenStreetMap is drawn, as which kind, and from which zoom on.

A kind is what looks the same on the map. Zooms are those of tiles of 512 pixels: one less than the
usual ones.
"""

from collections.abc import Mapping
from dataclasses import dataclass

MOST_ZOOM = 14
"""Tiles of this zoom are drawn larger from there on."""

LEAST_ZOOM = 5


@dataclass(frozen=True)
class StreetKind:
    """What looks the same."""

    name: str
    from_zoom: int
    is_area: bool = False
    names_from: int | None = None  # from which zoom its lines are named; None: never


SEA = StreetKind("sea", LEAST_ZOOM, is_area=True)
KINDS = (
    SEA,
    StreetKind("green", 9, is_area=True),
    StreetKind("sand", 11, is_area=True),
    StreetKind("water", LEAST_ZOOM, is_area=True),
    StreetKind("river", 9),
    StreetKind("stream", 12),
    StreetKind("square", 14, is_area=True),
    StreetKind("building", 14, is_area=True),
    StreetKind("path", 14, names_from=14),
    StreetKind("service", 13, names_from=14),
    StreetKind("street", 12, names_from=14),
    StreetKind("main", 9, names_from=13),
    StreetKind("primary", 7, names_from=12),
    StreetKind("motorway", LEAST_ZOOM, names_from=12),
    StreetKind("tram", 13),
    StreetKind("rail", 8),
)
"""In the order in which they are painted."""

_WAYS = {
    "highway": {
        **dict.fromkeys(("motorway", "motorway_link", "trunk", "trunk_link"), "motorway"),
        **dict.fromkeys(("primary", "primary_link"), "primary"),
        **dict.fromkeys(("secondary", "secondary_link", "tertiary", "tertiary_link"), "main"),
        **dict.fromkeys(("residential", "unclassified", "living_street", "road"), "street"),
        "service": "service",
        **dict.fromkeys(("pedestrian", "footway", "cycleway", "path", "steps", "track",
                         "bridleway"), "path"),
    },
    "railway": {"rail": "rail", "light_rail": "rail", "narrow_gauge": "rail", "tram": "tram",
                "subway": "rail"},
    "waterway": {"river": "river", "canal": "river", "stream": "stream", "ditch": "stream"},
}

_AREAS = {
    "natural": {
        "water": "water", "beach": "sand", "sand": "sand",
        **dict.fromkeys(("wood", "scrub", "heath", "grassland"), "green"),
    },
    "waterway": {"riverbank": "water", "dock": "water"},
    "landuse": {
        **dict.fromkeys(("reservoir", "basin"), "water"),
        **dict.fromkeys(("grass", "forest", "meadow", "village_green", "cemetery", "orchard",
                         "recreation_ground", "allotments", "vineyard"), "green"),
    },
    "leisure": dict.fromkeys(("park", "garden", "pitch", "golf_course", "playground"), "green"),
    "highway": dict.fromkeys(("pedestrian", "footway"), "square"),
    "place": {"square": "square"},
}

UNDERGROUND = ("rail", "tram", "path", "service", "river", "stream")
"""Not drawn in tunnels."""

KEYS = ("building", *dict.fromkeys((*_WAYS, *_AREAS)))
"""Only what has one of these tags is looked at."""


def kind_of_way(tags: Mapping[str, str]) -> str | None:
    """Return what a way is drawn as; None: not at all."""
    if tags.get("area") == "yes":
        return None
    kind = _first(_WAYS, tags)
    return None if kind in UNDERGROUND and tags.get("tunnel", "no") != "no" else kind


def name_of_way(tags: Mapping[str, str]) -> str:
    """Return what a way is called, as signs there say it; an empty text: nothing."""
    return tags.get("name", "") or tags.get("ref", "")


def kind_of_area(tags: Mapping[str, str]) -> str | None:
    """Return what an area is drawn as; None: not at all."""
    if tags.get("building", "no") != "no":
        return "building"
    if tags.get("highway") and tags.get("area") != "yes":
        return None
    return _first(_AREAS, tags)


def _first(kinds: Mapping[str, Mapping[str, str]], tags: Mapping[str, str]) -> str | None:
    for key, of_value in kinds.items():
        kind = of_value.get(tags.get(key, ""))
        if kind is not None:
            return kind
    return None
