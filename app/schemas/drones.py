"""The drones of a vehicle type."""

from collections.abc import Sequence
from typing import Annotated, Protocol, Self

from pydantic import Discriminator, Field, Tag, model_validator

from app.schemas.energy import EnergyInput, Watts
from app.schemas.errors import ALONE, LISTED
from app.schemas.fields import Count, Demand, Duration, Input, Metres, Money, Name, Speed
from app.schemas.rulebook import RuleName, fill_in

DEFAULT_DRONE_SPEED_KMH = 60.0
DEFAULT_ALTITUDE_M = 100.0

MAX_DRONE_TYPES = 8
"""Most types of drones on a truck."""


class DroneCostsInput(Input):
    """What a drone costs, in one currency."""

    per_km: Money = Field(0.25, description="Cost per kilometre flown.")
    per_hour: Money = Field(0.0, description="Cost per hour from take-off to the end of recovery.")


class TurnaroundInput(Input):
    """What a drone needs before it takes off again."""

    swap_duration: Duration = Field(
        0.0,
        description="Time to swap the battery in seconds, by which each launch of a trip takes "
        "longer, but for its first; of vehicles that fly, the time at the depot between trips.",
    )
    batteries: Count | None = Field(
        None,
        description="Charged batteries that a truck has for each trip, those in its drones among "
        "them: every sortie takes one. Null: enough.",
    )
    charge_w: Watts = Field(
        0.0,
        description="Power in watts at which a drone's only battery is charged while it rests "
        "aboard, full as each trip begins; it needs `energy`, and excludes the other two. 0: every "
        "launch begins with a full battery.",
    )


class Flyer(Protocol):
    """What flies: drones on trucks, or vehicles that fly by themselves."""

    @property
    def profile(self) -> str:
        """Entry of `matrices` that holds the flights."""

    @property
    def capacity(self) -> Sequence[float]:
        """Largest payload."""

    @property
    def count(self) -> int:
        """How many there are of it."""

    @property
    def endurance(self) -> float | None:
        """Seconds of a flight."""

    @property
    def speed_kmh(self) -> float | None:
        """Airspeed."""

    @property
    def altitude(self) -> float:
        """Metres above ground."""

    @property
    def max_range(self) -> float | None:
        """Metres to customers, straight."""

    @property
    def preset(self) -> RuleName | None:
        """A published rule."""

    @property
    def max_wind_kmh(self) -> float | None:
        """Strongest wind, and gusts, in which it may be in the air."""

    @property
    def energy(self) -> EnergyInput | None:
        """What flights take."""

    @property
    def turnaround(self) -> TurnaroundInput | None:
        """What is needed before the next flight."""


class DronesInput(Input):
    """Equal drones that ride on every truck of a type."""

    id: Name | None = Field(
        None,
        description="Name of this type of drones, unique on its truck. Needed in a list; else it "
        "may be null, and the drones are called `drone`.",
    )
    count: int = Field(ge=0, le=32, description="Drones per truck.")
    preset: RuleName | None = Field(
        None,
        description="A published rule whose `max_range` and `altitude` count here, and whose "
        "`max_airborne` and `truck_waits` count for the vehicle type, unless they are stated. The "
        "reply has its numbers and source. It is no permission to fly. Null: none.",
    )
    capacity: Demand = Field(
        description="Largest payload at any point of a sortie, per dimension, in the unit of "
        "`demand`."
    )
    speed_kmh: Speed | None = Field(
        None,
        description=f"Airspeed in km/h, {DEFAULT_DRONE_SPEED_KMH:g} by default. Without meaning "
        "where the profile has a matrix.",
    )
    profile: Name = Field("drone", description="Entry of `matrices` that holds the flights.")
    endurance: Duration | None = Field(
        None, description="Longest flight from take-off to recovery in seconds. Null: no limit."
    )
    max_range: Metres | None = Field(
        None,
        description="How far a customer of a sortie lies at most from where it is launched, and "
        "from where it is recovered: straight, in metres, whatever a matrix says. Null: no limit.",
    )
    max_wind_kmh: Annotated[float, Field(ge=0, le=500)] | None = Field(
        None,
        description="Strongest wind and strongest gusts in km/h in which a drone "
        "may be in the air: no flight lasts into an hour that has more. Null: any.",
    )
    endurance_includes_waiting: bool = Field(
        True, description="Whether waiting for the truck at the recovery stop uses endurance."
    )
    launch_duration: Duration = Field(
        0.0, description="Time to launch in seconds; the truck stands still meanwhile."
    )
    recovery_duration: Duration = Field(
        0.0, description="Time to recover in seconds; the truck stands still meanwhile."
    )
    service_duration: Duration | None = Field(
        None, description="Time at a customer in seconds. Null: the customer's `service_duration`."
    )
    turnaround: TurnaroundInput | None = Field(
        None, description="What a drone needs before it takes off again. Null: nothing."
    )
    max_customers_per_sortie: int = Field(
        1, ge=1, le=100, description="Most customers on one flight."
    )
    costs: DroneCostsInput = Field(DroneCostsInput(), description="What flying costs.")
    altitude: Annotated[float, Field(ge=0, le=10_000)] = Field(
        DEFAULT_ALTITUDE_M,
        description="Metres above the ground at which they fly, which decides which `zones` of the "
        "airspace they meet.",
    )
    energy: EnergyInput | None = Field(
        None,
        description="What flights take of the battery, beside `endurance`. Null: nothing is known.",
    )

    @model_validator(mode="after")
    def _keep_rule(self) -> Self:
        """Fill in what the rule named has and the request doesn't state."""
        fill_in(self, self.preset)
        return self


def _tag_of(value: object) -> str:
    return LISTED if isinstance(value, list) else ALONE


Drones = Annotated[
    Annotated[DronesInput, Tag(ALONE)]
    | Annotated[list[DronesInput], Field(max_length=MAX_DRONE_TYPES), Tag(LISTED)],
    Discriminator(_tag_of),
]
