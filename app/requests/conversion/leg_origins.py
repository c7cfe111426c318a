"""What the legs of a request are made of, as replies tell."""

from dataclasses import dataclass
from typing import Literal

from app.schemas.fields import Avoided

By = Literal["matrix", "roads", "great_circle", "straight", "flight"]

AS_THE_CROW_FLIES = ("Driving is as the crow flies: the service has no roads for this profile "
                     "(TANDEM_ROADS), and the request no matrix.")
AS_ASKED = "Driving is as the crow flies, as the request's roads ask for."


@dataclass(frozen=True)
class LegOrigin:
    """What the legs of one profile are made of; the fields are those of a reply."""

    profile: str
    by: By
    engine: str | None = None
    estimated: int = 0
    detour: float | None = None
    farthest_from_road_m: float | None = None
    note: str | None = None
    avoid: tuple[Avoided, ...] = ()
