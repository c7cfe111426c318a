"""How a problem is searched: which moves there are, and where insertion looks.

`docs/develop/by-problem.md` has a table of what kinds of problems let the search do.
"""

from dataclasses import dataclass

import numpy as np

from model.engine.drone_types import all_kinds
from model.engine.instance import Instance
from model.engine.records import Records
from model.engine.type_rows import WORK_RATES
from model.problem import UNLIMITED, BoolArray, IntArray, Problem, limits_chargers
from model.search.route.layout import MOST_VISITS, Strategy

SCAN_ALL_BELOW = 400
"""Number of customers from which insertions are tried beside neighbours only."""

LEAST_BLINK, MOST_BLINK, BLINKS = 0.01, 0.2, 6.0
"""How often a better place is overlooked: the last by the number of customers squared and that on a
sortie, within the first two. Small problems have so few places that little else would differ from
turn to turn, so that none are kept there where more than distance counts."""


@dataclass(frozen=True)
class Moves:
    """What the search may do beyond inserting customers where they cost least."""

    loops: bool = True  # sorties may end at the stop where they began
    crossings: bool = True  # and at others
    two_opt_star: bool = True  # routes may swap their tails
    resplit: bool = True  # trips with one drone may be split anew
    types: bool = True  # vehicles may drive each other's routes
    small_moves: bool = True  # trips with one drone may be annealed by small moves

    @property
    def flights(self) -> bool:
        """Whether drones may fly."""
        return self.loops or self.crossings


ALL_MOVES = Moves()


def strategy_of(problem: Problem, instance: Instance, moves: Moves, evaluation: Records,
                swap: BoolArray, most_visits: int) -> Strategy:
    """Choose how to search.

    Parameters
    ----------
    problem
        What is planned.
    instance
        The same, packed alone; `grounded` if drones may not fly.
    moves
        What the search may do at all.
    evaluation
        How routes of each type are timed and priced.
    swap
        (type, type) whose vehicles may drive each other's routes, at a cost by distance alone.
    most_visits
        Customers on any sortie; 1 where there are none.
    """
    linked = bool(evaluation["by_distance"].all())
    # Else parts of trips may have ends of shipments alone, or part who goes together.
    whole = not (problem.shipments or problem.keeps_together or problem.lags_across)
    fair = problem.fairness.is_stated
    # Who else has how much work counts wherever somebody is inserted, but to try all vehicles'
    # trips takes too long.
    scan_all = (problem.num_customers < SCAN_ALL_BELOW
                or (fair and all(kind.max_trips == 1 for kind in problem.vehicle_types)))
    blink = _blink(problem, most_visits)
    resplit = moves.resplit and moves.flights and whole and any(
        kind.num_drones == 1 for kind in problem.vehicle_types)
    return Strategy(
        loops=moves.loops, crossings=moves.crossings, two_opt_star=moves.two_opt_star and whole,
        resplit=resplit,
        small_moves=(moves.small_moves and resplit and not fair
                     and _may_be_any_time(problem, instance) and _flights_may_save(instance)),
        swap_vehicles=moves.types and bool(swap.any()),
        change_vehicles=moves.types and len(problem.vehicle_types) > 1 and not linked,
        scan_all=scan_all,
        keep_places=(scan_all and not linked and blink <= LEAST_BLINK
                     and not problem.lags_across and not limits_chargers(problem)),
        give_up_early=not (fair or problem.launch_sites or _may_save(instance, evaluation)),
        fly_shipments=moves.flights and _may_fly_shipments(problem, instance), blink=blink)


def grounded(instance: Instance) -> Instance:
    """Return a packed problem in which no drone flies."""
    types = instance.type.copy()
    types["drones"] = 0
    return instance._replace(type=types, can_fly=np.zeros_like(instance.can_fly))


def visits_of(problem: Problem) -> IntArray:
    """Return how many customers a sortie may have, (row,)."""
    visits = np.array([kind.drones.max_customers_per_sortie if kind.drones else 0
                       for kind, _, _ in all_kinds(problem)], np.int64)
    return np.minimum(visits, min(problem.num_customers, MOST_VISITS))


def _blink(problem: Problem, most_visits: int) -> float:
    """Return how often a better place is overlooked; sorties of several offer many more places."""
    places = most_visits * max(1, problem.num_customers) ** 2
    return min(MOST_BLINK, max(LEAST_BLINK, BLINKS / places))


def _may_fly_shipments(problem: Problem, instance: Instance) -> bool:
    """Tell whether drones may serve some end of a shipment."""
    return bool(instance.can_fly[0][:, [*problem.shipment_at]].any())


def _may_be_any_time(problem: Problem, instance: Instance) -> bool:
    """Tell whether customers may be served whenever that is, beside whomever."""
    place = instance.node[0][:, problem.num_depots:, 0]
    limited = ((place["window_earliest"] > 0) | (place["window_latest"] < UNLIMITED)
               | (place["release"] > 0)).any()
    return not (limited or instance.max_time_aboard.shape[1] or instance.goods.shape[1]
                or instance.setup.shape[1])


def _flights_may_save(instance: Instance) -> bool:
    """Tell whether somebody may be flown to, and time costs, or flying less than driving as far."""
    types, rates = instance.type[0], instance.rate[0]
    dear = rates["drone_distance"] < rates["distance"]
    for name in WORK_RATES:
        dear = dear | (rates[name] > 0)
    flies = (types["drones"] == 1) & instance.can_fly[0].any(axis=1)
    return bool((dear & flies).any())


def _may_save(instance: Instance, evaluation: Records) -> bool:
    """Tell whether to insert a customer may save something, if no detour does.

    What is aboard is driven less far where a trip is split, where a drone more has a fresh battery
    too; and whoever sets up sooner where others have to as well saves their setups.
    """
    types, rates = instance.type[0], instance.rate[0]
    setups = evaluation["timed"] & (instance.setup.shape[1] > 0)
    swapped = types["relaunch_duration"] != types["launch_duration"]
    split = ((rates["load"] > 0) | swapped) & (types["max_trips"] > 1)
    return bool((evaluation["held_back"] | evaluation["retimed"] | split | setups).any())
