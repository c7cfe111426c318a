"""What a reply says of the plan that it goes on from, and of broken rules."""

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.times import InstantReply, WordsReply


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class ViolationReply(_Reply):
    """A broken rule."""

    code: str = Field(description="Stable name of the rule.")
    path: str = Field(description="Where it is broken, such as `$.plan.routes[0].trips[1]`.")
    message: WordsReply = Field(description="How it is broken.")


class SettledReply(_Reply):
    """How far a vehicle's work is settled."""

    vehicle: str = Field(description="Name of the vehicle.")
    trip: int = Field(description="Index in `trips` of the last one that has begun.")
    stop: int = Field(
        description="Index in its `stops` of the last one that can't be changed: the truck has "
        "been there, is on its way there, or meets a drone there that is in the air."
    )


class ParcelReply(_Reply):
    """A parcel aboard a vehicle that does nothing more."""

    id: str = Field(description="Id of its customer; of a shipment `s1/delivery`.")
    vehicle: str = Field(description="The vehicle in `unavailable` that has it aboard.")
    back: InstantReply = Field(description="When it is at the depots again.")
    depot: str | None = Field(
        description="Where the new plan loads it: id of the depot, or of the vehicle type that "
        "begins at a place of its own. Null: the customer is left out.")
    by: str | None = Field(description="The vehicle that loads it there. Null: nobody does.")


class ChangesReply(_Reply):
    """How much changed of the plan that was given."""

    vehicle: int = Field(description="Orders that another vehicle serves.")
    position: int = Field(description="Orders of the same vehicle that changed places.")
    promise: float = Field(
        description="By how many seconds orders are reached sooner or later than promised, in sum.")


class ReplanReply(_Reply):
    """What became of the plan that was given."""

    settled: list[SettledReply] = Field(
        description="Vehicles that have departed before `freeze_before`. They come first in "
        "`routes`, in this order."
    )
    excused: list[ViolationReply] = Field(
        description="Rules that are broken already by what has happened, such as a window that was "
        "closed after service had begun there. Nothing can mend them."
    )
    parcels: list[ParcelReply] | None = Field(
        None, description="Parcels aboard vehicles that are unavailable, and from where others "
        "deliver them. Left out if there are none."
    )
    doubtful: list[str] | None = Field(
        None, description="Customers, of those stated as `doubtful`, whom the plan has as served "
        "by now though nobody told. Left out if there are none."
    )
    changes: ChangesReply | None = Field(
        None, description="What changed. Left out unless `options.change_costs` asks for it.")
