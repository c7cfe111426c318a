"""What a client may ask of a plan at `POST /flights`."""

from typing import Literal

from pydantic import Field

from app.schemas.check import PlannedProblem

FlightFormat = Literal["qgc-plan", "qgc-wpl", "kml", "dji-wpml", "geojson"]
Per = Literal["sortie", "vehicle"]

FORMAT_TEXT = (
    "`qgc-plan`: QGroundControl's `.plan`. `qgc-wpl`: MAVLink way points, `QGC WPL 110`. `kml`: "
    "KML 2.2. `dji-wpml`: DJI's WPML, a KMZ. `geojson`: lines with heights.")
PER_TEXT = (
    "`sortie`: a file for each flight. `vehicle`: one for each drone, with all its flights. "
    "Several files come as a ZIP.")


class FlightsRequest(PlannedProblem):
    """A problem, a plan for it, and how its flights are to be written."""

    format: FlightFormat = Field(description=FORMAT_TEXT)
    per: Per = Field("sortie", description=PER_TEXT)
