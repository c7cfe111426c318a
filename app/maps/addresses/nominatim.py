"""Nominatim's search."""

from pydantic import BaseModel, TypeAdapter

from app.maps.addresses.geocoder import MOST_CANDIDATES, Quality
from app.maps.addresses.places import AddressPlace
from app.maps.addresses.server import GeocodingServer, path_with
from app.maps.addresses.shapes import Latitude, Longitude

HOUSE_RANK, STREET_RANK = 28, 26
"""Least ranks of houses, and of streets."""


class _Address(BaseModel):
    house_number: str = ""
    road: str = ""
    postcode: str = ""


class _Place(BaseModel):
    lon: Longitude
    lat: Latitude
    display_name: str
    place_rank: int
    address: _Address = _Address()


_PLACES = TypeAdapter(list[_Place])


def path_of(address: str, server: GeocodingServer) -> str:
    """Return where an address is asked for."""
    query = {"q": address, "format": "jsonv2", "addressdetails": "1", "limit": MOST_CANDIDATES,
             "countrycodes": server.country.lower(), "accept-language": server.language,
             "email": server.email, "key": server.key}
    return path_with("/search", query)


def read(body: bytes) -> list[AddressPlace]:
    """Return the places of an answer; raises pydantic's `ValidationError`."""
    return [AddressPlace(place.lon, place.lat, place.display_name, _quality(place),
                         place.address.house_number, place.address.road, place.address.postcode)
            for place in _PLACES.validate_json(body)]


def _quality(place: _Place) -> Quality:
    if place.place_rank >= HOUSE_RANK:
        return "house"
    return "street" if place.place_rank >= STREET_RANK else "town"
