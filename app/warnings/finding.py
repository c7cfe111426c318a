"""All warnings about one request."""

from collections.abc import Collection

from app.schemas.request import PlanRequest
from app.warnings.fleets import fleet_warnings
from app.warnings.matrices import matrix_warnings
from app.warnings.places import crow_warnings, place_warnings
from app.warnings.survey import Survey
from app.warnings.times import time_warnings
from app.warnings.warning import RequestWarning


def warnings_of(request: PlanRequest,
                road_profiles: Collection[str] = ()) -> tuple[RequestWarning, ...]:
    """Return what looks wrong with a valid request, in time linear in its size.

    Parameters
    ----------
    road_profiles
        Profiles for which the service has roads.
    """
    survey = Survey(request, frozenset(road_profiles))
    return (*place_warnings(survey), *time_warnings(survey), *fleet_warnings(survey),
            *matrix_warnings(survey), *crow_warnings(survey))
