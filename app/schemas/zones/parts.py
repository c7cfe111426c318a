"""What zones have in common, whoever publishes them: corners, limits, names, times.

Files have more fields than these, which are not looked at.
"""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

MAX_FEATURES, MAX_STATED = 50_000, 5000
"""Most zones of a file that the service loads, and of one in a request."""

LISTED = Field(max_length=MAX_FEATURES, fail_fast=True, json_schema_extra={"maxItems": MAX_STATED})
"""A list of zones, as requests may state it."""

MAX_PARTS = 1000
"""Most volumes, rings or periods of a zone."""

MAX_RING = 100_000
"""Most corners of a ring."""

UNLIMITED = 99_999.0
"""From this on a limit stands for none."""

Text = Annotated[str, Field(max_length=10_000)]
Corner = Annotated[list[Annotated[float, Field(strict=True)]],
                   Field(min_length=2, max_length=10)]
"""Longitude and latitude, and what may follow, which is not looked at."""

Ring = Annotated[list[Corner], Field(min_length=3, max_length=MAX_RING, fail_fast=True)]
Rings = Annotated[list[Ring], Field(min_length=1, max_length=MAX_PARTS, fail_fast=True)]


class Published(BaseModel):
    """A part of a published file: numbers may stand in quotes, and what isn't known is passed over.
    """

    model_config = ConfigDict(extra="ignore", allow_inf_nan=False, frozen=True,
                              serialize_by_alias=True)


_RESTRICTIONS = {
    "REQ_AUTHORIZATION": "REQ_AUTHORISATION", "REQUIRES_AUTHORISATION": "REQ_AUTHORISATION",
    "REQUIRES_AUTHORIZATION": "REQ_AUTHORISATION", "USPACE": "REQ_AUTHORISATION",
    "U-SPACE": "REQ_AUTHORISATION", "NO_RESTRICTIONS": "NO_RESTRICTION",
}
_REFERENCES = {"GND": "AGL", "SFC": "AGL", "MSL": "AMSL", "HAE": "WGS84"}


def _in_capitals(meant: dict[str, str]) -> BeforeValidator:
    def spelled(value: Any) -> Any:
        if not isinstance(value, str):
            return value
        word = value.strip().upper().replace(" ", "_")
        return meant.get(word, word)
    return BeforeValidator(spelled, json_schema_input_type=str)


Restriction = Annotated[
    Literal["PROHIBITED", "REQ_AUTHORISATION", "CONDITIONAL", "NO_RESTRICTION"],
    _in_capitals(_RESTRICTIONS)]
"""What a zone asks for, as ED-269 spells it. U-space asks for an authorisation of each flight."""

VerticalReference = Annotated[Literal["AGL", "AMSL", "WGS84"], _in_capitals(_REFERENCES)]
"""Above the ground, above the sea, or above the ellipsoid."""

Unit = Annotated[Literal["M", "FT"], _in_capitals({})]
Weekday = Annotated[Literal["MON", "TUE", "WED", "THU", "FRI", "SAT", "SUN", "ANY"],
                    _in_capitals({})]


class TextInLanguage(Published):
    """A text in a language."""

    text: Text | None = Field(None, description="The text.")
    lang: str | None = Field(None, description="Its language.")


def _in_one_language(value: Any) -> Any:
    """Return a text in English if there is one, else in the first language."""
    if isinstance(value, str):
        return value or None
    if isinstance(value, int | float) and not isinstance(value, bool):
        return f"{value:g}"
    texts = [entry if isinstance(entry, dict) else {"text": entry} for entry in (
        value if isinstance(value, list) else [value])]
    texts = [entry for entry in texts if entry.get("text")]
    english = [entry for entry in texts if str(entry.get("lang")).lower().startswith("en")]
    return (english or texts or [{"text": None}])[0]["text"]


Words = Annotated[Text | None, BeforeValidator(
    _in_one_language,
    json_schema_input_type=Text | float | TextInLanguage | list[Text | TextInLanguage | None]
    | None)]
"""A text, which may stand in one language or several."""


def _not_truth(value: Any) -> Any:
    """Return a value; of true and false, which are no numbers, what isn't taken for one."""
    return [] if isinstance(value, bool) else value


Number = Annotated[float, BeforeValidator(_not_truth, json_schema_input_type=float | str)]
"""A number, which may stand in quotes."""


class Limits(Published):
    """From which height to which an area reaches, as ED-269 calls it."""

    unit: Unit = Field(
        "M", alias="uomDimensions", description="What heights are in: metres or feet."
    )
    lower: Number | None = Field(
        None, alias="lowerLimit",
        description="From which height. Left out or 99999: unknown or none."
    )
    lower_reference: VerticalReference | None = Field(
        None, alias="lowerVerticalReference", description="What that counts from."
    )
    upper: Number | None = Field(
        None, alias="upperLimit", description="To which height. Left out or 99999: unknown or none."
    )
    upper_reference: VerticalReference | None = Field(
        None, alias="upperVerticalReference", description="What that counts from."
    )


class Authority(Published):
    """Whom to ask."""

    name: Words = Field(None, description="Its name, in one language or several.")
    service: Words = Field(None, description="Its department.")
    contact_name: Words = Field(None, alias="contactName", description="Whom to ask.")
    site_url: Words = Field(None, alias="siteURL", description="Its page.")
    email: Words = Field(None, description="Its address.")
    phone: Words = Field(None, description="Its number.")
    purpose: Words = Field(None, description="What it is asked for.")


class DailyPeriod(Published):
    """A time of some days of the week."""

    day: Annotated[tuple[Weekday, ...], Field(max_length=8)] = Field(
        (), description="Days of the week. None: all."
    )
    start_time: Text | None = Field(
        None, alias="startTime", description="From when, such as `08:00Z`."
    )
    end_time: Text | None = Field(None, alias="endTime", description="Until when.")


class TimePeriod(Published):
    """When a zone applies."""

    permanent: Text | None = Field(None, description="`YES`: always.")
    start: Text | None = Field(
        None, alias="startDateTime", description="From when, a date and time."
    )
    end: Text | None = Field(None, alias="endDateTime", description="Until when.")
    schedule: Annotated[list[DailyPeriod], Field(max_length=MAX_PARTS)] | None = Field(
        None, description="At which hours. Null: all."
    )


def _listed(value: Any) -> Any:
    """Return a list also of what stands alone, or is left out."""
    if value is None:
        return []
    return value if isinstance(value, list) else [value]


Authorities = Annotated[tuple[Authority, ...], Field(max_length=MAX_PARTS), BeforeValidator(
    _listed, json_schema_input_type=Authority | list[Authority] | None)]
Periods = Annotated[tuple[TimePeriod, ...], Field(max_length=MAX_PARTS), BeforeValidator(
    _listed, json_schema_input_type=TimePeriod | list[TimePeriod] | None)]
