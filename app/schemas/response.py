"""What a client gets back from `POST /plan`, units in every field.

Replies are written by `app.plans.replies` as plain data for speed; these classes document them, and
a test holds the two together.
"""

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.hindrances import AirspaceReply
from app.schemas.forecast import OutlookReply
from app.schemas.hub import ChargingReply, HubReply
from app.schemas.lateness import (
    LATENESS_TEXT, RISK_TEXT, LatenessReply, LatenessRiskReply,
)
from app.schemas.legs import LegsReply
from app.schemas.named_models import DrivingLawReply, EnergyModelReply, PublishedRuleReply
from app.schemas.plan import (
    ALTERNATIVE_TEXT, PART_TEXT, STOP_ID_TEXT, STOP_KIND_TEXT, VISIT_KIND_TEXT, StopKind,
)
from app.schemas.reasons import ReasonReply
from app.schemas.replanned import ReplanReply
from app.schemas.shipment import EndKind
from app.schemas.times import InstantReply

LINE = ("as an encoded polyline of six decimals, latitude (of planar places y) first. Null: not "
        "known, or not found in time. Left out unless `options.geometry` asks for it.")


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class CostReply(_Reply):
    """What the plan costs, by term, in the currency of the request's costs."""

    total: float = Field(description="Sum of all terms.")
    fixed: float = Field(description="Vehicles used.")
    distance: float = Field(description="Kilometres driven, with what is aboard, and flown.")
    stops: float = Field(description="Customers served by trucks.")
    time: float = Field(description="Hours worked and flown.")
    overtime: float = Field(
        description="Hours past shifts or longest working durations, on top of `time`."
    )
    lateness: float = Field(description="Late arrivals.")
    earliness: float = Field(description="Waiting for windows to open.")
    lateness_risk: float | None = Field(
        None, description=f"Late arrivals to be expected beside the planned ones. {RISK_TEXT}")
    makespan: float = Field(description="The latest end, where that costs.")
    balance: float = Field(description="Unequal work of vehicles, where that costs.")
    too_few_vehicles: float = Field(
        description="Vehicles that lack, at a price that means nothing by itself.")
    unassigned: float = Field(description="Customers left out.")
    changes: float = Field(description="What changed of the plan gone on from, where that costs.")


class StopReply(_Reply):
    """A place where the truck halts."""

    kind: StopKind = Field(description=STOP_KIND_TEXT)
    id: str = Field(description=STOP_ID_TEXT)
    alternative: str | None = Field(None, description=f"{ALTERNATIVE_TEXT} Left out where it is.")
    part: str | None = Field(None, description=f"{PART_TEXT} Left out where it hasn't.")
    arrival: InstantReply = Field(
        description="Arrival; at the trip's first stop, when loading is done.")
    service_start: InstantReply = Field(description="Start of service; at depots the arrival.")
    departure: InstantReply = Field(
        description="Departure, once service, launches and recoveries are done; at the trip's last "
        "stop, its end."
    )
    setup: float = Field(0.0, description="Setup from the arrival on in seconds, if any.")
    waiting: float = Field(description="Wait for the time window to open in seconds.")
    lateness: float | LatenessReply = Field(description=LATENESS_TEXT)
    load: list[float] = Field(
        description="Load when the truck leaves, or ends its trip, per dimension."
    )
    energy_left_wh: float | None = Field(
        None,
        description="What is left in the battery, reserve included, when the vehicle takes off or, "
        "at the last stop, has landed, in watt-hours. Left out of trucks, and where not known."
    )
    geometry: str | None = Field(
        None, description=f"The way from the stop before, {LINE} A trip's first stop has none."
    )
    info: dict[str, str] | None = Field(
        None, description="The customer's `info` of the request. Left out if it has none."
    )


class VisitReply(_Reply):
    """A customer served by a drone."""

    kind: EndKind | None = Field(None, description=VISIT_KIND_TEXT)
    id: str = Field(description="Id of the customer, or of the shipment.")
    alternative: str | None = Field(None, description=f"{ALTERNATIVE_TEXT} Left out where it is.")
    part: str | None = Field(None, description=f"{PART_TEXT} Left out where it hasn't.")
    arrival: InstantReply = Field(description="Arrival of the drone.")
    service_start: InstantReply = Field(description="Start of service.")
    departure: InstantReply = Field(description="Departure of the drone.")
    setup: float = Field(0.0, description="Setup from the arrival on in seconds, if any.")
    lateness: float | LatenessReply = Field(description=LATENESS_TEXT)
    load: list[float] = Field(description="What the drone carries when it leaves, per dimension.")
    energy_left_wh: float | None = Field(
        None,
        description="What is left in the battery, reserve included, when the drone leaves, in "
        "watt-hours. Left out where not known."
    )
    geometry: str | None = Field(None, description=f"The flight that leads there, {LINE}")
    info: dict[str, str] | None = Field(
        None, description="The customer's `info` of the request. Left out if it has none."
    )


