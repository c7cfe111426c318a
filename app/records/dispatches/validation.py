"""Whether a plan can be driven as it stands."""

from collections.abc import Iterator

from app.requests.plan_departed import is_there
from app.requests.plan_names import Names
from app.requests.plan_validation import replan_errors
from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.plan import PlanInput
from app.schemas.request import PlanRequest, ReplanInput

MOST_VEHICLES = 500
"""As many as may be under way when a plan is gone on from."""

GIVEN = "$.replan.plan"
"""Where errors are told of that a plan to go on from has."""


def require_drivable(problem: PlanRequest, plan: PlanInput) -> None:
    """Make sure that a plan's trips lead from place to place and meet their drones.

    Raises
    ------
    InvalidRequestError
        With every error, if they don't.
    """
    if len(plan.routes) > MOST_VEHICLES:
        message = f"At most {MOST_VEHICLES} vehicles have links: send out parts of the plan."
        raise InvalidRequestError([
            InputError(code="TOO_MANY_VEHICLES", path="$.plan.routes", message=message)])
    names = Names.of(problem.depots, problem.customers, problem.fleet)
    errors = [error.model_copy(update={"path": error.path.replace(GIVEN, "$.plan", 1)})
              for error in replan_errors(ReplanInput(plan=plan), names)]
    errors += _gone(plan, problem)
    if errors:
        raise InvalidRequestError(errors)


def _gone(plan: PlanInput, problem: PlanRequest) -> Iterator[InputError]:
    """Yield the vehicles and depots of a plan that aren't there: nobody could drive them."""
    fleet, depots = {kind.id: kind for kind in problem.fleet}, {each.id for each in problem.depots}
    for index, route in enumerate(plan.routes):
        path = f"$.plan.routes[{index}]"
        if route.type not in fleet:
            yield InputError(code="UNKNOWN_VEHICLE_TYPE", path=f"{path}.type",
                             message=f"The fleet has no type {route.type!r}: use the id of one.")
        elif not is_there(route, fleet):
            yield InputError(code="UNKNOWN_VEHICLE", path=f"{path}.vehicle",
                             message=f"The fleet has {fleet[route.type].count} of this type: raise "
                             "its count.")
        for number, trip in enumerate(route.trips):
            for place, stop in enumerate(trip.stops):
                if stop.kind == "depot" and stop.id not in depots:
                    yield InputError(code="UNKNOWN_DEPOT",
                                     path=f"{path}.trips[{number}].stops[{place}].id",
                                     message=f"No depot has the id {stop.id!r}: use one's id.")
