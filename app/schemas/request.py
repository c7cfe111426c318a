"""What a client may send: the request of `POST /plan`, units in every field.

Numbers must be JSON numbers, unknown fields are refused. What one field alone can't tell, such as
an unknown depot, is checked in `app.requests.validation`.
"""

from typing import Annotated, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from app.schemas.airspace import AirspaceInput
from app.schemas.customer import CustomerInput
from app.schemas.day import Day, Times
from app.schemas.errors import IN_PLACE, IN_WORDS
from app.schemas.fairness import ChangeCostsInput, ChangeLimitsInput, FairnessInput
from app.schemas.fields import (
    LAUNCH_TEXT, LOCATION_INDEX_TEXT, LOCATION_TEXT, MAX_DEPOTS, MAX_LAUNCH_SITES, Approach, Count,
    Input, Instant, LocationIndex, Money, Name, PlaceLocation, Rounding, Table,
)
from app.schemas.lateness import LatenessRiskInput
from app.schemas.forecast import ComingInput
from app.schemas.launch_site import HoursInput, LaunchSiteInput
from app.schemas.limits import (
    DEFAULT_POLICY, MAX_CUSTOMERS, MAX_NUM_SAMPLES, MAX_THREADS, MAX_TIME_LIMIT, MAX_VEHICLES,
)
from app.schemas.plan import PlanInput
from app.schemas.relation import RelationInput
from app.schemas.shipment import ShipmentInput
from app.schemas.times import Currency, PlanStart, TimeZone
from app.schemas.vehicle import VehicleTypeInput
from model.problem import MAX_DIMENSIONS, MOST_INCOMPATIBLE, MOST_RELATIONS

MAX_VEHICLE_TYPES = 100
MAX_SHIPMENTS = MAX_CUSTOMERS // 2


class DepotInput(Input):
    """A place where trips start and end."""

    id: Name = Field(description="Name of the depot, unique among depots.")
    location: PlaceLocation | None = Field(None, description=LOCATION_TEXT)
    location_index: LocationIndex | None = Field(None, description=LOCATION_INDEX_TEXT)
    launch: bool = Field(True, description=LAUNCH_TEXT)
    time_window: HoursInput = Field(
        HoursInput(), description="When trips may begin and end here, and vehicles reload. "
        "Default: at any time.")
    batteries: Count | None = Field(
        None, description="Charged batteries here for vehicles that fly, those in them included. "
        "Each trip that begins here takes one, unless its vehicle is charged. Null: enough.")
    chargers: Count | None = Field(
        None, description="Places to charge here, for vehicles that fly and have `charge_w`. Each "
        "is for one vehicle at a time; others wait for it between trips. Null: enough.")


class MatrixInput(Input):
    """Legs between all places by one kind of vehicle; rows are origins."""

    durations: Table = Field(
        description="Travel durations in seconds, `durations[from][to]`. The diagonal counts only "
        "between two places that share a row. Null: there is no such leg."
    )
    distances: Table | None = Field(
        None,
        description="Distances in metres, `distances[from][to]`, null where `durations` are. Null: "
        "computed from locations.",
    )


class IncompatibleGoodsInput(Input):
    """Goods no two of which may be carried together."""

    goods: Annotated[list[Name], Field(min_length=2, max_length=MOST_INCOMPATIBLE)] = Field(
        description="Names of goods, as customers state them."
    )
    scope: Literal["trip", "vehicle"] = Field(
        "trip",
        description="Whether two may not share one `trip`, or one `vehicle` on all its trips.",
    )


class RoadsInput(Input):
    """How legs on roads are made, where the service has roads."""

    fallback: Literal["great_circle"] | None = Field(
        None,
        description="What legs are made of that no road tells, because a place is off the roads or "
        "they don't answer: `great_circle` times `detour`, at the vehicle type's speed. The "
        "reply's `legs` tells how many are. Null: such requests are refused.",
    )
    detour: Annotated[float, Field(ge=1, le=10)] = Field(
        1.3, description="By how much such legs are longer than the great circle."
    )
    walking_kmh: Annotated[float, Field(ge=0.1, le=100)] = Field(
        5.0,
        description="Speed in km/h between a place and the road nearest to it, where the vehicle "
        "halts.",
    )
    approach: Approach = Field(
        "any", description="How roads lead to customers, their other places and shipments' ends "
        "who don't say it themselves: `any`, or `curb`, on their side of the street.")


