"""What a client may ask of a plan at `POST /explain`, and what it gets back."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.check import PlannedProblem
from app.schemas.limits import MAX_TIME_LIMIT
from app.schemas.hindrances import StormReply, ZoneReply
from app.schemas.plan import ALTERNATIVE_TEXT, PART_TEXT
from app.schemas.reasons import ChangeReply, ReasonReply
from app.schemas.response import WARNINGS_TEXT, CostReply, WarningReply
from app.schemas.shipment import EndKind
from app.schemas.times import InstantReply, WordsReply

OTHERS_STAY = "All other customers stay with their vehicles, in their order."


class ExplainOptions(BaseModel):
    """How much is tried."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)

    time_limit: Annotated[float, Field(gt=0, le=MAX_TIME_LIMIT)] = Field(
        1.0, description="Seconds until the reply: what was not tried by then is not in it. Where "
        "reading took them, a fifth as many more.")


class ExplainRequest(PlannedProblem):
    """A problem, a plan for it, and what is asked."""

    customer: str | None = Field(
        None, description="Id of the customer of whom it is asked why he is served where he is. "
        "One end of a shipment (`s1/pickup`) moves alone. Null: of nobody.")
    shipment: str | None = Field(
        None, description="Id of a shipment of which the same is asked, all ends of which move as "
        "one. Null: of none.")
    drones: bool = Field(
        False, description="Whether to tell what drones save: each sortie, and all in sum.")
    idle_drones: bool = Field(
        False, description="Whether to tell why drones fly nothing, of each vehicle in use.")
    options: ExplainOptions = Field(ExplainOptions(), description="How much is tried.")


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class PositionReply(_Reply):
    """Where in a vehicle's work a customer is served."""

    trip: int = Field(description="Index in `trips` of the vehicle.")
    own_trip: bool = Field(description="Whether nobody else is on the trip.")
    stop: int = Field(
        description="Index in `stops` of the truck's stop there; by drone, where it is launched.")
    after: str = Field(
        description="Id of the stop before; by drone, of the stop where it is launched.")
    recovery_stop: int | None = Field(
        description="Index in `stops` where the drone is recovered. Null by truck.")
    recovered_at: str | None = Field(description="Id of that stop. Null by truck.")


class EndPlacedReply(_Reply):
    """Where and when an end of a shipment is served."""

    kind: EndKind = Field(description="Which end.")
    id: str = Field(description="Id of the shipment.")
    part: str | None = Field(None, description=f"{PART_TEXT} Left out where it hasn't.")
    by: Literal["truck", "drone"] = Field(description="Who comes.")
    window: int | None = Field(description="As a customer's.")
    position: PositionReply = Field(description="Where in the vehicle's work.")
    arrival: InstantReply = Field(description="Arrival.")
    service_start: InstantReply = Field(description="Start of service.")


class PlacedReply(_Reply):
    """Where and when a customer is served; of a shipment, its first end."""

    vehicle: str | None = Field(description="Name of the vehicle. Null: none.")
    alternative: str | None = Field(None, description=f"{ALTERNATIVE_TEXT} Left out where it is.")
    by: Literal["truck", "drone"] | None = Field(
        description="Who comes; `drone` if one comes to any end of a shipment. Null: nobody.")
    window: int | None = Field(
        description="Index in `time_windows` of the one in which service starts. Null: there is "
        "but one, or no service.")
    position: PositionReply | None = Field(description="Where in its work. Null: nowhere.")
    service_start: InstantReply | None = Field(
        description="Start of service. Null: there is none.")
    ends: list[EndPlacedReply] = Field(
        [], description="All ends of a shipment, in the order of visits. Left out of customers.")
    companions: list[str] = Field(
        [], description="Ids of customers and shipments who are served by the vehicle then, too, "
        "since relations bind them to be served by one. Left out where there is none.")


class HereReply(PlacedReply):
    """Where the plan serves the customer."""

    saving: CostReply = Field(
        description="What the plan would cost less without him, by term; nothing is counted for "
        f"leaving him out. {OTHERS_STAY}")


class RuleReply(_Reply):
    """A rule that forbids an alternative."""

    code: str = Field(description="Stable name of the rule, as `POST /check` names it.")
    message: WordsReply = Field(description="How it would be broken.")


class AlternativeReply(PlacedReply):
    """The best that was found of one kind."""

    kind: Literal["place", "by", "window", "vehicle", "unassigned"] = Field(
        description="`place`: elsewhere with the same vehicle, in the same way. `by`: by drone "
        "instead of truck, or the other way round, with any vehicle. `window`: in this window "
        "alone. `vehicle`: with this other vehicle. `unassigned`: not at all.")
    window_at: str | None = Field(
        None, description="Of a shipment's `window`: the end whose it is, as `s1/delivery`.")
    cost: CostReply = Field(
        description="What the plan would cost more, by term; less where negative. "
        f"{OTHERS_STAY} Where it is not feasible: the cost with the rule broken.")
    feasible: bool = Field(description="Whether no rule is broken.")
    reasons: list[RuleReply] = Field(description="Rules that forbid it.")


