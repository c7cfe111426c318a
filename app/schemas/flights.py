"""What a client may ask of a plan at `POST /flights`."""

from typing import Annotated, Literal

from fastapi import Query
from pydantic import Field

from app.schemas.check import PlannedProblem
from app.schemas.fields import Input

FlightFormat = Literal["qgc-plan", "qgc-wpl", "kml", "dji-wpml", "geojson"]
Per = Literal["sortie", "vehicle"]

FORMAT_TEXT = (
    "`qgc-plan`: QGroundControl's `.plan`. `qgc-wpl`: MAVLink way points, `QGC WPL 110`. `kml`: "
    "KML 2.2. `dji-wpml`: DJI's WPML, a KMZ. `geojson`: lines with heights.")
PER_TEXT = (
    "`sortie`: a file for each flight. `vehicle`: one for each drone, with all its flights. "
    "Several files come as a ZIP.")


ExitOnLost = Literal["goContinue", "executeLostAction"]
LostAction = Literal["hover", "landing", "goBack"]
FlyToWayline = Literal["safely", "pointToPoint"]
AircraftNumber = Annotated[int, Field(ge=0, le=100_000)]

EXIT_TEXT = ("`exitOnRCLost`: whether a flight goes on (`goContinue`) where the remote control is "
             "lost, or does as `rc_lost_action` says (`executeLostAction`).")
LOST_TEXT = ("`executeRCLostAction`: to `hover` there, to land there (`landing`), or to fly back "
             "to its take-off (`goBack`), straight, whatever zones lie between.")
TO_WAYLINE_TEXT = ("`flyToWaylineMode`: up first and then across (`safely`), or straight to the "
                   "first way point (`pointToPoint`).")
AIRCRAFT_TEXT = "`droneEnumValue`: the aircraft's number with DJI; 89 is a Matrice 350 RTK."
VARIANT_TEXT = "`droneSubEnumValue`: its variant."


class WpmlInput(Input):
    """What way lines of DJI's WPML say beside the flights."""

    exit_on_rc_lost: ExitOnLost = Field("goContinue", description=EXIT_TEXT)
    rc_lost_action: LostAction = Field("hover", description=LOST_TEXT)
    fly_to_wayline: FlyToWayline = Field("safely", description=TO_WAYLINE_TEXT)
    aircraft: AircraftNumber = Field(89, description=AIRCRAFT_TEXT)
    aircraft_variant: AircraftNumber = Field(0, description=VARIANT_TEXT)


async def wpml_asked(
    exit_on_rc_lost: Annotated[ExitOnLost, Query(description=EXIT_TEXT)] = "goContinue",
    rc_lost_action: Annotated[LostAction, Query(description=LOST_TEXT)] = "hover",
    fly_to_wayline: Annotated[FlyToWayline, Query(description=TO_WAYLINE_TEXT)] = "safely",
    aircraft: Annotated[AircraftNumber, Query(description=AIRCRAFT_TEXT)] = 89,
    aircraft_variant: Annotated[AircraftNumber, Query(description=VARIANT_TEXT)] = 0,
) -> WpmlInput:
    """Return what an address asks of way lines."""
    return WpmlInput(exit_on_rc_lost=exit_on_rc_lost, rc_lost_action=rc_lost_action,
                     fly_to_wayline=fly_to_wayline, aircraft=aircraft,
                     aircraft_variant=aircraft_variant)


class FlightsRequest(PlannedProblem):
    """A problem, a plan for it, and how its flights are to be written."""

    format: FlightFormat = Field(description=FORMAT_TEXT)
    per: Per = Field("sortie", description=PER_TEXT)
    wpml: WpmlInput = Field(
        WpmlInput(), description="Of `dji-wpml`: what is done where the remote control is lost, "
        "and what flies.")