class AddressesInput(Input):
    """What is taken for the place of an address."""

    accept: Literal["house", "street", "any"] = Field(
        "street",
        description="`house`: the house itself or a named place, nothing less. `street`: also a "
        "point between houses next to it, or the street alone, which the reply tells. `any`: the "
        "likeliest place, be it a town, one of several, or elsewhere than the address says, which "
        "the reply tells. Other addresses are refused.",
    )


def _tag_of_roads(value: object) -> str:
    return IN_WORDS if isinstance(value, str) else IN_PLACE


Roads = Annotated[
    Annotated[Literal["none"], Tag(IN_WORDS)] | Annotated[RoadsInput, Tag(IN_PLACE)],
    Discriminator(_tag_of_roads),
]


class OptionsInput(Input):
    """How to plan."""

    policy: Name = Field(DEFAULT_POLICY, description="Policy that builds the plan.")
    decoding: Literal["greedy", "sample"] = Field(
        "greedy",
        description="`greedy` takes the likeliest decision each time, for up to 300 customers in "
        "several views of the plane if no search follows; `sample` draws `num_samples` plans, "
        "those of all views among them. The cheapest plan by routes of all is kept. Most plans "
        "that `attention` draws keep a part of the best so far.",
    )
    num_samples: int = Field(64, ge=1, le=MAX_NUM_SAMPLES, description="Plans drawn when sampling.")
    temperature: Annotated[float, Field(ge=0.01, le=100)] = Field(
        1.0,
        description="Above 1 samples more widely, below 1 more narrowly. Samples that keep a part "
        "of the best are drawn at 2 times this, or 1.4 times where drones fly.",
    )
    seed: int = Field(
        0,
        ge=0,
        le=2**63 - 1,
        description="Seed of all random draws. See `search_iterations` for when plans repeat.",
    )
    time_limit: Annotated[float, Field(ge=0, le=MAX_TIME_LIMIT)] = Field(
        1.0,
        description="Seconds until the reply, validation included. 0: the policy's plan as it is. "
        "Where it isn't stated, the time in which roads and geocoders answer comes on top.",
    )
    search_iterations: Annotated[int, Field(ge=0, le=10**12)] | None = Field(
        None,
        description="Iterations of the search, of all its threads together. Null: until "
        "`time_limit`. 0: the policy's plan as it is. If stated, the same request with the same "
        "`seed` and number of threads gets the same plan, unless `time_limit` ends the search "
        "first; the reply's `solver.deterministic` tells.",
    )
    threads: Annotated[int, Field(ge=1, le=MAX_THREADS)] | None = Field(
        None,
        description="Threads of the search. Null: as the service's setting "
        "`TANDEM_SEARCH_THREADS` says, usually one. No more are used than the machine has cores; "
        "the reply's `solver.threads` tells how many.",
    )
    times: Times | None = Field(
        None,
        description="How the reply tells instants: `seconds` since plan start, `iso`, such as "
        "`2026-03-29T07:30:00+02:00`, or `clock`, such as `07:30:00` and, on the next day, `+1 "
        "07:30:00`. Lengths of time are always seconds. Null: `iso` with `plan_start`, else "
        "`seconds`.",
    )
    geometry: bool = Field(
        False,
        description="Whether the reply has the line of each leg and flight, `geometry`, for maps "
        "to draw.",
    )
    lateness_risk: LatenessRiskInput | None = Field(
        None, description="How times spread around the planned ones: stops then tell their chance "
        "of being late. Null: everything lasts as long as planned.")
    change_costs: ChangeCostsInput | None = Field(
        None,
        description="What changes of the plan in `replan` cost. Null: nothing.",
    )
    change_limits: ChangeLimitsInput = Field(
        ChangeLimitsInput(), description="What of the plan in `replan` may change at all.")


class LoadDimensionInput(Input):
    """What a dimension of the load is."""

    name: Name = Field(description="Its name, such as `weight`.")
    unit: Annotated[str, Field(max_length=50)] = Field("", description="Its unit, such as `kg`.")


