"""When a leg ends that takes longer at some hours, and in which window a customer is served.

Times in ms, plain Python integers.
"""

from bisect import bisect_left, bisect_right
from dataclasses import replace
from itertools import pairwise

from model.problem import FULL_SPEED, Customer, Problem, SpeedProfile
from model.solution import Solution, Trip, Visit

MS_PER_MINUTE = 60_000


def leg_end(departure: int, duration: int, profile: SpeedProfile | None) -> int:
    """Return when a leg of a matrix duration ends, rounded up to a millisecond."""
    return work_end(departure, duration * FULL_SPEED, profile)


def work_between(begin: int, end: int, profile: SpeedProfile | None) -> int:
    """Return how much is driven from one instant to another, in ms times the factor of speed."""
    if profile is None:
        return (end - begin) * FULL_SPEED
    times = [begin, *(time for time in profile.times if begin < time < end), end]
    return sum([(until - since) * profile.factors[bisect_right(profile.times, since)]
                for since, until in pairwise(times)])


def work_end(departure: int, work: int, profile: SpeedProfile | None) -> int:
    """Return when so much is driven, as `work_between` counts it, rounded up to a millisecond."""
    if profile is None:
        return departure - -work // FULL_SPEED
    time = departure
    for change in range(bisect_right(profile.times, departure), len(profile.times)):
        until_change = (profile.times[change] - time) * profile.factors[change]
        if work <= until_change:
            return time - -work // profile.factors[change]
        work -= until_change
        time = profile.times[change]
    return time - -work // profile.factors[-1]


def leg_start(arrival: int, duration: int, profile: SpeedProfile | None) -> int:
    """Return the latest departure whose leg ends no later than `arrival`."""
    if profile is None:
        return arrival - duration
    work = duration * FULL_SPEED
    time = arrival
    for change in range(bisect_left(profile.times, arrival) - 1, -1, -1):
        since_change = (time - profile.times[change]) * profile.factors[change + 1]
        if work <= since_change:
            return time + -work // profile.factors[change + 1]
        work -= since_change
        time = profile.times[change]
    return time + -work // profile.factors[0]


def opening(customer: Customer, arrival: int) -> int:
    """Return the beginning of the window in which whoever comes at `arrival` is served."""
    opens = customer.earliest
    for closes, reopens in customer.gaps:
        if arrival > closes:
            opens = reopens
    return opens


def service_start(customer: Customer, arrival: int) -> int:
    """Return when service begins; whoever is early, or comes between two windows, waits."""
    return max(arrival, opening(customer, arrival))


def closing(customer: Customer, start: int) -> int:
    """Return the last arrival in the window in which service starts that is not late."""
    for closes, reopens in customer.gaps:
        if start < reopens:
            return closes
    return customer.latest


def window_of(customer: Customer, start: int) -> int | None:
    """Return which of several windows service that starts then is in; None: there is but one."""
    if not customer.gaps:
        return None
    return sum([start >= reopens for _, reopens in customer.gaps])


def with_setups(problem: Problem, node: int, visits: tuple[Visit, ...]) -> tuple[Visit, ...]:
    """Return visits that are known, the first by who comes from a node, with their setups."""
    origins = (node, *(visit.node for visit in visits))
    return tuple(replace(visit, setup=problem.setup_between(origin, visit.node))
                 for origin, visit in zip(origins, visits, strict=False))


def with_all_setups(problem: Problem, solution: Solution) -> Solution:
    """Return a plan as it is stated, which may break any rule, with all its setups."""
    if not any(customer.setup_duration for customer in problem.customers):
        return solution
    return replace(solution, routes=tuple([
        replace(route, trips=tuple([_set_up(problem, trip) for trip in route.trips]))
        for route in solution.routes]))


def _set_up(problem: Problem, trip: Trip) -> Trip:
    stops = (*trip.stops[:1], *(
        replace(stop, setup=problem.setup_between(before.node, stop.node))
        for before, stop in pairwise(trip.stops)))
    return replace(trip, stops=stops, sorties=tuple([
        replace(sortie, visits=with_setups(problem, stops[sortie.launch_stop].node, sortie.visits))
        if 0 <= sortie.launch_stop < len(stops) else sortie for sortie in trip.sorties]))
