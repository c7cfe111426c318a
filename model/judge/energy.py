"""What sorties take of a drone's battery. Energies in µJ, plain Python integers."""

from bisect import bisect_right
from collections.abc import Sequence

from model.problem import DroneType, Energy, Problem
from model.solution import Sortie, Trip


def power_at(energy: Energy, powers: Sequence[int], weight: int) -> int:
    """Return a power in mW with so much aboard, rounded down; none is negative."""
    weights = energy.weights
    upper = min(bisect_right(weights, weight), len(weights) - 1)
    lower = upper - 1
    rise = (powers[upper] - powers[lower]) * (weight - weights[lower])
    return max(0, powers[lower] + rise // (weights[upper] - weights[lower]))


def leg_energy(energy: Energy, duration: int, weight: int) -> int:
    """Return what a leg takes, climb and descent included, with so much aboard."""
    flight = max(0, duration - energy.climb_duration - energy.descent_duration)
    return (power_at(energy, energy.climb, weight) * energy.climb_duration
            + power_at(energy, energy.cruise, weight) * flight
            + power_at(energy, energy.descent, weight) * energy.descent_duration)


def hover_energy(energy: Energy, duration: int, weight: int) -> int:
    """Return what hovering takes with so much aboard."""
    return power_at(energy, energy.hover, weight) * duration


def weights_aboard(problem: Problem, energy: Energy, nodes: Sequence[int]) -> list[int]:
    """Return what is aboard on each leg of a sortie to some customers, the way home last."""
    customers = [problem.customer_at(node) for node in nodes]
    weights = [sum([customer.demand[energy.dimension] for customer in customers])]
    for customer in customers:
        weights.append(weights[-1] - customer.demand[energy.dimension]
                       + customer.taken_in[energy.dimension])
    return weights


def sortie_energy(problem: Problem, drones: DroneType, energy: Energy, trip: Trip,
                  sortie: Sortie) -> int:
    """Return what a sortie takes: its legs, and the time that it waits in the air."""
    duration = problem.travel[drones.travel].duration
    nodes = [visit.node for visit in sortie.visits]
    aboard = weights_aboard(problem, energy, nodes)
    node, time, taken = trip.stops[sortie.launch_stop].node, sortie.launch_time, 0
    for visit, weight in zip(sortie.visits, aboard, strict=False):
        taken += leg_energy(energy, duration.item(node, visit.node) + visit.setup, weight)
        if not energy.lands:
            taken += hover_energy(energy, visit.departure - visit.ready, weight)
        node, time = visit.node, visit.departure
    home = duration.item(node, trip.stops[sortie.recovery_stop].node)
    return (taken + leg_energy(energy, home, aboard[-1])
            + hover_energy(energy, sortie.recovery_start - time - home, aboard[-1]))


def longest_hold(problem: Problem, energy: Energy, nodes: Sequence[int], legs: Sequence[int],
                 services: Sequence[int]) -> int | None:
    """Return in how long windows may let a sortie be back, by what it takes to hover for them.

    That is reckoned with the most that is aboard at a customer; `legs` and `services` are the
    durations. None if waiting for windows takes nothing, or the flight itself too much.
    """
    aboard = weights_aboard(problem, energy, nodes)
    most = power_at(energy, energy.hover, max(aboard))
    if energy.lands or most == 0:
        return None
    taken = sum([leg_energy(energy, leg, weight)
                 for leg, weight in zip(legs, aboard, strict=True)])
    taken += sum([hover_energy(energy, service, weight)
                  for service, weight in zip(services, aboard, strict=False)])
    if taken > energy.available:
        return None
    return sum(legs) + sum(services) + (energy.available - taken) // most
