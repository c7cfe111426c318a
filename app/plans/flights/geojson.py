"""Flights as GeoJSON: lines with heights, the places on the way, and the zones around.

References
----------
RFC 7946, the GeoJSON format. Its third coordinate is told above the launch, as properties say.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from app.plans.flights.flight import Flight, note_of
from app.plans.flights.zones import zones_of

Data = dict[str, Any]


def geojson_files(flights: Sequence[Flight]) -> Mapping[str, bytes]:
    """Return a collection of all lines, places and zones."""
    features = [feature for flight in flights for feature in _features(flight)]
    features += [_feature("Polygon", [ring], {"kind": "no_fly", **_kept(flights[0])})
                 for ring in zones_of(flights)]
    collection = {"type": "FeatureCollection", "comment": note_of(flights), "features": features}
    return {".geojson": json.dumps(collection, ensure_ascii=False, indent=1).encode() + b"\n"}


def _features(flight: Flight) -> Iterator[Data]:
    common = {"vehicle": flight.vehicle, "drone": flight.drone, "flight": flight.number}
    yield _feature("LineString", flight.line(), {
        "kind": "flight", **common, "customers": flight.customers,
        "heights": "metres above the launch", "altitude": flight.altitude,
        "at_customers": "lands" if flight.lands else "hovers", **_kept(flight),
        "launch_time": flight.told(flight.launch.arrival),
        "recovery_time": flight.told(flight.recovery_time)})
    for point in flight.way_points:
        yield _feature("Point", [*point.place, flight.altitude], {
            "kind": point.role, **common, "id": point.id, "speed": round(point.speed, 3),
            "arrival": flight.told(point.arrival), "waiting": round(point.waiting, 3)})


def _kept(flight: Flight) -> Data:
    return {"buffer": flight.buffer} if flight.buffer else {}


def _feature(kind: str, coordinates: Any, properties: Data) -> Data:
    return {"type": "Feature", "geometry": {"type": kind, "coordinates": coordinates},
            "properties": properties}
