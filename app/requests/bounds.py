"""How much one request may ask for, by the settings."""

from collections.abc import Iterator
from dataclasses import dataclass

from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.travels import Travels
from app.requests.draft import Draft
from app.schemas.errors import InputError
from app.schemas.limits import MAX_CUSTOMERS, MAX_LEGS, MAX_NUM_SAMPLES, MAX_TIME_LIMIT
from app.schemas.request import PlanRequest, ReplanInput
from app.serving.settings import Settings
from model.planner import DECODED_UP_TO, decoding_seconds
from model.replanning.workers import MAX_OWN_TYPES

PLAN_SECONDS = "TANDEM_MAX_PLAN_SECONDS"

@dataclass(frozen=True)
class Bounds:
    """The largest request that is answered; without settings, the largest that fits the schema."""

    customers: int = MAX_CUSTOMERS
    num_samples: int = MAX_NUM_SAMPLES
    time_limit: float = MAX_TIME_LIMIT  # seconds
    time_setting: str = PLAN_SECONDS  # where it comes from
    legs: int = MAX_LEGS
    on_roads: bool = False  # whether profiles may have roads

    @classmethod
    def of_plans(cls, settings: Settings) -> "Bounds":
        """Return the bounds of `POST /plan`."""
        return cls(settings.max_customers, settings.max_num_samples, settings.max_plan_seconds,
                   legs=settings.max_legs, on_roads=settings.roads is not None)


UNBOUNDED = Bounds()


def bound_errors(draft: Draft, bounds: Bounds) -> Iterator[InputError]:
    """Yield an error for each bound that a request exceeds."""
    number = len(draft.customers or ())
    if number > bounds.customers:
        yield InputError(
            code="WRONG_LENGTH", path="$.customers",
            message=f"There are {number} customers, and this service takes {bounds.customers} at "
            "most (TANDEM_MAX_CUSTOMERS): remove some.")
    options = draft.options
    if options is None:
        return
    if options.num_samples > bounds.num_samples:
        yield InputError(
            code="OUT_OF_RANGE", path="$.options.num_samples",
            message=f"This service draws {bounds.num_samples} samples at most "
            "(TANDEM_MAX_NUM_SAMPLES): lower the number.")
    if options.time_limit > bounds.time_limit:
        yield InputError(
            code="OUT_OF_RANGE", path="$.options.time_limit",
            message=f"This service takes {bounds.time_limit:g} s at most ({bounds.time_setting}): "
            "lower it" + (", or submit a job." if bounds.time_setting == PLAN_SECONDS else "."))
    samples = options.num_samples if options.decoding == "sample" else None
    seconds = decoding_seconds(number, samples)
    # A stated time limit cuts samples short; without one, all of them are drawn.
    draws_all = (number <= DECODED_UP_TO
                 and 0 in (options.time_limit, options.search_iterations))
    if draws_all and seconds > bounds.time_limit:
        yield InputError(
            code="OUT_OF_RANGE", path="$.options",
            message=f"The policy's plan takes about {seconds:.0f} s, and this service takes "
            f"{bounds.time_limit:g} s at most ({bounds.time_setting}): lower num_samples, or state "
            "a time_limit and no search_iterations of 0.")


def leg_errors(request: PlanRequest, bounds: Bounds) -> Iterator[InputError]:
    """Yield an error if the matrices of a valid request would take too much memory."""
    placed = PlacedRequest(request)
    kinds, places = Travels(placed).count(bounds.on_roads), placed.num_nodes
    legs = kinds * places**2
    once_more = ""
    if request.replan is not None:
        left = places + _most_under_way(request.replan)
        legs += kinds * left**2
        once_more = f", and {left} at most where the plan given goes on"
    if legs > bounds.legs:
        yield InputError(
            code="TOO_MANY_LEGS", path="$.fleet",
            message=f"The fleet travels in {kinds} ways, by speed and profile, between {places} "
            f"places{once_more}: {legs} legs, and this service holds {bounds.legs} at most "
            "(TANDEM_MAX_LEGS): give vehicle types the same speed, or send fewer customers.")


def _most_under_way(replan: ReplanInput) -> int:
    """Return how many vehicles may be under way, each at a place of its own."""
    return 0 if replan.freeze_before is None else min(len(replan.plan.routes), MAX_OWN_TYPES)