LoadDimensions = Annotated[
    list[LoadDimensionInput], Field(min_length=1, max_length=MAX_DIMENSIONS)]


class ReplanInput(Input):
    """A plan to go on from, and what of it stays."""

    plan: PlanInput = Field(
        description="A plan that `POST /plan` replied, unchanged or cut down. Customers whom it "
        "lacks are new orders; customers whom the request lacks are cancelled."
    )
    freeze_before: Instant | None = Field(
        None,
        description="Now, in seconds since plan start: what has departed by then stays as the plan "
        "says, and vehicles go on from where they are with what they carry. Null: nothing has "
        "happened yet; the plan is where the search begins.",
    )
    pinned: Annotated[list[Name], Field(max_length=MAX_CUSTOMERS)] = Field(
        [], description="Customers who stay with their vehicles; if need be, they are left out."
    )
    pin_all: bool = Field(
        False, description="Whether all customers of the plan stay with their vehicles."
    )
    keep_order: bool = Field(
        False,
        description="Whether pinned customers keep their places in the order, too: whom their "
        "truck serves before one of them in the plan given, nobody serves after, and the other "
        "way round. New ones may come between.",
    )
    unavailable: Annotated[list[Name], Field(max_length=MAX_VEHICLES)] = Field(
        [],
        description="Vehicles, such as `truck-2`, that do nothing more from `freeze_before` on; "
        "whom they haven't begun to serve by then others serve. Drones, such as "
        "`truck-2/drone-1`, that are launched no more; flights that have begun end as planned.",
    )
    parcels_back: Instant | None = Field(
        None,
        description="When the parcels aboard unavailable vehicles are at the depots again, in "
        "seconds since plan start. Null: at `freeze_before`.",
    )
    doubtful: Annotated[list[Name], Field(max_length=MAX_CUSTOMERS)] = Field(
        [],
        description="Customers of whom nobody told whether they were served, as "
        "`GET /dispatches/{id}/replan` has them. Planning doesn't look at it; the reply repeats "
        "those who are held to be served.",
    )
    concerned: Annotated[list[Name], Field(max_length=MAX_VEHICLES)] = Field(
        [], description="Vehicles whose routes may change where `options.change_limits.vehicles` "
        "is `concerned`.")
    promised: Annotated[dict[Name, Instant], Field(max_length=MAX_CUSTOMERS)] = Field(
        {},
        description="When customers were told that they are reached, for "
        "`options.change_costs.promise_per_minute`. Of others the plan tells it, and of those who "
        "are no more it means nothing.",
    )


