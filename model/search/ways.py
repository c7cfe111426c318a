"""What ways cost beside a last end, inside the search alone.

Where only the last vehicle counts, no way would be longer than another for all others: vehicles
that end alike are told apart by few turns, and those with long ways don't get shorter ones.
"""

from model.engine.instance import Instance
from model.problem import MM_PER_KM, MS_PER_HOUR, Problem

WAYS_BY_END = 0.001
"""What ways of all vehicles cost at least, by what as much later a last end does."""


def with_ways_priced(problem: Problem, instance: Instance) -> Instance:
    """Return a packed problem in which ways cost a little where the last end alone does.

    Time would do as well, but for who has to be held back then.
    """
    per_hour = WAYS_BY_END * problem.fairness.makespan_cost_per_hour
    if not per_hour:
        return instance
    per_hour /= max(1, min(sum([kind.count for kind in problem.vehicle_types]),
                           problem.num_customers))
    rate = instance.rate.copy()
    for row, kind in enumerate(problem.vehicle_types):
        duration, distance = problem.travel[kind.travel].longest()
        if distance:
            least = per_hour * (duration / MS_PER_HOUR) / (distance / MM_PER_KM)
            rate["distance"][0, row] = max(rate["distance"][0, row], least)
    return instance._replace(rate=rate)
