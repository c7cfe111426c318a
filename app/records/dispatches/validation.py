"""Whether a plan can be driven as it stands."""

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
    if errors:
        raise InvalidRequestError(errors)
