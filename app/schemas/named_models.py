"""What a reply says of models and rules of drones that a request names."""

from pydantic import BaseModel, ConfigDict, Field


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class PowerPointReply(_Reply):
    """What flying takes with a weight aboard, in watts."""

    weight: float = Field(description="Amount aboard, in the unit of `demand`.")
    cruise_w: float = Field(description="Power in level flight.")
    hover_w: float = Field(description="Power while it waits in the air.")
    up_w: float = Field(description="Power of the climb.")
    down_w: float = Field(description="Power of the descent.")


class EnergyModelReply(_Reply):
    """The numbers of a preset, for a vehicle type's drones."""

    vehicle_type: str = Field(description="Id of the vehicle type.")
    drone_type: str | None = Field(
        None, description="Id of the drones' type. Left out if it has none.")
    preset: str = Field(description="Name of the preset.")
    available_wh: float = Field(description="What a sortie may take, without the reserve.")
    up_seconds: float = Field(description="Duration of the climb of each leg.")
    down_seconds: float = Field(description="Duration of the descent of each leg.")
    power: list[PowerPointReply] = Field(
        description="Powers by weight aboard; between two weights they are straight lines."
    )


class RuleNumbersReply(_Reply):
    """What is planned by, the rule's numbers or those stated beside it."""

    max_airborne: int | None = Field(description="Drones of one truck in the air at once.")
    truck_waits: bool = Field(description="Whether trucks wait for their drones.")
    max_range: float | None = Field(description="Metres to customers, straight.")
    altitude: float = Field(description="Metres above the ground.")


class LawReply(_Reply):
    """The numbers of driving rules, in seconds."""

    max_driving: float | None = Field(description="At the wheel without a rest. Null: no limit.")
    break_duration: float = Field(description="Length of a rest.")
    split: list[float] | None = Field(
        description="Lengths of two rests that are as good as one. Null: none are.")
    max_driving_per_day: float | None = Field(
        description="At the wheel of one vehicle. Null: no limit.")
    max_work_before_break: float | None = Field(
        description="At work without a rest. Null: no limit.")
    max_working_duration: float | None = Field(
        description="From first departure to last return. Null: no limit.")
    other_work_interrupts: bool = Field(
        description="Whether other work as long as a rest interrupts driving, too.")


class DrivingLawReply(LawReply):
    """The numbers of published driving rules that a vehicle type names."""

    vehicle_type: str = Field(description="Id of the vehicle type.")
    preset: str = Field(description="Name of the rule.")
    source: str = Field(description="Where the rule stands, with its paragraphs.")
    planned: LawReply = Field(description="What the plan keeps.")


class PublishedRuleReply(_Reply):
    """The numbers of a published rule that a vehicle type's drones name. No permission to fly."""

    vehicle_type: str = Field(description="Id of the vehicle type.")
    drone_type: str | None = Field(
        None, description="Id of the drones' type. Left out if it has none.")
    preset: str = Field(description="Name of the rule.")
    source: str = Field(description="Where the rule stands, with its paragraphs.")
    max_airborne: int = Field(description="Drones of one pilot, taken as one truck, at once.")
    truck_waits: bool = Field(description="Whether nothing flies while its truck moves.")
    max_range: float | None = Field(description="Metres from the pilot. Null: it has no number.")
    altitude: float | None = Field(
        description="Metres above the ground, at most. Null: it has no number.")
    planned: RuleNumbersReply = Field(description="What the plan keeps.")
