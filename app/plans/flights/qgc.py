"""Flights as QGroundControl's `.plan`, and as text of way points, `QGC WPL 110`.

References
----------
QGroundControl, plan file format: https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html
MAVLink, file formats: https://mavlink.io/en/file_formats/
"""

import json
from collections.abc import Mapping, Sequence
from typing import Any

from app.plans.flights.flight import Flight, Place, note_of
from app.plans.flights.mavlink import Command, Frame, Item, fence_of, mission_of
from app.plans.flights.numbers import plain
from app.plans.flights.zones import zones_of

ANY_FIRMWARE, MULTIROTOR = 0, 2
"""`MAV_AUTOPILOT_GENERIC` and `MAV_TYPE_QUADROTOR`."""

RELATIVE = 1
"""QGroundControl's way to say that heights are above home."""

SIMPLE_ITEM = "SimpleItem"

Data = dict[str, Any]


def plan_files(flights: Sequence[Flight]) -> Mapping[str, bytes]:
    """Return the mission of one drone, its fence and where its truck will be."""
    first = flights[0]
    plan = {
        "fileType": "Plan", "version": 1, "groundStation": "Tandem", "comment": note_of(flights),
        "mission": {
            "version": 2, "firmwareType": ANY_FIRMWARE, "vehicleType": MULTIROTOR,
            "cruiseSpeed": round(first.top_speed, 3), "hoverSpeed": round(first.top_speed, 3),
            "globalPlanAltitudeMode": RELATIVE,
            "plannedHomePosition": [*_lat_lon(first.launch.place), 0],
            "items": [_simple_item(number, item)
                      for number, item in enumerate(mission_of(flights), 1)],
        },
        "geoFence": {
            "version": 2, "circles": [],
            "polygons": [{"version": 1, "inclusion": False,
                          "polygon": [_lat_lon(place) for place in ring[:-1]]}
                         for ring in zones_of(flights)],
        },
        "rallyPoints": {
            "version": 2,
            "points": [[*_lat_lon(place), altitude] for place, altitude in dict.fromkeys(
                (flight.recovery.place, flight.altitude) for flight in flights)],
        },
    }
    return {".plan": json.dumps(plan, ensure_ascii=False, indent=2).encode() + b"\n"}


def _lat_lon(place: Place) -> list[float]:
    longitude, latitude = place
    return [latitude, longitude]


def _simple_item(number: int, item: Item) -> Data:
    latitude, longitude = _lat_lon(item.place or (0.0, 0.0))
    told: Data = {"type": SIMPLE_ITEM, "autoContinue": True, "command": int(item.command),
                  "doJumpId": number, "frame": int(item.frame),
                  "params": [*item.params, latitude, longitude, item.altitude]}
    if item.place is not None:
        told |= {"AMSLAltAboveTerrain": None, "Altitude": item.altitude, "AltitudeMode": RELATIVE}
    return told


def way_point_files(flights: Sequence[Flight]) -> Mapping[str, bytes]:
    """Return the mission of one drone, and its fence as another file where there are zones.

    Nothing in them says what they are: QGroundControl reads no comments.
    """
    home = _line(0, Frame.GLOBAL, Item(Command.NAV_WAYPOINT, place=flights[0].launch.place))
    mission = [_line(number, item.frame, item)
               for number, item in enumerate(mission_of(flights), 1)]
    fence = [_line(number, item.frame, item)
             for number, item in enumerate(fence_of(zones_of(flights)))]
    return {".waypoints": _text([home, *mission])} | (
        {"-fence.waypoints": _text(fence)} if fence else {})


def _text(lines: Sequence[str]) -> bytes:
    return "\n".join(["QGC WPL 110", *lines, ""]).encode()


def _line(number: int, frame: Frame, item: Item) -> str:
    latitude, longitude = _lat_lon(item.place or (0.0, 0.0))
    fields = [number, int(frame == Frame.GLOBAL), int(frame), int(item.command),
              *map(plain, item.params), f"{latitude:.7f}", f"{longitude:.7f}",
              plain(item.altitude), 1]
    return "\t".join(map(str, fields))
