"""Photon's search."""

from urllib.parse import urlencode

from pydantic import BaseModel

from app.maps.addresses.geocoder import MOST_CANDIDATES, Quality
from app.maps.addresses.places import Place
from app.maps.addresses.server import GeocodingServer
from app.maps.addresses.shapes import Features


class _Properties(BaseModel):
    type: str
    name: str = ""
    housenumber: str = ""
    street: str = ""
    postcode: str = ""
    district: str = ""
    city: str = ""
    county: str = ""
    state: str = ""
    country: str = ""


def path_of(address: str, server: GeocodingServer) -> str:
    """Return where an address is asked for."""
    query = {"q": address, "limit": MOST_CANDIDATES, "lang": server.language, "key": server.key}
    return "/api?" + urlencode({name: value for name, value in query.items() if value})


def read(body: bytes) -> list[Place]:
    """Return the places of an answer; raises pydantic's `ValidationError`."""
    return [_place(*feature.geometry.coordinates, feature.properties)
            for feature in Features[_Properties].model_validate_json(body).features]


def _place(lon: float, lat: float, told: _Properties) -> Place:
    quality: Quality = "town"
    if told.type in ("house", "street"):
        quality = "house" if told.type == "house" else "street"
    street = told.street or (told.name if quality == "street" else "")
    line = f"{street} {told.housenumber}".strip() if street else ""
    town = f"{told.postcode} {told.city}".strip()
    parts = dict.fromkeys(part for part in (told.name, line, town, told.state, told.country)
                          if part)
    return Place(lon, lat, ", ".join(parts), quality, told.housenumber, street, told.postcode,
                 (told.district, told.city, told.county, told.state, told.country))