class SortieReply(_Reply):
    """One drone flight."""

    drone: str = Field(
        description="Name of the drone, `<vehicle>/drone-<number>`, numbered over all types.")
    drone_type: str | None = Field(
        None, description="Id of the drone's type. Left out if it has none.")
    launch_stop: int = Field(description="Index in `stops` where it is launched.")
    recovery_stop: int = Field(description="Index in `stops` where it is recovered.")
    load: list[float] = Field(description="What the drone carries at take-off, per dimension.")
    customers: list[VisitReply] = Field(description="Customers served, in order.")
    launch_time: InstantReply = Field(description="Take-off; the launch lies before it.")
    recovery_time: InstantReply = Field(description="End of the recovery.")
    distance: float = Field(description="Distance flown in metres.")
    duration: float = Field(description="From take-off to the end of the recovery in seconds.")
    energy_wh: float | None = Field(
        description="What the flight takes of the battery in watt-hours. Null: not known."
    )
    energy_left_wh: float | None = Field(
        None,
        description="What is left in the battery, reserve included, as the recovery begins, in "
        "watt-hours. Left out where not known."
    )
    recovery_geometry: str | None = Field(
        None, description=f"The flight from its last customer to the recovery, {LINE}"
    )


class TripReply(_Reply):
    """Depot to depot on one loading."""

    load: list[float] = Field(
        description="Load when it begins, drones' parcels too, per dimension."
    )
    load_rate: float = Field(
        description="Highest load at any point / capacity, the largest over dimensions, 0 to 1."
    )
    distance: float = Field(description="Distance driven in metres.")
    duration: float = Field(description="From first departure or take-off to the end in seconds.")
    stops: list[StopReply] = Field(description="Stops in order, the depot first and last.")
    sorties: list[SortieReply] = Field(description="Drone flights of this trip.")
    energy_wh: float | None = Field(
        description="What its flights take in watt-hours. Null: not known, or there are none."
    )
    charging: list[ChargingReply] | None = Field(
        None, description="When its vehicle is charged before it, in order. Left out where it "
        "isn't, or its depot has places enough."
    )


class RouteReply(_Reply):
    """One vehicle's work."""

    vehicle: str = Field(description="Name of the vehicle, `<type>-<number>`.")
    type: str = Field(description="Id of the vehicle type.")
    working_duration: float = Field(
        description="From first departure to last return in seconds, waiting included."
    )
    working_rate: float | None = Field(
        description="Working duration / longest without overtime, above 1 only with it. Null "
        "without a longest."
    )
    overtime: float = Field(
        description="Seconds past the end of the shift or the longest working duration, the longer."
    )
    cost: float = Field(description="Cost of the vehicle and its drones.")
    trips: list[TripReply] = Field(description="Trips in order.")


class UnassignedReply(_Reply):
    """A customer, or a shipment, that no vehicle serves."""

    kind: Literal["customer", "shipment"] = Field(
        "customer", description="What it is; left out for customers.")
    id: str = Field(description="Id of the customer or the shipment.")
    parts: list[str] = Field(
        [], description="Ids of the shipment's `pickups`; left out if it has but one pickup.")
    reasons: list[ReasonReply] = Field(
        description="Reasons by vehicle type; none where `unexplained` counts the customer.")


class LoadRateReply(_Reply):
    """Load rates over all trips, 0 to 1; all 0 without trips."""

    min: float = Field(description="Smallest.")
    mean: float = Field(description="Mean.")
    max: float = Field(description="Largest.")


class SummaryReply(_Reply):
    """The plan in numbers."""

    customers: int = Field(
        description="Customers of the request; each end of a shipment counts as one.")
    served: int = Field(description="Customers served.")
    must_unserved: int = Field(
        description="Customers left out who must be served, as no `unassigned_cost` holds for them."
    )
    vehicles: int = Field(description="Vehicles used.")
    vehicles_lacking: int = Field(
        description="How many fewer that is than `fairness.min_vehicles` asks for.")
    trips: int = Field(description="Trips of all vehicles.")
    sorties: int = Field(description="Drone flights.")
    distance: float = Field(description="Distance driven in metres.")
    drone_distance: float = Field(description="Distance flown in metres.")
    energy_wh: float | None = Field(
        description="What all flights take in watt-hours. Null: not known, or there are none."
    )
    load_rate: LoadRateReply = Field(description="Load rates of the trips.")
    makespan: InstantReply = Field(description="Last return of any vehicle.")
    co2_kg: float | None = Field(
        description="CO2 of trucks' kilometres and drones' energy in kilograms, as far as vehicle "
        "types state it. Null if none does."
    )


class ElapsedReply(_Reply):
    """Where the time went, in seconds."""

    validate_: float = Field(alias="validate", description="Reading and checking the request.")
    decode: float = Field(description="The policy's plan.")
    search: float = Field(description="Its improvement.")
    check: float = Field(description="The independent check.")
    total: float = Field(description="From the last byte received to the reply, queueing included.")


