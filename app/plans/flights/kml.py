"""Flights as KML 2.2: lines above ground, the places on the way, and the zones around.

References
----------
OGC 07-147r2, OGC KML 2.2.
"""

from collections.abc import Iterable, Mapping, Sequence

from lxml import etree
from lxml.builder import ElementMaker

from app.plans.flights.flight import Flight, WayPoint, note_of
from app.plans.flights.numbers import plain
from app.plans.flights.zones import zones_of

KML = "http://www.opengis.net/kml/2.2"

E = ElementMaker(namespace=KML, nsmap={None: KML})

BLUE, RED, HALF_RED = "ffb27200", "ff3b3bd6", "603b3bd6"
"""Opacity, blue, green and red."""

WORDS = {"launch": "Take-off", "customer": "Customer", "recovery": "Recovery"}


def kml_files(flights: Sequence[Flight]) -> Mapping[str, bytes]:
    """Return a document of all flights and of the zones around them."""
    zones = [E.Placemark(E.name(f"Zone {number}"), E.styleUrl("#zone"), E.Polygon(
        E.altitudeMode("clampToGround"),
        E.outerBoundaryIs(E.LinearRing(_coordinates((*place, 0.0) for place in ring)))))
        for number, ring in enumerate(zones_of(flights), 1)]
    document = E.kml(E.Document(
        E.name(shown(flights[0].drone)), E.description(note_of(flights)),
        E.Style(E.LineStyle(E.color(BLUE), E.width("3")), E.PolyStyle(E.color("40b27200")),
                id="flight"),
        E.Style(E.LineStyle(E.color(RED), E.width("1")), E.PolyStyle(E.color(HALF_RED)),
                id="zone"),
        *map(_folder, flights),
        *([E.Folder(E.name("Zones that flights stay out of"), *_kept(flights[0]), *zones)]
          if zones else [])))
    return {".kml": written(document)}


def written(root: etree._Element) -> bytes:
    """Return a document in UTF-8."""
    etree.indent(root)
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True) + b"\n"


def shown(text: str) -> str:
    """Return a text without characters that XML doesn't have."""
    return "".join(character if character.isprintable() else "\N{REPLACEMENT CHARACTER}"
                   for character in text)


def _folder(flight: Flight) -> etree._Element:
    at_customers = "lands" if flight.lands else "hovers"
    line = E.Placemark(
        E.name(shown(flight.name)),
        E.description(f"It {at_customers} at customers. Heights are above ground."),
        E.styleUrl("#flight"),
        E.ExtendedData(*_data(
            vehicle=flight.vehicle, drone=flight.drone, flight=flight.number,
            launch_time=flight.told(flight.launch.arrival),
            recovery_time=flight.told(flight.recovery_time))),
        E.LineString(E.extrude("1"), E.altitudeMode("relativeToGround"),
                     _coordinates(flight.line())))
    return E.Folder(E.name(shown(flight.name)), line, *(
        _place(flight, point) for point in flight.way_points if point.role != "bend"))


def _kept(flight: Flight) -> Iterable[etree._Element]:
    return [E.description(f"Flights keep {flight.buffer:g} m from them.")] if flight.buffer else []


def _place(flight: Flight, point: WayPoint) -> etree._Element:
    return E.Placemark(
        E.name(shown(f"{WORDS[point.role]} {point.id}")),
        E.ExtendedData(*_data(arrival=flight.told(point.arrival), waiting=round(point.waiting, 3),
                              speed=round(point.speed, 3))),
        E.Point(E.altitudeMode("relativeToGround"),
                _coordinates([(*point.place, flight.altitude)])))


def _data(**values: str | float) -> Iterable[etree._Element]:
    return [E.Data(E.value(shown(str(value))), name=name) for name, value in values.items()]


def _coordinates(places: Iterable[tuple[float, float, float]]) -> etree._Element:
    return E.coordinates(" ".join(f"{longitude:.7f},{latitude:.7f},{plain(height)}"
                                  for longitude, latitude, height in places))
