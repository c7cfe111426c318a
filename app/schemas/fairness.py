"""What a plan costs as a whole: fairness, and changes of the plan before."""

from typing import Literal

from pydantic import Field

from app.schemas.fields import Input, Money
from app.schemas.limits import MAX_VEHICLES


class BalanceInput(Input):
    """What unequal work of vehicles costs."""

    measure: Literal["duration", "stops", "load", "distance"] = Field(
        description="What of each vehicle used is compared: its working `duration` in hours, "
        "customers served by the truck (`stops`), first dimension brought and picked up, drones' "
        "too (`load`), or km driven (`distance`).")
    cost: Money = Field(
        description="Cost of the sum, over vehicles used, of (measure - mean)² / mean.")


class ChangeCostsInput(Input):
    """What changes of a plan gone on from cost."""

    vehicle: Money = Field(
        0.0, description="For each order that another vehicle serves than before, unless that "
        "vehicle is unavailable.")
    position: Money = Field(
        0.0, description="For each order that changes places in its vehicle's route, the fewest "
        "that tell the new order, or between the truck and its drones.")
    promise_per_minute: Money = Field(
        0.0, description="For each minute that an order is reached sooner or later than "
        "`replan.promised` says, or the plan before.")


class ChangeLimitsInput(Input):
    """What of a plan gone on from may change at all."""

    new_orders: Literal["anywhere", "behind"] = Field(
        "anywhere", description="Where new orders may come: `anywhere` in a route, or only "
        "`behind` all whom its vehicle served in the plan before.")
    vehicles: Literal["any", "concerned"] = Field(
        "any", description="Whose orders may move: those of `any` vehicle, or those of the "
        "vehicles in `replan.concerned`, and within these vehicles' routes alone. All others keep "
        "their vehicle and their place in its order, unless it is unavailable.")


class FairnessInput(Input):
    """What a plan costs as a whole, beside what its routes cost."""

    makespan_cost_per_hour: Money = Field(
        0.0, description="Cost per hour from plan start to the latest end of any vehicle.")
    balance: BalanceInput | None = Field(
        None, description="What unequal work costs. Null: nothing.")
    min_vehicles: int = Field(
        0, ge=0, le=MAX_VEHICLES,
        description="Least number of vehicles to use, whatever that costs; as many as there are "
        "customers and shipments, if they are fewer. Where no plan does, "
        "`summary.vehicles_lacking` says so.")
