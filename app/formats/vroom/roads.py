"""Legs by the service's own roads, and VROOM's errors where they lead nowhere."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import polyline

from app.formats.vroom.errors import MAX_TOLD, ROUTING, VroomError
from app.maps.roads.engine import RoadsError, RoadsStoppedError, RoadTable
from app.maps.roads.lines import DECIMALS
from app.maps.roads.roads import Roads
from app.requests.conversion.preparing import Preparing, StoppedError
from model.problem import FloatArray


def ask_roads(roads: Roads, profile: str, lon_lat: FloatArray, preparing: Preparing) -> RoadTable:
    """Return the drives between places, each of which has a way to each other.

    Raises
    ------
    VroomError
        If some haven't, or roads don't answer.
    RequestError
        If the work is to end.
    """
    try:
        with preparing.waiting() as until:
            table = roads.table(profile, lon_lat, until, preparing.should_stop)
    except RoadsStoppedError as error:
        raise StoppedError("The work was stopped before there was a plan: try again.") from error
    except RoadsError as error:
        preparing.pause()
        raise VroomError(ROUTING, f"The roads of {profile}: {error}") from error
    missing = np.argwhere(~np.isfinite(table.durations_s) | ~np.isfinite(table.distances_m))
    if len(missing):
        raise VroomError(ROUTING, _unfound(lon_lat, missing[:, 0].tolist()))
    return table


def add_lines(reply: Mapping[str, Any], profiles: Mapping[int, str], roads: Roads,
              until: float) -> None:
    """Put the drives on roads in place of straight lines between the steps. In place.

    Parameters
    ----------
    profiles
        By the id of the vehicle, those that drive on roads.

    Raises
    ------
    VroomError
        If roads don't answer.
    """
    for route in reply["routes"]:
        profile = profiles.get(route["vehicle"])
        if profile is None:
            continue
        points = np.array([step["location"] for step in route["steps"] if "location" in step])
        try:
            line = roads.route(profile, points, until).geometry
        except RoadsError as error:
            raise VroomError(ROUTING, f"The roads of {profile}: {error}") from error
        route["geometry"] = polyline.encode(polyline.decode(line, DECIMALS))


def _unfound(lon_lat: FloatArray, rows: list[int]) -> str:
    """Say from where roads don't lead everywhere, as VROOM does."""
    places = list(dict.fromkeys(rows))
    told = ", ".join(f"[{lon:.6f},{lat:.6f}]" for lon, lat in lon_lat[places[:MAX_TOLD]])
    more = f" and {len(places) - MAX_TOLD} more" if len(places) > MAX_TOLD else ""
    return f"Unfound route(s) from location(s) {told}{more}."
