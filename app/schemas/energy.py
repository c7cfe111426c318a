"""What flying takes of a drone's battery."""

from typing import Annotated, Literal

from pydantic import Field

from app.schemas.fields import Amount, Duration, Input, Metres
from model.problem import MAX_BATTERY

Preset = Literal[
    "murray-raj-2020", "murray-raj-2020-linear-fast", "murray-raj-2020-linear-slow",
    "dorling-2017", "rodrigues-2022"]
"""Published models of what flying takes, by authors and year."""

Watts = Annotated[float, Field(ge=0, le=1e5)]
WattHours = Annotated[float, Field(ge=1e-3, le=MAX_BATTERY)]


class PowerInput(Input):
    """Power by the weight aboard: a fixed part, and one for each kilogram."""

    cruise_w: Watts = Field(description="Power in level flight, empty, in watts.")
    cruise_w_per_kg: Watts = Field(0.0, description="More of it for each kg aboard, in watts.")
    hover_w: Watts | None = Field(
        None, description="Power while it waits in the air, empty, in watts. Null: as in cruise."
    )
    hover_w_per_kg: Watts | None = Field(
        None, description="More of it for each kg aboard, in watts. Null: as in cruise."
    )


class ClimbInput(Input):
    """Climb and descent of each leg of a sortie."""

    altitude: Metres = Field(
        0.0, description="Height climbed in metres, by which a `preset` tells the power."
    )
    up_seconds: Duration = Field(
        0.0,
        description="How long the climb takes. A part of each leg's duration: added to flights "
        "computed from locations, included in those of a matrix.",
    )
    up_w: Watts = Field(0.0, description="Power of the climb, empty, in watts.")
    up_w_per_kg: Watts = Field(0.0, description="More of it for each kg aboard, in watts.")
    down_seconds: Duration = Field(0.0, description="How long the descent takes; as `up_seconds`.")
    down_w: Watts = Field(0.0, description="Power of the descent, empty, in watts.")
    down_w_per_kg: Watts = Field(0.0, description="More of it for each kg aboard, in watts.")


class EnergyInput(Input):
    """A battery and what flying takes of it. State `power` or `preset`."""

    battery_wh: WattHours = Field(description="What the battery holds in watt-hours.")
    reserve: Annotated[float, Field(ge=0, le=0.99)] = Field(
        0.2, description="Share of the battery that no sortie may take."
    )
    kg_per_unit: Amount = Field(
        1.0, description="Weight of a unit of the demand's `weight_dimension` in kg."
    )
    weight_dimension: int = Field(
        0, ge=0, le=7,
        description="Dimension of `demand` and `pickup` that tells the weight, from 0."
    )
    power: PowerInput | None = Field(
        None, description="What level flight and hovering take. Null: as `preset` says."
    )
    climb: ClimbInput | None = Field(
        None,
        description="Climb and descent. Null: as the preset `murray-raj-2020` says, else flights "
        "take no time for these.",
    )
    lands: bool = Field(
        True,
        description="Whether the drone lands at customers, so that waiting and serving there take "
        "nothing. False: it hovers.",
    )
    preset: Preset | None = Field(
        None,
        description="A published model of the power of cruise, hovering, climb and descent; the "
        "reply states its numbers. Null: as `power` and `climb` say.",
    )
