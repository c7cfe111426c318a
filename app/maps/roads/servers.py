"""Which server answers for a profile, as its operator states it."""

from typing import Literal

from app.maps.remote.servers import Options, numbers_of, parted
from app.maps.roads.engine import RoadEngine
from app.maps.roads.openrouteservice import MAX_PLACES as ORS_PLACES
from app.maps.roads.openrouteservice import MAX_POINTS as ORS_POINTS
from app.maps.roads.openrouteservice import OpenRouteService
from app.maps.roads.osrm import Osrm
from app.maps.roads.server import RoadServer
from app.maps.roads.valhalla import MAX_PLACES as VALHALLA_PLACES
from app.maps.roads.valhalla import MAX_POINTS as VALHALLA_POINTS
from app.maps.roads.valhalla import Valhalla

ServerKind = Literal["osrm", "valhalla", "ors"]

PROFILES: dict[ServerKind, dict[str, str]] = {
    "osrm": {},
    "valhalla": {"truck": "truck", "bicycle": "bicycle"},
    "ors": {"truck": "driving-hgv", "bicycle": "cycling-regular"},
}
"""What servers call our profiles, where these aren't cars."""

CARS: dict[ServerKind, str] = {"osrm": "driving", "valhalla": "auto", "ors": "driving-car"}

LIMITS: dict[ServerKind, dict[str, int]] = {
    "osrm": {},
    "valhalla": {"max_places": VALHALLA_PLACES, "max_points": VALHALLA_POINTS},
    "ors": {"max_places": ORS_PLACES, "max_points": ORS_POINTS},
}
"""What servers take at once as they come, where it is less than of OSRM's."""

OPTIONS = Options(("max_places", "max_points", "at_once", "max_url", "failures"),
                  ("patience", "rest"), ("profile", "key", "key_parameter"))


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
    url, options = parted(address)
    limits = numbers_of(options, OPTIONS, "a server of roads")
    name = options.get("profile", PROFILES[kind].get(profile, CARS[kind]))
    key, parameter = options.get("key"), options.get("key_parameter")
    if parameter is not None and (key is None or kind != "valhalla"):
        raise ValueError("key_parameter is for a server of Valhalla with a key")
    headers = {} if key is None or parameter is not None else {"Authorization": key}
    server = RoadServer(url, headers=headers, **(LIMITS[kind] | limits))  # type: ignore[arg-type]
    if kind == "osrm":
        return Osrm(server, name)
    if kind == "valhalla":
        stated = {} if key is None or parameter is None else {parameter: key}
        return Valhalla(server, name, stated)
    return OpenRouteService(server, name)
