"""What fields of a request have in common: their types, bounds and strictness."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag

from app.schemas.errors import IN_PLACE, LISTED
from app.schemas.limits import MAX_CUSTOMERS
from app.schemas.rows import HeldAsArray, Row
from app.schemas.times import READ_DURATION, READ_INSTANT, READ_OPENING
from model.problem import MAX_DIMENSIONS, MAX_MONEY, MAX_QUANTITY

MAX_AMOUNT = MAX_QUANTITY // 1000
"""Largest amount, duration in seconds or distance in metres: all are held as thousandths."""

MAX_DEPOTS = 100
MAX_LAUNCH_SITES = 100

Name = Annotated[str, Field(min_length=1, max_length=200)]
Count = Annotated[int, Field(ge=0, le=1_000_000)]
Amount = Annotated[float, Field(ge=0, le=MAX_AMOUNT)]
Duration = Annotated[float, Field(ge=0, le=MAX_AMOUNT), READ_DURATION]
Instant = Annotated[float, Field(ge=0, le=MAX_AMOUNT), READ_INSTANT]
Opening = Annotated[float, Field(ge=0, le=MAX_AMOUNT), READ_OPENING]
"""An instant from which on something is so."""
Metres = Annotated[float, Field(ge=0, le=MAX_AMOUNT)]
Money = Annotated[float, Field(ge=0, le=MAX_MONEY)]
# Speed and factor together keep every share of the fastest speed above a millionth.
Speed = Annotated[float, Field(ge=1, le=1000)]
Demand = Annotated[list[Amount], Field(min_length=1, max_length=MAX_DIMENSIONS)]
Location = tuple[float, float]
LocationIndex = Annotated[
    int, Field(ge=0, le=MAX_CUSTOMERS + MAX_DEPOTS + MAX_LAUNCH_SITES)]
Rounding = Literal["exact", "round", "trunc", "dimacs", "thousandths"]
Skills = Annotated[list[Name], Field(max_length=100)]
Goods = Annotated[list[Name], Field(max_length=100)]
VehicleCosts = Annotated[dict[Name, Money], Field(max_length=200)]
DurationsByType = Annotated[dict[Name, Duration], Field(max_length=200)]
MAX_INFO_ENTRIES = 20
MAX_INFO_LENGTH = 500
Info = Annotated[
    dict[Name, Annotated[str, Field(max_length=MAX_INFO_LENGTH)]],
    Field(max_length=MAX_INFO_ENTRIES),
]
MAX_PLACES = MAX_CUSTOMERS + MAX_DEPOTS + MAX_LAUNCH_SITES + 1
"""Most rows of a matrix, and columns: what `location_index` can name."""

_Row = Annotated[Row, HeldAsArray(Annotated[
    list[Annotated[float, Field(le=MAX_AMOUNT)] | None],
    Field(fail_fast=True, max_length=MAX_PLACES)])]
Table = Annotated[list[_Row], Field(fail_fast=True, max_length=MAX_PLACES)]

LOCATION_TEXT = (
    "`[x, y]` in units of `planar_unit` metres, or `[longitude, latitude]` in degrees when "
    "`coordinate_system` is `geographic`, or then `{\"address\": \"…\"}` where the service has a "
    "geocoder. May be left out where `matrices` cover every vehicle."
)
LOCATION_INDEX_TEXT = "Row and column of this place in `matrices`, from 0. Needed with `matrices`."
LAUNCH_TEXT = ("Whether drones may take off from a truck there and be recovered. It says nothing "
               "of who may serve the place.")


Approach = Literal["any", "curb"]
"""From which side of the street a place may be reached."""

APPROACH_TEXT = (
    "How roads lead there: `any`, or `curb`, with the place on the side of the street where one "
    "stops, and on in the same direction, without a U-turn. Null: as `roads.approach` says.")

Avoided = Literal["tolls", "motorways", "ferries"]
"""What vehicles may keep off."""


class Input(BaseModel):
    """Strict on types, names and finiteness."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)


class AddressInput(Input):
    """A place by its address, to be looked up."""

    address: Annotated[str, Field(min_length=1, max_length=500)] = Field(
        description="As on a letter, on one line: street and house number, postcode and town."
    )


def _tag_of_place(value: object) -> str:
    """Tell how a place is stated; an object of coordinates is told that it should be a list."""
    is_address = isinstance(value, AddressInput) or (isinstance(value, dict) and "address" in value)
    return IN_PLACE if is_address else LISTED


PlaceLocation = Annotated[
    Annotated[Location, Tag(LISTED)] | Annotated[AddressInput, Tag(IN_PLACE)],
    Discriminator(_tag_of_place),
]


def point_of(location: Location | AddressInput | None) -> Location | None:
    """Return the coordinates of a place, if it states any."""
    return None if isinstance(location, AddressInput) else location
