"""Flights as DJI's WPML: a KMZ of a template and of the way lines that an aircraft flies.

There is no landing within a way line, so each leads from a take-off to the next landing.

References
----------
DJI, Cloud API, WPML: https://developer.dji.com/doc/cloud-api-tutorial/en/api-reference/dji-wpml/
"""

import time
from collections.abc import Iterator, Mapping, Sequence

from lxml import etree
from lxml.builder import ElementMaker

from app.plans.flights.flight import BeyondFormatError, Flight, WayPoint, note_of
from app.plans.flights.kml import KML, written
from app.plans.flights.numbers import plain
from app.plans.flights.packing import packed
from app.schemas.flights import WpmlInput

WPML = "http://www.dji.com/wpmz/1.0.2"

K = ElementMaker(namespace=KML, nsmap={None: KML, "wpml": WPML})
W = ElementMaker(namespace=WPML, nsmap={"wpml": WPML})

MOST_SPEED = 15.0
"""Metres a second that WPML goes up to."""

LEAST_HEIGHT, MOST_HEIGHT = 1.2, 1500.0
"""Metres above the launch between which it flies."""

STRAIGHT_TO_THE_POINT = "toPointAndStopWithDiscontinuityCurvature"
"""How corners are turned: otherwise they are cut, at zones into these."""


def wpml_files(flights: Sequence[Flight], asked: WpmlInput) -> Mapping[str, bytes]:
    """Return the KMZ of one drone's flights.

    Raises
    ------
    BeyondFormatError
        If one is faster, lower or higher than the format can say.
    """
    for flight in flights:
        _require_sayable(flight)
    hops = [(flight, hop) for flight in flights for hop in flight.hops()]
    return {".kmz": packed({
        "wpmz/template.kml": written(_template(flights, hops, asked)),
        "wpmz/waylines.wpml": written(_way_lines(flights, hops, asked))})}


Hops = Sequence[tuple[Flight, tuple[WayPoint, ...]]]


def _require_sayable(flight: Flight) -> None:
    if flight.top_speed > MOST_SPEED:
        raise BeyondFormatError(
            f"{flight.name} flies {flight.top_speed * 3.6:.1f} km/h over ground, and WPML goes up "
            f"to {MOST_SPEED * 3.6:g}: plan with less drones.speed_kmh, or take another format.")
    if not LEAST_HEIGHT <= flight.altitude <= MOST_HEIGHT:
        raise BeyondFormatError(
            f"{flight.name} flies at {flight.altitude:g} m, and WPML goes from {LEAST_HEIGHT:g} to "
            f"{MOST_HEIGHT:g}: plan with another drones.altitude, or take another format.")


def _template(flights: Sequence[Flight], hops: Hops, asked: WpmlInput) -> etree._Element:
    now = str(round(time.time() * 1000))
    return _document(
        flights, W.author("Tandem"), W.createTime(now), W.updateTime(now), _mission(flights, asked),
        *(K.Folder(
            W.templateType("waypoint"), W.templateId(str(number)),
            W.waylineCoordinateSysParam(
                W.coordinateMode("WGS84"), W.heightMode("relativeToStartPoint")),
            W.autoFlightSpeed(plain(flight.top_speed)), W.globalHeight(plain(flight.altitude)),
            W.globalWaypointTurnMode(STRAIGHT_TO_THE_POINT), W.globalUseStraightLine("1"),
            W.gimbalPitchMode("manual"),
            W.globalWaypointHeadingParam(W.waypointHeadingMode("followWayline")),
            *(K.Placemark(
                _point(point), W.index(str(index)), W.useGlobalHeight("1"),
                W.ellipsoidHeight(plain(flight.altitude)), W.height(plain(flight.altitude)),
                W.useGlobalSpeed("0"), W.waypointSpeed(plain(_speed_from(hop, index))),
                W.useGlobalHeadingParam("1"), W.useGlobalTurnParam("1"),
                *_hovering(flight, point, index))
              for index, point in enumerate(hop)))
          for number, (flight, hop) in enumerate(hops)))


def _way_lines(flights: Sequence[Flight], hops: Hops, asked: WpmlInput) -> etree._Element:
    return _document(flights, _mission(flights, asked), *(
        K.Folder(
            W.templateId(str(number)), W.executeHeightMode("relativeToStartPoint"),
            W.waylineId(str(number)), W.autoFlightSpeed(plain(flight.top_speed)),
            *(K.Placemark(
                _point(point), W.index(str(index)), W.executeHeight(plain(flight.altitude)),
                W.waypointSpeed(plain(_speed_from(hop, index))),
                W.waypointHeadingParam(W.waypointHeadingMode("followWayline")),
                W.waypointTurnParam(W.waypointTurnMode(STRAIGHT_TO_THE_POINT),
                                    W.waypointTurnDampingDist("0")),
                W.useStraightLine("1"), *_hovering(flight, point, index))
              for index, point in enumerate(hop)))
        for number, (flight, hop) in enumerate(hops)))


def _document(flights: Sequence[Flight], *parts: etree._Element) -> etree._Element:
    return K.kml(K.Document(etree.Comment(note_of(flights)), *parts))


def _mission(flights: Sequence[Flight], asked: WpmlInput) -> etree._Element:
    """Return what holds for all way lines: they begin at their height, and end on the ground."""
    return W.missionConfig(
        W.flyToWaylineMode(asked.fly_to_wayline), W.finishAction("autoLand"),
        W.exitOnRCLost(asked.exit_on_rc_lost), W.executeRCLostAction(asked.rc_lost_action),
        W.takeOffSecurityHeight(plain(flights[0].altitude)),
        W.globalTransitionalSpeed(plain(max(flight.top_speed for flight in flights))),
        W.droneInfo(W.droneEnumValue(str(asked.aircraft)),
                    W.droneSubEnumValue(str(asked.aircraft_variant))))


def _speed_from(hop: Sequence[WayPoint], index: int) -> float:
    """Return the speed from a way point to the next, which is how WPML tells speeds."""
    return hop[min(index + 1, len(hop) - 1)].speed


def _point(point: WayPoint) -> etree._Element:
    longitude, latitude = point.place
    return K.Point(K.coordinates(f"{longitude:.7f},{latitude:.7f}"))


def _hovering(flight: Flight, point: WayPoint, index: int) -> Iterator[etree._Element]:
    """Yield the wait at a customer where it hovers, and before its truck is there."""
    if not point.waiting or (point.role == "customer" and flight.lands):
        return
    yield W.actionGroup(
        W.actionGroupId(str(index)), W.actionGroupStartIndex(str(index)),
        W.actionGroupEndIndex(str(index)), W.actionGroupMode("sequence"),
        W.actionTrigger(W.actionTriggerType("reachPoint")),
        W.action(W.actionId("0"), W.actionActuatorFunc("hover"),
                 W.actionActuatorFuncParam(W.hoverTime(f"{point.waiting:.1f}"))))
