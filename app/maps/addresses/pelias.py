"""Pelias' search."""

from app.maps.addresses.geocoder import MOST_CANDIDATES, Quality
from app.maps.addresses.places import AddressPlace
from app.maps.addresses.server import GeocodingServer, path_with
from app.maps.addresses.shapes import Address, read_features

STREETS = ("street", "intersection")
HOUSES = ("address", "venue")
BETWEEN = "interpolated"


class _Properties(Address):
    layer: str
    label: str
    accuracy: str = ""
    match_type: str = ""
    postalcode: str = ""
    borough: str = ""
    locality: str = ""
    localadmin: str = ""
    region: str = ""


def path_of(address: str, server: GeocodingServer) -> str:
    """Return where an address is asked for."""
    query = {"text": address, "size": MOST_CANDIDATES, "boundary.country": server.country.upper(),
             "lang": server.language, "api_key": server.key}
    return path_with("/search", query)


def read(body: bytes) -> list[AddressPlace]:
    """Return the places of an answer; raises pydantic's `ValidationError`."""
    return read_features(body, _Properties, _place)


def _place(lon: float, lat: float, told: _Properties) -> AddressPlace:
    return AddressPlace(lon, lat, told.label, _quality(told), told.housenumber, told.street,
                        told.postalcode, (told.borough, told.locality, told.localadmin, told.county,
                                          told.region, told.country))


def _quality(told: _Properties) -> Quality:
    if told.layer in HOUSES:
        return "interpolated" if BETWEEN in (told.accuracy, told.match_type) else "house"
    return "street" if told.layer in STREETS else "town"