class BindingReply(_Reply):
    """A limit that is reached, or of which a unit more would save something."""

    rule: str = Field(description="Field of the request that states it, as `time_window.latest`.")
    at: str = Field(description="Id of the customer or vehicle type whose field it is; empty: it "
                    "is the request's.")
    slack: float | None = Field(
        description="How much is left until it, in units. 0: none. Null: the customer isn't "
        "served where it counts, or it is no number.")
    unit: Literal["minute", "unit", "km", "vehicle", "trip", "Wh", "W", "rule"] = Field(
        description="What `slack` is counted in. `rule`: it has no number, as `vehicles`.")
    saves_per_unit: float = Field(
        description="What the plan would cost less with one unit more, or without the `rule`, the "
        f"customer being served where that is cheapest of the places tried. {OTHERS_STAY} "
        "0: nothing.")
    changes: list[ChangeReply] = Field(
        description="A unit more, or no rule, as changes of the request; none where it has no "
        "place for them.")


class SearchedReply(_Reply):
    """What a search came to."""

    cost: CostReply = Field(description="Cost by term.")
    unassigned: int = Field(description="Customers left out.")
    search_iterations: int = Field(description="Iterations of the search.")


class SortieWorthReply(_Reply):
    """What a sortie saves."""

    vehicle: str = Field(description="Name of the vehicle.")
    trip: int = Field(description="Index in its `trips`.")
    sortie: int = Field(description="Index in the trip's `sorties`.")
    customers: list[str] = Field(description="Ids of the customers served.")
    saves: float | None = Field(
        description="What the plan would cost more if trucks served them. 0 or less: the sortie "
        f"saves nothing. {OTHERS_STAY} Null: no truck can, or it was not tried.")
    tried: bool = Field(description="Whether there was time to try.")


class DronesReply(_Reply):
    """What drones save."""

    sorties: list[SortieWorthReply] = Field(description="One by one, as the plan lists them.")
    saves: float | None = Field(
        description="What drones save against trucks alone: `trucks_alone` less `with_drones`, "
        "two searches of the same length from the same plan. Null: there was no time, trucks "
        "alone leave out more customers, or the plan is one that goes on.")
    saves_at_most: float | None = Field(
        description="`trucks_alone` less this plan's cost: an upper bound, since this plan may "
        "have been searched for longer. Null as `saves`.")
    seconds: float = Field(description="How long each of the searches took.")
    with_drones: SearchedReply | None = Field(description="The search with drones.")
    trucks_alone: SearchedReply | None = Field(description="The search without any.")


class IdleDronesReply(_Reply):
    """Why a vehicle's drones fly nothing."""

    vehicle: str = Field(description="Name of the vehicle.")
    code: str = Field(
        description="Stable name of the reason. `COSTS_MORE`: flights are possible, and none of "
        "those tried would save. `SAVES`: one would, and the search didn't find it. `KIND`, "
        "`CAPACITY`, `RANGE`: nobody may be served by its drones, no order is light enough, nobody "
        "is within reach. `SORTIES`, `LOST`, `UNAVAILABLE`: they don't take off. `UNTRIED`: there "
        "was no time. Else the rule that most flights would break, as `POST /check` names it.")
    message: WordsReply = Field(description="The reason in words.")
    customer: str | None = Field(description="Id of the customer of whom it speaks. Null: nobody.")
    cost: float | None = Field(
        description="What the best legal flight would make the plan cost more; less where "
        f"negative. {OTHERS_STAY} Null: there is none.")


class ExplainReply(_Reply):
    """Why a customer is served where he is, and what else it would cost."""

    customer: str | None = Field(description="Id of the customer asked about.")
    shipment: str | None = Field(description="Id of the shipment asked about.")
    cost: CostReply = Field(description="What the plan costs, by term.")
    here: HereReply | None = Field(description="Where the plan serves him. Null: nowhere.")
    alternatives: list[AlternativeReply] = Field(
        description=f"What else could be done with him. {OTHERS_STAY}")
    binding: list[BindingReply] = Field(
        description="Limits that bind at his stop, those that cost most first.")
    reasons: list[ReasonReply] = Field(
        description="If he is left out: why, by vehicle type, as `POST /plan` tells it.")
    zones: list[ZoneReply] = Field(
        [], description="Published zones in which he is, where no drone lands.")
    wind: list[StormReply] = Field(
        [], description="When drones may not fly, by `max_wind_kmh`.")
    drones: DronesReply | None = Field(description="What drones save. Null: it was not asked.")
    idle_drones: list[IdleDronesReply] | None = Field(
        None, description="Why drones fly nothing, by vehicle in use. Null: it was not asked.")
    complete: bool = Field(
        description="Whether there was time to try all that is tried with time enough.")
    warnings: list[WarningReply] = Field([], description=WARNINGS_TEXT)
