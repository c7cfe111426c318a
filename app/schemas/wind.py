"""The wind of a request: steady, by the hour, or as Open-Meteo tells it."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag

from app.schemas.errors import ALONE, FORECAST, LISTED
from app.schemas.fields import Input, Opening

MAX_HOURS = 400
"""Most hours of wind; Open-Meteo tells 16 days."""

Strength = Annotated[float, Field(ge=0, le=500)]
Direction = Annotated[float, Field(ge=0, le=360)]

DIRECTION_TEXT = (
    "Where the wind comes from in degrees clockwise from north (the y axis): 0 blows southwards, "
    "90 westwards."
)


class WindInput(Input):
    """A steady wind, felt by drones alone."""

    speed_kmh: Strength = Field(0.0, description="Speed in km/h.")
    direction_deg: Direction = Field(0.0, description=DIRECTION_TEXT)


class WindHourInput(Input):
    """The wind from an instant on, until the next entry."""

    from_time: Opening = Field(
        alias="from",
        description="When this wind begins, in seconds since plan start. The first entry holds "
        "before, too, the last one ever after.",
    )
    speed_kmh: Strength = Field(description="Speed in km/h.")
    direction_deg: Direction = Field(0.0, description=DIRECTION_TEXT)
    gust_kmh: Strength | None = Field(
        None, description="Speed of gusts in km/h, where they are stronger than the wind. "
        "`max_wind_kmh` bounds both. Null: as strong as the wind."
    )


class _Forecast(BaseModel):
    """A part of a reply of Open-Meteo, of which only what is needed here is read."""

    model_config = ConfigDict(extra="ignore", strict=True, allow_inf_nan=False, frozen=True)


WindUnit = Literal["km/h", "m/s", "mp/h", "kn"]
_Speeds = Annotated[list[Annotated[float, Field(ge=0, le=1000)] | None],
                    Field(max_length=MAX_HOURS)]


class HourlyInput(_Forecast):
    """The hours of a forecast, one after another."""

    time: Annotated[list[str | int], Field(max_length=MAX_HOURS)] = Field(
        description="When each hour begins: local dates and times, or Unix time."
    )
    wind_speed_10m: _Speeds = Field(description="Wind of each hour.")
    wind_direction_10m: Annotated[list[Direction | None], Field(max_length=MAX_HOURS)] = Field(
        description="Where it comes from in degrees clockwise from north."
    )
    wind_gusts_10m: _Speeds | None = Field(
        None, description="Gusts of each hour, where they are stronger than the wind. Null, or "
        "null in all hours: none are known, and the wind's speed counts."
    )

    @property
    def gusts(self) -> list[float | None]:
        """Gusts of each hour; empty if none of any is known."""
        stated = self.wind_gusts_10m or []
        return stated if any(gust is not None for gust in stated) else []


class HourlyUnitsInput(_Forecast):
    """What the numbers of a forecast are in."""

    wind_speed_10m: WindUnit = Field("km/h", description="Unit of the wind.")
    wind_gusts_10m: WindUnit = Field("km/h", description="Unit of gusts.")


class OpenMeteoInput(_Forecast):
    """What Open-Meteo's forecast replies to `hourly=wind_speed_10m,wind_direction_10m,…`."""

    utc_offset_seconds: Annotated[int, Field(ge=-86400, le=86400)] = Field(
        0, description="How much later the local times are than UTC."
    )
    hourly_units: HourlyUnitsInput = Field(
        HourlyUnitsInput(), description="What the numbers are in."
    )
    hourly: HourlyInput = Field(description="The hours, one after another.")


class ForecastInput(Input):
    """A forecast as it was replied. It needs `plan_start`."""

    open_meteo: OpenMeteoInput = Field(
        description="The JSON of Open-Meteo's hourly forecast, as it is; what else it has isn't "
        "read."
    )


def _tag_of(value: object) -> str:
    if isinstance(value, list):
        return LISTED
    is_forecast = isinstance(value, ForecastInput) or (
        isinstance(value, dict) and "open_meteo" in value)
    return FORECAST if is_forecast else ALONE


Wind = Annotated[
    Annotated[WindInput, Tag(ALONE)]
    | Annotated[list[WindHourInput], Field(min_length=1, max_length=MAX_HOURS), Tag(LISTED)]
    | Annotated[ForecastInput, Tag(FORECAST)],
    Discriminator(_tag_of),
]
