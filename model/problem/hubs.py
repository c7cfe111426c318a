"""What vehicles that fly share at depots."""

from model.problem.fleet import VehicleType
from model.problem.problem import Problem


def shares_chargers(problem: Problem, kind: VehicleType) -> bool:
    """Tell whether a type's vehicles are charged where there may be too few places."""
    return kind.flies and not kind.takes_batteries and any(
        problem.depots[node].chargers is not None for node in kind.reload_places)


def limits_chargers(problem: Problem) -> bool:
    """Tell whether any vehicles are charged where there may be too few places."""
    return any(shares_chargers(problem, kind) for kind in problem.vehicle_types)
