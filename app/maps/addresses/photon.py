"""Photon's search."""

from app.maps.addresses.geocoder import MOST_CANDIDATES, Quality
from app.maps.addresses.places import AddressPlace
from app.maps.addresses.server import GeocodingServer, path_with
from app.maps.addresses.shapes import Address, read_features


class _Properties(Address):
    type: str
    name: str = ""
    postcode: str = ""
    district: str = ""
    city: str = ""
    state: str = ""


def path_of(address: str, server: GeocodingServer) -> str:
    """Return where an address is asked for."""
    query = {"q": address, "limit": MOST_CANDIDATES, "lang": server.language, "key": server.key}
    return path_with("/api", query)


def read(body: bytes) -> list[AddressPlace]:
    """Return the places of an answer; raises pydantic's `ValidationError`."""
    return read_features(body, _Properties, _place)


def _place(lon: float, lat: float, told: _Properties) -> AddressPlace:
    quality: Quality = "town"
    if told.type in ("house", "street"):
        quality = "house" if told.type == "house" else "street"
    street = told.street or (told.name if quality == "street" else "")
    line = f"{street} {told.housenumber}".strip() if street else ""
    town = f"{told.postcode} {told.city}".strip()
    parts = dict.fromkeys(part for part in (told.name, line, town, told.state, told.country)
                          if part)
    return AddressPlace(lon, lat, ", ".join(parts), quality, told.housenumber, street,
                        told.postcode,
                        (told.district, told.city, told.county, told.state, told.country))
