"""What vehicles have done of the work before a problem begins, as the engine reads it."""

from model.engine.records import Records
from model.problem import Problem

UNUSED = -1
"""Stands for what a vehicle has done that isn't used yet."""


def write_shares(problem: Problem, types: Records) -> None:
    """Write what vehicles have done that are used already. In place."""
    for vehicle in problem.fairness.before:
        for kind in vehicle.kinds:
            types[kind]["share_before"] = vehicle.share
