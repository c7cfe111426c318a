"""All warnings about one request."""

from collections.abc import Collection

from app.requests.ends import stated_path
from app.requests.warnings.fleets import fleet_warnings
from app.requests.warnings.matrices import matrix_warnings
from app.requests.warnings.places import crow_warnings, place_warnings
from app.requests.warnings.roads import road_warnings
from app.requests.warnings.rulebook import law_warnings, rule_warnings
from app.requests.warnings.survey import Survey
from app.requests.warnings.times import time_warnings
from app.requests.warnings.warning import RequestWarning
from app.requests.warnings.winds import wind_warnings
from app.schemas.request import PlanRequest


def warnings_of(request: PlanRequest,
                road_profiles: Collection[str] = ()) -> tuple[RequestWarning, ...]:
    """Return what looks wrong with a valid request, in time linear in its size.

    Parameters
    ----------
    road_profiles
        Profiles for which the service has roads.
    """
    survey = Survey(request, frozenset(road_profiles))
    found = (*place_warnings(survey), *time_warnings(survey), *fleet_warnings(survey),
             *matrix_warnings(survey), *crow_warnings(survey), *road_warnings(survey),
             *wind_warnings(survey), *rule_warnings(survey), *law_warnings(survey))
    return tuple([each._replace(path=stated_path(request, each.path)) for each in found])