class PlanRequest(Input):
    """Customers and a fleet."""

    plan_start: PlanStart | None = Field(
        None,
        description="When the plan's seconds begin: a date and time after ISO 8601, with its "
        "offset from UTC, or that of `time_zone`. With it, instants may be stated as times of its "
        "day. Null: only seconds tell when.",
    )
    time_zone: TimeZone = Field(
        None,
        description="Zone of the plan's wall clock by its name in the IANA database, such as "
        "`Europe/Berlin`. Null: the offset of `plan_start`, all day.",
        validate_default=True,
    )
    currency: Currency | None = Field(
        None,
        description="What costs are in, by its code after ISO 4217, such as `EUR`. Replies repeat "
        "it; planning doesn't look at it.",
    )
    load_dimensions: LoadDimensions | None = Field(
        None,
        description="What the dimensions of `demand` and `capacity` are, in their order. Replies "
        "repeat it; planning doesn't look at it.",
    )
    coordinate_system: Literal["planar", "geographic"] = Field(
        "planar", description="What `location` means: planar `[x, y]` or `[longitude, latitude]`."
    )
    planar_unit: Annotated[float, Field(ge=1e-3, le=1e6)] = Field(
        1.0, description="Metres per planar unit."
    )
    planar_rounding: Rounding = Field(
        "exact",
        description="What distances between planar locations become, in planar units: `round` to "
        "whole ones, `trunc` down to whole ones, `dimacs` down to tenths, `thousandths` to the "
        "nearest. Durations follow from them. Flights around no-fly areas or in wind stay exact, "
        "and matrices as they are.",
    )
    depots: Annotated[list[DepotInput], Field(max_length=MAX_DEPOTS)] = Field(
        description="Depots, at least one."
    )
    customers: Annotated[list[CustomerInput], Field(max_length=MAX_CUSTOMERS)] = Field(
        description="Customers to serve; none is allowed and gives an empty plan."
    )
    fleet: Annotated[list[VehicleTypeInput], Field(max_length=MAX_VEHICLE_TYPES)] = Field(
        description="Vehicle types, at least one."
    )
    shipments: Annotated[list[ShipmentInput], Field(max_length=MAX_SHIPMENTS)] = Field(
        [],
        description="Parcels that a truck fetches at one place and brings to another on the same "
        "trip. In plans their ends are stops of kinds `pickup` and `delivery`.",
    )
    launch_sites: Annotated[list[LaunchSiteInput], Field(max_length=MAX_LAUNCH_SITES)] = Field(
        [],
        description="Places where trucks may stop for their drones alone, as often as it pays. In "
        "plans they are stops of kind `launch_site`.",
    )
    matrices: Annotated[dict[Name, MatrixInput], Field(max_length=100)] | None = Field(
        None,
        description="Travel durations and distances by profile, used in place of locations and "
        "speeds.",
    )
    roads: Roads | None = Field(
        None,
        description="Legs on roads, for geographic locations and profiles that `matrices` lacks "
        "and the service has roads for (`TANDEM_ROADS`). `none`: great circles instead.",
    )
    addresses: AddressesInput = Field(
        AddressesInput(),
        description="How locations that are addresses are looked up, where the service has a "
        "geocoder (`TANDEM_GEOCODER`).",
    )
    airspace: AirspaceInput = Field(AirspaceInput(), description="No-fly areas and wind.")
    incompatible_goods: Annotated[list[IncompatibleGoodsInput], Field(max_length=100)] = Field(
        [], description="Goods that must not be carried together; at most 62 names in all."
    )
    fairness: FairnessInput = Field(
        FairnessInput(), description="What the plan costs as a whole: its end, and unequal work.")
    relations: Annotated[list[RelationInput], Field(max_length=2 * MOST_RELATIONS)] = Field(
        [], description="Who goes with whom, and who doesn't."
    )
    unassigned_cost: Money | None = Field(
        None,
        description="Cost of each customer left out who states none. Null: these must be served; "
        "each who isn't costs more than the detour to any customer, and than leaving out all who "
        "state a cost.",
    )
    replan: ReplanInput | None = Field(
        None, description="A plan to go on from. Null: plan from nothing."
    )
    forecast: ComingInput | None = Field(
        None, description="What may come: the reply's `outlook` then says who leaves now, and who "
        "waits and why. Not with shipments, relations, alternatives or fairness.")
    options: OptionsInput = Field(OptionsInput(), description="How to plan.")

    @model_validator(mode="after")
    def _count_more(self) -> Self:
        """Let customers' other places, and ends of shipments, be customers behind those stated."""
        others = [place for customer in self.customers if customer.alternatives
                  for place in customer.others()]
        ends = [end for each in self.shipments for end in each.ends()]
        if others or ends:
            self.__dict__["customers"] = [*self.customers, *others, *ends]
        return self

    @property
    def num_stated(self) -> int:
        """How many customers are stated; places and ends that count as such come behind them."""
        others = [len(customer.alternatives) for customer in self.customers]
        ends = [len(each.named_ends()) for each in self.shipments]
        return len(self.customers) - sum(others) - sum(ends)

    def with_customer(self, customer: CustomerInput) -> Self:
        """Return the request with another customer, the last of those stated."""
        stated = [*self.customers[:self.num_stated], customer]
        others = [place for each in stated for place in each.others()]
        ends = [end for each in self.shipments for end in each.ends()]
        return self.model_copy(update={"customers": [*stated, *others, *ends]})

    @property
    def day(self) -> Day | None:
        """The day of the plan; None if it is not stated."""
        return None if self.plan_start is None else Day.of(self.plan_start, self.time_zone)

    @property
    def times(self) -> Times:
        """How the reply tells instants."""
        if self.options.times is not None:
            return self.options.times
        return "seconds" if self.plan_start is None else "iso"
