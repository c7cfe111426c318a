"""Small files of zones, written after the fields of the standards."""

from typing import Any

Data = dict[str, Any]

SQUARE = [[24.90, 60.20], [24.92, 60.20], [24.92, 60.21], [24.90, 60.21], [24.90, 60.20]]
CENTER = [24.95, 60.18]


def volume(**changed: Any) -> Data:
    """Return a volume of ED-269 from the ground to 120 m."""
    return {"uomDimensions": "M", "lowerLimit": 0, "lowerVerticalReference": "AGL",
            "upperLimit": 120, "upperVerticalReference": "AGL",
            "horizontalProjection": {"type": "Polygon", "coordinates": [SQUARE]}} | changed


def circle(radius: float = 500, center: list[float] = CENTER, **changed: Any) -> Data:
    """Return a round volume of ED-269."""
    area = {"type": "Circle", "center": center, "radius": radius}
    return volume(horizontalProjection=area, **changed)


def zone(*volumes: Data, **changed: Any) -> Data:
    """Return a zone of ED-269."""
    return {
        "identifier": "FIN0001", "country": "FIN", "name": "Harbour", "type": "COMMON",
        "restriction": "PROHIBITED", "restrictionConditions": [], "region": 0,
        "reason": ["SENSITIVE"], "otherReasonInfo": "", "regulationExemption": "NO",
        "uSpaceClass": "", "message": "No flights",
        "applicability": [{"permanent": "YES"}],
        "zoneAuthority": [{"name": "Port", "service": "Tower", "email": "tower@port.example",
                           "purpose": "AUTHORIZATION", "intervalBefore": "P1D"}],
        "geometry": list(volumes or (volume(),))} | changed


def ed269(*zones: Data) -> Data:
    """Return a file of ED-269 as a request states it."""
    return {"format": "ed269", "data": {"title": "UAS zones", "features": list(zones or (zone(),))}}


def ed318(geometry: Data, **changed: Any) -> Data:
    """Return a file of ED-318 with one zone as a request states it."""
    properties = {
        "identifier": "FIN0002", "country": "FIN",
        "name": [{"text": "Satama", "lang": "fi-FI"}, {"text": "Harbour", "lang": "en-GB"}],
        "type": "REQ_AUTHORIZATION", "variant": "COMMON", "reason": ["AIR_TRAFFIC"],
        "zoneAuthority": [{"name": [{"text": "Port", "lang": "en-GB"}],
                           "phone": "+358 1", "purpose": "AUTHORIZATION"}]}
    feature = {"type": "Feature", "geometry": geometry, "properties": properties | changed}
    return {"format": "ed318", "data": {
        "type": "FeatureCollection", "metadata": {"issued": "2026-01-01T00:00:00Z"},
        "features": [feature]}}


def layer(lower: float | None, upper: float | None, unit: str = "m",
          reference: str = "AGL") -> Data:
    """Return a layer of ED-318."""
    stated = {"lower": lower, "lowerReference": reference, "upper": upper,
              "upperReference": reference, "uom": unit}
    return {name: value for name, value in stated.items() if value is not None}


def geojson(geometry: Data, **properties: Any) -> Data:
    """Return an area as GeoJSON as a request states it."""
    return {"format": "geojson", "data": {
        "type": "FeatureCollection",
        "features": [{"type": "Feature", "properties": properties, "geometry": geometry}]}}


def kml(*rings: str, name: str = "Old town", namespace: str = "http://www.opengis.net/kml/2.2"
        ) -> Data:
    """Return a polygon and its holes as KML as a request states it."""
    outer, *inner = (
        f"<LinearRing><coordinates>{ring}</coordinates></LinearRing>" for ring in rings)
    holes = "".join(f"<innerBoundaryIs>{ring}</innerBoundaryIs>" for ring in inner)
    return {"format": "kml", "data": (
        f'\ufeff<?xml version="1.0" encoding="UTF-8"?>\n<kml xmlns="{namespace}"><Document><Folder>'
        f'<Placemark id="p1"><name>{name}</name><Polygon><outerBoundaryIs>{outer}'
        f'</outerBoundaryIs>{holes}</Polygon></Placemark></Folder></Document></kml>')}