class SolverReply(_Reply):
    """How the plan was made."""

    policy: str = Field(description="Policy that was asked for.")
    decoding: str = Field(description="How its decisions were taken.")
    seed: int = Field(description="Seed of all random draws.")
    start: Literal["policy", "insertion", "given"] = Field(
        description="What the search began with: the policy's plan, one made by insertion where "
        "the policy would take too much of `time_limit`, or one given with the request."
    )
    decoded_cost: float = Field(description="Cost of the plan that the search began with.")
    final_cost: float = Field(description="Cost of this plan.")
    search_iterations: int = Field(
        description="Iterations of the search, of all its threads together."
    )
    threads: int = Field(description="Threads of the search.")
    deterministic: bool = Field(
        description="True if the same request gets the same plan again, with as many threads: all "
        "iterations asked for were made, or none was. False if the clock ended the search."
    )
    plans_refused: int = Field(
        description="Plans on the way that broke a rule, for which this one stands: please report."
    )
    elapsed: ElapsedReply = Field(description="Seconds by phase.")


class LoadDimensionReply(_Reply):
    """What a dimension of the load is."""

    name: str = Field(description="Its name.")
    unit: str = Field(description="Its unit.")


class WarningReply(_Reply):
    """What is allowed and is hardly meant."""

    code: str = Field(
        description="Stable name of the warning; `/guide/use/warnings/` lists them.")
    message: str = Field(description="What was seen, what it would mean and what to write instead.")
    path: str = Field(description="Where it was seen first, such as `$.customers[3].location`.")


class WarningsReply(_Reply):
    """What looks wrong with a valid request."""

    warnings: list[WarningReply] = Field(description="Warnings; none: nothing looks wrong.")


WARNINGS_TEXT = "What looks wrong with the request, though it is valid."


class AddressReply(_Reply):
    """Where an address of the request is."""

    path: str = Field(description="Where it is in the request: `$.customers[3].location`.")
    address: str = Field(description="As stated.")
    location: tuple[float, float] = Field(description="`[longitude, latitude]` that was found.")
    label: str = Field(description="What was found there, in the geocoder's words.")
    quality: Literal["house", "interpolated", "street", "town"] = Field(
        description="The house itself or a named place, a point between the houses next to it, the "
        "street alone, or something larger."
    )
    by: str = Field(description="The geocoder: `extract`, `nominatim`, `photon` or `pelias`.")
    doubt: str | None = Field(description="Why it may be wrong, in words. Null: nothing speaks so.")


class PlanReply(_Reply):
    """A plan that passed the independent check."""

    plan_start: str | None = Field(
        None, description="As the request states it. Left out if it doesn't; so the next three.")
    time_zone: str | None = Field(None, description="Zone of the plan's wall clock.")
    currency: str | None = Field(None, description="What costs are in.")
    load_dimensions: list[LoadDimensionReply] | None = Field(
        None, description="What the dimensions of loads are.")

    status: Literal["complete", "partial"] = Field(
        description="`partial` if customers stay unassigned."
    )
    cost: CostReply = Field(description="Cost by term.")
    routes: list[RouteReply] = Field(description="One entry per vehicle used.")
    unassigned: list[UnassignedReply] = Field(description="Customers left out, with reasons.")
    unexplained: int | None = Field(
        None,
        description="How many of `unassigned`, the last ones, have no reasons since those before "
        "have 10,000 already. Left out if all have theirs.",
    )
    summary: SummaryReply = Field(description="The plan in numbers.")
    solver: SolverReply = Field(description="How the plan was made.")
    lateness: LatenessRiskReply | None = Field(
        None, description=f"What is to be expected of promises. {RISK_TEXT}")
    legs: list[LegsReply] = Field(
        [], description="What the legs are made of, an entry for each profile used."
    )
    warnings: list[WarningReply] = Field([], description=WARNINGS_TEXT)
    addresses: list[AddressReply] | None = Field(
        None, description="Where the request's addresses are. Left out if it has none."
    )
    energy_models: list[EnergyModelReply] | None = Field(
        None, description="Presets of drones' energy. Left out if none was named."
    )
    hubs: list[HubReply] | None = Field(
        None, description="What is left at depots that state `batteries` or `chargers`. Left out "
        "if none does."
    )
    airspace: AirspaceReply | None = Field(
        None, description="What flights keep to. Left out without a `buffer`."
    )
    rules: list[PublishedRuleReply] | None = Field(
        None, description="Published rules that drones name. Left out if none was named."
    )
    driving_rules: list[DrivingLawReply] | None = Field(
        None, description="Published driving rules that are named. Left out if none was."
    )
    replan: ReplanReply | None = Field(
        None, description="What became of the plan given. Left out if none was."
    )
    outlook: list[OutlookReply] | None = Field(
        None, description="Who leaves now and who waits, of all who aren't aboard yet. Left out "
        "without a `forecast`.")


class LivenessReply(_Reply):
    """The process runs."""

    status: Literal["live"] = Field(description="Always the same.")


class ReadinessReply(_Reply):
    """Whether plans can be computed now."""

    status: Literal["ready", "starting", "stopping", "unavailable"] = Field(
        description="`ready` if all plans can be computed; `unavailable` while the database's "
        "tables don't fit this version, or keys are needed and can't be read."
    )
    detail: str = Field(description="The same in words.")
