"""Which server answers for a profile, as its operator states it."""

from dataclasses import replace
from typing import Literal
from urllib.parse import parse_qsl, urlsplit, urlunsplit

from app.roads.engine import RoadEngine
from app.roads.openrouteservice import MAX_PLACES as ORS_PLACES
from app.roads.openrouteservice import MAX_POINTS as ORS_POINTS
from app.roads.openrouteservice import OpenRouteService
from app.roads.osrm import Osrm
from app.roads.server import RoadServer
from app.roads.valhalla import MAX_PLACES as VALHALLA_PLACES
from app.roads.valhalla import MAX_POINTS as VALHALLA_POINTS
from app.roads.valhalla import Valhalla

ServerKind = Literal["osrm", "valhalla", "ors"]

PROFILES: dict[ServerKind, dict[str, str]] = {
    "osrm": {},
    "valhalla": {"truck": "truck", "bicycle": "bicycle"},
    "ors": {"truck": "driving-hgv", "bicycle": "cycling-regular"},
}
"""What servers call our profiles, where these aren't cars."""

CARS: dict[ServerKind, str] = {"osrm": "driving", "valhalla": "auto", "ors": "driving-car"}

WHOLE, BROKEN = ("max_places", "max_points", "at_once", "max_url", "failures"), ("patience", "rest")
"""Options of an address that are whole numbers, and those that needn't be."""


def server_engine(kind: ServerKind, address: str, profile: str) -> RoadEngine:
    """Return what asks a server for a profile.

    Parameters
    ----------
    address
        With options as in `http://localhost:5000?max_places=200&profile=car`: any of `RoadServer`,
        `profile`, what the server calls it, `key`, and `key_parameter`, what that is called where
        it has to be part of the address (of Valhalla only).

    Raises
    ------
    ValueError
        If it can't be read.
    """
    parts = urlsplit(address)
    options = dict(parse_qsl(parts.query, keep_blank_values=True))
    name = options.pop("profile", PROFILES[kind].get(profile, CARS[kind]))
    key, parameter = options.pop("key", None), options.pop("key_parameter", None)
    if parameter is not None and (key is None or kind != "valhalla"):
        raise ValueError("key_parameter is for a server of Valhalla with a key")
    server = RoadServer(urlunsplit(parts._replace(query="")).rstrip("/"),
                        headers={} if key is None or parameter is not None
                        else {"Authorization": key})
    if kind == "osrm":
        return Osrm(_limited(server, options), name)
    if kind == "valhalla":
        usual = replace(server, max_places=VALHALLA_PLACES, max_points=VALHALLA_POINTS)
        stated = {} if key is None or parameter is None else {parameter: key}
        return Valhalla(_limited(usual, options), name, stated)
    usual = replace(server, max_places=ORS_PLACES, max_points=ORS_POINTS)
    return OpenRouteService(_limited(usual, options), name)


def _limited(server: RoadServer, options: dict[str, str]) -> RoadServer:
    unknown = options.keys() - {*WHOLE, *BROKEN}
    if unknown:
        raise ValueError(f"A server of roads has no option {min(unknown)!r}: it has "
                         f"{', '.join((*WHOLE, *BROKEN, 'profile', 'key', 'key_parameter'))}")
    try:
        whole = {name: int(options[name]) for name in WHOLE if name in options}
        broken = {name: float(options[name]) for name in BROKEN if name in options}
    except ValueError:
        raise ValueError("An option of a server of roads is no number") from None
    return replace(server, **whole, **broken)  # type: ignore[arg-type]
