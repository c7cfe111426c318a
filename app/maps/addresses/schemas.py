"""What `POST /addresses` takes and answers."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.maps.addresses.geocoder import Candidates, Quality
from app.maps.addresses.words import in_words
from app.schemas.fields import Input

MOST_ADDRESSES = 10_000

Text = Annotated[str, Field(min_length=1, max_length=500)]


class AddressesRequest(Input):
    """Addresses to look up."""

    addresses: Annotated[list[Text], Field(min_length=1, max_length=MOST_ADDRESSES)] = Field(
        description="Each on one line, as on a letter: street and house number, postcode and town."
    )
    seconds: Annotated[float, Field(ge=0, le=60)] = Field(
        10.0, description="Longest time until the reply. What isn't known by then is kept for the "
        "next time as far as it was answered: send the same again."
    )


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class PlaceReply(_Reply):
    """A place that an address may mean."""

    location: tuple[float, float] = Field(description="`[longitude, latitude]`.")
    label: str = Field(description="What is there, in the geocoder's words.")
    quality: Quality = Field(
        description="The house itself or a named place, a point between the houses next to it, the "
        "street alone, or something larger."
    )
    by: str = Field(description="The geocoder: `extract`, `nominatim`, `photon` or `pelias`.")


class LookedUpReply(_Reply):
    """What was found for an address."""

    address: str = Field(description="As stated.")
    is_known: bool = Field(description="False: there was no answer yet.")
    places: list[PlaceReply] = Field(
        description="What it may mean, the likeliest first; several: nothing tells which. None: it "
        "is not found."
    )
    doubt: str | None = Field(description="Why the first may be wrong, in words.")

    @classmethod
    def of(cls, address: str, candidates: Candidates | None) -> "LookedUpReply":
        """Return what is said of an address; None: there was no answer."""
        return cls(
            address=address, is_known=candidates is not None,
            places=[PlaceReply(location=(place.lon, place.lat), label=place.label,
                               quality=place.quality, by=place.by) for place in candidates or ()],
            doubt=in_words(address, candidates) if candidates else None)


class AddressesReply(_Reply):
    """What was found."""

    addresses: list[LookedUpReply] = Field(description="In the order of the request.")
    known: int = Field(description="How many were answered.")
    error: str | None = Field(description="Why others weren't, in words.")
    attribution: str = Field(description="Whom to name where places are shown.")
